"""What a level of finite elements will take, before anything is meshed."""

import numpy as np

from comparisons.models.finite_element.mesh import Refinement, expected_unknowns
from comparisons.models.level import ExpectedCost
from comparisons.models.problem import Problem
from fem.solver.mumps import factorisation_seconds

# Peak of the process: without unknowns, and of each (1.9 to 3 kB from 38 000 to 170 000 unknowns).
START_BYTES, BYTES_PER_UNKNOWN = 1.7e8, 2600.0
# Seconds an unknown of gmsh, assembly, back-substitutions and stresses, on one core.
MESH_SECONDS, ASSEMBLY_SECONDS, REST_SECONDS = 5e-6, 1.6e-6, 3e-6
START_SECONDS = 0.3  # of gmsh's own process
# Of one process at the peak, and seconds an unknown: finite deformation of two rough bodies under
# friction, stresses included (2600 bytes; 15 to 17 us from 88 000 to 613 000 unknowns); one step
# of plastic flow, pressed and let go (2300 bytes; 9 to 12 us from 13 000 to 220 000).
NONLINEAR_BYTES = 3500.0
# Of a body that flows, times unknowns^0.2: 3.2 to 5.5 kB from 78 000 to 690 000 unknowns.
FLOW_BYTES, FLOW_ORDER = 360.0, 0.2
FINITE_SECONDS, FLOW_SECONDS = 1.7e-5, 1.1e-5
FINITE_FLOW = 2.0  # times as long an unknown at finite strains, on a rough surface
FEWEST_INCREMENTS = 4.0  # of plastic flow, however little it spreads


def expected(problem: Problem, refinement: Refinement, patches: np.ndarray) -> ExpectedCost:
    """For contact predicted on `patches` (k, 2) [m]."""
    unknowns = expected_unknowns(problem, refinement, patches)
    factorisation = factorisation_seconds(unknowns)
    others = MESH_SECONDS + ASSEMBLY_SECONDS + REST_SECONDS
    seconds, memory = START_SECONDS + factorisation + others * unknowns, BYTES_PER_UNKNOWN
    settings = problem.scene.finite_element
    if settings.deformation == "finite":
        seconds, memory = seconds + FINITE_SECONDS * unknowns, NONLINEAR_BYTES
    if settings.plastic:
        steps = flow_increments(problem, refinement, patches)
        steps *= FINITE_FLOW if settings.deformation == "finite" else 1.0
        seconds += FLOW_SECONDS * steps * unknowns
        memory = max(NONLINEAR_BYTES, FLOW_BYTES * unknowns**FLOW_ORDER)
    return ExpectedCost(unknowns, START_BYTES + memory * unknowns, seconds)


def flow_increments(problem: Problem, refinement: Refinement, patches: np.ndarray) -> float:
    """Increments of the load in which a body flows. The edges of the `patches` (k, 2) [m] come from
    their middles, at most over Hertz's contact, and travel one hat an increment in the mean
    (`fem.nonlinear.press_plastic.edge_travel`): early those of the widest, later all of them."""
    span = 2.0 * problem.hertz.half_width
    halves = 0.5 * np.minimum(np.ptp(patches, axis=1), span)
    travel = 0.5 * (halves.max() + halves.mean())
    return max(FEWEST_INCREMENTS, float(travel / (refinement.travel * refinement.pitch)))
