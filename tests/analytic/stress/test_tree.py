"""The tree against the sum over all elements."""

import numpy as np
import pytest

from analytic.stress.points import friction_stress_at, stress_at
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
        assert np.abs(together.parts[:, k] - alone.parts).max() < 1e-13 * load.max()


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
