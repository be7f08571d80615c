"""Crests that pressure elements do not resolve, against exact solutions of the spline that is
pressed: what is stated bounds the error, and is no more than a few times as large."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scenes import STEEL, half_plane_at, run_of
from scipy.optimize import root

from comparisons.judging.rule import judged
from comparisons.models.crest import RESOLVED
from comparisons.models.problem import Levels

NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)
# Ridges as (slopes to the left and right, half of the flat top, half the distance of two of them,
# spacing of samples, of which so many parts the first stands beside the crest, radius, load), SI.
RIDGES = {
    "blunt": (0.01, 0.01, 0.0, 0.0, 5e-7, 0.0, 50e-3, 1e5),
    "fine": (0.01, 0.01, 0.0, 0.0, 5e-8, 0.0, 50e-3, 1e5),
    "fine, beside": (0.01, 0.01, 0.0, 0.0, 5e-8, 0.3, 50e-3, 1e5),
    "steep, between": (0.03, 0.03, 0.0, 0.0, 2e-7, 0.5, 10e-3, 1e5),
    "flat": (0.003, 0.003, 0.0, 0.0, 1e-6, 0.0, 20e-3, 3e5),
    "flat, fine": (0.003, 0.003, 0.0, 0.0, 2e-8, 0.0, 20e-3, 5e4),
    "steeper, fine": (0.05, 0.05, 0.0, 0.0, 1e-8, 0.0, 5e-3, 5e4),
    "uneven": (0.02, 0.005, 0.0, 0.0, 1e-7, 0.0, 20e-3, 1e5),
    "uneven, beside": (0.02, 0.05, 0.0, 0.0, 1e-7, 0.25, 5e-3, 1e5),
    "truncated": (0.01, 0.01, 10e-6, 0.0, 1e-7, 0.5, 20e-3, 2e5),
    "little truncated": (0.03, 0.03, 3e-6, 0.0, 5e-7, 0.0, 10e-3, 1e5),
    "two": (0.01, 0.01, 0.0, 30e-6, 1e-7, 0.0, 20e-3, 1e5),
    "two, fine": (0.02, 0.02, 0.0, 20e-6, 2e-8, 0.0, 10e-3, 1e5),
    "coarse": (0.01, 0.01, 0.0, 0.0, 3e-6, 0.0, 50e-3, 1e5),
}


def ridge(folder: Path, name: str) -> dict:
    """The scene of a rigid roller on one of RIDGES, as tables."""
    left, right, flat, apart, spacing, beside, radius, load = RIDGES[name]
    reach = 2.5 * load / (230e9 * min(left, right)) + 2.0 * (apart + flat)
    count = round(reach / spacing)
    x = (np.arange(-count, count + 1) + beside) * spacing
    z = -np.where(x < 0.0, left, right) * np.maximum(np.abs(np.abs(x) - apart) - flat, 0.0)
    path = folder / "ridge.csv"
    np.savetxt(path, np.column_stack([x, z]), "%.17g", ",", header="x [m],z [m]", comments="")
    return {
        "title": name,
        "roller": {"radius": radius, "rigid": True},
        "body": dict(STEEL),
        "profile": {"file": str(path), "form": "none"},
        "load": {"per_length": load, "position": 0.0},
    }


class Patch:
    """The exact contact of one patch (Johnson 1985, section 2.7): with t = m + r cos phi on it

    int g'(t) dphi = 0,   P = (E*/2) int (t - m) g'(t) dphi,
    p(x) = (E*/2 pi) sqrt((x - a)(b - x)) int (g'(t) - g'(x))/(t - x) dphi,   0 < phi < pi.

    Of two like patches at both sides of x = 0, with the distance squared for x, g'/x for g' and p/x
    for p."""

    def __init__(self, posed, patch, two):
        surface, radius = posed.surface.profile.spline(), posed.scene.roller.radius
        self.two, self.knots, self.modulus = two, surface.x, posed.modulus
        self.slope = lambda t: t / radius - surface(t, 1)
        if two:
            self.knots, patch = surface.x[surface.x > 0.0] ** 2, np.square(patch)
            self.slope = lambda u: 1.0 / radius - surface(np.sqrt(u), 1) / np.sqrt(u)
        found = root(self._missed, patch, args=posed.hertz.load_per_length, tol=1e-13)
        assert np.abs(found.fun).max() < 1e-9
        self.ends = found.x

    def _points(self, ends, x=()):
        middle, reach = np.mean(ends), 0.5 * np.ptp(ends)
        breaks = np.concatenate([self.knots[(self.knots > ends[0]) & (self.knots < ends[1])], x])
        angles = np.arccos((breaks - middle) / reach)
        angles = np.sort(np.concatenate([np.linspace(0.0, np.pi, 65), angles]))
        steps = np.diff(angles)
        inside = angles[:-1] + 0.5 * (NODES[:, None] + 1.0) * steps
        return middle + reach * np.cos(inside.ravel()), (0.5 * WEIGHTS[:, None] * steps).ravel()

    def _missed(self, ends, load):
        t, weights = self._points(ends)
        slope = weights * self.slope(t)
        carried = 0.5 * self.modulus * np.sum((t - np.mean(ends)) * slope)
        return slope.sum() / np.abs(slope).sum(), carried / load - 1.0

    def pressure(self, x):
        """[Pa] at x [m]."""
        place = x**2 if self.two else x
        t, weights = self._points(self.ends, [place])
        beside = (self.slope(t) - self.slope(place)) / (t - place)
        size = np.sqrt((place - self.ends[0]) * (self.ends[1] - place)) / (2.0 * np.pi)
        return self.modulus * size * (weights @ beside) * (x if self.two else 1.0)

    def peak(self, near, pitch):
        """The largest pressure [Pa] within two pitches of an x [m]."""
        for reach in (2.0 * pitch, 0.1 * pitch, 0.005 * pitch):
            x = np.linspace(near - reach, near + reach, 81)
            pressures = [self.pressure(place) for place in x]
            near = x[np.nanargmax(pressures)]
        return np.nanmax(pressures)


@pytest.mark.parametrize("name", RIDGES)
def test_a_ridge_is_stated_as_uncertain_as_its_exact_peak_is_far(name, tmp_path):
    two = RIDGES[name][3] > 0.0
    run = run_of(ridge(tmp_path, name), "half_plane", levels=Levels(4))
    figure = run.figures.one(study="contact", quantity="peak_pressure")
    levels = run.runs["half_plane"].levels
    near = abs(figure.place[0]) if two else figure.place[0]
    exact = Patch(run.problem, levels[-1].patches[-1], two).peak(near, levels[-1].grid.pitch)
    assert figure.numerical > abs(exact / figure.value - 1.0)
    for level in levels:
        error, stated = abs(exact / level.solution.pressure.max() - 1.0), level.unresolved_crest
        assert error < (stated or 1.5 * RESOLVED)
        assert stated < max(2.2 * error, 2.2 * RESOLVED)


def test_refinement_goes_on_until_a_crest_is_resolved(tmp_path):
    run = run_of(ridge(tmp_path, "flat, fine"), "half_plane", tolerance={"peak_pressure": 0.02})
    finest = run.runs["half_plane"].finest
    assert finest.grid.pitch < RIDGES["flat, fine"][4]
    assert run.figures.one(study="contact", quantity="peak_pressure").numerical < 0.02


@pytest.mark.parametrize("seed", [0, 4])
def test_roughness_finer_than_the_elements_is_bounded(seed):
    """Against elements that resolve it; the levels alone state a fifth of the error."""
    samples, length = 20001, 2e-3
    waves = {"hurst": 0.8, "rms_slope": 0.02, "seed": seed, "samples": samples, "length": length}
    shortest = {"shortest_wavelength": 4.0 * length / (samples - 1)}
    tables = {
        "title": "Rough",
        "roller": {"radius": 10e-3, "rigid": True},
        "body": dict(STEEL),
        "profile": {"kind": "self-affine", **waves, **shortest},
        "load": {"per_length": 1e6},
        "resolution": {"elements": 60},
    }
    run = run_of(tables, "half_plane", levels=Levels(3))
    figure = run.figures.one(study="contact", quantity="peak_pressure")
    fine = half_plane_at(run.problem, run.runs["half_plane"].finest.grid.pitch / 32.0)
    error = abs(fine.solution.pressure.max() / figure.value - 1.0)
    assert 0.4 < error < figure.numerical < 2.0 * error


def test_what_meshes_and_hats_lack_of_a_crest_does_not_cancel(tmp_path):
    """Half-plane and finite elements under one period of wedges would agree."""
    x = np.linspace(0.0, 1e-3, 10001)
    z = -0.01 * np.abs(x - 0.5e-3)
    path = tmp_path / "wedges.csv"
    np.savetxt(path, np.column_stack([x, z]), "%.17g", ",", header="x [m],z [m]", comments="")
    tables = {
        "title": "Wedges",
        "roller": {"rigid": True},
        "body": dict(STEEL),
        "profile": {"file": str(path), "periodic": True, "form": "mean"},
        "load": {"mean_pressure": 1e8},
        "budget": {"effects": False},
    }
    run = run_of(tables, levels=Levels(2))
    difference = run.figures.one(study="comparison", quantity="peak_pressure")
    assert 0.01 < abs(difference.value) < difference.numerical
    largest = max(model.finest.unresolved_crest for model in run.runs.values())
    assert difference.numerical == pytest.approx(largest, rel=0.01)


def test_shears_under_a_crest_are_as_unresolved_as_its_pressure(tmp_path):
    tables = ridge(tmp_path, "fine") | {"stress": {"points": [40, 20]}}
    run = run_of(tables, "half_plane", levels=Levels(6))
    model = run.runs["half_plane"]
    known = judged(replace(model, levels=model.levels[:3]), run.problem)
    levels = run.figures.one(study="contact", quantity="tau1_max").levels
    error = abs(levels[-1] / levels[2] - 1.0)
    assert 0.03 < error < known["tau1_max"].total < 4.0 * error
    assert known["txz_max_abs"].total < 0.01  # which stands beside the crest
