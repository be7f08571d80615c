"""Smooth and rough cases to judge linear kinematics on.

Lengths in half-widths of the smooth contact, stresses in Young's moduli. Rigid roller, Poisson's
ratio 0.3, no friction.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from scipy.interpolate import CubicSpline

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import solve_contact
from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.grid import HatGrid, roller_gap
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from analytic.surface.synthetic import self_affine

MATERIAL = Material(1.0, 0.3)
BLOCK = 400.0
HURST = 0.8
LONGEST, SHORTEST = 1.0, 0.25  # waves of the roughness
TRACE = 16.0  # length of the roughness, in the middle of which the roller stands
FADE = 0.5  # beyond the hats the roughness fades over this length
REACHES = (1.4, 2.0, 2.8, 4.0, 5.6, 7.0)  # that hats may have, rounded up to whole edges
UNTOUCHED = 0.85  # of the reach beyond which there must be no contact


@dataclass(frozen=True)
class Case:
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
        modulus = MATERIAL.plane_strain_modulus
        peak = 0.5 * modulus * self.curvature
        return hertz_from_peak_pressure(peak, self.radius, modulus).load_per_length

    @cached_property
    def reach(self) -> float:
        """Hats lie from -reach to reach, with the half-plane's contact well inside."""
        for wanted in REACHES:
            reach = float(np.ceil(wanted * self.edges)) / self.edges
            grid = HatGrid.within(-reach, reach, 1.0 / self.edges)
            pressure = self.pressed(grid, self.gap(grid, "parabola"))
            if np.abs(grid.x[pressure > 0.0]).max() < UNTOUCHED * reach:
                return reach
        raise ValueError(f"the contact reaches beyond {UNTOUCHED * reach:g} half-widths: {self}")

    @cached_property
    def grid(self) -> HatGrid:
        return HatGrid.within(-self.reach, self.reach, 1.0 / self.edges)

    def gap(self, grid: HatGrid, shape: Literal["parabola", "circle"]) -> np.ndarray:
        """Weighted initial gap over the hats of a grid, the roughness in it."""
        knots = np.arange(-64.0 * np.ceil(REACHES[-1]), 64.0 * np.ceil(REACHES[-1])) / 64.0
        return grid.hat_integrals(roller_gap(self.radius, self.roughness, shape), knots)

    def pressed(self, grid: HatGrid, gap: np.ndarray) -> np.ndarray:
        """The half-plane's pressure on a grid."""
        model = HalfPlane(grid.count, grid.pitch, MATERIAL.plane_strain_modulus)
        return solve_contact(model, gap, grid.weights, Constraints(load=self.load)).pressure

    @property
    def hats(self) -> np.ndarray:
        x = self.grid.x
        return np.concatenate([[x[0] - self.grid.pitch], x, [x[-1] + self.grid.pitch]])

    def roughness(self, x: np.ndarray) -> np.ndarray:
        """Height of the profile."""
        if self.slope == 0.0:
            return np.zeros_like(x)
        return self._spline(x)

    def height(self, x: np.ndarray) -> np.ndarray:
        """Height of the real boundary anywhere: the profile under the hats, which then fades."""
        share = np.clip((self.reach + FADE - np.abs(x)) / FADE, 0.0, 1.0)
        smooth = share**3 * (10.0 - 15.0 * share + 6.0 * share**2)
        return smooth * self.roughness(np.clip(x, -0.5 * TRACE, 0.5 * TRACE))

    @cached_property
    def _spline(self) -> CubicSpline:
        return self_affine(
            hurst=HURST,
            samples=int(64 * TRACE) + 1,
            length=TRACE,
            seed=self.seed,
            rms_slope=self.slope,
            shortest_wavelength=SHORTEST,
            longest_wavelength=LONGEST,
        ).spline()
