"""Flow of the metal at a point: closed forms, an independent path, the tangent, scaling."""

import numpy as np
import pytest
from blocks import hooke
from scipy.integrate import solve_ivp

from analytic.material import Material
from analytic.material.hardening import Hardening
from analytic.stress_state import StressState, von_mises
from fem.nonlinear.plasticity import ElasticPlastic, PlasticState, return_mapping, stress_of

E, Y = 200.0, 0.5
HARDENING = [0.0, 15.0]
LAWS = {
    "perfect": Hardening(Y),
    "linear": Hardening(Y, 15.0),
    "table": Hardening(Y, table=((0.0, Y), (0.004, 0.7), (0.02, 0.9), (0.1, 1.0))),
    "voce": Hardening(Y, voce=(0.9, 60.0)),
    "ludwik": Hardening(Y, ludwik=(1.5, 0.3)),
    "kinematic": Hardening(Y, voce=(0.9, 60.0), kinematic=15.0),
}


@pytest.fixture(params=LAWS)
def law(request):
    return ElasticPlastic(Material(E, 0.3), LAWS[request.param])


def metal(hardening=0.0, poisson=0.3, unit=1.0):
    return ElasticPlastic(Material(E * unit, poisson), Hardening(Y * unit, hardening * unit))


def stress(law, strain, state):
    """Stress (k, 3) and sy (k,) of strains (k, 3)."""
    return stress_of(law.elastic.shear_modulus, law.elastic.poissons_ratio, strain, state)


def led(law, path):
    """Stress (3,), sy and state after strains (steps, 3) one after another."""
    state = PlasticState.virgin(1)
    for strain in path:
        state = return_mapping(law, strain[None], state).state
    (inside,), (across,) = stress(law, path[-1][None], state)
    return inside, across, state


@pytest.mark.parametrize("steps", [1, 7])
@pytest.mark.parametrize("hardening", HARDENING)
def test_pure_shear(hardening, steps):
    """tau = Y/sqrt 3, then the slope G H / (3 G + H), whatever the number of steps."""
    law = metal(hardening)
    shear = law.elastic.shear_modulus
    first = Y / np.sqrt(3.0) / shear
    twist = 3.0 * first
    path = np.outer(np.linspace(0.0, 1.0, steps + 1)[1:], [0.0, 0.0, twist])
    inside, across, state = led(law, path)
    slope = shear * hardening / (3.0 * shear + hardening)
    exact = Y / np.sqrt(3.0) + slope * (twist - first)
    np.testing.assert_allclose(inside, [0, 0, exact], atol=1e-14)
    assert across == pytest.approx(0.0, abs=1e-14)
    plastic = twist - inside[2] / shear
    assert state.equivalent[0] == pytest.approx(plastic / np.sqrt(3.0), rel=1e-12)


@pytest.mark.parametrize("poisson", [0.0, 0.3, 0.4999])
@pytest.mark.parametrize("hardening", HARDENING)
def test_one_strain_alone(hardening, poisson):
    """Strain exx only: q = 2 G exx up to Y, then q = Y + H k with 3 G k = 2 G exx - q."""
    law = metal(hardening, poisson)
    shear = law.elastic.shear_modulus
    strain = -4.0 * Y / (2.0 * shear)
    inside, across, state = led(law, np.array([[strain, 0.0, 0.0]]))
    k = (2.0 * shear * abs(strain) - Y) / (3.0 * shear + hardening)
    q = Y + hardening * k
    mean = E / (3.0 * (1.0 - 2.0 * poisson)) * strain
    np.testing.assert_allclose(inside, [mean - 2.0 * q / 3.0, mean + q / 3.0, 0.0], rtol=1e-12)
    assert across == pytest.approx(mean + q / 3.0, rel=1e-12)
    assert state.equivalent[0] == pytest.approx(k, rel=1e-12)


@pytest.mark.parametrize("hardening", HARDENING)
def test_below_yield_it_is_elastic_and_forgets(hardening):
    law = metal(hardening)
    strain = np.array([[1e-3, -4e-4, 7e-4]])
    step = return_mapping(law, strain, PlasticState.virgin(1))
    (inside,), (across,) = stress(law, strain, step.state)
    expected = hooke(law.elastic, *strain[0])
    np.testing.assert_allclose(inside, expected, rtol=1e-13)
    assert across == pytest.approx(0.3 * (expected[0] + expected[1]), rel=1e-13)
    assert von_mises(StressState(*inside), across) < Y
    assert not step.yields.any()
    assert step.softening.shape == (0, 3, 3)
    assert not step.state.strain.any()


def stretched(law, poisson, hardening, strain):
    """Plane-strain tension (sz = 0, exx given) by integrating the rates of Prandtl and Reuss.

    Written in full tensors with eyy = 0 and the rate of ezz from sz = 0: an independent
    computation.
    """
    compliance = (np.eye(3) * (1.0 + poisson) - poisson * np.ones((3, 3))) / E
    stiffness = np.linalg.inv(compliance)

    def rates(_, y):
        sigma = np.array([y[0], y[1], y[2]])  # xx, yy, zz
        deviator = sigma - sigma.mean()
        q = np.sqrt(1.5 * deviator @ deviator)
        tangent = stiffness
        if q >= (Y + hardening * y[3]) * (1.0 - 1e-12):
            along = 1.5 * deviator / q
            pushed = stiffness @ along
            tangent = stiffness - np.outer(pushed, pushed) / (along @ pushed + hardening)
        ezz = -tangent[2, 0] / tangent[2, 2]
        rate = tangent @ np.array([1.0, 0.0, ezz])
        k = 0.0
        if tangent is not stiffness:
            k = along @ stiffness @ np.array([1.0, 0.0, ezz]) / (along @ pushed + hardening)
        return [*rate, k, ezz]

    start = Y / np.sqrt(1.0 - poisson + poisson**2)
    elastic = start * (1.0 - poisson**2) / E
    ezz = -poisson * (1.0 + poisson) * start / E
    begin = [start, poisson * start, 0.0, 0.0, ezz]
    done = solve_ivp(rates, (elastic, strain), begin, rtol=1e-11, atol=1e-14, method="DOP853")
    return done.y[:, -1]


