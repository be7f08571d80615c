"""Stresses of one strip and of one hat against high-precision values; their scalars. Direct sums
of element stresses: what superposition, scaling and equilibrium demand. The tree against the sum
over all elements."""

from itertools import pairwise

import numpy as np
import pytest
from exact_stresses import hat_stress
from scenes import reference
from scipy.integrate import trapezoid
from strips import strip_stress

from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.stress.points import friction_stress_at, stress_at
from analytic.stress.tree import LoadedLine, direct_stress, tree_stress
from analytic.stress_state import StressState

STRIP = reference("b_uniform_strip")["points"]
HAT = reference("hat_stress")["points"]


def numbers(rows: list[dict], name: str) -> np.ndarray:
    return np.array([float(row[name]) for row in rows])


@pytest.mark.parametrize("load", ["normal", "tangential"])
@pytest.mark.parametrize("component", ["sx", "sz", "txz"])
def test_strip_reference_values_each_to_rounding(load, component):
    """Bailey and Sayles' equations (1) and (2), from 1e-12 to 1e6 half-widths, each component.

    One value, -1.27e-60, is written as 0 in the table: hence the absolute bound.
    """
    unit = strip_stress(numbers(STRIP, "x_over_a"), numbers(STRIP, "z_over_a"), 1.0)
    stress = unit.normal if load == "normal" else unit.traction
    expected = numbers([row[load] for row in STRIP], component)
    assert len(expected) == 33
    np.testing.assert_allclose(getattr(stress, component), expected, rtol=2e-15, atol=2e-60)


@pytest.mark.parametrize("component", ["sx", "sz", "txz", "sx_traction"])
def test_hat_reference_values(component):
    """To rounding of the largest stress everywhere, and of each component near the surface.

    Close below the hat the sx that is left between -p and -sz is a hundredth of what cancels.
    """
    x, z = numbers(HAT, "x_over_pitch"), numbers(HAT, "z_over_pitch")
    columns = [numbers(HAT, name) for name in ("sx", "sz", "txz", "sx_traction")]
    row = ["sx", "sz", "txz", "sx_traction"].index(component)
    stress, expected = hat_stress(x, z, 1.0).parts[row], columns[row]
    assert len(expected) == 64
    assert np.all(np.abs(stress - expected) <= 1e-14 * np.max(np.abs(columns), axis=0))
    shallow = (z < 1e-2) & (np.hypot(x, z) < 4.0)
    np.testing.assert_allclose(stress[shallow], expected[shallow], rtol=1e-14)


def test_hat_closed_form_and_moments_meet():
    """The tiers of the moments too: each joins the next within the rounding of the sum."""
    angle = np.linspace(0.0, np.pi, 41)
    for radius in (4.0, 16.0, 128.0, 512.0):
        inside, outside = (
            np.array(hat_stress(r * np.cos(angle), r * np.sin(angle), 1.0).parts)
            for r in (np.nextafter(radius, 0.0) * (1.0 - 1e-15), radius * (1.0 + 1e-15))
        )
        scale = 1.0 / radius
        assert np.abs(inside - outside).max() < 2e-14 * scale


def test_point_load_far_away():
    """Half-width 1/2 carries one unit; corrections are of the order 1/r^2."""
    for x, z in ((1e7, 1e-3), (-1e7, 1e7), (1.0, 1e7)):
        square = (x * x + z * z) ** 2
        point = -2.0 / np.pi / square * np.array([x * x * z, z**3, x * z * z, x**3])
        atol = 0.0 if abs(x) > 1.0 else 1e-13 / abs(z)
        np.testing.assert_allclose(strip_stress(x, z, 0.5).parts, point, rtol=1e-12, atol=atol)
        hat = hat_stress(x, z, 1.0).parts
        np.testing.assert_allclose(hat, point, rtol=0.0, atol=1e-13 * np.abs(point).max())


def test_surface_of_a_hat_is_its_own_load():
    x = np.array([-3.0, -1.0, -0.75, 0.0, 0.5, 1.0, 8.0])
    unit = hat_stress(x, 0.0, 1.0)
    hat = np.maximum(1.0 - np.abs(x), 0.0)
    np.testing.assert_array_equal(unit.normal.sz, -hat)
    np.testing.assert_array_equal(unit.normal.sx, -hat)
    np.testing.assert_array_equal(unit.traction.txz, -hat)
    np.testing.assert_array_equal(unit.normal.txz, 0.0)
    assert np.isfinite(unit.traction_sx).all()


