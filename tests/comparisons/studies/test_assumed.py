"""What a run says that its models assume: the run that was made, its whole model included."""

from types import SimpleNamespace

import pytest
from scenes import STEEL, resolved

from comparisons.figures.figure import Findings
from comparisons.models.plan import make_plan
from comparisons.models.posing import problem_of
from comparisons.studies.problem import _assumed
from comparisons.studies.study import Solved

TABLES = {
    "roller": {"radius": 8e-3, **STEEL},
    "body": {**STEEL, "yield_stress": 1e9, "hardening_modulus": 2e9},
    "profile": {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.2e-6},
    "load": {"per_length": 1e6},
}


@pytest.mark.parametrize(
    ("added", "said", "unsaid"),
    [
        (set(), ["elastic"], ["whole model", "von Mises"]),
        (
            {"plastic_flow"},
            ["half-plane: linear elasticity; whole model: von Mises' yield at 1 GPa, hardening by"],
            ["\nelastic"],
        ),
        ({"finite_strain"}, ["elastic", "whole model: neo-Hookean elasticity, finite"], ["yield"]),
    ],
)
def test_assumptions_are_those_of_the_run_that_was_made(added, said, unsaid):
    problem = problem_of(resolved(TABLES))
    solved = Solved(problem, make_plan(problem, ("half_plane", "finite_element")), None, {})
    selection = SimpleNamespace(added=added, whole=frozenset(added))
    budget = SimpleNamespace(selection=selection, wholes={0.0: "a level"})
    text = "\n" + "\n".join(_assumed(solved, Findings(data=budget)))
    assert all(words in text for words in (*said, "between samples the surface is a cubic spline"))
    assert not any(words in text for words in unsaid)
    assert ("\nthe finite elements beside the whole model: as the half-plane" in text) == bool(
        added
    )
