"""Where finite deformation carries the contact to the end of what can be pressed."""

from dataclasses import replace
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np
import pytest
from scenes import STEEL, problem

from comparisons.models.finite_element import nonlinear as finite_element_nonlinear
from comparisons.models.finite_element.nonlinear import pressed_finitely
from fem.solver.mumps import FemError

RIGID = {
    "roller": {"radius": 8e-3, "rigid": True},
    "body": STEEL,
    "load": {"hertz_peak_pressure": 2e9},
}
COMPUTED = {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.1e-6}
WHOLE = SimpleNamespace(rough=SimpleNamespace(body=None, hats=None, far=None))


def pressed(problem, shift: float):
    """Strained pressures in every node, on the trace of a scene moved by `shift` [m]."""
    grid = problem.grid(problem.pitches[0])
    alone = np.where(np.arange(len(grid.x)) == len(grid.x) // 2, 1.0, 0.0)
    linear = SimpleNamespace(pressure=alone)
    found = SimpleNamespace(pressure=np.ones(len(grid.x)))
    profile = problem.scene.profile
    if profile is not None:
        end = profile.x[-1] - grid.x[-1] - shift
        scene = replace(problem.scene, profile=profile.shifted(end))
        problem = replace(problem, scene=scene)
    with patch.object(finite_element_nonlinear, "press_finitely", return_value=found):
        return pressed_finitely(problem, WHOLE, grid, linear, problem.constraints())


@pytest.mark.parametrize(
    ("profile", "pitches", "words"),
    [(None, 0, "elements$"), (COMPUTED, 9, "elements$"), (COMPUTED, 1, "trace: take a longer one")],
)
def test_it_is_told_what_ends_there(profile, pitches, words):
    posed = problem(RIGID if profile is None else RIGID | {"profile": profile})
    with pytest.raises(FemError, match=f"reaches beyond the .*{words}"):
        pressed(posed, pitches * posed.pitches[0])
