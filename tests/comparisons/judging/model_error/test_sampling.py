"""Share of a figure owed to the trace's sampling: stated, and held against finer samples."""

import numpy as np
import pytest
from scenes import KNOWN_STEEL, half_plane_at, run_of

from comparisons.common.provenance import as_json
from comparisons.common.tasks import Tasks
from comparisons.judging.effects.sampling import sampling_changes
from comparisons.judging.model_error.show import not_modelled_line
from comparisons.judging.rule import values_of
from comparisons.judging.study import Case, Solved
from comparisons.judging.verdict.headline import headline
from comparisons.models.level import Solution
from comparisons.models.problem import Levels
from comparisons.output.result import read_result, result_of

LENGTH, WAVE, AMPLITUDE = 1.2e-3, 60e-6, 0.3e-6


@pytest.fixture
def pressed(problem_with, tmp_path):
    """`pressed(n)`: a wave of n samples to a period, under a roller; its problem and levels."""

    def made(samples: int):
        x = np.arange(-0.5 * LENGTH, 0.5 * LENGTH, WAVE / samples)
        trace = np.column_stack([x, AMPLITUDE * np.cos(2.0 * np.pi * (x - 3e-6) / WAVE)])
        np.savetxt(tmp_path / "trace.csv", trace, delimiter=",", header="x,z", fmt="%.12e")
        file = {"file": str(tmp_path / "trace.csv"), "x_unit": "m", "z_unit": "m", "form": "none"}
        load, resolution = {"hertz_peak_pressure": 1e9}, {"pitch": 0.4e-6, "levels": 3}
        problem = problem_with(profile=file, load=load, resolution=resolution)
        levels = [half_plane_at(problem, pitch) for pitch in problem.pitches]
        return problem, levels

    return made


def stated(pressed, samples: int) -> tuple[dict, dict]:
    problem, levels = pressed(samples)
    case = Case(problem, {"half_plane": Solution("half_plane", tuple(levels))})
    changes = sampling_changes(Solved(problem, None, (case,)), Tasks())
    return values_of(levels[-1], problem), changes


@pytest.mark.parametrize("samples", [6, 9, 16])
def test_it_covers_what_finer_samples_change(pressed, samples):
    true, _ = stated(pressed, 200)
    coarse, doubt = stated(pressed, samples)
    for name in ("peak_pressure", "contact_length"):
        error = abs(coarse[name] / true[name] - 1.0)
        assert error <= doubt[name]


def test_of_a_well_sampled_wave_it_is_nothing(pressed):
    _, few = stated(pressed, 8)
    _, many = stated(pressed, 64)
    assert few["peak_pressure"] > 1e-4
    assert max(many[name] for name in ("peak_pressure", "contact_length")) < 1e-4
    # of fourth order, till edges are seen
    assert many["peak_pressure"] < 0.05 * few["peak_pressure"]
    assert set(many) == {"peak_pressure", "contact_length"}


@pytest.fixture
def flank(tmp_path):
    """`flank(n, apart)`: the run of a gear flank's trace of n samples so far apart [m]."""

    def solved(samples: int, apart: float):
        x, rough = apart * np.arange(samples), np.random.default_rng(3).standard_normal(samples)
        z = 150e-9 * np.sin(2.0 * np.pi * x / 830e-6) + 30e-9 * rough
        np.savetxt(tmp_path / "flank.csv", np.column_stack([x, z]), delimiter=",")
        tables = {
            "title": "Flank",
            "roller": {"radius": 12e-3, **KNOWN_STEEL},
            "body": dict(KNOWN_STEEL),
            "profile": {"file": str(tmp_path / "flank.csv"), "x_unit": "m", "z_unit": "m"},
            "load": {"per_length": 450e3},
            "tolerance": {"peak_pressure": 0.03, "contact_length": 0.03},
        }
        return run_of(tables, levels=Levels(2, 2))

    return solved


def test_a_trace_of_few_samples_on_the_contact_holds_within_nothing(flank, tmp_path):
    run = flank(60, 51e-6)
    said = headline(run)
    assert said.within.size is None and said.kind == "inconclusive"
    assert "the contact has 9.9 samples, 51.0 µm apart" in said.within.sentence
    assert "tolerance" not in said.next
    [peak, _] = run.model_errors
    assert abs(peak.value) + peak.numerical < 2e-3  # half-planes are no worse on few samples
    (tmp_path / "result.json").write_text(as_json(result_of(run).result), encoding="utf-8")
    read = read_result(tmp_path).figures
    assert read.one(study="model_error", quantity="peak_pressure").unknown == peak.unknown


def test_what_every_other_sample_changes_counts_like_any_effect(flank):
    run = flank(140, 22e-6)
    peak, sentence = headline(run).within.figure, headline(run).within.sentence
    assert peak.quantity == "peak_pressure" and "mostly sampling of the trace" in sentence
    assert peak.unknown["trace_sampling"] > 0.1
    assert peak.reach == pytest.approx(abs(peak.value) + peak.total)
    assert peak.verdict == "inconclusive"
    assert "sampling of the trace (at most" in not_modelled_line(run)
