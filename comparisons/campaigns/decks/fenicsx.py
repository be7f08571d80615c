"""The deck for FEniCSx: a script of plain dolfinx, and the mesh and gap that it reads."""

import io

import numpy as np

from comparisons.campaigns.decks import TEMPLATES
from comparisons.campaigns.decks.problem import MM, MPA, DeckBody, DeckProblem
from comparisons.common.errors import SceneError
from comparisons.output.page.html import rendered

GAP_POINTS = 8  # an edge, of the sampled gap
SAME = 1e-6  # of an edge: places that are one


def fenicsx_files(deck: DeckProblem) -> dict[str, str | bytes]:
    """solve.py and mesh.npz. Raises SceneError for what the script does not solve: finite
    deformation, bodies of their own shapes, a block that nothing holds sideways."""
    problem, scene = deck.problem, deck.problem.scene
    source = f"{scene.source}: finite_element"
    if deck.flatter == 1.0:
        raise SceneError(
            f"{source}: asks for bodies of their own shapes; allowed in a deck for fenicsx are "
            "flat ones at small deformation"
        )
    if scene.body.width is not None and scene.body.base == "frictionless":
        raise SceneError(f'{scene.source}: body.base: allowed in a deck for fenicsx is "bonded"')
    bodies = [deck.rough] if scene.roller.rigid else [deck.rough, deck.roller]
    points, triangles = zip(*(_corners(body) for body in bodies), strict=True)
    lowest = deck.rough.points[deck.rough.surface, 1].min()
    points[0][points[0][:, 1] >= lowest, 1] = 0.0  # the gap is apart from the mesh
    if len(points) > 1:
        points[1][:, 1] += deck.edge  # no node of one body stands where one of the other does
    low, high = np.array(problem.extent) * MM
    x = np.linspace(low, high, int(np.ceil((high - low) / deck.edge * GAP_POINTS)) + 1)
    file = io.BytesIO()
    np.savez_compressed(
        file,
        points=np.concatenate(points),
        triangles=np.concatenate([triangles[0], *(t + len(points[0]) for t in triangles[1:])]),
        part=np.concatenate([2 * k + body.coated for k, body in enumerate(bodies)]),
        hats=_hats(deck, [np.sort(p[p[:, 1] == deck.edge * k, 0]) for k, p in enumerate(points)]),
        gap=np.column_stack([x, problem.finite_element_gap(x / MM) * MM]),
    )
    materials = [
        scene.body.material,
        scene.coating and scene.coating.material,
        scene.roller.material,
    ]
    constants = {
        number: (each.youngs_modulus * MPA, each.poissons_ratio)
        for number, each in enumerate(materials)
        if each is not None
    }
    widths = {
        f"{name.lower()}_half_width": float(abs(body.points[:, 0]).max())
        for name, body in deck.bodies.items()
    }
    values = widths | {"deck": deck, "scene": scene, "materials": constants}
    script = rendered(TEMPLATES / "solve.py.j2", **values)
    return {"solve.py": script, "mesh.npz": file.getvalue()}


def _corners(body: DeckBody) -> tuple[np.ndarray, np.ndarray]:
    """Points (n, 2) [mm] and triangles (m, 3) without the midpoints of edges."""
    used, corners = np.unique(body.triangles[:, :3], return_inverse=True)
    return body.points[used], corners.reshape(-1, 3)


def _hats(deck: DeckProblem, tops: list[np.ndarray]) -> np.ndarray:
    """Places (n,) [mm] of the pressures: vertices on the tops of all bodies, well inside the
    refined ranges, where their neighbours are the same on all."""
    x = tops[0]
    inside = np.zeros(len(x), dtype=bool)
    for low, high in deck.ranges:
        inside |= (x > low + 0.5 * deck.edge) & (x < high - 0.5 * deck.edge)
    for top in tops[1:]:
        inside &= np.abs(top - x[:, None]).min(axis=1) < SAME * deck.edge
    return x[inside]
