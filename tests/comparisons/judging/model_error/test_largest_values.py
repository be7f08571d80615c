"""Largest values asperity by asperity: which one a model error is about, and what else may be it.

The models are made up: three asperities, whose largest shears and depths each solution just has.
"""

from dataclasses import replace
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np
import pytest

from comparisons.figures.figure import Figure
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging.model_error.model_error import Solutions, SplitVariants
from comparisons.judging.rule import QuantitiesOfInterest
from comparisons.judging.study import Case

PLACES = np.array([-30e-6, 0.0, 40e-6])
MODULE = "comparisons.judging.model_error.model_error"


def solution(*shears: float, depths=(1e-6, 2e-6, 3e-6)) -> QuantitiesOfInterest:
    figures = {"tau1_max": np.array(shears), "tau1_max_depth": np.array(depths)}
    return QuantitiesOfInterest(figures, {"tau1_max": PLACES})


def errors(
    problem, half_plane, plain, whole, effects: dict, settled: float = 1e-4, read=None
) -> dict[str, Figure]:
    """Errors of the largest shear and its depth; the same on all three levels. `read` gives another
    model's error of the solutions and a quantity."""
    runs = {}
    for name, of in (("half_plane", half_plane), ("finite_element", plain)):
        level = SimpleNamespace(values=of, solution=None)
        runs[name] = SimpleNamespace(levels=[level] * 3, finest=level)
    pairs = {name: (name, "plain") for name in effects}
    split = SplitVariants("whole", None, "plain", pairs, {}, ())
    history = [{"whole": whole, None: plain, "plain": plain, **effects}] * 3
    rows = []
    for name in ("tau1_max", "tau1_max_depth"):
        one, other = (of.largest()[name] for of in (half_plane, plain))
        difference = one / other - 1.0
        sure = Uncertainty({"numerical": settled})
        row = Figure("comparison", name, "half_plane", difference, {"friction": 0.0})
        rows.append(replace(row, against="finite_element", uncertainty=sure))
    stated = {name: SimpleNamespace(numerical=settled) for name in ("tau1_max", "tau1_max_depth")}
    with patch.multiple(
        MODULE,
        quantities_of=lambda level, problem: level.values,
        judged=lambda *arguments: stated,
        iteration=lambda *solutions: 0.0,
        relative_resolution=lambda *levels: 0.0,
        formal_order=lambda *of: 2.0,
    ):
        solutions = Solutions(Case(problem, runs), split, (), tuple(history), 3)
        if read is not None:
            return {error.quantity: error for error in read(solutions)}
        return {row.quantity: solutions.error(row) for row in rows}


def test_other_models_are_judged_by_their_own_largest_values(problem_with):
    """Finite elements without the effect that moves the maximum, with it, and a closed form; what
    is not known of the whole model is what is not known of the scene's own finite elements."""
    plain, strained = solution(1.0, 3.0, 2.9), solution(1.0, 2.7, 3.19)

    def errors_by(read) -> list[tuple[float, float]]:
        known = errors(problem_with(), plain, plain, strained, {}, 1e-3, read)
        return [(known[n].value, known[n].numerical) for n in ("tau1_max", "tau1_max_depth")]

    without = errors_by(lambda solutions: solutions.of_levels([plain] * 3))
    assert [value for value, _ in without] == pytest.approx([3.0 / 3.19 - 1.0, 2.0 / 3.0 - 1.0])
    assert errors_by(lambda of: of.of_levels([strained] * 3)) == [(0.0, 0.0)] * 2
    exact = errors_by(lambda of: of.of_exact(plain.largest()))
    assert [value for value, _ in exact] == pytest.approx([value for value, _ in without])
    assert exact[0][1] == pytest.approx(1e-3 * 3.0 / 3.19)
    whole = errors_by(lambda of: of.of_exact())
    assert whole == [(0.0, pytest.approx(1e-3 * ratio)) for ratio in (3.0 / 3.19, 2.0 / 3.0)]


def test_an_effect_that_moves_the_maximum_is_measured_where_the_whole_has_it(problem_with):
    """It raises the third asperity by 10 % and lowers the second by 10 %: no difference of the
    largest values, which stand at two x, is either."""
    plain, strained = solution(1.0, 3.0, 2.9), solution(1.0, 2.7, 3.19)
    result = errors(problem_with(), plain, plain, strained, {"finite_strain": strained})
    shear = result["tau1_max"]
    effect = shear.part("finite_strain")
    assert effect.value == pytest.approx(0.29 / 3.19) and effect.moves_maximum
    assert shear.value == pytest.approx(3.0 / 3.19 - 1.0)
    assert shear.part("jump").value == pytest.approx(0.1 / 3.19)
    assert shear.place == (0.0, 40e-6)
    jump, interaction = (shear.part(name).value for name in ("jump", "interaction"))
    assert shear.value == pytest.approx(-effect.value - interaction + jump)
    depth = result["tau1_max_depth"]
    assert depth.value == pytest.approx(-1.0 / 3.0)
    assert depth.part("jump").value == pytest.approx(-1.0 / 3.0)


def test_where_the_maximum_stays_there_is_no_jump(problem_with):
    plain, strained = solution(1.0, 3.0, 2.5), solution(1.0, 3.3, 2.6)
    shear = errors(problem_with(), plain, plain, strained, {"finite_strain": strained})["tau1_max"]
    assert (shear.part("jump").value, shear.place) == (0.0, None)
    assert not shear.part("finite_strain").moves_maximum
    assert shear.numerical == pytest.approx(1e-4, rel=0.5)


def test_effects_that_outweigh_each_other_interact(problem_with):
    plain, one, other = solution(1.0, 3.0, 2.0), solution(1.0, 3.1, 2.0), solution(1.0, 3.05, 2.0)
    effects = {"finite_strain": one, "exact_circle": other}
    whole = solution(1.0, 2.7, 2.0)
    shear = errors(problem_with(), plain, plain, whole, effects)["tau1_max"]
    assert shear.part("interaction").value == pytest.approx(-0.45 / 2.7)
    assert shear.part("jump").value == 0.0
    assert shear.value == pytest.approx(-sum(part.value for part in shear.parts))


def test_twin_peaks_are_not_said_to_move(problem_with):
    """Symmetric bodies have two equal largest values: rounding chooses one."""
    plain, strained = solution(3.0, 1.0, 3.0 - 1e-9), solution(3.3 - 1e-9, 1.0, 3.3)
    shear = errors(problem_with(), plain, plain, strained, {"finite_strain": strained})["tau1_max"]
    assert shear.place is None and not shear.part("finite_strain").moves_maximum
    assert shear.part("finite_strain").value == pytest.approx(0.3 / 3.3)


def test_an_asperity_that_may_have_it_counts_in_the_uncertainty(problem_with):
    near, far = solution(1.0, 3.0, 2.99), solution(1.0, 3.0, 2.5)
    of = [errors(problem_with(), shear, shear, shear, {}, settled=0.01) for shear in (near, far)]
    wide, narrow = (result["tau1_max"].numerical for result in of)
    assert narrow == pytest.approx(0.01) and wide == pytest.approx(narrow, abs=2e-4)
    # the depth may be the other one's
    wide, narrow = (result["tau1_max_depth"].numerical for result in of)
    assert narrow == pytest.approx(0.01) and wide == pytest.approx(0.01 + 1.0 / 2.0)
