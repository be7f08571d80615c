"""A contact on a mesh and hats that it refines itself until its error estimate meets a tolerance.

The half-plane predicts the contact patches. Hats and element edges are graded towards their ends
(`meshes.end_grading`), and the contact is solved. The solution tells the ends, how far its hats are
from a smooth pressure on each patch (`analytic.contact.smooth_pressure`) and the elements' errors
(`fem.stress.recovery`). Both errors decide the next round, with the fewest hats and elements. The
half-plane on the same hats is the model of the iteration.

    n_k    edges on half of patch k        e_k    L2 error of the pressure on it [Pa m^(1/2)]
    h_m    size of element m [m]           E_m    its error in the norm of energy [(J/m)^(1/2)]
    q      degree of the displacement

Hertz's contact to 0.6 % of the pressure takes 1500 unknowns and 25 hats, to 0.05 % 3700 and 70: a
quarter and a thirteenth of what equal edges take (`comparisons.benchmarks.hertz_convergence`).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactSolution, solve_contact
from analytic.contact.smooth_pressure import Patch, smooth_pressure
from analytic.grid import HatGrid, hat_integrals
from analytic.material import Material
from analytic.operators.half_plane import DenseCompliance, HalfPlane, SumOfBodies
from analytic.operators.unequal_hats import half_plane_matrix, hat_weights
from fem.body.elasticity import ElasticBody, Support, elastic_body
from fem.compliance.far_field import FarField
from fem.compliance.operator import FiniteElementCompliance
from fem.stress.recovery import energy_errors
from meshes.block import BlockSpec
from meshes.build import build_block
from meshes.end_grading import graded_vertices
from meshes.size_field import SizeField, size_field

FEWEST_EDGES, MOST_FINER = 5, 4.0  # on half a patch; by how much a round may refine it
SEARCH_HATS = 2000  # of the half-plane that predicts the patches
FIRST_EDGES = 8  # on half of the largest patch, in the first round
GROWTH = 0.35  # of element sizes: in the first round everywhere, later the steepest
# Relative L2 error of the pressure from elements, over the energy of their error relative to the
# work: 1.1 to 2.6 on Hertz's contact where it was the larger part.
PRESSURE_PER_ENERGY = 5.0
SAFETY = 0.8  # part of the tolerance that the next round aims at
ROUNDS = 8
HATS_PER_WAVE = 6.0  # of the shortest wavelength, in the first round
# Half-width and depth of a block that stands for a half-plane, over the extent of the contact.
FAR = 4.0


@dataclass(frozen=True)
class Pressing:
    """What is pressed. Lengths in m.

    gap        initial gap g0(x) [m] but for a constant; knots (k,) where its third derivative jumps
    load       P [N/m]
    material   of the body
    extent     (x0, x1) stretch of the surface that contact may reach
    shortest   wavelength of the gap; no estimate sees waves shorter than the hats
    block      half_width, depth and support of the body; None: a half-plane
    stiffening compliance of both bodies over that of the body, 1 for a rigid roller
    degree     of the displacement
    """

    gap: Callable[[np.ndarray], np.ndarray]
    load: float
    material: Material
    extent: tuple[float, float]
    knots: np.ndarray | None = None
    shortest: float = np.inf
    block: tuple[float, float, Support] | None = None
    stiffening: float = 1.0
    degree: int = 2

    @property
    def modulus(self) -> float:
        """E* [Pa] of the half-plane."""
        return self.material.plane_strain_modulus / self.stiffening


@dataclass(frozen=True)
class Round:
    """One solution on the way: unknowns, hats, estimate of the relative L2 error of the pressure
    (its parts from the hats and from the elements)."""

    unknowns: int
    hats: int
    hat_error: float
    element_error: float

    @property
    def estimate(self) -> float:
        return float(np.hypot(self.hat_error, self.element_error))


@dataclass(frozen=True)
class AdaptedContact:
    """The last round's solution.

    hats        (n + 2,) [m] nodes, with the feet of the outer two
    solution    pressures (n,) [Pa], gaps, approach and residuals on them
    patches     of contact, with a smooth curve of pressure on each
    body, compliance   solved on, for stresses
    rounds      all of them
    converged   whether the estimate meets the tolerance and the contact conditions hold
    """

    hats: np.ndarray
    solution: ContactSolution
    patches: tuple[Patch, ...]
    body: ElasticBody
    compliance: FiniteElementCompliance
    rounds: tuple[Round, ...]
    converged: bool

    @property
    def peak_pressure(self) -> float:
        """Largest pressure [Pa] of the smooth curves."""
        return max(patch.peak[0] for patch in self.patches)

    @property
    def contact_length(self) -> float:
        """Sum of the patches [m]."""
        return float(sum(np.diff(patch.ends)[0] for patch in self.patches))


def adapted_contact(pressing: Pressing, tolerance: float, rounds: int = ROUNDS) -> AdaptedContact:
    """Press until the estimated relative L2 error of the hat pressures is within `tolerance`.

    The smooth pressures err by a third of that or less. Raises MeshError or FemError where a mesh
    or a factorisation fails; what misses the tolerance after `rounds` has `converged` False.
    """
    ends = predicted_patches(pressing)
    half = 0.5 * np.diff(ends, axis=1)[:, 0]
    edges = np.maximum(FEWEST_EDGES, FIRST_EDGES * (half / half.max()) ** 0.4)
    block = pressing.block or half_plane_block(np.abs(ends).max())
    largest, sizes, done = pressing.shortest / HATS_PER_WAVE, None, []
    while True:
        vertices = graded_vertices(ends, edges, largest)
        solution, compliance = pressed(pressing, block, vertices, sizes)
        body, hats = compliance.body, compliance.hats
        patches = smooth_pressure(hats, solution.pressure, solution.gap)
        norm = np.sqrt(sum(patch.norm**2 for patch in patches))
        error = np.sqrt(sum(patch.error**2 for patch in patches))
        moved = compliance.displacement(solution.pressure)
        work = float((compliance.load(solution.pressure) * moved).sum())
        energy = energy_errors(body, moved)
        element_error = PRESSURE_PER_ENERGY * float((energy**2).sum()) / work
        done.append(Round(body.unknowns, len(hats) - 2, float(error / norm), element_error))
        good = done[-1].estimate <= tolerance and solution.converged
        if good or len(done) == rounds:
            return AdaptedContact(hats, solution, patches, body, compliance, tuple(done), good)
        aim = SAFETY * tolerance / np.sqrt(2.0)
        ends, edges = next_edges(patches, hats, aim * norm)
        largest /= np.clip(np.sqrt(error / (aim * norm)), 1.0, MOST_FINER)
        factor = next_sizes(energy, aim / PRESSURE_PER_ENERGY * work, pressing.degree)
        sizes = size_field(body.mesh, factor, GROWTH)


def predicted_patches(pressing: Pressing) -> np.ndarray:
    """Patches (k, 2) [m] that the half-plane touches, on SEARCH_HATS equal hats."""
    start, stop = pressing.extent
    grid = HatGrid.within(start, stop, (stop - start) / SEARCH_HATS)
    solution = solve_contact(
        HalfPlane(grid.count, grid.pitch, pressing.modulus),
        grid.hat_integrals(pressing.gap, pressing.knots),
        grid.weights,
        Constraints(load=pressing.load),
    )
    return contact_patches(grid.x, solution.pressure, solution.gap)


def half_plane_block(extent: float) -> tuple[float, float, Support]:
    """Half-width, depth [m] and support of a block that takes a far field around |x| < extent."""
    return FAR * extent, FAR * extent, Support("bonded", "fixed")


def pressed(
    pressing: Pressing,
    block: tuple[float, float, Support],
    vertices: np.ndarray,
    sizes: SizeField | None,
) -> tuple[ContactSolution, FiniteElementCompliance]:
    """Contact on hats between `vertices` [m] of the surface, by iteration with the half-plane as
    model; where that does not converge, by the body's whole matrix."""
    half_width, depth, support = block
    interval = vertices[[0, -1]].reshape(1, 2)
    unit = float(np.diff(vertices).max())
    spec = BlockSpec(half_width, depth, interval, unit, GROWTH, vertices=vertices)
    mesh = build_block(spec, sizes=sizes)
    body = elastic_body(mesh, pressing.material, support, degree=pressing.degree)
    far = FarField(body, vertices[0], vertices[-1]) if pressing.block is None else None
    compliance = FiniteElementCompliance(body, vertices, far=far)
    operator = SumOfBodies(compliance, factors=(pressing.stiffening,))
    model = DenseCompliance(half_plane_matrix(vertices, pressing.modulus))
    gap, weights = hat_integrals(vertices, pressing.gap, pressing.knots), hat_weights(vertices)
    load = Constraints(load=pressing.load)
    solution = solve_with_model(operator, model, gap, weights, load)
    if not solution.converged:
        whole = DenseCompliance(pressing.stiffening * compliance.matrix())
        solution = solve_contact(whole, gap, weights, load, solution.pressure)
    return solution, compliance


