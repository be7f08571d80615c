"""What linear kinematics does not model, against the roller's curvature and the surface's slope.

    python -m comparisons.benchmarks.finite_deformation

A rigid roller presses a smooth body, then rough ones (self-affine, Hurst exponent 0.8, waves from
a quarter to one half-width). Each case is solved by a series of models, each of which drops one
assumption of the one before:

    half-plane      flat body, a parabola for the roller
    true circle     flat body, the roller's true shape
    real geometry   the rough boundary, contact along z at the undeformed place
    current place   contact where the deformed surface is, along the roller's normal there;
                    pressure by deformed length
    finite strain   and neo-Hookean material: nothing is linearised

Columns show what each step changes in the peak pressure, in per cent, and what all of them change
in the peak pressure, the contact length and the largest principal shear. A minute on one thread.

Measured with 80 edges to a half-width, the peak pressure on the deformed surface is higher than
the linear theory's by

    smooth   a/R        0.005   0.01   0.02   0.05   0.1    0.2       1 % at a/R = 0.13
             per cent   0.04    0.07   0.14   0.36   0.75   1.63
    rough    rms slope  0.01    0.02   0.05   0.1    0.2              1 % at rms slope 0.03
             per cent   0.46    0.76   1.45   2.32   3.07             (a/R = 0.01, means)

so that it starts to matter where the largest pressure reaches 0.07 E on a smooth body and 0.032 to
0.033 E on a rough one. So it does on a single wave, at 0.03 E; that takes an rms slope of 0.06
(`comparisons/studies/maps/finished/slope-wavelength.json`), for its crests are all as high.
Contact at the current place makes it higher by twice that and the finite strain takes half of it
back; the circle's true shape adds 0.25 % at a/R = 0.2, the real geometry up to 0.03 % at an rms
slope of 0.05 and 0.8 % at 0.2, where the largest shear is 5 % higher. What the finite strain
changes depends on the material's law (`fem.nonlinear.hyperelastic`).

Lengths in half-widths of the smooth contact, stresses in Young's moduli. Poisson's ratio 0.3, no
friction; the block is fixed all round.
"""

import argparse
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import pairwise
from typing import Literal, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import solve_contact
from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.grid import HatGrid, roller_gap
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from analytic.surface.synthetic import self_affine
from comparisons.benchmarks.harness import print_table, run_on_one_thread
from fem.body.elasticity import ElasticBody, Support, elastic_body
from fem.compliance.operator import FiniteElementCompliance
from fem.contact.rigid_roller import CurrentContact, circle
from fem.contact.terms import Contact, LinearContact, LinearResponse
from fem.nonlinear.finite_deformation import FiniteDeformation, press, press_finitely
from fem.stress.maximum import maximum
from fem.stress.stress import NodalStress, nodal_stress
from meshes.block import BlockSpec
from meshes.build import build_block
from meshes.real_shape import roughen

CURVATURES = (0.005, 0.01, 0.02, 0.05, 0.1, 0.2)
SLOPES = (0.01, 0.02, 0.05, 0.1, 0.2)
SEEDS = (1, 2, 3)
ROUGH_CURVATURE = 0.01  # a/R of the rough cases: its own effect is small
MATTERS = 0.01  # of the peak pressure
MATERIAL = Material(1.0, 0.3)
MODULUS = MATERIAL.plane_strain_modulus
BLOCK = 400.0
GROWTH = 0.2  # of the elements
HURST = 0.8
LONGEST, SHORTEST = 1.0, 0.25  # waves of the roughness
TRACE = 16.0  # length of the roughness, in the middle of which the roller stands
FADE = 0.5  # beyond the hats the roughness fades over this length
REACHES = (1.4, 2.0, 2.8, 4.0, 5.6, 7.0)  # allowed for the hats, rounded up to whole edges
UNTOUCHED = 0.85  # of the reach, beyond which there must be no contact
DEEPEST = 2.0  # to which the largest shear is searched
COLUMNS = ("a/R", "rms slope", "seed", "p0/E", "true circle", "real geometry", "current place")
COLUMNS += ("finite strain", "peak", "length", "tau1_max", "Newton")


