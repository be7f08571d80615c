"""A scene as a folder that another code solves, with how to run it and bring the answer back.

For CalculiX the job and the mesh that it reads: the rough body's top is the slave surface, the
roller's the master, and the load acts on a reference node, with which the roller's far boundary
moves as one. For FEniCSx a script of plain dolfinx, and the mesh and gap that it reads."""

import io
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from analytic.material.hardening import Hardening
from comparisons.campaigns.decks.problem import MM, MPA, DeckBody, DeckProblem, deck_problem
from comparisons.common.errors import InputError, SceneError
from comparisons.common.files import publish
from comparisons.figures.quantity import MODELS
from comparisons.output.page.html import rendered
from comparisons.output.records import Records
from comparisons.output.terminal import Printed
from comparisons.runs.run import posed
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import surface_of

TEMPLATES = Path(__file__).parent / "templates"
PAGES = ("README.md", "answer.toml")
FILES = (*PAGES, "job.inp", "mesh.inp", "solve.py", "mesh.npz")
CODES = {"calculix": "CalculiX", "fenicsx": "FEniCSx"}
MOST_LEVEL = 8
AXES = ((0, "X"), (1, "Y"))
# Pressure over penetration, in E over an edge, so that finer meshes penetrate less. Of
# Hertz's peak pressure it takes 1e-4 at twenty edges to a half-width.
STIFFNESS = 50.0
# Of a body that flows, which keeps the mark of every jag that a stiffer contact has; and with
# friction at finite strains Newton's method stalls on it.
STIFFNESS_OF_FLOW = 5.0
STICK = 0.1  # of that: tangential stiffness before the surfaces slide
SLIDE = 12.0  # mu P / E: bodies with 400 half-widths to their far boundaries shear by less
# What CalculiX has for the laws of elasticity at finite strain.
HYPERELASTIC, ELASTIC = "*HYPERELASTIC, NEO HOOKE", "*ELASTIC"
LAWS = {"neo-hookean": HYPERELASTIC, "st-venant-kirchhoff": ELASTIC}
OF_FLOW = 0.02  # of the load: an increment in which a body flows
FARTHEST, FLOW_ROWS = 10.0, 60  # plastic strain that rows of a flow stress reach to, and how many
GAP_POINTS = 8  # an edge, of the sampled gap
SAME = 1e-6  # of an edge: points that are one


@dataclass(frozen=True, repr=False)
class Deck(Printed):
    """A scene as input of one of CODES."""

    scene: Scene
    code: str
    problem: DeckProblem
    files: Mapping[str, str | bytes]  # that the code reads

    @property
    def figures(self) -> Records:
        """The size of its mesh: nodes, and the edge of an element under the contact [m]."""
        return Records([{"nodes": self.problem.nodes, "edge": self.problem.edge / MM}])

    def as_dict(self) -> dict:
        """Code, files and figures for JSON."""
        return {"code": self.code, "files": sorted([*self.files, *PAGES]), **self.figures.rows[0]}

    def tables(self) -> str:
        """Size of the deck, and where it says how to solve it."""
        return f"{self.problem.nodes} nodes; {PAGES[0]} says how to solve it"

    def write(self, folder: Path) -> None:
        """Write it into a folder. Raises InputError where that cannot be."""
        values = {"code": self.code, "name": CODES[self.code], "deck": self.problem}
        values |= {"scene": self.scene, "folder": folder}
        pages = {name: rendered(TEMPLATES / f"{name}.j2", **values) for name in PAGES}
        publish(folder, {**self.files, **pages}, FILES)


