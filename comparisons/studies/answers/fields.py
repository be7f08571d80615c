"""From a mesh of any code to the pressure along the surface and the stresses below it.

The mesh is that of a body in plane strain: in a plane, or one layer of elements, as CalculiX makes
of its plane elements. x is the file's first axis. Signs of normal stresses are those of tension."""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from analytic.stress_state import Extremum, StressState
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.scenes.fields import LARGEST, SMALLEST
from comparisons.scenes.studies.answers import AnswerSection
from comparisons.studies.answers.answer import OutsideStress
from comparisons.studies.answers.meshes import Faces, read_mesh

FEWEST = 5  # points that show a pressure
PLANES = 3  # of nodes of one layer of elements
SAME = 1e-6  # of the mesh's extent: nodes of one plane
SAME_PLACE = 1e-12  # of the length: x closer than this coincide
FACING = 0.5  # cosine between the normal of a top edge and the way up
OFF_THE_SURFACE = 0.5  # half-widths: farther from the mean line no top is the scene's
# Components along the file's axes 0, 1, 2: of a tensor by the number of its components.
ORDERS = {
    3: ((0, 0), (1, 1), (0, 1)),
    4: ((0, 0), (1, 1), (2, 2), (0, 1)),
    6: ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)),
    9: tuple((i, j) for i in range(3) for j in range(3)),
}
TENSOR = re.compile(r"s|.*(stress|sigma|sigm|sief|cauchy).*")
STEM = "(?:s|si|sig|sigma|stress|cauchystress)"
COMPONENT = re.compile(f"{STEM}((?:[xyz]|[123]){{2}})")
ROW = re.compile(f"{STEM}([xyz])")  # what VTK makes of xx, xy and xz that follow in an Exodus file
AXES = {"x": 0, "y": 1, "z": 2, "1": 0, "2": 1, "3": 2}
OWN = ("sx", "sz", "txz")  # as this project's files have them, z into the body


@dataclass(frozen=True)
class PlaneMesh:
    """The rough body in the project's axes."""

    x: np.ndarray  # (n,) [m]
    z: np.ndarray  # (n,) [m]
    triangles: np.ndarray  # (m, 3)
    stress: StressState  # (n,) [Pa]
    # (n,) [Pa] of the arrays that the source names, where it names some
    pressure: np.ndarray | None
    shear: np.ndarray | None


def read_fields(
    path: Path, source: AnswerSection, problem: Problem, window: Window | None
) -> tuple[np.ndarray, np.ndarray, np.ndarray, OutsideStress | None]:
    """x (n,) [m], pressure and traction (n,) [Pa] along the surface, and the stresses on the
    window; of a contact that friction holds none, for the models' are those of sliding.
    Raises ValueError with what is wrong."""
    frictions = problem.scene.load.friction
    friction = frictions[0] if source.friction is None else source.friction
    if friction not in frictions or (source.friction is None and len(frictions) > 1):
        listed = ", ".join(f"{friction:g}" for friction in frictions)
        raise ValueError(f"is of one friction coefficient; allowed is friction = one of {listed}")
    body = plane_mesh(read_mesh(path, source.step), source, friction)
    nodes, pressure, shear = _surface_tractions(body)
    reach = np.abs(body.x[nodes]) <= np.abs(problem.extent).max()
    off = float(np.median(np.abs(body.z[nodes][reach]))) if reach.any() else np.inf
    if off > OFF_THE_SURFACE * problem.hertz.half_width:
        raise ValueError(
            f"its surface lies {off:.3g} m off the scene's, or nowhere near x = 0; allowed is "
            "z_origin, x_origin or units that bring it there"
        )
    x, pressure, shear = checked(body.x[nodes], pressure, shear)
    if window is None or problem.scene.partial_slip is not None:
        return x, pressure, shear, None
    return x, pressure, shear, _stresses(body, nodes, friction, problem, window)


