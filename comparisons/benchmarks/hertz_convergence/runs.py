"""One finite-element solution of Hertz's contact: its cost, and its distance from the exact one.

A rigid cylinder on a body of plane-strain modulus 1, half-width and peak pressure 1.
"""

import resource
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.smooth_pressure import Patch, smooth_pressure
from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.grid import HatGrid
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from comparisons.models.finite_element.adaptive import Pressing, adapted_contact, half_plane_block
from fem.body.elasticity import Support, elastic_body
from fem.compliance.far_field import FarField
from fem.compliance.operator import FiniteElementCompliance
from fem.stress.maximum import maximum
from fem.stress.stress import nodal_stress
from meshes.block import BlockSpec
from meshes.build import build_block

HERTZ = hertz_from_peak_pressure(1.0, 0.5, 1.0)
BODY = Material(0.91, 0.3)
BEYOND = 6  # equal edges beyond the end of contact, on each side
BETWEEN = 0.25  # of a pitch: nobody knows where among the nodes a contact ends
BLOCK = 200.0, 400.0  # half-width and depth of a block without far field, in half-widths
# Growth of the elements under 20 edges a half-width; with finer edges it falls like their root.
GROWTH, STEEPEST = 0.2, 0.5


@dataclass(frozen=True)
class Run:
    """What came out. Errors are relative.

    size       edges on half of the contact, or the tolerance
    seconds    of the processor, gmsh's process included; wall the time on the clock
    node       peak pressure as the highest nodal value; peak that of the smooth curve
    half_width, tau1   tau1 is the largest principal shear
    hats, curve   L2 norms of the error of the piecewise-linear and of the smooth pressure
    """

    size: float
    unknowns: int
    count: int
    seconds: float
    wall: float
    node: float
    peak: float
    half_width: float
    hats: float
    curve: float
    tau1: float


def equal_edges(
    per_half: int,
    degree: int = 2,
    hats_per_edge: int = 1,
    far_field: bool = True,
    growth: float | None = None,
) -> Run:
    """Equal edges all over the contact, each under one hat or more; `growth` that does not fall."""
    timer = _Timer()
    edge = 1.0 / (per_half + BETWEEN)
    edges = per_half + BEYOND
    grid = HatGrid.within(-edges * edge, edges * edge, edge / hats_per_edge)
    half_width, depth, support = half_plane_block(1.5)
    if not far_field:
        (half_width, depth), support = BLOCK, Support("bonded", "fixed")
    growth = growth or min(STEEPEST, GROWTH * np.sqrt(20.0 / per_half))
    ground = edge * np.array([[-edges, edges]])
    mesh = build_block(BlockSpec(half_width, depth, ground, edge, growth))
    body = elastic_body(mesh, BODY, support, degree=degree)
    hats = grid.pitch * np.arange(grid.first - 1, grid.last + 2)
    far = FarField(body, hats[0], hats[-1]) if far_field else None
    compliance = FiniteElementCompliance(body, hats, far=far)
    solution = solve_with_model(
        compliance,
        HalfPlane(grid.count, grid.pitch, HERTZ.combined_modulus),
        grid.hat_integrals(_gap),
        grid.weights,
        Constraints(load=HERTZ.load_per_length),
    )
    (patch,) = smooth_pressure(hats, solution.pressure, solution.gap)
    return _assessed(per_half, compliance, solution.pressure, patch, timer)


def adapted(tolerance: float, degree: int = 2) -> Run:
    """Meshes and hats by `comparisons.models.finite_element.adaptive`, until its estimate meets the
    tolerance."""
    timer = _Timer()
    pressing = Pressing(_gap, HERTZ.load_per_length, BODY, (-1.5, 1.5), degree=degree)
    contact = adapted_contact(pressing, tolerance)
    (patch,) = contact.patches
    return _assessed(tolerance, contact.compliance, contact.solution.pressure, patch, timer)


def distance(
    found: Callable[[np.ndarray], np.ndarray], exact: Callable[[np.ndarray], np.ndarray]
) -> float:
    """L2 norm of the difference of two pressures over that of the second one."""
    angle = np.linspace(0.0, np.pi, 100_001)
    x, share = -1.2 * np.cos(angle), np.sin(angle)
    return float(np.sqrt(share @ (found(x) - exact(x)) ** 2 / (share @ exact(x) ** 2)))


class _Timer:
    def __init__(self) -> None:
        self._wall, self._processor = time.perf_counter(), _processor_seconds()

    def seconds(self) -> tuple[float, float]:
        """Of the processor and of the clock, since it was made."""
        return _processor_seconds() - self._processor, time.perf_counter() - self._wall


def _processor_seconds() -> float:
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def _gap(x: np.ndarray) -> np.ndarray:
    return x**2 / (2.0 * HERTZ.radius)


def _assessed(
    size: float,
    compliance: FiniteElementCompliance,
    pressure: np.ndarray,
    patch: Patch,
    timer: _Timer,
) -> Run:
    seconds, wall = timer.seconds()
    hats, body = compliance.hats, compliance.body
    whole = np.concatenate([[0.0], pressure, [0.0]])
    nodal = nodal_stress(body, compliance.displacement(pressure), hats, pressure)
    shear = maximum(body, nodal, lambda stress: stress.tau1).value

    def curve(x: np.ndarray) -> np.ndarray:
        return np.where((x > patch.ends[0]) & (x < patch.ends[1]), patch.curve(x), 0.0)

    return Run(
        size=size,
        unknowns=body.unknowns,
        count=len(pressure),
        seconds=seconds,
        wall=wall,
        node=abs(pressure.max() - 1.0),
        peak=abs(patch.peak[0] - 1.0),
        half_width=abs(0.5 * (patch.ends[1] - patch.ends[0]) - 1.0),
        hats=distance(lambda x: np.interp(x, hats, whole), HERTZ.pressure),
        curve=distance(curve, HERTZ.pressure),
        tau1=abs(shear / HERTZ.tau1_max - 1.0),
    )