def next_edges(
    patches: tuple[Patch, ...], hats: np.ndarray, aim: float
) -> tuple[np.ndarray, np.ndarray]:
    """Ends (k, 2) [m] of the patches, and edges (k,) on their halves for an error of `aim`.

    Graded edges err like n^-2, so that e_k^2 n_k^4 is constant, and the fewest altogether have n_k
    in proportion to its fifth root. The edges at the ends give the present number.
    """
    ends = np.array([patch.ends for patch in patches])
    half, edge = 0.5 * np.diff(ends, axis=1)[:, 0], np.diff(hats)
    shortest = np.array([0.5 * (edge[patch.first] + edge[patch.last + 1]) for patch in patches])
    now = np.sqrt(half / shortest)
    weight = np.array([patch.error**2 for patch in patches]) * now**4
    wanted = (np.sum(weight**0.2) / aim**2) ** 0.25 * weight**0.2
    wanted = np.clip(wanted, FEWEST_EDGES, np.maximum(FEWEST_EDGES, MOST_FINER * now))
    return joined_patches(ends, wanted)


def joined_patches(ends: np.ndarray, edges: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Patches with less than their shortest edge between them joined into one."""
    kept_ends, kept_edges = [ends[0]], [edges[0]]
    for (start, end), count in zip(ends[1:], edges[1:], strict=True):
        before = kept_ends[-1]
        shortest = min(before[1] - before[0], end - start) / max(count, kept_edges[-1]) ** 2
        if start - before[1] < shortest:
            kept_ends[-1] = np.array([before[0], end])
            kept_edges[-1] += count
        else:
            kept_ends.append(np.array([start, end]))
            kept_edges.append(count)
    return np.array(kept_ends), np.array(kept_edges)


def next_sizes(energy: np.ndarray, aim: float, degree: int) -> np.ndarray:
    """Factors (m,) of the elements' sizes for squared errors (m,) that sum to `aim` [J/m], with the
    fewest elements: all errors are then equal.

    E_m ~ h_m^(q+1), and the number of the next elements in place of one goes like h_m^-2.
    """
    order = degree + 1
    energy = np.maximum(energy, 1e-12 * energy.max())
    alike = (aim / np.sum(energy ** (2.0 / order))) ** (order / (2.0 * degree))
    return (alike / energy) ** (1.0 / order)
