"""Pressure along the surface and stresses below it from a mesh of any code.

The mesh is that of a body in plane strain: in a plane, or one layer of elements, as CalculiX makes
of its plane elements. x is the file's first axis. Signs of normal stresses are those of tension."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import numpy as np

from analytic.stress_state import Extremum, StressState
from comparisons.models.level import StressResult
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.scenes.fields import LARGEST, SMALLEST
from comparisons.scenes.studies.answers import AnswerSection
from comparisons.studies.answers.meshes import read_mesh

FEWEST = 5  # points that show a pressure
PLANES = 3  # of nodes of one layer of elements
PART = "RegionId"  # array of pyvista's: what hangs together
SAME = 1e-6  # of the mesh's extent: nodes of one plane
SAME_PLACE = 1e-12  # of the length: x closer than this coincide
FACING = 0.5  # cosine between the normal of a top edge and the way up
OFF_THE_SURFACE = 0.5  # half-widths: farther from the mean line no top is the scene's
# Components of a tensor, along the file's axes, by their number.
ORDERS = {
    3: ("xx", "yy", "xy"),
    4: ("xx", "yy", "zz", "xy"),
    6: ("xx", "yy", "zz", "xy", "yz", "xz"),
    9: tuple(map("".join, product("xyz", repeat=2))),
}
TENSOR = re.compile(r"s|.*(stress|sigma|sigm|sief|cauchy).*")
STEM = "(?:s|si|sig|sigma|stress|cauchystress)"
COMPONENT = re.compile(f"{STEM}((?:[xyz]|[123]){{2}})")
ROW = re.compile(f"{STEM}([xyz])")  # what VTK makes of xx, xy and xz that follow in an Exodus file
OWN = ("sx", "sz", "txz")  # as this project's files have them, z into the body


@dataclass(frozen=True)
class PlaneMesh:
    """The rough body in the project's axes."""

    x: np.ndarray  # (n,) [m]
    z: np.ndarray  # (n,) [m]
    triangles: np.ndarray  # (m, 3)
    stress: StressState  # (n,) [Pa]
    arrays: Mapping[str, np.ndarray]  # as in the file


def read_fields(
    path: Path, source: AnswerSection, problem: Problem
) -> tuple[tuple[np.ndarray, ...], dict[str, object]]:
    """x (n,) [m], pressure and traction (n,) [Pa] along the surface, and the fields of an `Answer`
    that stresses on the window make; of a contact that friction holds none, for the models' are
    those of sliding. Raises ValueError with what is wrong."""
    frictions = problem.scene.load.friction
    friction = frictions[0] if source.friction is None else source.friction
    if friction not in frictions or (source.friction is None and len(frictions) > 1):
        listed = ", ".join(f"{friction:g}" for friction in frictions)
        raise ValueError(f"is of one friction coefficient; allowed is friction = one of {listed}")
    body = _plane_mesh(path, source, friction)
    nodes, pressure, shear = _surface_tractions(body)
    unit = source.unit("stress")
    if source.pressure is not None:
        pressure = unit * _component(body.arrays, source.pressure)[nodes]
    if source.shear is not None:
        name = str(source.shear[0])
        shear = unit * _component(body.arrays, name.removeprefix("-"))[nodes]
        shear = -shear if name.startswith("-") else shear
    x, z = body.x[nodes], body.z[nodes]
    reach = np.abs(x) <= np.abs(problem.extent).max()
    off = float(np.median(np.abs(z[reach]))) if reach.any() else np.inf
    if off > OFF_THE_SURFACE * problem.hertz.half_width:
        raise ValueError(
            f"its surface lies {off:.3g} m off the scene's, or nowhere near x = 0; allowed is "
            "z_origin, x_origin or units that bring it there"
        )
    stresses = {}
    if problem.window is not None and problem.scene.partial_slip is None:
        top = np.argsort(x)
        stresses = _stresses(body, (x[top], z[top]), friction, problem)
    return checked(x, pressure, shear), stresses


