"""Runs under loads out of the ordinary: by an approach, and so light that one crest touches."""

import numpy as np
import pytest
from scenes import STEEL, run_of

from analytic.exact.hertz import hertz_from_load
from comparisons.common.errors import ExitStatus
from comparisons.figures.quantity import MODELS
from comparisons.studies.scatter.shares import designs
from comparisons.studies.scatter.study import values_at


def test_approach_prescribed_on_a_layer():
    tables = {
        "roller": {"radius": 10e-3, "rigid": True},
        "body": {"youngs_modulus": 3e9, "poissons_ratio": 0.35, "thickness": 4e-4},
        "load": {"approach": 10e-6},
        "budget": {"effects": False},
    }
    outcome = run_of(tables)
    [approach] = outcome.figures.of(study="contact", quantity="approach")
    assert approach.source == "finite_element"
    assert approach.value == pytest.approx(10e-6, rel=1e-3)
    why = outcome.findings["contact"].said("no approach", "half_plane")
    assert "known but for a constant" in why
    assert outcome.exit_status == ExitStatus.OUTSIDE_TOLERANCE


@pytest.mark.parametrize("load", [1.0, 1e-3])
def test_a_load_that_touches_one_crest_only(load):
    """Both models find Hertz's contact on the crest's own curvature, however light the load."""
    wavelength, amplitude = 50e-6, 0.2e-6
    tables = {
        "roller": {"radius": 10e-3, **STEEL},
        "body": dict(STEEL),
        "profile": {"kind": "sinusoid", "wavelength": wavelength, "amplitude": amplitude},
        "load": {"per_length": load},
        "budget": {"effects": False},
    }
    outcome = run_of(tables)
    curvature = 1.0 / 10e-3 + amplitude * (2.0 * np.pi / wavelength) ** 2
    crest = hertz_from_load(load, 1.0 / curvature, outcome.problem.modulus)
    assert outcome.exit_status == ExitStatus.DONE
    for model in MODELS:
        known = outcome.figures.of(study="contact", source=model)
        peak, length = (known.one(quantity=n).value for n in ("peak_pressure", "contact_length"))
        assert peak == pytest.approx(crest.peak_pressure, rel=2e-3)
        assert length == pytest.approx(2.0 * crest.half_width, rel=5e-3)


def test_inputs_scatter_at_a_prescribed_approach():
    """A layer's load at an approach is in proportion to its modulus, and its contact the same: so
    is the half-plane's peak pressure, (P E)^1/2, and its contact length."""
    tables = {
        "roller": {"radius": 10e-3, "rigid": True},
        "body": {"youngs_modulus": 200e9, "poissons_ratio": 0.3, "thickness": 1e-3},
        "load": {"approach": 2e-6},
        "resolution": {"elements": 8, "levels": 2},
        "scatter": {"body_youngs_modulus": "6 %", "samples": 8},
        "budget": {"effects": False},
    }
    outcome = run_of(tables)
    peak, length = (
        outcome.figures.one(study="scatter", quantity=name)
        for name in ("peak_pressure", "contact_length")
    )
    scene, points = outcome.problem.scene, designs(8, 1, 0).reshape(-1, 1)
    moduli = values_at(scene.scatter.body_youngs_modulus, 1.0, points)
    assert peak.spread.deviation / peak.value == pytest.approx(moduli.std(ddof=1), rel=1e-4)
    assert peak.spread.mean / peak.value == pytest.approx(moduli.mean(), rel=1e-4)
    assert length.spread.deviation < 1e-4 * length.value