def make_deck(scene: Scene, code: str, level: int = 1) -> Deck:
    """The deck of a scene for one of CODES.

    level  of the scene's own refinement, from 1, whose elements the contact gets
    Raises InputError for another code or level, SceneError for a scene that decks of this code do
    not describe."""
    if code not in CODES:
        raise InputError(f"--for: is {code}; allowed is one of {', '.join(CODES)}")
    if not 1 <= level <= MOST_LEVEL:
        raise InputError(f"--level: is {level}; allowed is 1 to {MOST_LEVEL}")
    problem, _ = posed(scene, surface_of(scene), MODELS)
    if scene.finite_element.plastic and code == "fenicsx":
        why = "is true; allowed in a deck for fenicsx are elastic bodies"
        raise SceneError(f"{scene.source}: finite_element.plastic: {why}")
    deck = deck_problem(problem, problem.pitch_of(level))
    return Deck(scene, code, deck, (fenicsx_files if code == "fenicsx" else calculix_files)(deck))


def calculix_files(deck: DeckProblem) -> dict[str, str]:
    """job.inp and mesh.inp. Raises SceneError for a law of elasticity that CalculiX lacks."""
    scene = deck.problem.scene
    modulus = max(material.youngs_modulus for material in deck.rough.materials) * MPA
    flow, held = _flow(deck), _held(deck)
    stiffness = (STIFFNESS_OF_FLOW if flow else STIFFNESS) * modulus / deck.edge
    unlike = held and deck.problem.dundurs_beta != 0.0
    slides = (mu for mu in scene.load.friction if mu and not held)
    distances = [(mu, SLIDE * mu * deck.load / modulus) for mu in slides]
    job = rendered(
        TEMPLATES / "job.inp.j2",
        deck=deck,
        scene=scene,
        materials=dict(_materials(deck)),
        flow=flow,
        stiffness=stiffness,
        stick=STICK * stiffness,
        held=held,
        increment=1.0 / scene.partial_slip.increments if unlike else OF_FLOW if flow else 1.0,
        sliding=[] if flow else distances,
        dragging=distances[0] if flow and distances else None,
    )
    return {"job.inp": job, "mesh.inp": "\n".join(_mesh(deck)) + "\n"}


def _held(deck: DeckProblem) -> tuple[float, ...]:
    """Friction coefficient and tangential loads [N/mm] of a scene with [partial_slip]."""
    scene = deck.problem.scene
    if scene.partial_slip is None:
        return ()
    if scene.partial_slip.bulk_stress:
        raise SceneError(f"{scene.source}: partial_slip.bulk_stress: allowed in a deck is 0")
    friction = max(scene.load.friction)
    return friction, *(share * friction * deck.load for share in scene.partial_slip.path)


def _materials(deck: DeckProblem) -> Iterator[tuple[str, tuple[str, str]]]:
    scene = deck.problem.scene
    for name, body in deck.bodies.items():
        for material, part in zip(body.materials, ("", "_COATING"), strict=False):
            keyword = LAWS.get(material.law.name) if deck.finite else ELASTIC
            if name == "ROUGH" and scene.finite_element.plastic:
                keyword = ELASTIC  # which is by logarithmic strain, where strains are finite
            if name == "ROLLER" and scene.roller.rigid:
                keyword = ELASTIC  # nothing in it deforms
            if keyword is None:
                section = "body" if name == "ROUGH" else "roller"
                allowed = " or ".join(f'"{law}"' for law in LAWS)
                raise SceneError(
                    f'{scene.source}: {section}.law: is "{material.law.name}"; '
                    f"allowed in a deck for calculix is {allowed}"
                )
            modulus, nu = material.youngs_modulus * MPA, material.poissons_ratio
            constants = modulus, nu
            if keyword == HYPERELASTIC:  # C10 = mu/2, D1 = 2/K
                constants = 0.5 * material.shear_modulus * MPA, 6.0 * (1.0 - 2.0 * nu) / modulus
            yield name + part, (keyword, ", ".join(f"{constant:.12g}" for constant in constants))


