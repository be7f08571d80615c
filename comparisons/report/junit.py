"""JUnit XML for continuous integration: of the verdicts of a run, and of any other testcases."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal
from xml.etree import ElementTree

from comparisons.assessment.verdict import Validity, Verdict
from comparisons.common.errors import InputError
from comparisons.common.files import check_writable, published
from comparisons.common.mpi import is_first
from comparisons.common.numbers import given_percent, percent
from comparisons.report.headline import headline
from comparisons.report.tables.text import error_text
from comparisons.results.outcome import Outcome

Result = Literal["passed", "failure", "error", "skipped"]
RESULTS: dict[Verdict | Validity, Result] = {
    "agree": "passed",
    "holds": "passed",
    "differ": "failure",
    "fails": "failure",
    "inconclusive": "skipped",  # neither red nor green, and shown with its reason
}


@dataclass(frozen=True)
class JunitCase:
    """A test as CI systems show it."""

    classname: str  # what they group by, with dots
    name: str
    text: str  # what was found
    result: Result = "passed"
    message: str = ""  # in a line, why it did not pass


def check_place(junit: Path | None) -> None:
    """Raise InputError unless the file can be written; None is no file."""
    if junit is not None:
        if junit.is_dir():
            raise InputError(f"{junit}: cannot be written: it is a folder; allowed is a file")
        check_writable(junit.parent, ())


def write_junit(junit: Path | None, content: str) -> None:
    """Leave the content in the file, whole or not at all; None is no file."""
    if junit is not None and is_first():
        with published(junit.parent, ()) as folder:
            (folder / junit.name).write_text(content, encoding="utf-8")


def junit_xml(suite: str, testcases: Iterable[JunitCase], seconds: float) -> str:
    """One suite of testcases, which took so many seconds together."""
    root = ElementTree.Element("testsuites", name=f"crosscheck {suite}")
    element = ElementTree.SubElement(root, "testsuite", name=suite)
    counts = {"tests": 0, "failure": 0, "error": 0, "skipped": 0}
    for each in testcases:
        case = ElementTree.SubElement(element, "testcase", classname=each.classname, name=each.name)
        counts["tests"] += 1
        if each.result != "passed":
            ElementTree.SubElement(case, each.result, message=each.message)
            counts[each.result] += 1
        ElementTree.SubElement(case, "system-out").text = each.text
    names = {"failure": "failures", "error": "errors"}
    element.attrib.update({names.get(name, name): str(count) for name, count in counts.items()})
    element.set("time", f"{seconds:.3f}")
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def run_cases_of(outcome: Outcome) -> list[JunitCase]:
    """That the solvers converged, and each judged figure and friction of both tables.

    A figure that differs or fails is a failure; an inconclusive one is skipped, with the reason;
    all are errors where a solver did not converge.
    """
    scene, sentence = outcome.problem.scene.name, headline(outcome).sentence
    cases = [JunitCase(f"{scene}.solvers", "converged", sentence)]
    for row in outcome.comparisons:
        if row.verdict is not None:
            parts = row.difference, row.uncertainty, row.tolerance, row.verdict
            cases.append(_judged(f"{scene}.comparison", row.quantity, row.friction, *parts))
    for row in outcome.tolerance_checks:
        parts = row.value, row.total_uncertainty, row.tolerance, row.verdict
        cases.append(_judged(f"{scene}.model_error", row.quantity, row.friction, *parts))
    for answer in outcome.answers:
        for row in answer.rows:
            if row.verdict is not None:
                parts = row.difference, row.uncertainty, row.tolerance, row.verdict
                where = f"{scene}.answers.{answer.name}"
                cases.append(_judged(where, row.quantity, row.friction, *parts))
    if outcome.converged:
        return cases
    return [replace(case, result="error", message=sentence) for case in cases]


def _judged(
    table: str,
    quantity: str,
    friction: float,
    value: float,
    uncertainty: float | None,
    tolerance: float,
    verdict: Verdict | Validity,
) -> JunitCase:
    text = (
        f"{verdict}: {error_text(quantity, value, uncertainty)} with an uncertainty of "
        f"{percent(uncertainty)}, tolerance {given_percent(tolerance)}"
    )
    return JunitCase(table, f"{quantity}, friction {friction:g}", text, RESULTS[verdict], text)