@pytest.mark.parametrize("hardening", HARDENING)
def test_plane_strain_tension_converges_to_the_rates(hardening):
    """First order in the step as the deviator turns from nu sx to sx/2 across; both bounds."""
    law = metal(hardening)
    strain = 3.0 * Y / E
    sx, sy, sz, k, _ = stretched(law, 0.3, hardening, strain)
    errors = []
    for steps in (20, 40, 80):
        state, ezz = PlasticState.virgin(1), 0.0
        for exx in np.linspace(0.0, strain, steps + 1)[1:]:
            for _ in range(30):  # Newton for sz = 0
                at = np.array([[exx, ezz, 0.0]])
                step = return_mapping(law, at, state)
                (inside,), (across,) = stress(law, at, step.state)
                lame = 2.0 * law.elastic.shear_modulus * 0.3 / 0.4
                slope = lame + 2.0 * law.elastic.shear_modulus
                slope -= step.softening[0, 1, 1] if step.yields[0] else 0.0
                ezz -= inside[1] / slope
                if abs(inside[1]) < 1e-13 * Y:
                    break
            state = step.state
        errors.append(abs(across - sy) / Y + abs(inside[0] - sx) / Y)
        assert state.equivalent[0] == pytest.approx(k, rel=0.05)
    assert sz == pytest.approx(0.0, abs=1e-9)
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all((orders > 0.8) & (orders < 1.2)), orders
    assert errors[-1] < 2e-3


@pytest.mark.parametrize("size", [1.0, 30.0])
def test_tangent_is_the_derivative(law, size):
    """Central differences of the stress, from a state with a history, at every point at once."""
    random = np.random.default_rng(3)
    before = return_mapping(
        law, 4.0 * Y / E * random.normal(size=(40, 3)), PlasticState.virgin(40)
    ).state
    strain = size * Y / E * random.normal(size=(40, 3))
    step = return_mapping(law, strain, before)
    assert step.yields.sum() > 5
    h = 1e-6 * size * Y / E
    elastic = np.array(hooke(law.elastic, *np.eye(3)))
    for column in range(3):
        ahead, behind = strain.copy(), strain.copy()
        ahead[:, column] += h
        behind[:, column] -= h
        up, down = (
            stress(law, s, return_mapping(law, s, before).state)[0] for s in (ahead, behind)
        )
        slope = (up - down) / (2.0 * h)
        tangent = np.tile(elastic[:, column], (40, 1))
        tangent[step.yields] -= step.softening[:, :, column]
        np.testing.assert_allclose(tangent, slope, atol=1e-7 * E)
    np.testing.assert_allclose(step.softening, step.softening.transpose(0, 2, 1), atol=1e-13 * E)


def test_stress_ends_on_the_yield_surface(law):
    random = np.random.default_rng(5)
    strain = 10.0 * Y / E * random.normal(size=(200, 3))
    step = return_mapping(law, strain, PlasticState.virgin(200))
    inside, across = stress(law, strain, step.state)
    reached = law.hardening.stress(step.state.equivalent)
    exx, ezz, exz = 2.0 / 3.0 * law.hardening.kinematic * step.state.strain.T
    q = von_mises(StressState(*(inside.T - [exx, ezz, exz])), across + exx + ezz)
    np.testing.assert_allclose(q[step.yields], reached[step.yields], rtol=1e-12)
    assert np.all(q[~step.yields] < Y)
    assert 0 < np.count_nonzero(~step.yields) < 50
    # what was reached is elastic when it is reached again, but for rounding
    again = return_mapping(law, strain, step.state)
    np.testing.assert_allclose(again.state.strain, step.state.strain, atol=1e-14)


def test_a_bar_sheared_to_and_fro():
    """Linear: after a reversal the isotropic metal yields at the stress that it had reached, the
    kinematic one when the stress has changed by 2 Y/sqrt 3; both harden by G H / (3 G + H)."""
    shear, twist = E / 2.6, 5e-3
    last = np.array([[0.0, 0.0, -twist]])
    first = Y / np.sqrt(3.0)
    slope = shear * 15.0 / (3.0 * shear + 15.0)
    there = first + slope * (twist - first / shear)
    for hardening, back in (
        (Hardening(Y, 15.0), there),
        (Hardening(Y, kinematic=15.0), 2.0 * first - there),
    ):
        law = ElasticPlastic(Material(E, 0.3), hardening)
        (_, _, reached), _, state = led(law, -last)
        assert reached == pytest.approx(there, rel=1e-12)
        state = return_mapping(law, last, state).state
        ((_, _, last_shear),), _ = stress(law, last, state)
        onset = twist - (there + back) / shear
        assert last_shear == pytest.approx(-back - slope * (onset + twist), rel=1e-12)


def test_units_do_not_matter():
    random = np.random.default_rng(7)
    strain = 3.0 * Y / E * random.normal(size=(50, 3))
    virgin = PlasticState.virgin(50)
    small, large = (
        return_mapping(metal(15.0, unit=unit), strain, virgin) for unit in (1.0, 2.0**30)
    )
    np.testing.assert_array_equal(small.state.strain, large.state.strain)
    np.testing.assert_array_equal(small.softening * 2.0**30, large.softening)