def _flow(deck: DeckProblem) -> tuple[str, list[str]] | None:
    """Kind of hardening and rows of flow stress [MPa] over plastic strain in the deck, which is
    that of the scene over `flatter`; None of a body that does not flow."""
    scene = deck.problem.scene
    if not scene.finite_element.plastic:
        return None
    law, kind = scene.body.flow_stress(), "ISOTROPIC"
    if law.kinematic:
        if law != Hardening(law.yield_stress, kinematic=law.kinematic):
            why = "is kinematic beside another law; allowed in a deck is one of both"
            raise SceneError(f"{scene.source}: body.hardening: {why}")
        law, kind = Hardening(law.yield_stress, law.kinematic), "KINEMATIC"
    strains = np.concatenate([[0.0], np.geomspace(1e-6, FARTHEST, FLOW_ROWS)])
    if law.table is not None:
        strains = np.array(law.table)[:, 0]
    elif law == Hardening(law.yield_stress, law.modulus):
        strains = np.array([0.0, FARTHEST] if law.modulus else [0.0])
    rows = zip(law.stress(strains) * MPA, strains / deck.flatter, strict=True)
    return kind, [f"{stress:.12g}, {strain:.12g}" for stress, strain in rows]


def _mesh(deck: DeckProblem) -> Iterator[str]:
    """Nodes, elements, surfaces and sets of both bodies, the reference node and its equations."""
    nodes = elements = 0
    for name, body in deck.bodies.items():
        lower = deck.overlap if name == "ROLLER" else 0.0  # contact to begin with
        yield f"*NODE, NSET={name}_NODES"
        for number, (x, y) in enumerate(body.points, nodes + 1):
            yield f"{number}, {x:.12g}, {y - lower:.12g}"
        for part, chosen in (("", ~body.coated), ("_COATING", body.coated)):
            if chosen.any():
                yield f"*ELEMENT, TYPE=CPE6, ELSET={name}{part}"
            for k in np.flatnonzero(chosen):
                yield ", ".join(map(str, (elements + k + 1, *(nodes + body.triangles[k] + 1))))
        yield f"*SURFACE, NAME={name}_TOP, TYPE=ELEMENT"
        yield from (f"{elements + triangle + 1}, S{edge + 1}" for triangle, edge in body.faces)
        sets = {f"{name}_TOP_NODES": body.surface}
        sets |= {f"{name}_HELD_{axis}": np.flatnonzero(body.held[:, k]) for k, axis in AXES}
        for label, members in sets.items():
            yield f"*NSET, NSET={label}"
            listed = list(map(str, nodes + 1 + members))
            yield from (", ".join(listed[k : k + 12]) for k in range(0, len(listed), 12))
        nodes, elements = nodes + len(body.points), elements + len(body.triangles)
    yield "*NODE, NSET=REFERENCE"
    yield f"{nodes + 1}, 0., {deck.roller.points[:, 1].max():.12g}"
    tied = (2,) if deck.problem.scene.partial_slip is None else (1, 2)
    for node in nodes - len(deck.roller.points) + 1 + np.flatnonzero(deck.roller.held[:, 1]):
        for axis in tied:
            yield from ("*EQUATION", "2", f"{node}, {axis}, 1., {nodes + 1}, {axis}, -1.")


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
    coating = scene.coating and scene.coating.material
    constants = {
        number: (material.youngs_modulus * MPA, material.poissons_ratio)
        for number, material in enumerate((scene.body.material, coating, scene.roller.material))
        if material is not None
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
    """Positions (n,) [mm] of the pressures: vertices on the tops of all bodies, well inside the
    refined ranges, where their neighbours are the same on all."""
    x = tops[0]
    inside = np.zeros(len(x), dtype=bool)
    for low, high in deck.ranges:
        inside |= (x > low + 0.5 * deck.edge) & (x < high - 0.5 * deck.edge)
    for top in tops[1:]:
        inside &= np.abs(top - x[:, None]).min(axis=1) < SAME * deck.edge
    return x[inside]
