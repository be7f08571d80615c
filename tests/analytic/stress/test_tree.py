"""The tree against the sum over all elements; expansions against the potential itself."""

import numpy as np
import pytest

from analytic.stress.points import friction_stress_at, stress_at
from analytic.stress.potential import (
    FAR_TERMS,
    ORDER,
    element_moments,
    element_potential,
    inner_to_child,
    nodes_to_outer,
    outer_to_inner,
    outer_to_parent,
    stresses,
)
from analytic.stress.tree import LoadedLine, direct_stress, tree_stress

PITCH = 2.0**-9


def line(rng: np.random.Generator, count: int, signs: bool) -> tuple[np.ndarray, np.ndarray]:
    nodes = (np.arange(count) - count // 3) * PITCH
    return nodes, rng.uniform(-1.0 if signs else 0.0, 1.0, count)


def points(
    rng: np.random.Generator, nodes: np.ndarray, lowest: float
) -> tuple[np.ndarray, np.ndarray]:
    """On nodes and between them, at their edges, on the surface and at every depth, inside and out.

    x - node is a whole number of 2^-20 pitches, so that no method has a rounding to resolve.
    """
    width = nodes[-1] - nodes[0]
    x = [
        rng.uniform(nodes[0] - width, nodes[-1] + width, 400),
        np.repeat(nodes[::9], 2),
        np.repeat(nodes[::9] + 0.5 * PITCH, 2),
        rng.uniform(nodes[0] - 3.0 * PITCH, nodes[-1] + 3.0 * PITCH, 400),
    ]
    ends = np.tile([lowest, 1e-12], len(nodes[::9])) * PITCH
    z = [
        10.0 ** rng.uniform(-14.0, 0.0, 400) * width,
        ends,
        ends,
        rng.uniform(0.0, 40.0, 400) * PITCH,
    ]
    grain = PITCH * 2.0**-20
    return np.round(np.concatenate(x) / grain) * grain, np.concatenate(z)


@pytest.mark.parametrize("count", [64, 65, 700])
@pytest.mark.parametrize("element", ["hat", "strip"])
@pytest.mark.parametrize("signs", [False, True])
def test_tree_equals_direct_sum(rng, count, element, signs):
    """White noise: neighbours differ by as much as they are, which is the worst for the sums."""
    nodes, load = line(rng, count, signs)
    x, z = points(rng, nodes, 0.0 if element == "hat" else 1e-13)
    direct = direct_stress(LoadedLine(nodes, load, PITCH, element), x, z)
    tree = tree_stress(LoadedLine(nodes, load, PITCH, element), x, z)
    assert np.abs(tree - direct).max() < 1e-13 * np.abs(direct).max()


@pytest.mark.parametrize("origin", [0.0, 0.05, -3.3])
@pytest.mark.parametrize("element", ["hat", "strip"])
def test_nodes_that_binary_numbers_do_not_hit(origin, element):
    """A pitch of 1 um far from the origin, against whole numbers, for which all is exact.

    At nodes as they are given nothing is lost; between them what rounding moves the place by.
    """
    rng = np.random.default_rng(31)
    count, pitch = 2000, 1e-6
    whole = np.arange(count)
    nodes, load = origin + whole * pitch, rng.uniform(0.0, 1.0, count)
    at_nodes = whole[::27]
    along = np.concatenate([at_nodes, rng.uniform(-9.0, count + 8.0, 75)])
    down = np.concatenate([np.full(len(at_nodes), 1e-3), rng.uniform(0.1, 40.0, 75)])
    if element == "hat":
        down[: len(at_nodes)] = 0.0
    x = np.concatenate([nodes[at_nodes], origin + along[len(at_nodes) :] * pitch])
    direct = direct_stress(LoadedLine(nodes, load, pitch, element), x, down * pitch)
    tree = tree_stress(LoadedLine(nodes, load, pitch, element), x, down * pitch)
    ideal = direct_stress(LoadedLine(whole.astype(float), load, 1.0, element), along, down)
    assert np.abs(tree - direct).max() < 1e-13
    error = np.abs(direct - ideal)
    assert error[:, : len(at_nodes)].max() < 1e-14
    rounding = np.finfo(float).epsneg * np.abs(x).max() / pitch
    assert error[:, len(at_nodes) :].max() < 1e-13 + 2.0 * rounding


@pytest.mark.parametrize("element", ["hat", "strip"])
def test_far_from_all_load(rng, element):
    """From one width beyond the load to a million of them, shallow and deep: to rounding of the
    largest of the four stresses."""
    nodes, load = line(rng, 300, signs=False)
    width = nodes[-1] - nodes[0]
    distance, angle = np.meshgrid(
        np.geomspace(1.01, 1e6, 60) * width, [1e-9, 1e-4, 0.02, 0.7, 1.5, 2.2, 3.1, np.pi - 1e-6]
    )
    x = 0.5 * (nodes[0] + nodes[-1]) + (distance * np.cos(angle)).ravel()
    z = (distance * np.sin(angle)).ravel()
    direct = direct_stress(LoadedLine(nodes, load, PITCH, element), x, z)
    tree = tree_stress(LoadedLine(nodes, load, PITCH, element), x, z)
    assert np.all(np.abs(tree - direct) < 1e-12 * np.abs(direct).max(axis=0))


@pytest.mark.parametrize("count", [40, 3000])
def test_the_quicker_way_is_taken_without_a_seam(rng, count):
    """One point alone is summed directly, many together by the tree."""
    nodes, load = line(rng, 400, signs=False)
    x, z = rng.uniform(-0.5, 1.0, count), rng.uniform(0.0, 0.2, count)
    together = stress_at(nodes, load, 0.3, x, z)
    for k in (0, count // 2, count - 1):
        alone = stress_at(nodes, load, 0.3, x[k], z[k])
        for name in ("sx", "sz", "txz"):
            difference = getattr(together, name)[k] - getattr(alone, name)
            assert abs(difference) < 1e-13 * load.max()


def test_an_idle_stretch_and_idle_ends_change_nothing(rng):
    nodes, load = line(rng, 900, signs=False)
    load[:90], load[400:700], load[850:] = 0.0, 0.0, 0.0
    x, z = rng.uniform(-1.0, 2.0, 500), rng.uniform(0.0, 0.3, 500)
    stress = tree_stress(LoadedLine(nodes, load, PITCH, "hat"), x, z)
    assert np.abs(stress - direct_stress(LoadedLine(nodes, load, PITCH, "hat"), x, z)).max() < 1e-13
    alone = friction_stress_at(nodes, np.zeros(900), x, z)
    assert not np.any(alone.normal.sx) and not np.any(alone.traction_sx)


def test_threads_change_nothing(rng, monkeypatch):
    nodes, load = line(rng, 300, signs=True)
    x, z = rng.uniform(-0.3, 0.6, 9000), 10.0 ** rng.uniform(-6.0, -0.5, 9000)
    stress = []
    for threads in ("1", "3"):
        monkeypatch.setenv("OMP_NUM_THREADS", threads)
        stress.append(tree_stress(LoadedLine(nodes, load, PITCH, "hat"), x, z))
    np.testing.assert_array_equal(*stress)


def outer_value(outer: np.ndarray, u: np.ndarray) -> np.ndarray:
    return sum(c / u ** (k + 1) for k, c in enumerate(outer)) / np.pi


def inner_value(inner: np.ndarray, u: np.ndarray) -> np.ndarray:
    return sum(c * u**k for k, c in enumerate(inner)) / np.pi


LOAD = np.array([0.3, 1.0, -0.4, 0.8, 0.0, 0.2, 0.9, 0.5])
SPHERE = np.exp(1j * np.linspace(0.0, np.pi, 9))


def potential_of_nodes(places: np.ndarray, w: np.ndarray, element: str) -> np.ndarray:
    """I from each element's stresses, by w in pitches."""
    unit = direct_stress(LoadedLine(places, LOAD, 1.0, element), w.real, w.imag)
    return 0.5j * (unit[0] + unit[1]) - 0.5 * (unit[3] + unit[2])


@pytest.mark.parametrize("element", ["hat", "strip"])
def test_outer_expansion_of_nodes_and_of_their_parent(element):
    places = np.arange(8) - 3.5
    outer = nodes_to_outer(8, element) @ LOAD
    w = 4.0 * 2.5 * SPHERE
    expected = potential_of_nodes(places, w, element)
    np.testing.assert_allclose(outer_value(outer, w / 4.0) / 4.0, expected, rtol=0.0, atol=1e-14)
    for side in (-1, 1):
        parent = outer_to_parent(side) @ outer
        w = 8.0 * 2.5 * SPHERE
        expected = potential_of_nodes(places + 4.0 * side, w, element)
        np.testing.assert_allclose(outer_value(parent, w / 8.0) / 8.0, expected, atol=1e-14)


@pytest.mark.parametrize("boxes", [-6, -4, 5])
def test_inner_expansion_and_that_of_its_halves(boxes):
    """`boxes` away the load stands at u = 2 boxes; the expansion holds at 3.6 half-widths."""
    outer = nodes_to_outer(8, "hat") @ LOAD
    inner = outer_to_inner(boxes) @ outer
    u = 3.6 * SPHERE
    expected = potential_of_nodes(np.arange(8) - 3.5 + 8.0 * boxes, 4.0 * u, "hat")
    np.testing.assert_allclose(inner_value(inner, u) / 4.0, expected, rtol=0.0, atol=2e-15)
    for side in (-1, 1):
        child = inner_to_child(side) @ inner
        np.testing.assert_allclose(
            inner_value(child, 2.0 * (u - 0.5 * side)) / 2.0, expected, rtol=0.0, atol=2e-14
        )


def test_moments_are_integrals_of_the_element():
    s, weight = np.polynomial.legendre.leggauss(40)
    for order in range(0, 20, 3):
        right = 0.5 * (s + 1.0)
        hat = 0.5 * weight @ ((1.0 - right) * (right**order + (-right) ** order))
        strip = 0.5 * weight @ (0.5 * s) ** order
        assert element_moments("hat", 20)[order] == pytest.approx(hat, abs=1e-15)
        assert element_moments("strip", 20)[order] == pytest.approx(strip, abs=1e-15)


@pytest.mark.parametrize(("start", "terms"), FAR_TERMS)
@pytest.mark.parametrize("element", ["hat", "strip"])
def test_potential_of_an_element_from_its_first_moments(start, terms, element):
    x, z = np.array([1.0, 1.3]) * start, np.array([0.0, 0.3, 5.0]) * start
    parts = element_potential(x, z, element, terms)
    stress = stresses(parts[0] + 1j * parts[1], parts[2] + 1j * parts[3])
    across, down = (a.ravel() for a in np.meshgrid(x, z))
    expected = direct_stress(LoadedLine(np.zeros(1), np.ones(1), 1.0, element), across, down)
    assert np.abs(stress.reshape(4, -1) - expected).max() < 5e-16 / start
    assert len(element_moments(element, ORDER)) == ORDER