def checked(x: np.ndarray, pressure: np.ndarray, *others: np.ndarray) -> tuple[np.ndarray, ...]:
    """All in ascending order. Raises ValueError for what is no pressure along a surface."""
    order = np.argsort(x, kind="stable")
    x, pressure, *others = (values[order] for values in (x, pressure, *others))
    if len(x) < FEWEST:
        raise ValueError(f"has {len(x)} points; allowed are {FEWEST} or more along the contact")
    if not max(np.abs(x).max(), np.abs(pressure).max()) <= LARGEST:
        raise ValueError(f"holds a place or a pressure beyond {LARGEST:g} in SI units")
    apart = np.diff(x) > max(SMALLEST, SAME_PLACE * np.ptp(x))
    if not np.all(apart):
        twice = x[:-1][~apart][0]
        raise ValueError(f"has x = {twice:g} m twice; allowed is one pressure at each place")
    if not np.any(pressure):
        raise ValueError("has no pressure but 0; allowed is that of a contact")
    return x, pressure, *others


def plane_mesh(faces: Faces, source: AnswerSection, friction: float) -> PlaneMesh:
    """The rough body of a mesh: what hangs together and lies below the surface."""
    points = np.asarray(faces.points, dtype=float) * source.unit("length")
    vertical, sign = _up(points, source)
    level, tolerance = points[:, 3 - vertical], SAME * float(np.ptp(points))
    planes = len(np.unique(np.round(level / tolerance)))
    if planes > PLANES:
        raise ValueError(
            f"its nodes stand in {planes} planes along {'xyz'[3 - vertical]}; allowed is a mesh in "
            "a plane, or one layer of elements"
        )
    triangles = faces.triangles
    triangles = triangles[np.all(level[triangles] < level.min() + tolerance, axis=1)]
    x, z = points[:, 0] - source.x_origin, source.z_origin - sign * points[:, vertical]
    triangles = _below(x, z, triangles)
    used, triangles = np.unique(triangles, return_inverse=True)
    arrays = {name: np.asarray(values)[used] for name, values in faces.arrays.items()}
    unit = source.unit("stress")
    stress = [unit * part for part in _stress_of(arrays, vertical, sign, friction)]
    if not np.all(np.abs(stress) <= LARGEST):
        most = f"allowed is one up to {LARGEST:g} Pa at every node"
        raise ValueError(f"holds a stress that is no number, or too large; {most}")
    pressure = shear = None
    if source.pressure is not None:
        pressure = unit * _component(arrays, source.pressure)
    if source.shear is not None:
        name = str(source.shear[0])
        sense = -unit if name.startswith("-") else unit
        shear = sense * _component(arrays, name.removeprefix("-"))
    shape = x[used], z[used], triangles.reshape(-1, 3)
    return PlaneMesh(*shape, StressState(*stress), pressure, shear)


def _up(points: np.ndarray, source: AnswerSection) -> tuple[int, int]:
    """The axis out of the body, and its sign: the body is what reaches far to one side."""
    if source.up is not None:
        return AXES[source.up[-1]], -1 if source.up.startswith("-") else 1
    vertical = 1 + int(np.argmax(np.ptp(points[:, 1:], axis=0)))
    above, below = points[:, vertical].max(), -points[:, vertical].min()
    if min(above, below) > max(above, below) / 3.0:
        raise ValueError('does not say which way is out of the body; allowed is up = "y" or such')
    return vertical, 1 if below > above else -1


