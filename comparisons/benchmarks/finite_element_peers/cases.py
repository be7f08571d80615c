"""The contact problems on which finite-element codes are compared, and their meshes.

A rigid parabola, smooth or with waves on it, on a block of plane strain that is held at its bottom
and sides. It is so flat that to first order in its slope there is but one problem, however a code
measures gaps and turns its tractions. Without waves the load gives Hertz's a and p0.

The approach is prescribed, which every code offers as it comes. It goes with the load in the
reference, this project's solution by cubic elements on a mesh finer than all that race. That
the peers' errors fall with their meshes as far as this project's says that it is theirs, too.

    a   half-width, 1 m     R   radius [m]     E, nu   1 Pa and 0.3
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import solve_contact
from analytic.exact.hertz import HertzContact, hertz_from_peak_pressure
from analytic.grid import HatGrid
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from comparisons.benchmarks.finite_element_peers.task import Answer, Task, gap

MATERIAL = Material(1.0, 0.3)
SLOPE = 1e-5  # a / R
BLOCK = 40.0  # half-width and depth, in a
MARGIN = 1.25  # of the predicted contact: ground that may be touched
LARGEST = 3.0  # reach of the waves' contact, in a
# The reference: edges to a, growth of the elements, degree, hats to an edge.
FINEST, FINEST_GROWTH, FINEST_DEGREE, FINEST_HATS = 640, 0.15, 3, 2
SAMPLES = 40_001  # places at which pressures are compared


@dataclass(frozen=True)
class Case:
    """One contact problem.

    waves      (k, 3) as in `fe_peers_task`
    ladder     element edges to a, coarse to fine
    reach      half of the ground that may be touched [m]
    approach   [m]                  reference   pressures, and the load's approach
    """

    title: str
    waves: np.ndarray
    ladder: tuple[int, ...]
    reach: float
    approach: float
    reference: Answer

    def task(self, edges: int, growth: float, repeats: int) -> Task:
        """The problem on a mesh of so many edges to a."""
        return _task(self.waves, self.reach, self.approach, edges, growth, repeats)

    def errors(self, answer: Answer) -> dict[str, float]:
        """Relative errors: `peak`, of the largest pressure, and `pressure`, in the L2 norm."""
        x = np.linspace(-self.reach, self.reach, SAMPLES)
        wanted, found = self.reference.at(x), answer.at(x)
        return {
            "peak": abs(answer.pressure.max() / self.reference.pressure.max() - 1.0),
            "pressure": float(np.linalg.norm(found - wanted) / np.linalg.norm(wanted)),
        }


def hertz() -> HertzContact:
    """Of the smooth parabola on a half-plane."""
    modulus = MATERIAL.plane_strain_modulus
    return hertz_from_peak_pressure(0.5 * SLOPE * modulus, 1.0 / SLOPE, modulus)


def cylinder() -> Case:
    """Hertz's contact."""
    return made("cylinder", np.zeros((0, 3)), (5, 10, 20, 40, 80, 160))


def waves() -> Case:
    """A sinusoid on the parabola: five asperities touch, each over a part of it."""
    length = 0.5
    amplitude = 2.0 * SLOPE * length / (2.0 * np.pi)
    return made("waves", np.array([[amplitude, length, 0.0]]), (10, 20, 40, 80, 160))


def rough(seed: int = 1, shortest: float = 0.1, hurst: float = 0.8) -> Case:
    """Self-affine roughness on the parabola, with waves from 4 a down to `shortest` a."""
    random = np.random.default_rng(seed)
    number = np.arange(1, round(4.0 / shortest) + 1)
    length = 4.0 / number
    amplitude = number ** (-0.5 - hurst)
    slope = np.sqrt(0.5 * np.sum((2.0 * np.pi * amplitude / length) ** 2))
    phase = random.uniform(0.0, 2.0 * np.pi, len(number))
    rows = np.column_stack([2.0 * SLOPE / slope * amplitude, length, phase])
    return made("rough", rows, (10, 20, 40, 80, 160))


def made(title: str, waves: np.ndarray, ladder: tuple[int, ...], finest: int = FINEST) -> Case:
    """The case of these waves, its reference solved on `finest` edges to a."""
    smooth = hertz()
    grid = HatGrid.within(-LARGEST, LARGEST, 1.0 / finest)
    modulus = MATERIAL.plane_strain_modulus
    predicted = solve_contact(
        HalfPlane(grid.count, grid.pitch, modulus),
        grid.hat_integrals(_gap(waves)),
        grid.weights,
        Constraints(load=smooth.load_per_length),
    )
    reach = MARGIN * float(np.abs(grid.x[predicted.pressure > 0.0]).max())
    task = _task(waves, reach, 0.0, finest, FINEST_GROWTH, 0)
    answer, approach = _solved(task, smooth.load_per_length)
    return Case(title, waves, ladder, float(task.ground[1]), approach, answer)


def _gap(waves: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    return lambda x: gap(x, 1.0 / SLOPE, waves)


def _task(
    waves: np.ndarray, reach: float, approach: float, edges: int, growth: float, repeats: int
) -> Task:
    from meshes.block import BlockSpec
    from meshes.build import build_block

    size = 1.0 / edges
    end = size * np.ceil(reach / size - 1e-9)
    ground = np.array([-end, end])
    mesh = build_block(BlockSpec(BLOCK, BLOCK, ground[None], size, growth))
    return Task(
        points=mesh.points,
        triangles=mesh.triangles,
        half_width=BLOCK,
        depth=BLOCK,
        ground=ground,
        surface_size=size,
        growth=growth,
        radius=1.0 / SLOPE,
        waves=waves,
        approach=approach,
        youngs_modulus=MATERIAL.youngs_modulus,
        poissons_ratio=MATERIAL.poissons_ratio,
        repeats=repeats,
    )


def _solved(task: Task, load: float) -> tuple[Answer, float]:
    """The reference and its approach [m] under a load [N/m]."""
    from comparisons.benchmarks.finite_element_peers.crosscheck import contact_of

    feet, solution, unknowns = contact_of(task, FINEST_DEGREE, FINEST_HATS, Constraints(load=load))
    pressure = np.concatenate([[0.0], solution.pressure, [0.0]])
    steps = solution.iterations["steps"]
    return Answer(feet, pressure, np.zeros(1), unknowns, steps), solution.approach
