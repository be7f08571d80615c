"""CalculiX' deck holds the whole problem, and its results are read rightly."""

import sys

import numpy as np
import pytest

from tests.finite_element_peers.calculix import deck, last_contact, seconds_of
from tests.finite_element_peers.task import FailedError, gap


@pytest.fixture(scope="module")
def task(cylinder):
    return cylinder.task(5, 0.4)


def blocks(deck: str) -> dict[str, list[list[str]]]:
    """Rows by their keyword line."""
    found: dict[str, list[list[str]]] = {}
    for line in deck.splitlines():
        if line.startswith("*"):
            rows = found.setdefault(line, [])
        else:
            rows.append(line.split(","))
    return found


def test_calculix_block_has_the_gap_on_its_top(task):
    found = blocks(deck(task))
    nodes = np.array(found["*NODE"], dtype=float)
    count = len(task.mesh.points)
    x, z = task.mesh.points.T
    top = task.touchable(x, z)
    lowered = np.where(top, gap(x), 0.0)
    np.testing.assert_allclose(nodes[:count, 1], x, rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(nodes[:count, 2], -z - lowered, rtol=1e-13, atol=1e-13)
    assert np.abs(nodes[:count, 2] + z).max() > 1e-6
    assert nodes[count:, 2].min() == 0.0  # the punch begins where the gap does
    elements = np.array(found["*ELEMENT,TYPE=CPE6,ELSET=BLOCK"], dtype=int)[:, 1:] - 1
    corner = nodes[elements[:, :3], 1:]
    side, other = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    assert (side[:, 0] * other[:, 1] - side[:, 1] * other[:, 0]).min() > 0.0
    flat = task.mesh.points[elements]
    for middle, ends in ((3, (0, 1)), (4, (1, 2)), (5, (2, 0))):
        np.testing.assert_allclose(flat[:, middle], flat[:, ends].mean(axis=1), atol=1e-12)


def test_calculix_faces_cover_the_top_and_sets_the_support(task):
    found = blocks(deck(task))
    elements = np.array(found["*ELEMENT,TYPE=CPE6,ELSET=BLOCK"], dtype=int)[:, 1:] - 1
    faces = found["*SURFACE,NAME=TOP"]
    ends = {"S1": (0, 1), "S2": (1, 2), "S3": (2, 0)}
    pairs = np.array([elements[int(e) - 1][list(ends[face])] for e, face in faces])
    assert np.abs(np.diff(task.mesh.points[pairs, 0])).sum() == pytest.approx(np.ptp(task.ends))
    fixed = np.array(found["*NSET,NSET=FIXED"], dtype=int).ravel() - 1
    np.testing.assert_array_equal(fixed, np.flatnonzero(task.fixed(*task.mesh.points.T)))


FRD = """    2C                             3                                     1
 -1         1 1.00000E+00 0.00000E+00 0.00000E+00
 -3
 -4  CONTACT     6    1
 -5  COPEN       1    4    1    1
 -1         1 0.00000E+00 0.00000E+00 0.00000E+00 7.00000E+00 0.00000E+00 0.00000E+00
 -1         9 0.00000E+00 0.00000E+00 0.00000E+00 8.00000E+00 0.00000E+00 0.00000E+00
 -3
 -4  DISP        4    1
 -1         1 1.00000E+00 1.00000E+00 1.00000E+00 9.00000E+00
 -3
 -4  CONTACT     6    1
 -1         1 0.00000E+00-1.00000E+00 0.00000E+00 2.50000E+00 0.00000E+00 0.00000E+00
 -1        12 0.00000E+00 0.00000E+00 0.00000E+00-1.00000E-01 0.00000E+00 0.00000E+00
 -3
"""


def test_calculix_pressures_are_those_of_the_last_increment():
    nodes, pressure = last_contact(FRD)
    assert list(nodes) == [1, 12]
    assert list(pressure) == [2.5, -0.1]
    with pytest.raises(FailedError, match="no contact pressures"):
        last_contact(FRD.replace("CONTACT", "STRESS"))


def test_processes_are_charged_their_processor_time(tmp_path):
    def seconds(program: str, limit: float = 60.0) -> float:
        return seconds_of([sys.executable, "-c", program], tmp_path, limit)

    assert 0.19 < seconds("import time\nwhile time.process_time() < 0.2: pass") < 1.0
    assert seconds("import time; time.sleep(0.3)") < 0.2
    with pytest.raises(FailedError, match=r"not done after 0.2 s"):
        seconds("while True: pass", 0.2)
    with pytest.raises(FailedError, match=r"^one last$"):
        seconds("import sys; print('one'); sys.exit('last')")