def checked(x: np.ndarray, pressure: np.ndarray, *others: np.ndarray) -> tuple[np.ndarray, ...]:
    """Answer in ascending order. Raises ValueError for what is no pressure along a surface."""
    order = np.argsort(x, kind="stable")
    x, pressure, *others = (values[order] for values in (x, pressure, *others))
    if len(x) < FEWEST:
        raise ValueError(f"has {len(x)} points; allowed are {FEWEST} or more along the contact")
    if not max(np.abs(x).max(), np.abs(pressure).max()) <= LARGEST:
        raise ValueError(f"holds an x or a pressure beyond {LARGEST:g} in SI units")
    apart = np.diff(x) > max(SMALLEST, SAME_PLACE * np.ptp(x))
    if not np.all(apart):
        twice = x[:-1][~apart][0]
        raise ValueError(f"has x = {twice:g} m twice; allowed is one pressure at each x")
    if not np.any(pressure):
        raise ValueError("has no pressure but 0; allowed is that of a contact")
    return x, pressure, *others


def _plane_mesh(path: Path, source: AnswerSection, friction: float) -> PlaneMesh:
    """The rough body of a file: what hangs together and lies below the surface."""
    faces = read_mesh(path, source.step).connectivity()
    points = np.asarray(faces.points, dtype=float) * source.unit("length")
    vertical, sign = _up(points, source)
    level, tolerance = points[:, 3 - vertical], SAME * float(np.ptp(points))
    planes = len(np.unique(np.round(level / tolerance)))
    if planes > PLANES:
        raise ValueError(
            f"its nodes stand in {planes} planes along {'xyz'[3 - vertical]}; allowed is a mesh in "
            "a plane, or one layer of elements"
        )
    x, z = points[:, 0] - source.x_origin, source.z_origin - sign * points[:, vertical]
    triangles, part = faces.regular_faces, np.asarray(faces.point_data[PART])
    triangles = triangles[np.all(level[triangles] < level.min() + tolerance, axis=1)]
    below = np.bincount(part, z)[part] > 0.0  # of parts whose nodes, on average, are
    if not below[triangles].any():
        raise ValueError('has no body below its surface; allowed is up = "-y" or such, z_origin')
    used, triangles = np.unique(triangles[below[triangles[:, 0]]], return_inverse=True)
    known = {name: np.asarray(values)[used] for name, values in faces.point_data.items()}
    arrays = {n: v for n, v in known.items() if n != PART and v.dtype.kind in "fiub"}
    stress = source.unit("stress") * np.array(_stress_of(arrays, vertical, sign, friction))
    if not np.all(np.abs(stress) <= LARGEST):
        most = f"allowed is one up to {LARGEST:g} Pa at every node"
        raise ValueError(f"holds a stress that is no number, or too large; {most}")
    return PlaneMesh(x[used], z[used], triangles.reshape(-1, 3), StressState(*stress), arrays)


def _up(points: np.ndarray, source: AnswerSection) -> tuple[int, int]:
    """The axis out of the body, and its sign: the body is what reaches far to one side."""
    if source.up is not None:
        return "xyz".index(source.up[-1]), -1 if source.up.startswith("-") else 1
    vertical = 1 + int(np.argmax(np.ptp(points[:, 1:], axis=0)))
    above, below = points[:, vertical].max(), -points[:, vertical].min()
    if min(above, below) > max(above, below) / 3.0:
        raise ValueError('does not say which way is out of the body; allowed is up = "y" or such')
    return vertical, 1 if below > above else -1


