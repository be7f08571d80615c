"""Conduction in time: steps, fluxes and pulses on a slab, orders in time, stored heat."""

import json

import numpy as np
import pytest
from doubling_times import doubling_times
from scenes import DATA
from scipy.special import erfc

from analytic.material import ThermalMaterial
from fem.body.coating import Coating
from fem.heat.body import thermal_body
from fem.heat.conduction import Conduction, Surroundings
from fem.heat.surface_heat import flux_load

UNIT = ThermalMaterial(1.0, 1.0, 1.0)
INSULATED = Surroundings("insulated", "insulated")
HEAT = json.loads((DATA / "h_heat.json").read_text())
T_L = 1.0 / 12.0  # L^2 / (12 kappa) of the slab


@pytest.fixture(scope="module")
def slab(structured_block):
    """Thickness 1, graded to the surface, of no variation along x: cubic elements, as quadratic
    ones a thousand times as wide as high vary along x by 4e-4."""
    z = np.concatenate([[0.0], np.geomspace(1e-3, 1.0, 30)])
    return thermal_body(structured_block(np.linspace(-1.0, 1.0, 3), z), UNIT, degree=3)


def test_a_step_at_a_face_of_a_slab(slab):
    held = Conduction(slab, 0.0, Surroundings("insulated", "insulated", "held"))
    times = np.unique(np.concatenate([doubling_times(1e-6, 16 * T_L, 32), T_L * CASES]))
    start = np.where(held.held, 1.0, 0.0)
    states = held.transient(lambda t: np.zeros(len(start)), times, start)
    history = dict(zip(times, states, strict=True))
    for row in HEAT["step_slab"]:
        t, y = T_L * float(row["t_over_tL"]), float(row["y_over_L"])
        (value,) = slab.at(np.array([[0.0, y]]), history[t])
        assert value == pytest.approx(float(row["exact"]), abs=2e-5)


CASES = np.array([float(row["t_over_tL"]) for row in HEAT["step_slab"]])


def face(slab, times, flux):
    """Temperature of the heated face at the times."""
    unit = flux_load(slab, np.linspace(-1.0, 1.0, 3), np.ones(3))
    plain, rest = Conduction(slab, 0.0, INSULATED), np.zeros(len(unit))
    states = plain.transient(lambda t: flux(t) * unit, times, rest)
    return {t: state[slab.surface.point[0]] for t, state in zip(times, states, strict=True)}


def test_a_flux_into_a_slab(slab):
    wanted = np.array([T_L * float(row["t_over_tL"]) for row in HEAT["constant_flux"]])
    times = np.unique(np.concatenate([doubling_times(1e-6, wanted[-1], 32), wanted]))
    history = face(slab, times, lambda t: 1.0)
    for t, row in zip(wanted, HEAT["constant_flux"], strict=True):
        assert history[t] == pytest.approx(float(row["slab_insulated_exact"]), rel=1e-4)


@pytest.mark.parametrize("duration", [0.25, 1.0])
def test_a_pulse_into_a_slab(slab, duration):
    pulses = [row for row in HEAT["pulse"] if float(row["t0_over_tL"]) == duration]
    wanted = np.array([T_L * float(row["t_over_tL"]) for row in pulses])
    end = T_L * duration
    off = end + doubling_times(1e-6, wanted[-1] - end, 32)
    on = doubling_times(1e-6, end, 32)
    times = np.unique(np.concatenate([on[on < end], off, wanted]))
    history = face(slab, times, lambda t: float(t <= end))
    for t, row in zip(wanted, pulses, strict=True):
        assert history[t] == pytest.approx(float(row["slab_insulated"]), rel=2e-4)
    assert len(pulses) > 1


def test_heat_is_stored_to_rounding(slab):
    unit = flux_load(slab, np.linspace(-1.0, 1.0, 3), np.ones(3))
    plain, times = Conduction(slab, 0.0, INSULATED), np.array([0.0, 1e-3, 2e-3, 5e-3, 0.1, 0.4])
    for t, state in zip(times, plain.transient(lambda t: unit, times, 0.0 * unit), strict=True):
        assert (slab.capacity @ state).sum() == pytest.approx(2.0 * t, rel=1e-10)


@pytest.mark.parametrize("velocity", [0.0, 3.0])
def test_the_order_in_time(structured_block, velocity):
    """T = cos(pi x) cos(pi z) (2 + sin(5 t)) on cubic elements, insulated."""
    mesh = structured_block(np.linspace(-1.0, 1.0, 25), np.linspace(0.0, 1.0, 13))
    body = thermal_body(mesh, UNIT, degree=3)
    moving = Conduction(body, velocity, INSULATED)
    x, z = np.pi * body.nodes.T
    shape, along = np.cos(x) * np.cos(z), -np.pi * np.sin(x) * np.cos(z)

    def load(t):
        wave, rate = 2.0 + np.sin(5.0 * t), 5.0 * np.cos(5.0 * t)
        source = (rate + 2.0 * np.pi**2 * wave) * shape + velocity * wave * along
        return body.capacity @ source

    ends = []
    for steps in (16, 32, 64, 128):
        times = np.linspace(0.0, 0.25, steps + 1)
        *_, last = moving.transient(load, times, 2.0 * shape)
        ends.append(last)
    change = np.abs(np.diff(ends, axis=0)).max(axis=1)
    assert np.log2(change[:-1] / change[1:]) == pytest.approx(3.0, abs=0.25)
    assert ends[-1] == pytest.approx((2.0 + np.sin(1.25)) * shape, abs=2e-4)


def two_layer_face(t, coat, below, thickness):
    """Of a coated half-space under a unit flux from t = 0, by the series of its images (Carslaw and
    Jaeger 1959, section 12.8)."""

    def ierfc(u):
        return np.exp(-(u**2)) / np.sqrt(np.pi) - u * erfc(u)

    ratio = (coat.effusivity - below.effusivity) / (coat.effusivity + below.effusivity)
    n = np.arange(1, 200)
    echoes = ratio**n * ierfc(n * thickness / np.sqrt(coat.diffusivity * t))
    return 2.0 * np.sqrt(t) / coat.effusivity * (1.0 / np.sqrt(np.pi) + 2.0 * echoes.sum())


@pytest.mark.parametrize("conductivity", [0.05, 20.0])
def test_a_coating_heated_in_time(structured_block, conductivity):
    coat, thickness = ThermalMaterial(conductivity, 2.0, 1.5), 0.05
    layer = np.concatenate([[0.0], np.geomspace(1e-3, thickness, 16)])
    z = np.concatenate([layer, np.geomspace(thickness, 20.0, 50)[1:]])
    mesh = structured_block(np.linspace(-1.0, 1.0, 3), z)
    body = thermal_body(mesh, UNIT, degree=3, coating=Coating(coat, thickness))
    times = doubling_times(1e-6, 1.0, 16)
    history = face(body, times, lambda t: 1.0)
    for t in times[times > 1e-4][::20]:
        assert history[t] == pytest.approx(two_layer_face(t, coat, UNIT, thickness), rel=3e-4)


def test_times_must_ascend(slab):
    moving = Conduction(slab, 0.0, INSULATED)
    with pytest.raises(ValueError, match="ascend"):
        list(moving.transient(lambda t: 0.0, np.array([0.0, 1.0, 1.0]), np.zeros(3)))