def _below(x: np.ndarray, z: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Triangles of the parts whose middle lies below the surface."""
    ends = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]]]).T
    size = (len(x), len(x))
    _, part = connected_components(coo_array((np.ones(ends.shape[1]), ends), size), directed=False)
    one, other = (
        np.stack([x[triangles[:, k]] - x[triangles[:, 0]], z[triangles[:, k]] - z[triangles[:, 0]]])
        for k in (1, 2)
    )
    area = np.abs(one[0] * other[1] - one[1] * other[0])
    moment = np.bincount(part[triangles[:, 0]], area * z[triangles].mean(axis=1), part.max() + 1)
    kept = triangles[(moment > 0.0)[part[triangles[:, 0]]]]
    if len(kept) == 0:
        raise ValueError('has no body below its surface; allowed is up = "-y" or such, z_origin')
    return kept


def _stress_of(
    arrays: dict[str, np.ndarray], vertical: int, sign: int, friction: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """sx, sz and txz at the points, in the file's unit: whatever the arrays are called."""
    for suffix in ("", f" (friction {friction:g})"):
        if all(name + suffix in arrays for name in OWN):
            return tuple(arrays[name + suffix] for name in OWN)
    components: dict[tuple[int, int], np.ndarray] = {}
    for name, values in arrays.items():
        bare = re.sub(r"[^a-z0-9]", "", name.lower())
        if values.ndim == 2 and (match := ROW.fullmatch(bare)):
            pairs = (tuple(sorted((AXES[match[1]], other))) for other in range(3))
            components |= dict(zip(pairs, values.T, strict=False))
        elif values.ndim == 2 and values.shape[1] in ORDERS and TENSOR.fullmatch(bare):
            for pair, column in zip(ORDERS[values.shape[1]], values.T, strict=True):
                components.setdefault(pair, column)
        elif values.ndim == 1 and (match := COMPONENT.fullmatch(bare)):
            components.setdefault(tuple(sorted(AXES[axis] for axis in match[1])), values)
    wanted = ((0, 0), (vertical, vertical), (0, vertical))
    if any(pair not in components for pair in wanted):
        listed = ", ".join(arrays) or "none"
        raise ValueError(f"holds no stresses in its plane, of {listed}; allowed is S or sxx, …")
    along, out, shear = (components[pair] for pair in wanted)
    return along, out, -sign * shear


def _component(arrays: dict[str, np.ndarray], name: str) -> np.ndarray:
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
    nodes = np.unique([start[up], stop[up]])
    at = np.searchsorted(nodes, [start[up], stop[up]]).ravel()
    nx, nz = (np.bincount(at, np.tile(part[up], 2), len(nodes)) for part in normal)
    nx, nz = nx / np.hypot(nx, nz), nz / np.hypot(nx, nz)
    stress = body.stress
    sx, sz, txz = (part[nodes] for part in (stress.sx, stress.sz, stress.txz))
    shear = (sz - sx) * nx * nz + txz * (nx**2 - nz**2)  # along (-nz, nx)
    shear = shear if body.shear is None else body.shear[nodes]
    if body.pressure is not None:
        return nodes, body.pressure[nodes], shear
    return nodes, -(sx * nx**2 + 2.0 * txz * nx * nz + sz * nz**2), shear


def _stresses(
    body: PlaneMesh, nodes: np.ndarray, friction: float, problem: Problem, window: Window
) -> OutsideStress:
    """Largest values at the nodes in the window, and the fields on it."""
    stress, nu = body.stress, problem.scene.body.poissons_ratio
    inside = window.holds(body.x) & (body.z <= window.z[-1])
    if not inside.any():
        raise ValueError("has no node in the window of [stress]; allowed is one around x = 0")
    shears = {"tau1": stress.tau1, "txz": np.abs(stress.txz), "von_mises": stress.von_mises(nu)}
    extremes = {}
    for name, values in shears.items():
        top = int(np.argmax(np.where(inside, values, -np.inf)))
        extremes[name] = Extremum(float(values[top]), float(body.x[top]), float(body.z[top]))
    order = nodes[np.argsort(body.x[nodes])]
    surface = np.interp(extremes["tau1"].x, body.x[order], body.z[order])
    depth = extremes["tau1"].z - float(surface)
    largest = int(np.argmax(np.where(inside, stress.tau1, -np.inf)))
    beside = body.z[body.triangles[np.any(body.triangles == largest, axis=1)]]
    spacing = 0.5 * float(np.ptp(beside))
    return OutsideStress(friction, extremes, depth, spacing, on_window(body, window))


def on_window(body: PlaneMesh, window: Window) -> StressState:
    """Stresses (m, k) at the window's points, linear between nodes; none outside the mesh."""
    from matplotlib.tri import LinearTriInterpolator, Triangulation

    mesh, at = Triangulation(body.x, body.z, body.triangles), np.meshgrid(window.x, window.z)
    parts = (body.stress.sx, body.stress.sz, body.stress.txz)
    try:
        fields = [LinearTriInterpolator(mesh, part)(*at).filled(np.nan) for part in parts]
    except RuntimeError as error:
        raise ValueError(f"its elements overlap ({error}); allowed is a mesh of one body") from None
    return StressState(*fields)
