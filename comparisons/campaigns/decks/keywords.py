"""Decks in the keyword format that Abaqus and CalculiX share: the job, and the mesh that it reads.

The rough body's top is the slave surface, the roller's the master. The load acts on a reference
node, with which the roller's far boundary moves as one."""

from collections.abc import Iterable, Iterator

import numpy as np

from analytic.material import Material
from comparisons.campaigns.decks import TEMPLATES
from comparisons.campaigns.decks.problem import MPA, DeckProblem
from comparisons.common.errors import SceneError
from comparisons.output.page.html import rendered

# CalculiX: pressure over penetration, in E over an edge, so that finer meshes penetrate less. Of
# Hertz's peak pressure it takes 1e-4 at twenty edges to a half-width.
STIFFNESS = 50.0
STICK = 0.1  # of that: tangential stiffness before the surfaces slide
SLIDE = 12.0  # mu P / E: bodies with 400 half-widths to their far boundaries shear by less
# What a code has for the laws of elasticity at finite strain.
HYPERELASTIC, ELASTIC = "*HYPERELASTIC, NEO HOOKE", "*ELASTIC"
LAWS = {
    "calculix": {"neo-hookean": HYPERELASTIC, "st-venant-kirchhoff": ELASTIC},
    "abaqus": {"neo-hookean": HYPERELASTIC, "hencky": ELASTIC},
}


def keyword_files(deck: DeckProblem, code: str) -> dict[str, str]:
    """job.inp and mesh.inp of "calculix" or "abaqus". SceneError for a law that the code lacks."""
    scene = deck.problem.scene
    modulus = max(material.youngs_modulus for material in deck.rough.materials) * MPA
    stiffness = STIFFNESS * modulus / deck.edge
    job = rendered(
        TEMPLATES / "job.inp.j2",
        code=code,
        deck=deck,
        scene=scene,
        materials=dict(_materials(deck, code)),
        stiffness=stiffness,
        stick=STICK * stiffness,
        sliding=[(mu, SLIDE * mu * deck.load / modulus) for mu in scene.load.friction if mu],
    )
    return {"job.inp": job, "mesh.inp": "\n".join(_mesh(deck, code)) + "\n"}


def _materials(deck: DeckProblem, code: str) -> Iterator[tuple[str, tuple[str, str]]]:
    scene = deck.problem.scene
    for name, body in deck.bodies.items():
        for material, part in zip(body.materials, ("", "_COATING"), strict=False):
            keyword = LAWS[code].get(material.law.name) if deck.finite else ELASTIC
            if name == "ROLLER" and scene.roller.rigid:
                keyword = ELASTIC  # nothing in it deforms
            if keyword is None:
                given = f'{"body" if name == "ROUGH" else "roller"}.law: is "{material.law.name}"'
                allowed = " or ".join(f'"{law}"' for law in LAWS[code])
                raise SceneError(
                    f"{scene.source}: {given}; allowed in a deck for {code} is {allowed}"
                )
            yield name + part, (keyword, _constants(material, keyword))


def _constants(material: Material, keyword: str) -> str:
    modulus, nu = material.youngs_modulus * MPA, material.poissons_ratio
    if keyword == ELASTIC:
        return f"{modulus:.12g}, {nu:.12g}"
    # C10 = mu/2, D1 = 2/K
    return f"{0.5 * material.shear_modulus * MPA:.12g}, {6.0 * (1.0 - 2.0 * nu) / modulus:.12g}"


def _mesh(deck: DeckProblem, code: str) -> Iterator[str]:
    """Nodes, elements, surfaces and sets of both bodies, the reference node and its equations."""
    nodes = elements = 0
    for name, body in deck.bodies.items():
        # there is no contact to begin with, but for CalculiX, which has no step that makes some
        lower = deck.overlap if (code, name) == ("calculix", "ROLLER") else 0.0
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
            yield from _lines(nodes + 1 + members)
        nodes, elements = nodes + len(body.points), elements + len(body.triangles)
    yield "*NODE, NSET=REFERENCE"
    yield f"{nodes + 1}, 0., {deck.roller.points[:, 1].max():.12g}"
    for node in nodes - len(deck.roller.points) + 1 + np.flatnonzero(deck.roller.held[:, 1]):
        yield from ("*EQUATION", "2", f"{node}, 2, 1., {nodes + 1}, 2, -1.")


AXES = ((0, "X"), (1, "Y"))


def _lines(numbers: Iterable[int], a_line: int = 12) -> Iterator[str]:
    listed = list(map(str, numbers))
    return (", ".join(listed[k : k + a_line]) for k in range(0, len(listed), a_line))
