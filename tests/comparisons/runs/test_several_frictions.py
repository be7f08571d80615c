"""Several friction coefficients where each moves the contact: figures are those of each alone."""

import numpy as np
import pytest
from scenes import STEEL, changed, resolved, run_of

from comparisons.common.errors import SceneError
from comparisons.common.progress import no_progress
from comparisons.figures.quantity import MODELS, WHOLE
from comparisons.models.finite_element.level import problem_of_approach
from comparisons.output.arrays import RunArrays
from comparisons.runs.run import run

pytestmark = pytest.mark.usefixtures("undrawn")

FRICTIONS = [0.0, 0.3]
WAVE = {"kind": "sinusoid", "wavelength": "60 um", "amplitude": "0.1 um", "length": "1 mm"}
TABLES = {
    "roller": {"radius": 5e-3, "rigid": True},
    "body": {**STEEL, "law": "neo-hookean", "yield_stress": 1.2e9},
    "load": {"hertz_peak_pressure": 1.5e9, "friction": FRICTIONS},
    "stress": {"points": [41, 15]},
    "resolution": {"pitch": "12 um", "levels": 2},
    "budget": {"time": 1e-6, "effects": False},
}
CASES = {
    "finite": ({"finite_element": {"deformation": "finite"}, "profile": WAVE}, None),
    "plastic": ({"finite_element": {"plastic": True}}, None),
    "coupled": ({"load": {"coupled": True}}, 1e-9),  # on the grid that all of them need
}


@pytest.fixture(scope="module", params=CASES)
def runs(request, tmp_path_factory):
    """Runs of all coefficients, and of each alone; and how far figures may be apart."""
    sections, apart = CASES[request.param]
    tables = changed(TABLES, **sections)
    together = run(resolved(tables), tmp_path_factory.mktemp("several") / "out", MODELS)
    alone = {mu: run_of(tables, load={"friction": mu}) for mu in FRICTIONS}
    return together, alone, apart


def test_figures_are_those_of_each_coefficient_alone(runs):
    together, alone, apart = runs
    for mu, one in alone.items():
        known = {"study": "comparison", "friction": mu}
        for study in ("contact", "comparison"):
            for figure in one.figures.of(study=study, friction=mu):
                names = {n: getattr(figure, n) for n in ("quantity", "source", "against")}
                same = together.figures.one(**known | names | {"study": study})
                if apart is None:
                    assert same.value == figure.value and same.numerical == figure.numerical
                else:
                    assert same.value == pytest.approx(figure.value, rel=1e-6, abs=1e-6)
        peaks = [
            r.figures.one(**known | {"study": "model_error"}, quantity="peak_pressure")
            for r in (together, one)
        ]
        assert peaks[0].value == pytest.approx(peaks[1].value, rel=1e-6, abs=1e-6)
        assert peaks[0].against == WHOLE
    levels = [together.levels(mu)["finite_element"] for mu in FRICTIONS]
    assert levels[0].solution.pressure.max() != levels[1].solution.pressure.max()


def test_every_coefficient_has_its_files_and_they_are_read_again(runs):
    together, *_ = runs
    names = {str(path.relative_to(together.directory)) for path in together.directory.rglob("*.*")}
    below = {f"finite_element/friction_0.3/{n}" for n in ("contact.csv", "mesh.msh", "stress.vtu")}
    assert below <= names
    again = RunArrays.read(together.directory)
    for mu in FRICTIONS:
        known = together.levels(mu)["finite_element"].solution.pressure
        assert np.array_equal(again.contact("finite_element", mu)["pressure"], known)


def test_an_approach_takes_one_coefficient():
    tables = changed(TABLES, body={"thickness": 1e-3}, finite_element={"deformation": "finite"})
    tables["load"] = {"approach": 2e-6, "friction": FRICTIONS}
    with pytest.raises(SceneError, match=r"load\.friction: has 2 coefficients.*allowed is one"):
        problem_of_approach(resolved(tables), no_progress)
