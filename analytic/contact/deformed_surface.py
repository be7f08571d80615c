"""Contact of half-planes on their deformed surfaces, to second order in the gradient of u.

p(x) is Cauchy's pressure, a force per current length at a current x, along the current normal.
In contact both surfaces are one curve s(x). A body's surface was at X = x - u_x before, at its
height h there, so that

    s(x) = h(x - u_x(x)) + u_y(x),

which is exact: no slope of h has to be small, for the pressure flattens it. Cauchy's stress of a
law of third order (`analytic.material.third_order`) is expanded to second order in grad u at
current x. u1 balances p on a flat surface; u2 balances what is quadratic in grad u1. Of waves
p(k) of the pressure the outward u2 of the surface is, for k > 0,

    u2(k) = -A / (2 k) (p+ p+)(k) - B (P+ p-)(k)        p+, p- waves k > 0 and k < 0 of p
    G^2 A = 5/2 - 6 nu + 4 nu^2 + c                     P+ = p+ / k
    G^2 B = 3/2 - 3 nu + 2 nu^2 + c                     (f g)(k): of the product of f(x) and g(x)
    c = (l t^3 + m t (1 + t^2) / 2) / G                 t = 1 - 2 nu

and where the surface bears on a curve s, of slope -t s' p / (2 G) besides. A and B follow from the
equations of elasticity wave by wave; a test solves these. Friction has no part in u2.

    p     pressure [Pa]           G, nu  shear modulus [Pa], Poisson's ratio
    u_x   in +x [m], of p: u_x' = -t p / (2 G)      l, m   third-order constants [Pa]
    u_y   outward [m]"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy import fft

from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid
from analytic.material import Material
from analytic.material.third_order import third_order
from analytic.operators.half_plane import HalfPlane

PADDING = 8  # grid lengths of the ring on which waves are taken: its images move u2 by 1e-3
ROUNDS = 2  # of pressures and the gap that they deform; a third moves peaks by 1e-4 (p/E)

Curve = Callable[[np.ndarray], np.ndarray]  # of x (n,) [m] a height (n,) [m]
Solver = Callable[[np.ndarray, np.ndarray], ContactSolution]  # of weighted gap and first pressures


@dataclass(frozen=True)
class SecondOrderSurface:
    """A body's surface under pressures (n,) [Pa] of hats at equal distances `pitch` [m]."""

    material: Material
    pitch: float

    @property
    def symbols(self) -> tuple[float, float]:
        """A and B [1/Pa^2]."""
        nu, shear = self.material.poissons_ratio, self.material.shear_modulus
        ell, m, _ = third_order(self.material.law, self.material)
        t = 1.0 - 2.0 * nu
        law = (ell * t**3 + 0.5 * m * t * (1.0 + t**2)) / shear
        same = 2.5 - 6.0 * nu + 4.0 * nu**2 + law
        mixed = 1.5 - 3.0 * nu + 2.0 * nu**2 + law
        return same / shear**2, mixed / shear**2

    def aside(self, pressure: np.ndarray) -> np.ndarray:
        """u_x (n,) [m]; far away it is as much inward on either side."""
        inward = np.cumsum(pressure) - 0.5 * (pressure + pressure.sum())
        return -self._shortening * self.pitch * inward

    def rise(self, pressure: np.ndarray, slope: np.ndarray) -> np.ndarray:
        """u_y of second order (n,) [m] but for a constant, on a curve of `slope` (n,)."""
        count = fft.next_fast_len(PADDING * len(pressure))
        k = 2.0 * np.pi * fft.fftfreq(count, self.pitch)
        divisor = np.where(k > 0.0, k, np.inf)
        # the mean is half of either sign: without it the ring would bear no load
        waves = fft.fft(pressure, count) * (0.5 * np.sign(k) + 0.5)
        ahead, integral = fft.ifft(waves), fft.ifft(waves / divisor)
        same, mixed = self.symbols
        products = mixed * fft.fft(integral * ahead.conj())
        products = np.where(k > 0.0, products, 0.0) + 0.5 * same * fft.fft(ahead**2) / divisor
        local = -self._shortening * slope * pressure
        beneath = self.pitch * (np.cumsum(local) - 0.5 * local)
        return beneath - 2.0 * fft.ifft(products).real[: len(pressure)]

    @property
    def _shortening(self) -> float:
        """Strain of the surface along x by pressure, as a shortening [1/Pa]."""
        return (0.5 - self.material.poissons_ratio) / self.material.shear_modulus


@dataclass(frozen=True)
class DeformedContact:
    """A roller, elastic or rigid (None), on a body whose surface may be rough."""

    grid: HatGrid
    body: Material
    roller: Material | None
    height: Curve  # of the body's surface, undeformed
    sagitta: Curve  # of the roller's, up
    knots: np.ndarray | None  # (k,) [m] where the height's third derivative jumps

    def pressed(self, solve: Solver, linear: ContactSolution) -> ContactSolution:
        """The contact by successive approximation, from its linear solution on."""
        solution = linear
        for _ in range(ROUNDS):
            gap = self.grid.hat_integrals(self.gap(solution.pressure), self.knots)
            solution = solve(gap, solution.pressure)
        return solution

    def gap(self, pressure: np.ndarray) -> Curve:
        """The gap [m] that linear displacements have to close where `pressure` (n,) [Pa] has moved
        the points of both surfaces."""
        from scipy.interpolate import CubicSpline

        x, pitch = self.grid.x, self.grid.pitch
        body = SecondOrderSurface(self.body, pitch)
        slope = np.gradient(self.sagitta(x), x)
        below, above, second = body.aside(pressure), np.zeros(len(x)), np.zeros(len(x))
        if self.roller is not None:
            roller = SecondOrderSurface(self.roller, pitch)
            above = roller.aside(pressure)
            operator = HalfPlane(len(x), pitch, self.roller.plane_strain_modulus)
            # by which the pressure flattens the roller
            slope = slope + np.gradient(operator.apply(pressure) / self.grid.weights, x)
            second = roller.rise(pressure, -slope)  # the roller is turned over
        second = second + body.rise(pressure, slope)
        aside = CubicSpline(x, np.array([below, above, second]), axis=1)

        def gap(at: np.ndarray) -> np.ndarray:
            moved, other, risen = aside(at)
            return self.sagitta(at - other) - self.height(at - moved) - risen

        return gap