@dataclass(frozen=True)
class RollerCase:
    """`curvature` a/R of the smooth contact, `slope` rms of the roughness, its `seed`; `edges` to
    a half-width, each under one hat."""

    curvature: float
    slope: float = 0.0
    seed: int = 0
    edges: int = 80

    @property
    def radius(self) -> float:
        return 1.0 / self.curvature

    @property
    def load(self) -> float:
        peak = 0.5 * MODULUS * self.curvature
        return hertz_from_peak_pressure(peak, self.radius, MODULUS).load_per_length

    @cached_property
    def reach(self) -> float:
        """Hats lie from -reach to reach, with the half-plane's contact well inside."""
        for wanted in REACHES:
            reach = float(np.ceil(wanted * self.edges)) / self.edges
            grid = HatGrid.within(-reach, reach, 1.0 / self.edges)
            pressure = self.half_plane_pressure(grid)
            if np.abs(grid.x[pressure > 0.0]).max() < UNTOUCHED * reach:
                return reach
        raise ValueError(f"the contact reaches beyond {UNTOUCHED * reach:g} half-widths: {self}")

    @cached_property
    def grid(self) -> HatGrid:
        return HatGrid.within(-self.reach, self.reach, 1.0 / self.edges)

    @property
    def hats(self) -> np.ndarray:
        """Nodes with the outer feet."""
        x, pitch = self.grid.x, self.grid.pitch
        return np.array([x[0] - pitch, *x, x[-1] + pitch])

    def weighted_gap(self, grid: HatGrid, shape: Literal["parabola", "circle"]) -> np.ndarray:
        """Initial gap weighted with the hats of a grid, with the roughness."""
        knots = np.arange(-64.0 * np.ceil(REACHES[-1]), 64.0 * np.ceil(REACHES[-1])) / 64.0
        return grid.hat_integrals(roller_gap(self.radius, self.roughness, shape), knots)

    def half_plane_pressure(self, grid: HatGrid) -> np.ndarray:
        model = HalfPlane(grid.count, grid.pitch, MODULUS)
        gap, load = self.weighted_gap(grid, "parabola"), Constraints(load=self.load)
        return solve_contact(model, gap, grid.weights, load).pressure

    def roughness(self, x: np.ndarray) -> np.ndarray:
        """Height of the profile."""
        return self._spline(x) if self.slope else np.zeros_like(x)

    def height(self, x: np.ndarray) -> np.ndarray:
        """Height of the rough boundary anywhere: the profile under the hats, which then fades."""
        share = np.clip((self.reach + FADE - np.abs(x)) / FADE, 0.0, 1.0)
        smooth = share**3 * (10.0 - 15.0 * share + 6.0 * share**2)
        return smooth * self.roughness(np.clip(x, -0.5 * TRACE, 0.5 * TRACE))

    @cached_property
    def _spline(self) -> CubicSpline:
        kind = {"hurst": HURST, "rms_slope": self.slope, "seed": self.seed}
        waves = {"shortest_wavelength": SHORTEST, "longest_wavelength": LONGEST}
        return self_affine(samples=int(64 * TRACE) + 1, length=TRACE, **kind, **waves).spline()


class ModelFigures(NamedTuple):
    """Peak pressure, contact length, largest principal shear, iterations."""

    peak: float
    length: float
    shear: float
    iterations: int


class ModelChanges(NamedTuple):
    """Relative to the half-plane: what each step changes in the peak pressure (circle, geometry,
    place, strain), and what all of them change in the peak, the length and the shear."""

    circle: float
    geometry: float
    place: float
    strain: float
    peak: float
    length: float
    shear: float


def changes(models: list[ModelFigures]) -> ModelChanges:
    """From the figures of all models of one case."""
    first, last = models[0], models[-1]
    steps = [(b.peak - a.peak) / first.peak for a, b in pairwise(models)]
    return ModelChanges(*steps, *(last[i] / first[i] - 1.0 for i in range(3)))