def test_surface_of_a_strip_is_its_own_load_and_half_of_it_at_the_ends():
    x = np.array([-2.0, -0.5, 0.0, 0.3, 0.5, 0.6])
    unit = strip_stress(x, 0.0, 0.5)
    load = np.array([0.0, 0.5, 1.0, 1.0, 0.5, 0.0])
    np.testing.assert_array_equal(unit.normal.sz, -load)
    np.testing.assert_array_equal(unit.normal.sx, -load)
    np.testing.assert_array_equal(unit.traction_sx[[1, 4]], [np.inf, -np.inf])


def test_strip_has_a_logarithmic_spike_where_the_hat_is_bounded():
    """Each decade towards the end of a strip adds (2/pi) ln 10 to its sx under q."""
    z = 10.0 ** -np.arange(2.0, 13.0)
    strip, hat = strip_stress(0.5, z, 0.5).traction_sx, hat_stress(1.0, z, 1.0).traction_sx
    np.testing.assert_allclose(np.diff(strip), -2.0 / np.pi * np.log(10.0), rtol=2e-2)
    np.testing.assert_allclose(np.diff(strip)[4:], -2.0 / np.pi * np.log(10.0), rtol=1e-6)
    assert np.abs(hat - hat_stress(1.0, 0.0, 1.0).traction_sx).max() < 0.05
    assert np.abs(hat[-1] - hat_stress(1.0, 0.0, 1.0).traction_sx) < 1e-11


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.4999])
def test_scalars_of_random_tensors(nu):
    rng = np.random.default_rng(11)
    sx, sz, txz = rng.standard_normal((3, 50)) * 1e9
    stress, none, sy = StressState(sx, sz, txz), np.zeros(50), nu * (sx + sz)
    tensor = np.array([[sx, txz, none], [txz, sz, none], [none, none, sy]]).transpose(2, 0, 1)
    in_plane = np.linalg.eigvalsh(tensor[:, :2, :2])
    largest = 0.5 * (in_plane[:, 1] - in_plane[:, 0])
    np.testing.assert_allclose(stress.tau1, largest, rtol=0, atol=1e-5)
    np.testing.assert_allclose(stress.sy(nu), tensor[:, 2, 2], rtol=1e-14)
    deviator = tensor - np.trace(tensor, axis1=1, axis2=2)[:, None, None] / 3.0 * np.eye(3)
    expected = np.sqrt(1.5 * np.sum(deviator**2, axis=(1, 2)))
    np.testing.assert_allclose(stress.von_mises(nu), expected, rtol=1e-13)


def test_shapes_must_agree():
    with pytest.raises(ValueError, match="equal shape"):
        StressState(np.zeros(3), np.zeros(3), np.zeros(2))


RNG = np.random.default_rng(17)
PITCH = 2.0**-9
NODES = (np.arange(40) - 13.0) * PITCH
PRESSURE = np.maximum(RNG.standard_normal(40), 0.0) * 1e9
X, Z = RNG.uniform(-0.1, 0.15, 60), RNG.uniform(0.0, 0.05, 60)


def test_sum_of_the_elements():
    total = stress_at(NODES, PRESSURE, 0.3, X, Z)
    states = [hat_stress(X - node, Z, PITCH).at(0.3) for node in NODES]
    expected = sum(p * stress.parts for p, stress in zip(PRESSURE, states, strict=True))
    assert np.abs(total.parts - expected).max() < 1e-14 * PRESSURE.max()


@pytest.mark.parametrize("count", [20, 2000])  # one by one, and by the tree
def test_the_surface_has_no_sign(count):
    """A depth of -0.0 is the surface."""
    load = np.tile(PRESSURE, 10)
    nodes = np.arange(len(load)) * PITCH
    x = np.concatenate([nodes[::40], np.linspace(0.0, nodes[-1], count)])
    plus, minus = (stress_at(nodes, load, 0.3, x, zero * np.ones_like(x)) for zero in (0.0, -0.0))
    assert np.all(plus.sx == minus.sx) and np.all(plus.txz == minus.txz)


