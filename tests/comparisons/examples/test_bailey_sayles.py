"""The script that computes Bailey and Sayles (1991) anew: formulas, numbers, table, pictures."""

import ast
from pathlib import Path

import numpy as np
import pytest
from scenes import PROJECT
from strips import stress_of_strips

from analytic.exact.hertz import HertzContact, hertz_stress
from comparisons.examples import bailey_sayles as paper

# By figure, in the order of the table; those of 5 are errors, with a test of their own.
NUMBERS = {
    "1": [1.0],
    "6b": [0.25],
    "6e": [0.300283, 0.786151],
    "8a": [0.6895, 0.439],
    "8e": [2.3605, 0.0976, 0.00448],
    "8g": [0.50884, 0.629],
    "9a": [0.8686, 1.667],
    "9e": [0.0034],
    "10e": [0.7073, 0.01118, 0.9985, 0.78706],
    "11a": [0.42735, 0.3553],
    "11b": [1.1576],
    "8f": [0.2322, 0.0750],
    "9f": [0.2321, 0.0717],
    "9g": [0.550],
    "10f": [0.1533, 0.0547],
    "10g": [0.464],
}
NOT_CONFIRMED = {
    "denied": ["5b", "8g"],
    "made so": ["8a", "8a", "9a", "9a", "10e"],
    "open": ["8e", "10g"],
}


@pytest.fixture(scope="module")
def made(tmp_path_factory) -> tuple[list[paper.Claim], Path]:
    """The claims of the table, and the folder."""
    judged, out = [], tmp_path_factory.mktemp("examples") / "out"
    with pytest.MonkeyPatch.context() as patch:
        claims = paper.claims

        def kept(*surfaces):
            judged.extend(claims(*surfaces))
            return judged

        patch.setattr(paper, "claims", kept)
        paper.main(["--out", str(out)])
    return judged, out


def test_numbers_are_those_of_the_paper_s_figures(made):
    """Within what a depth between two rows of a field is uncertain."""
    judged, _ = made
    for figure, expected in NUMBERS.items():
        found = [claim.number for claim in judged if claim.figure == figure]
        assert found == pytest.approx(expected, rel=5e-3, abs=5e-3), figure


def test_errors_are_small_but_for_strips_below_a_rough_surface(made):
    judged, _ = made
    on_axis, smooth, rough = (c.number for c in judged if c.figure in ("5a", "5b"))
    assert on_axis < 1e-4 and smooth < 1e-4 and 0.2 < rough < 1.5


def test_outcomes(made):
    judged, _ = made
    for outcome, figures in NOT_CONFIRMED.items():
        assert [claim.figure for claim in judged if claim.outcome == outcome] == figures
    assert sum(claim.outcome == "confirmed" for claim in judged) == len(judged) - 9 == 23


@pytest.mark.parametrize(
    ("number", "outcome"), [(2.5, "confirmed"), (1.5, "open"), (0.5, "denied"), (3.5, "denied")]
)
def test_a_number_confirms_inside_its_bounds_and_denies_beyond_wider_ones(number, outcome):
    assert paper.Claim("1", "", number, 2.0, 3.0, allowed=1.0).outcome == outcome
    strict = paper.Claim("1", "", number, 2.0, 3.0, made_so=True).outcome
    assert strict == {"confirmed": "made so"}.get(outcome, "denied")


def test_the_folder_holds_table_and_pictures(made):
    judged, out = made
    pictures = {f"figure-{number}.png" for number in (1, 5, 6, 7, 8)}
    assert {path.name for path in out.iterdir()} == pictures | {"claims.md"}
    assert all((out / name).read_bytes().startswith(b"\x89PNG") for name in pictures)
    rows = (out / "claims.md").read_text(encoding="utf-8").splitlines()
    assert rows[2:] == list(map(str, judged))


def test_the_page_shows_that_table(made):
    judged, _ = made
    page = (PROJECT / "comparisons/docs/bailey_sayles/index.md").read_text(encoding="utf-8")
    shown = page.partition("| figure | claim | number |")[2].partition("\n\n")[0].splitlines()[2:]
    for row, claim in zip(shown, judged, strict=True):
        (figure, says, number, *judgement), cells = (
            [cell.strip() for cell in text.strip("|").split("|")] for text in (row, str(claim))
        )
        assert [figure, says, *judgement] == [*cells[:2], *cells[3:]]
        assert float(number) == pytest.approx(claim.number, rel=0.01, abs=1e-4)


def test_the_smooth_contact_is_hertz_s():
    x, z = np.meshgrid(np.linspace(-1.4, 1.4, 15), np.geomspace(1e-3, 2.0, 8))
    exact = hertz_stress(HertzContact(1.0, 1.0, 0.5 * np.pi, 1.0, 2.0), x, z)
    found = paper.hertz(x, z)
    for value, part in zip(found, (exact.sx, exact.sz, exact.tau1), strict=True):
        np.testing.assert_allclose(value, part, atol=1e-12)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_the_paper_s_equations_are_those_of_uniform_strips(friction):
    middles = np.linspace(-1.0, 1.0, 21)
    pressure = np.random.default_rng(7).random(21)
    x, z = np.meshgrid(np.linspace(-1.3, 1.3, 12), [0.003, 0.1, 0.8])
    exact = stress_of_strips(middles, pressure, friction, x, z)
    found = paper.strips(middles, pressure, friction, x, z)
    np.testing.assert_allclose(found, [exact.sx, exact.sz], atol=1e-12)


def test_the_examples_take_the_public_face_alone():
    ours = ("analytic", "meshes", "fem", "comparisons")
    for path in (PROJECT / "comparisons/examples").glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            else:
                names = [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            assert [n for n in names if n.split(".")[0] in ours and n != "comparisons"] == []
