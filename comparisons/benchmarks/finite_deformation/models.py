"""One contact by a chain of models, each of which leaves out one thing less than the one before.

Units as in `finite_deformation_cases`. The block is held all round.
"""

from dataclasses import dataclass

import numpy as np

from analytic.contact.patches import contact_patches
from comparisons.benchmarks.finite_deformation.cases import BLOCK, MATERIAL, Case
from fem.body.elasticity import ElasticBody, Support, elastic_body
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.rigid_roller import CurrentContact, circle
from fem.contact.terms import Contact, LinearContact, LinearResponse
from fem.nonlinear.finite_deformation import FiniteDeformation, press, press_finitely
from fem.stress.maximum import maximum
from fem.stress.stress import NodalStress, nodal_stress
from meshes.block import BlockMesh, BlockSpec
from meshes.build import build_block
from meshes.real_shape import roughen

GROWTH = 0.2
DEEPEST = 2.0  # of where the largest shear is looked for


@dataclass(frozen=True)
class Figures:
    """Peak pressure and largest principal shear in Young's moduli, contact length in half-widths
    of the smooth contact; Newton's `iterations`."""

    peak: float
    length: float
    shear: float
    iterations: int


@dataclass(frozen=True)
class Chain:
    """Figures of one case.

    half_plane      flat body, parabola for the roller: what the half-plane's assumptions give
    true_circle     flat body, the roller's true shape
    real_geometry   the real boundary, contact along z at the undeformed place
    current_place   contact where the surface is now, along the roller's normal there; the
                    pressure is by deformed length
    finite_strain   and neo-Hookean material: nothing linearised
    """

    half_plane: Figures
    true_circle: Figures
    real_geometry: Figures
    current_place: Figures
    finite_strain: Figures


def chain(case: Case) -> Chain:
    """All models of one case on the same hats and, flat or rough, the same triangles."""
    spec = BlockSpec(
        0.5 * BLOCK, BLOCK, np.array([[-case.reach, case.reach]]), 1.0 / case.edges, GROWTH
    )
    mesh = build_block(spec)
    flat = _body(mesh)
    rough = _body(roughen(mesh, case.height)) if case.slope else flat
    parabola, true = (case.gap(case.grid, shape) for shape in ("parabola", "circle"))
    start = case.pressed(case.grid, parabola)
    roller = circle(case.radius)

    def linear(body: ElasticBody, contact: Contact, gap: np.ndarray | None) -> FiniteDeformation:
        bodies = [(LinearResponse(body), contact)]
        solution = press(bodies, body, case.hats, start, case.load, gap=gap)
        return FiniteDeformation(body, case.hats, roller, 0.0, solution)

    flat_contact, rough_contact = _undeformed(flat, case), _undeformed(rough, case)
    found = [
        _as_linear(linear(flat, flat_contact, parabola)),
        _as_linear(linear(flat, flat_contact, true)),
        _as_linear(linear(rough, rough_contact, true)),
        _deformed(linear(rough, CurrentContact(rough, case.hats, roller), None), linear=True),
    ]
    finite = press_finitely(rough, case.hats, roller, start, load=case.load)
    return Chain(*found, _deformed(finite, linear=False))


def _body(mesh: BlockMesh) -> ElasticBody:
    return elastic_body(mesh, MATERIAL, Support("bonded", "fixed"))


def _undeformed(body: ElasticBody, case: Case) -> LinearContact:
    forces = FiniteElementCompliance(body, case.hats)
    return LinearContact(len(body.nodes), body.surface, forces.normal)


def _as_linear(found: FiniteDeformation) -> Figures:
    """Pressure and stresses at the undeformed place."""
    stress = nodal_stress(found.body, found.displacement, found.hats, found.pressure)
    return _figures(found, stress, found.hats[1:-1], found.pressure)


def _deformed(found: FiniteDeformation, linear: bool) -> Figures:
    """Pressure on the deformed surface; stresses of the linear theory, or Cauchy's."""

    def direction(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return found.roller(x)[1], np.ones_like(x)

    stress = (
        nodal_stress(
            found.body, found.displacement, found.hats, found.pressure, direction=direction
        )
        if linear
        else found.stress
    )
    return _figures(found, stress, found.place, found.cauchy_pressure)


def _figures(
    found: FiniteDeformation, stress: NodalStress, place: np.ndarray, pressure: np.ndarray
) -> Figures:
    x = found.hats[1:-1]
    patches = contact_patches(x, found.pressure, found.gap)
    length = float(np.diff(np.interp(patches, x, place), axis=1).sum())
    window = (x[0], x[-1], DEEPEST)
    shear = maximum(found.body, stress, lambda s: s.tau1, window).value
    return Figures(float(pressure.max()), length, shear, found.solution.iterations)
