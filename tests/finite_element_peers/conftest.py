"""A case whose reference is good enough for what is compared here."""

import pytest

from tests.finite_element_peers import cases


@pytest.fixture(scope="package")
def cylinder() -> cases.BlockCase:
    """Hertz's contact."""
    return cases.cylinder(finest=40)
