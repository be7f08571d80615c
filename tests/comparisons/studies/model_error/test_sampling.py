"""What a figure owes to the sampling of the trace: stated, and held against finer samples."""

import numpy as np
import pytest
from scenes import half_plane_at

from comparisons.common.tasks import Tasks
from comparisons.studies.contact import values_of
from comparisons.studies.model_error.sampling import sampling_changes

LENGTH, WAVE, AMPLITUDE = 1.2e-3, 60e-6, 0.3e-6


@pytest.fixture
def pressed(problem_with, tmp_path):
    """`pressed(n)`: a wave of n samples to a period, under a roller; its problem and levels."""

    def made(samples: int):
        x = np.arange(-0.5 * LENGTH, 0.5 * LENGTH, WAVE / samples)
        trace = np.column_stack([x, AMPLITUDE * np.cos(2.0 * np.pi * (x - 3e-6) / WAVE)])
        np.savetxt(tmp_path / "trace.csv", trace, delimiter=",", header="x,z", fmt="%.12e")
        problem = problem_with(
            profile={
                "file": str(tmp_path / "trace.csv"),
                "x_unit": "m",
                "z_unit": "m",
                "form": "none",
            },
            load={"hertz_peak_pressure": 1e9},
            resolution={"pitch": 0.4e-6, "levels": 3},
        )
        levels = [half_plane_at(problem, pitch) for pitch in problem.pitches]
        return problem, levels

    return made


def stated(pressed, samples: int) -> tuple[dict, dict]:
    problem, levels = pressed(samples)
    changes = sampling_changes(problem, None, levels, Tasks())
    return values_of(levels[-1], problem, 0.0), changes[0.0]


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
    assert (
        many["peak_pressure"] < 0.05 * few["peak_pressure"]
    )  # of fourth order, till edges are seen
    assert set(many) == {"peak_pressure", "contact_length"}
