"""A missing stretch of x is a dropout, and rounded or uneven steps are not."""

import numpy as np
import pytest

from analytic.surface.readers.dropouts import gaps
from analytic.surface.readers.files import read_measured
from analytic.surface.readers.source import ProfileError

X = 0.5 * np.arange(400)  # um
Z = np.sin(X / 7.0)
KEPT = (X < 60.0) | (X > 90.0)


def written(folder, x, z, form="%.6g"):
    path = folder / "trace.csv"
    np.savetxt(path, np.column_stack([x, z]), fmt=form, delimiter=",")
    return path


def read(path, dropouts, **options):
    return read_measured(path, x_scale=1e-6, height_scale=1e-6, dropouts=dropouts, **options)


def test_a_gap_is_refused_where_it_is(tmp_path):
    path = written(tmp_path, X[KEPT], Z[KEPT])
    with pytest.raises(ProfileError) as caught:
        read(path, "refuse")
    assert str(caught.value) == (
        f"{path}: x has a gap from 5.95e-05 m to 9.05e-05 m (61 samples lost); correct it, or ask "
        "for dropouts to be bridged"
    )
    kept = KEPT & ((X < 20.0) | (X > 21.5))
    with pytest.raises(ProfileError, match=r"and at 1 more places \(65 samples lost\)"):
        read(written(tmp_path, X[kept], Z[kept]), "refuse")


def test_a_gap_is_bridged_by_a_straight_line(tmp_path):
    found = read(written(tmp_path, X[KEPT], Z[KEPT]), "bridge")
    np.testing.assert_allclose(found.profile.x, 1e-6 * X, atol=1e-15)
    np.testing.assert_allclose(found.profile.height[KEPT], 1e-6 * Z[KEPT], atol=1e-11)
    between = 1e-6 * np.interp(X[~KEPT], X[KEPT], Z[KEPT])
    np.testing.assert_allclose(found.profile.height[~KEPT], between, atol=1e-11)
    assert (found.bridged, found.trimmed) == (61, 0)
    assert found.stretch == pytest.approx((59.5e-6, 90.5e-6))


def test_lost_heights_and_a_gap_count_together(tmp_path):
    z = Z.copy()
    z[[3, 5]] = np.nan
    found = read(written(tmp_path, X[KEPT], z[KEPT]), "bridge")
    assert (found.bridged, found.trimmed) == (63, 0)
    assert found.stretch == pytest.approx((59.5e-6, 90.5e-6))


def test_a_gap_beyond_all_bounds_is_not_filled(tmp_path):
    x = np.append(X[:-1], 1e7)
    with pytest.raises(ProfileError, match=r"x has a gap of 199996.. samples; at most 2000000"):
        read(written(tmp_path, x, Z), "bridge")


def test_an_uneven_scan_of_an_instrument_has_gaps_too(tmp_path, monkeypatch):
    from analytic.surface.readers import files
    from analytic.surface.readers.topography import Topography

    scan = Topography(tmp_path, 1e-6 * Z[KEPT], None, 1e-6 * X[KEPT], 1.0, "made")
    monkeypatch.setattr(files, "read_instrument_file", lambda path, channel: scan)
    path = tmp_path / "trace.dat"
    path.write_bytes(b"\x00\x01")
    with pytest.raises(ProfileError, match=r"x has a gap from 5.95e-05 m to 9.05e-05 m"):
        read_measured(path)
    assert read_measured(path, dropouts="bridge").bridged == 61


RNG = np.random.default_rng(5)
WHOLE = {
    "even": X,
    "rounded to its own step": np.round(0.156 * np.arange(2000), 1),
    "rounded, rarely a longer step": np.round(0.101 * np.arange(2000), 1),
    "random steps": np.cumsum(RNG.uniform(0.2, 1.0, 500)),
    "steps of exponential length": np.cumsum(0.01 + RNG.exponential(1.0, 500)),
    "coarse, then fine": np.concatenate([np.arange(50.0), 50.0 + 0.1 * np.arange(200)]),
    "one sample lost": np.delete(X, 100),
    "few samples": np.array([0.0, 1.0, 2.0, 50.0, 51.0]),
}


@pytest.mark.parametrize("x", WHOLE.values(), ids=WHOLE)
def test_other_steps_are_no_gaps(x):
    assert gaps(x) == []
