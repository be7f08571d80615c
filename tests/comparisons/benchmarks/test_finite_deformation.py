"""The benchmark of what linear kinematics does not model, on coarse meshes."""

import re

import numpy as np
import pytest

from comparisons.benchmarks.finite_deformation import (
    MATERIAL,
    RollerCase,
    changes,
    main,
    model_series,
    threshold,
)


def test_changes_are_in_proportion_to_the_curvature():
    """The circle's to its square."""
    curvatures = (0.08, 0.04)
    series = [model_series(RollerCase(curvature, edges=10)) for curvature in curvatures]
    smooth = [changes(models) for models in series]
    for name, order in (("circle", 2.0), ("place", 1.0), ("strain", 1.0), ("peak", 1.0)):
        ratio = getattr(smooth[0], name) / getattr(smooth[1], name)
        assert np.log2(ratio) == pytest.approx(order, abs=0.2), name
    for curvature, models, each in zip(curvatures, series, smooth, strict=True):
        assert each.geometry == 0.0
        assert each.circle + each.place + each.strain == pytest.approx(each.peak, rel=1e-12)
        hertz = 0.5 * MATERIAL.plane_strain_modulus * curvature
        assert models[-1].peak == pytest.approx(hertz * (1.0 + each.peak), rel=5e-3)
    assert smooth[0].peak == pytest.approx(0.0058, rel=0.1)


def test_a_rough_case_has_a_geometry():
    case = RollerCase(0.02, slope=0.05, seed=1, edges=10)
    models = model_series(case)
    assert 1e-6 < abs(changes(models).geometry) < 1e-2
    assert models[-1].peak > 2.0 * case.curvature * MATERIAL.plane_strain_modulus / 2.0
    x = np.linspace(-7.5, 7.5, 20001)
    slope = np.gradient(case.roughness(x), x)
    assert np.sqrt(np.mean(slope**2)) == pytest.approx(0.05, rel=0.1)
    edge = case.reach + 0.6
    assert np.all(case.height(np.array([-edge, edge])) == 0.0)


def test_thresholds_are_linear_in_logarithms():
    points = [(1.0, 0.001), (10.0, 0.008), (10.0, 0.012), (100.0, 0.1)]
    assert threshold(points, 0.01) == pytest.approx(10.0)
    assert threshold(points, 0.001 * np.sqrt(10.0)) == pytest.approx(np.sqrt(10.0))
    assert threshold(points, 0.0001) == 1.0
    assert threshold(points, 1.0) is None


def test_both_tables_are_printed(capsys):
    arguments = ["--curvatures", "0.01", "--slopes", "0.05", "--seeds", "1", "--edges", "8"]
    assert main(arguments) == 0
    shown = capsys.readouterr().out
    assert len(re.findall(r"│ 0.01 │ +0(.05)? │", shown)) == 2
    assert shown.count("linear kinematics misses 1 % of the peak pressure") == 2