def test_many_elements_in_blocks_as_in_one():
    """More pairs than one block holds, and points of any shape."""
    x = np.linspace(-0.1, 0.2, 1900).reshape(19, 100)
    whole = friction_stress_at(NODES, np.full(40, 1e9), x, 0.01)
    assert whole.normal.sx.shape == (19, 100)
    single = [friction_stress_at(NODES, np.full(40, 1e9), x[k, 7], 0.01) for k in (0, 18)]
    parts = [one.normal.sx for one in single]
    np.testing.assert_allclose(whole.normal.sx[[0, 18], 7], parts, rtol=1e-13)
    idle = stress_at(NODES, np.zeros(40), 0.1, x, 0.01)
    np.testing.assert_array_equal(idle.sz, np.zeros((19, 100)))


@pytest.mark.parametrize(
    ("nodes", "pressure", "z", "said"),
    [
        (NODES**2, PRESSURE, 1.0, "uniform and ascending"),
        (NODES[::-1], PRESSURE, 1.0, "uniform and ascending"),
        (NODES, PRESSURE[1:], 1.0, "equal length"),
        (NODES[:1], PRESSURE[:1], 1.0, "at least 2 nodes"),
        (NODES, np.where(PRESSURE > 0.0, np.nan, 0.0), 1.0, "finite"),
        (NODES, PRESSURE, -1.0, "z must not be negative"),
    ],
)
def test_what_makes_no_stress_is_refused(nodes, pressure, z, said):
    with pytest.raises(ValueError, match=said):
        stress_at(nodes, pressure, 0.0, 0.0, z)


UNIT = hertz_from_peak_pressure(1.0, 1.0, 2.0)
UNIT_NODES = np.linspace(-1.0, 1.0, 401)
UNIT_PRESSURE = UNIT.pressure(UNIT_NODES)


def test_two_slanted_sections_carry_the_load_between_them():
    """A wedge under the contact is in equilibrium: tractions on its sides against p and q."""
    share, force = np.linspace(0.0, 1.0, 4001), np.zeros(2)
    corners = np.array([[-2.0, 0.0], [0.3, 1.5], [2.5, 0.0]])
    for start, stop in pairwise(corners):
        x, z = (start + share[:, None] * (stop - start)).T
        stress = stress_at(UNIT_NODES, UNIT_PRESSURE, 0.25, x, z)
        run, fall = stop - start
        # the normal of the wedge's side is (-fall, run) over its length
        along = trapezoid(run * stress.txz - fall * stress.sx, share)
        down = trapezoid(run * stress.sz - fall * stress.txz, share)
        force += along, down
    load = UNIT_PRESSURE.sum() * (UNIT_NODES[1] - UNIT_NODES[0])
    np.testing.assert_allclose(force, [-0.25 * load, -load], rtol=1e-5)


