"""The exact cases as a test that any code can take: scenes, a form to fill in, and its judgement.

The form is a CSV table, a row a figure: expected value, tolerance, and two columns to fill in, the
answer [SI] and its relative uncertainty. A row is judged as figures of a run are; `covered` says
whether an answer lies within its own uncertainty."""

import csv
import io
import json
import math
import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from analytic.exact.cases import ExactContact, exact_contacts
from comparisons.campaigns.verify.coverage import EXACT
from comparisons.campaigns.verify.rough import FEW, HALF_PLANE, LAYERED, rough_contact, rough_scene
from comparisons.campaigns.verify.scenes import ExactScene, gallery_scenes, layer_scenes
from comparisons.common.errors import ExitStatus, InputError
from comparisons.common.files import csv_text, publish
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import QUANTITIES
from comparisons.figures.uncertainty import Uncertainty
from comparisons.output.page.html import rendered

if TYPE_CHECKING:
    from rich.console import Group

COLUMNS = ("case", "quantity", "unit", "expected", "tolerance", "answer", "uncertainty")
TOLERANCE = 0.01  # of the form as it is written; whoever fills it in may tighten it
DIGITS = 10
GAP_POINTS = 2001  # of a wave or a punch
HALF_PLANES = (20, 21, 22)  # seeds of rough contacts
ELEMENTS = 60.0  # of a scene's third level, on half a mean patch
FILE_SIZE = 2**20  # bytes of the largest form


@dataclass(frozen=True)
class FormCase:
    """A case of the form."""

    name: str
    # by name, text: a scene with its trace, or the gap of a wave or a punch
    files: Mapping[str, str]
    exact: Mapping[str, float]  # figures [SI] by quantity
    about: str = ""  # what no scene says, in words

    @property
    def rows(self) -> list[tuple[object, ...]]:
        """Of the form, to be filled in."""
        return [
            (self.name, quantity, unit_of(quantity), f"{value:.{DIGITS}g}", TOLERANCE, "", "")
            for quantity, value in self.exact.items()
        ]


@dataclass(frozen=True)
class JudgedForm:
    """What was filled in, and the number of rows that were not. Each figure is an error over the
    expected value, its scale, with the answer as its one level."""

    figures: tuple[Figure, ...]
    empty: int

    @property
    def exit_status(self) -> ExitStatus:
        verdicts = {figure.verdict for figure in self.figures}
        if "differ" in verdicts:
            return ExitStatus.OUTSIDE_TOLERANCE
        return ExitStatus.INCONCLUSIVE if "inconclusive" in verdicts else ExitStatus.DONE

    def as_dict(self) -> dict:
        rows = [
            {
                "case": figure.source,
                "quantity": figure.quantity,
                "expected": figure.scale,
                "answer": figure.levels[0],
                "error": figure.value,
                "uncertainty": figure.numerical,
                "tolerance": figure.tolerance,
                "verdict": figure.verdict,
                "covered": is_covered(figure),
            }
            for figure in self.figures
        ]
        return {"rows": rows, "empty": self.empty}


def is_covered(figure: Figure) -> bool:
    """Whether an answer lies within its own uncertainty."""
    return abs(figure.value) <= figure.numerical


@cache
def form_cases() -> tuple[FormCase, ...]:
    """Hertz at rest and sliding, layers, rough contacts made from pressures, waves, punches."""
    bodies = [(seed, HALF_PLANE) for seed in HALF_PLANES]
    bodies += [(2 * k, body) for k, body in enumerate(LAYERED)]  # at rest: friction moves layers
    scenes = [scene for scene in gallery_scenes() if scene.kind != "hardness"]
    scenes += layer_scenes()
    for seed, body in bodies:
        name = f"rough {body} {seed}"
        rough = rough_scene(name, rough_contact(seed, body, FEW), ELEMENTS, {})
        scenes.append(replace(rough, name=name))
    others = [case for case in exact_contacts() if case.period is not None or case.knots]
    return (*map(_of_scene, scenes), *map(_of_gap, others))


def export_form(out: Path) -> int:
    """Write scenes, form and README to `out`; the number of cases. InputError if that fails."""
    cases = form_cases()
    files = {name: text for case in cases for name, text in case.files.items()}
    files["form.csv"] = csv_text([COLUMNS, *(row for case in cases for row in case.rows)])
    template = Path(__file__).with_name("verify.md.j2")
    files["README.md"] = rendered(template, cases=cases, tolerance=TOLERANCE)
    publish(out, files)
    return len(cases)


