"""A case whose reference is good enough for what is raced here."""

import numpy as np
import pytest

from comparisons.benchmarks.finite_element_peers.cases import BlockCase, case_of


@pytest.fixture(scope="package")
def cylinder() -> BlockCase:
    """Hertz's contact."""
    return case_of("cylinder", np.zeros((0, 3)), (5, 10), finest=40)
