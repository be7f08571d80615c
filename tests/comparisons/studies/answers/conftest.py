"""Hertz' exact pressure, and what is made of it, as answers from outside."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scenes import QUICK, problem, resolved

from comparisons.judging.study import Run
from comparisons.runs.run import run


@pytest.fixture(scope="session")
def hertz():
    return problem(QUICK).hertz


@pytest.fixture
def curve(tmp_path, hertz) -> Callable[..., dict]:
    """`curve(x, p)`: the section of an answer whose file has Hertz' pressure, changed by functions
    of x [m] and of p [Pa]."""

    def written(x=lambda x: x, p=lambda p: p, contact=hertz, points=801, **options) -> dict:
        place = 1.2 * contact.half_width * np.linspace(-1.0, 1.0, points)
        rows = np.column_stack([x(place), p(contact.pressure(place))])
        path = tmp_path / f"answer{len(list(tmp_path.iterdir()))}.csv"
        np.savetxt(path, rows, delimiter=",", header="x,p", comments="")
        return {"file": str(path), **options}

    return written


@pytest.fixture
def answered() -> Callable[..., Run]:
    """`answered(section)`: the half-plane of a smooth contact beside one answer, "other"."""

    def solved(section: dict, out: Path | None = None, **changes):
        scene = resolved(QUICK | changes | {"answers": {"other": section}})
        return run(scene, out, ("half_plane",))

    return solved
