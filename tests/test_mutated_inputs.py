"""Mutated inputs: the same for a seed, and what counts as a defect."""

import pytest
from mutated_inputs.inputs import profiles, scenes
from mutated_inputs.outcomes import Refusal, outcome, resolve

from analytic.surface.readers import instruments
from comparisons.common.errors import InputError


@pytest.mark.parametrize("inputs", [scenes, profiles])
def test_a_seed_gives_the_same_inputs_and_each_is_read_or_refused(tmp_path, monkeypatch, inputs):
    monkeypatch.setattr(instruments, "_ask", lambda *_: {"problem": "is no text"})
    rounds = []
    for again in ("first", "second"):
        (tmp_path / again).mkdir()
        made = inputs(tmp_path / again, range(40), 7)
        rounds.append([(n, path.read_bytes(), outcome(resolve, path)) for n, path in made])
    assert rounds[0] == rounds[1]
    assert {word for _, _, (word, _) in rounds[0]} == {"resolved", "refused"}
    assert len({content for _, content, _ in rounds[0]}) > 10


@pytest.mark.parametrize(
    ("error", "cause"),
    [
        (ZeroDivisionError("why"), "ZeroDivisionError: why"),
        (SystemExit(1), "SystemExit: 1"),
        (Refusal("not finite"), "not finite"),
        (InputError("is wrong"), "names no file"),
        (InputError("scene.toml: a map of nan m by 1 m"), "a number that is none"),
    ],
)
def test_what_is_a_defect(tmp_path, error, cause):
    def work(path):
        raise error

    word, account = outcome(work, tmp_path / "scene.toml")
    assert word == "DEFECT" and cause in account