def model_series(case: RollerCase) -> list[ModelFigures]:
    """All models in order, on the same hats and, flat or rough, the same triangles."""
    refined = np.array([[-case.reach, case.reach]])
    mesh = build_block(BlockSpec(0.5 * BLOCK, BLOCK, refined, 1.0 / case.edges, GROWTH))
    body_of = partial(elastic_body, material=MATERIAL, support=Support("bonded", "fixed"))
    flat = body_of(mesh)
    rough = body_of(roughen(mesh, case.height)) if case.slope else flat
    parabola, true = (case.weighted_gap(case.grid, shape) for shape in ("parabola", "circle"))
    start = case.half_plane_pressure(case.grid)
    roller = circle(case.radius)

    def linear(
        body: ElasticBody, contact: Contact, gap: np.ndarray | None = None
    ) -> FiniteDeformation:
        bodies = [(LinearResponse(body), contact)]
        solution = press(bodies, body, case.hats, start, case.load, gap=gap)
        initial = (true if gap is None else gap) / case.grid.weights
        return FiniteDeformation(body, case.hats, roller, 0.0, solution, initial)

    def undeformed(body: ElasticBody, gap: np.ndarray) -> ModelFigures:
        contact = LinearContact(FiniteElementCompliance(body, case.hats))
        found = linear(body, contact, gap)
        stress = nodal_stress(body, found.displacement, case.hats, found.pressure)
        return _figures(found, stress, case.hats[1:-1], found.pressure)

    current = linear(rough, CurrentContact(rough, case.hats, roller))
    loaded = rough, current.displacement, case.hats, current.pressure
    along_roller = {"direction": lambda x: (roller(x)[1], np.ones_like(x))}
    current_stress = nodal_stress(*loaded, **along_roller)
    finite = press_finitely(rough, case.hats, roller, start, load=case.load)
    return [
        undeformed(flat, parabola),
        undeformed(flat, true),
        undeformed(rough, true),
        _figures(current, current_stress, current.place, current.cauchy_pressure),
        _figures(finite, finite.stress, finite.place, finite.cauchy_pressure),
    ]


def _figures(
    found: FiniteDeformation, stress: NodalStress, place: np.ndarray, pressure: np.ndarray
) -> ModelFigures:
    x = found.hats[1:-1]
    patches = contact_patches(x, found.pressure, found.gap)
    length = float(np.diff(np.interp(patches, x, place), axis=1).sum())
    window = (x[0], x[-1], DEEPEST)
    shear = maximum(found.body, stress, lambda s: s.tau1, window).value
    return ModelFigures(float(pressure.max()), length, shear, found.solution.iterations)


def threshold(points: list[tuple[float, float]], level: float) -> float | None:
    """The place where values first reach a level, None if they do not.

    points  (place, value); values at one place are averaged, linear in logarithms between places
    """
    places = sorted({x for x, _ in points})
    means = [float(np.mean([y for x, y in points if x == place])) for place in places]
    i = next((i for i, value in enumerate(means) if value >= level), None)
    if i is None or i == 0:
        return None if i is None else places[0]
    share = np.log(level / means[i - 1]) / np.log(means[i] / means[i - 1])
    return float(places[i - 1] * (places[i] / places[i - 1]) ** share)


def main(arguments: list[str] | None = None) -> int:
    """Print both tables and where 1 % of the peak pressure is reached; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--curvatures", type=float, nargs="*", default=CURVATURES, help="a/R")
    parser.add_argument("--slopes", type=float, nargs="*", default=SLOPES, help="rms")
    parser.add_argument("--seeds", type=int, nargs="+", default=SEEDS)
    parser.add_argument("--edges", type=int, default=80, help="to a half-width")
    options = parser.parse_args(arguments)
    smooth = [RollerCase(each, edges=options.edges) for each in sorted(options.curvatures)]
    rough = [
        RollerCase(ROUGH_CURVATURE, slope, seed, options.edges)
        for slope in sorted(options.slopes)
        for seed in options.seeds
    ]
    for title, name, cases in (("Smooth", "curvature", smooth), ("Rough", "slope", rough)):
        rows, points = [], []
        for case in cases:
            models = model_series(case)
            found = changes(models)
            numbers = (f"{case.curvature:g}", f"{case.slope:g}", f"{case.seed}")
            percents = (f"{100.0 * change:+.3f}" for change in found)
            rows.append((*numbers, f"{models[-1].peak:.3g}", *percents, f"{models[-1].iterations}"))
            points.append((getattr(case, name), abs(found.peak)))
        print_table(f"{title}, differences in per cent", COLUMNS, rows)
        place = threshold(points, MATTERS)
        where = "at no case" if place is None else f"from a {name} of {place:.2g}"
        print(f"linear kinematics misses {100.0 * MATTERS:g} % of the peak pressure {where}")
    return 0


if __name__ == "__main__":
    run_on_one_thread(main)