def line(rng: np.random.Generator, count: int, signs: bool) -> tuple[np.ndarray, np.ndarray]:
    nodes = (np.arange(count) - count // 3) * PITCH
    return nodes, rng.uniform(-1.0 if signs else 0.0, 1.0, count)


def points(rng: np.random.Generator, nodes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points on nodes and between them, at edges, on the surface and at depths, inside and out.

    x - node is a whole number of 2^-20 pitches, so that no method has a rounding to resolve.
    """
    width = nodes[-1] - nodes[0]
    x = [
        rng.uniform(nodes[0] - width, nodes[-1] + width, 400),
        np.repeat(nodes[::9], 2),
        np.repeat(nodes[::9] + 0.5 * PITCH, 2),
        rng.uniform(nodes[0] - 3.0 * PITCH, nodes[-1] + 3.0 * PITCH, 400),
    ]
    ends = np.tile([0.0, 1e-12], len(nodes[::9])) * PITCH
    z = [
        10.0 ** rng.uniform(-14.0, 0.0, 400) * width,
        ends,
        ends,
        rng.uniform(0.0, 40.0, 400) * PITCH,
    ]
    grain = PITCH * 2.0**-20
    return np.round(np.concatenate(x) / grain) * grain, np.concatenate(z)


@pytest.mark.parametrize("count", [64, 65, 700])
@pytest.mark.parametrize("signs", [False, True])
def test_tree_equals_direct_sum(rng, count, signs):
    """White noise: neighbours differ by as much as they are, which is the worst for the sums."""
    nodes, load = line(rng, count, signs)
    x, z = points(rng, nodes)
    direct = direct_stress(LoadedLine(nodes, load, PITCH), x, z)
    tree = tree_stress(LoadedLine(nodes, load, PITCH), x, z)
    assert np.abs(tree - direct).max() < 1e-13 * np.abs(direct).max()


@pytest.mark.parametrize("origin", [0.0, 0.05, -3.3])
def test_nodes_that_binary_numbers_do_not_hit(origin):
    """A pitch of 1 um far from the origin, against whole numbers, for which all is exact.

    At nodes as they are given nothing is lost; between them what rounding moves the point by.
    """
    rng = np.random.default_rng(31)
    count, pitch = 2000, 1e-6
    whole = np.arange(count)
    nodes, load = origin + whole * pitch, rng.uniform(0.0, 1.0, count)
    at_nodes = whole[::27]
    along = np.concatenate([at_nodes, rng.uniform(-9.0, count + 8.0, 75)])
    down = np.concatenate([np.zeros(len(at_nodes)), rng.uniform(0.1, 40.0, 75)])
    x = np.concatenate([nodes[at_nodes], origin + along[len(at_nodes) :] * pitch])
    direct = direct_stress(LoadedLine(nodes, load, pitch), x, down * pitch)
    tree = tree_stress(LoadedLine(nodes, load, pitch), x, down * pitch)
    ideal = direct_stress(LoadedLine(whole.astype(float), load, 1.0), along, down)
    assert np.abs(tree - direct).max() < 1e-13
    error = np.abs(direct - ideal)
    assert error[:, : len(at_nodes)].max() < 1e-14
    rounding = np.finfo(float).epsneg * np.abs(x).max() / pitch
    assert error[:, len(at_nodes) :].max() < 1e-13 + 2.0 * rounding


def test_far_from_all_load(rng):
    """From one width beyond the load to a million of them, shallow and deep: to rounding of the
    largest of the four stresses."""
    nodes, load = line(rng, 300, signs=False)
    width = nodes[-1] - nodes[0]
    distance, angle = np.meshgrid(
        np.geomspace(1.01, 1e6, 60) * width, [1e-9, 1e-4, 0.02, 0.7, 1.5, 2.2, 3.1, np.pi - 1e-6]
    )
    x = 0.5 * (nodes[0] + nodes[-1]) + (distance * np.cos(angle)).ravel()
    z = (distance * np.sin(angle)).ravel()
    direct = direct_stress(LoadedLine(nodes, load, PITCH), x, z)
    tree = tree_stress(LoadedLine(nodes, load, PITCH), x, z)
    assert np.all(np.abs(tree - direct) < 1e-12 * np.abs(direct).max(axis=0))


@pytest.mark.parametrize("count", [40, 3000])
def test_the_quicker_way_is_taken_without_a_seam(rng, count):
    """One point alone is summed directly, many together by the tree."""
    nodes, load = line(rng, 400, signs=False)
    x, z = rng.uniform(-0.5, 1.0, count), rng.uniform(0.0, 0.2, count)
    together = stress_at(nodes, load, 0.3, x, z)
    for k in (0, count // 2, count - 1):
        alone = stress_at(nodes, load, 0.3, x[k], z[k])
        assert np.abs(together.parts[:, k] - alone.parts).max() < 1e-13 * load.max()


def test_an_idle_stretch_and_idle_ends_change_nothing(rng):
    nodes, load = line(rng, 900, signs=False)
    load[:90], load[400:700], load[850:] = 0.0, 0.0, 0.0
    x, z = rng.uniform(-1.0, 2.0, 500), rng.uniform(0.0, 0.3, 500)
    stress = tree_stress(LoadedLine(nodes, load, PITCH), x, z)
    assert np.abs(stress - direct_stress(LoadedLine(nodes, load, PITCH), x, z)).max() < 1e-13
    alone = friction_stress_at(nodes, np.zeros(900), x, z)
    assert not np.any(alone.normal.sx) and not np.any(alone.traction_sx)


def test_threads_change_nothing(rng, monkeypatch):
    nodes, load = line(rng, 300, signs=True)
    x, z = rng.uniform(-0.3, 0.6, 9000), 10.0 ** rng.uniform(-6.0, -0.5, 9000)
    stress = []
    for threads in ("1", "3"):
        monkeypatch.setenv("OMP_NUM_THREADS", threads)
        stress.append(tree_stress(LoadedLine(nodes, load, PITCH), x, z))
    np.testing.assert_array_equal(*stress)