def _stress_of(
    arrays: Mapping[str, np.ndarray], vertical: int, sign: int, friction: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """sx, sz and txz at the points, in the file's unit: whatever the arrays are called."""
    for suffix in ("", f" (friction {friction:g})"):
        if all(name + suffix in arrays for name in OWN):
            return tuple(arrays[name + suffix] for name in OWN)
    components: dict[str, np.ndarray] = {}
    for name, values in arrays.items():
        columns = np.atleast_2d(values.T)
        for axes, column in zip(_axes_of(name, len(columns)), columns, strict=False):
            components.setdefault("".join(sorted(axes)), column)
    up = "xyz"[vertical]
    wanted = ("xx", 2 * up, f"x{up}")
    if any(axes not in components for axes in wanted):
        listed = ", ".join(arrays) or "none"
        raise ValueError(f"holds no stresses in its plane, of {listed}; allowed is S or sxx, …")
    along, out, shear = (components[axes] for axes in wanted)
    return along, out, -sign * shear


def _axes_of(name: str, count: int) -> Sequence[str]:
    """Pairs of axes of an array's components, as xy; none where it is no stress."""
    bare = re.sub(r"[^a-z0-9]", "", name.lower())
    if count == 1:
        match = COMPONENT.fullmatch(bare)
        return [match[1].translate(str.maketrans("123", "xyz"))] if match else []
    if match := ROW.fullmatch(bare):
        return [match[1] + axis for axis in "xyz"]
    return ORDERS.get(count, ()) if TENSOR.fullmatch(bare) else ()


def _component(arrays: Mapping[str, np.ndarray], name: str) -> np.ndarray:
    """An array of numbers, or ARRAY.K, the component K of one, from 0."""
    array, _, column = name.partition(".")
    values = arrays.get(name, arrays.get(array))
    if values is not None and values.ndim == 2 and column.isdecimal():
        values = values[:, int(column)] if int(column) < values.shape[1] else None
    if values is None or values.ndim != 1:
        listed = ", ".join(arrays)
        raise ValueError(f"has no pressure {name}; allowed are {listed}, with .0 for a component")
    return values


def _surface_tractions(body: PlaneMesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Nodes (k,) of the top, the pressure (k,) [Pa] there, minus the normal stress, and the
    traction towards +x."""
    corners = body.triangles[:, [[0, 1, 2], [1, 2, 0], [2, 0, 1]]].reshape(-1, 3)
    _, first, count = np.unique(
        np.sort(corners[:, :2], axis=1), axis=0, return_index=True, return_counts=True
    )
    start, stop, inner = corners[first[count == 1]].T
    normal = np.stack([body.z[start] - body.z[stop], body.x[stop] - body.x[start]])
    inward = np.stack([body.x[inner] - body.x[start], body.z[inner] - body.z[start]])
    normal *= -np.sign(np.sum(normal * inward, axis=0))
    up = normal[1] < -FACING * np.hypot(*normal)
    nodes, at = np.unique([start[up], stop[up]], return_inverse=True)
    nx, nz = (np.bincount(at.ravel(), np.tile(part[up], 2)) for part in normal)
    nx, nz = nx / np.hypot(nx, nz), nz / np.hypot(nx, nz)
    sx, sz, txz = (part[nodes] for part in (body.stress.sx, body.stress.sz, body.stress.txz))
    shear = (sz - sx) * nx * nz + txz * (nx**2 - nz**2)  # along (-nz, nx)
    return nodes, -(sx * nx**2 + 2.0 * txz * nx * nz + sz * nz**2), shear


def _stresses(
    body: PlaneMesh, top: tuple[np.ndarray, np.ndarray], friction: float, problem: Problem
) -> dict[str, object]:
    """Largest values at the nodes in the window, the fields on it, and the nodes' distance.

    top  x and z (k,) [m] of the surface, x ascending"""
    stress, nu, window = body.stress, problem.scene.body.poissons_ratio, problem.window
    inside = window.holds(body.x) & (body.z <= window.z[-1])
    if not inside.any():
        raise ValueError("has no node in the window of [stress]; allowed is one around x = 0")
    shears = {"tau1": stress.tau1, "txz": np.abs(stress.txz), "von_mises": stress.von_mises(nu)}
    nodes = {n: int(np.argmax(np.where(inside, v, -np.inf))) for n, v in shears.items()}
    depths = body.z - np.interp(body.x, *top)
    maxima = {
        name: np.array([shears[name][node], body.x[node], depths[node]])[:, None]
        for name, node in nodes.items()
    }
    extremes = {name: Extremum.highest(largest) for name, largest in maxima.items()}
    beside = body.z[body.triangles[np.any(body.triangles == nodes["tau1"], axis=1)]]
    stress = StressResult(friction, extremes, maxima, _on_window(body, window))
    return {"stress": stress, "depth_spacing": 0.5 * float(np.ptp(beside))}


def _on_window(body: PlaneMesh, window: Window) -> StressState:
    """Stresses (m, k) at the window's points, linear between nodes; none outside the mesh."""
    from matplotlib.tri import LinearTriInterpolator, Triangulation

    mesh, at = Triangulation(body.x, body.z, body.triangles), np.meshgrid(window.x, window.z)
    parts = (body.stress.sx, body.stress.sz, body.stress.txz)
    try:
        fields = [LinearTriInterpolator(mesh, part)(*at).filled(np.nan) for part in parts]
    except RuntimeError as error:
        raise ValueError(f"its elements overlap ({error}); allowed is a mesh of one body") from None
    return StressState(*fields)