def judged_form(path: Path) -> JudgedForm:
    """Raises InputError for a file that is no form, an unknown case, and what is no number."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            table = list(csv.DictReader(io.StringIO(file.read(FILE_SIZE)), strict=True))
    except (OSError, UnicodeError, csv.Error) as error:
        raise InputError(f"{path}: cannot be read ({error}); allowed is a form.csv") from None
    missing = set(COLUMNS) - set(table[0] if table else ())
    if missing:
        raise InputError(f"{path}: has no column {sorted(missing)[0]}; allowed is a form.csv")
    exact = {(c.name, q): value for c in form_cases() for q, value in c.exact.items()}
    figures, empty = [], 0
    for line, row in enumerate(table, start=2):
        if not (row["answer"] or "").strip():
            empty += 1
            continue
        where = f"{path}: line {line}"
        key = row["case"], row["quantity"]
        if key not in exact:
            raise InputError(f"{where}: {' '.join(map(str, key))} is no figure of the form")
        answer = _number(row, "answer", where)
        tolerance = _number(row, "tolerance", where, least=0.0)
        uncertainty = _number(row, "uncertainty", where, least=0.0)
        figures.append(
            Figure(
                *("verify", key[1], key[0], answer / exact[key] - 1.0),
                against=EXACT,
                scale=exact[key],
                uncertainty=Uncertainty({"stated": uncertainty}),
                bounds=(-tolerance, tolerance),
                levels=(answer,),
            )
        )
    if not figures:
        raise InputError(f"{path}: has no answer; allowed is a form with at least one filled in")
    return JudgedForm(tuple(figures), empty)


def form_table(judged: JudgedForm) -> "Group":
    from rich.console import Group

    from comparisons.output.terminal import plain_table

    numbers = "expected", "answer", "error, %", "uncert., %", "tol., %", "verdict", "covered"
    table = plain_table("case", "quantity", numbers=numbers)
    for f in judged.figures:
        values = (f"{value:.5g} {unit_of(f.quantity)}" for value in (f.scale, *f.levels))
        shares = (f"{100 * value:.3g}" for value in (f.value, f.numerical, f.tolerance))
        covered = "yes" if is_covered(f) else "no"
        table.add_row(f.source, f.quantity, *values, *shares, f.verdict, covered)
    counts = Counter(figure.verdict for figure in judged.figures)
    listed = ", ".join(f"{counts[v]} {v}" for v in ("agree", "differ", "inconclusive"))
    covered = sum(map(is_covered, judged.figures))
    return Group(
        table, f"{listed}; {covered} within their own uncertainty; {judged.empty} not filled in"
    )


def unit_of(quantity: str) -> str:
    return QUANTITIES[quantity].unit if quantity in QUANTITIES else "m"


def _number(row: Mapping[str, str], column: str, where: str, least: float = -math.inf) -> float:
    """A cell as a number; nothing counts as 0 but for the answer, which is there."""
    text = (row[column] or "0").strip()
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value >= least):
        allowed = "a number" if least < 0.0 else "a number of 0 or more"
        raise InputError(f"{where}: {column}: is {text}; allowed is {allowed}")
    return value


def _of_scene(scene: ExactScene) -> FormCase:
    """What a user would write, without what only concerns the project's own models."""
    name = _slug(scene.name)
    kept = ("roller", "body", "coating", "profile", "load", "stress", "resolution")
    tables = {section: dict(scene.tables[section]) for section in kept if section in scene.tables}
    files = {}
    if scene.trace is not None:
        trace = scene.trace.read.profile
        files[f"{name}.csv"] = _table("x [m],height [m]", trace.x, trace.height)
        tables["profile"] = {"file": f"{name}.csv", "form": "none", "x_unit": "m", "z_unit": "m"}
    tables["budget"] = {"effects": False}
    lines = [f"title = {json.dumps(scene.name)}"]
    for section, fields in tables.items():
        values = {key: json.dumps(value, default=float) for key, value in fields.items()}
        lines += ["", f"[{section}]", *(f"{key} = {value}" for key, value in values.items())]
    files[f"{name}.toml"] = "\n".join([*lines, ""])
    return FormCase(name, files, {q: v for q, v in scene.exact.items() if v})


def _of_gap(case: ExactContact) -> FormCase:
    """The gap of what no scene describes: of a wave that goes on for ever, a period; of a punch
    three half-widths, with the ends of its flat among the points."""
    name = _slug(case.name)
    half = case.half_range if case.period is None else 0.5 * case.period
    x = np.union1d(np.linspace(-half, half, GAP_POINTS), case.knots)
    bodies = " and ".join(
        f"E = {m.youngs_modulus:g} Pa, nu = {m.poissons_ratio:g}"
        for m in (case.body, case.roller)
        if m is not None
    )
    period = "" if case.period is None else f" on each period of {case.period:g} m"
    about = f"{case.load:.{DIGITS}g} N/m{period}; half-planes of {bodies}"
    about += " under a rigid one" if case.roller is None else ""
    wanted = ("peak_pressure", "contact_length", "mean_gap")
    exact = {q: case.quantities[q] for q in wanted if case.quantities.get(q)}
    files = {f"{name}.csv": _table("x [m],gap [m]", x, case.gap(x))}
    return FormCase(name, files, exact, about)


def _table(head: str, *columns: np.ndarray) -> str:
    rows = (",".join(f"{value:.15g}" for value in row) for row in zip(*columns, strict=True))
    return "\n".join([head, *rows, ""])


def _slug(text: str) -> str:
    return re.sub(r"[^a-z0-9.]+", "-", text.lower()).strip("-")
