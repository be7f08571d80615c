"""Meshes of the blocks of tests/blocks.py."""

from collections.abc import Callable
from functools import cache

import pytest
from blocks import ALL

from meshes.block import BlockMesh
from meshes.build import build_block


@pytest.fixture(scope="session")
def built() -> Callable[[str], BlockMesh]:
    """The mesh of a block by its name, built once for all modules."""
    return cache(lambda name: build_block(ALL[name]))


@pytest.fixture
def mesh(request, built) -> BlockMesh:
    return built(request.param)
