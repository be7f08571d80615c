"""JUnit XML for continuous integration: of the verdicts of a run, and of any other testcases."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal
from xml.etree import ElementTree

from comparisons.common.errors import InputError
from comparisons.common.files import check_writable, published
from comparisons.common.mpi import is_first
from comparisons.common.numbers import given_percent, percent
from comparisons.figures.verdict import Validity, Verdict
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
    """That the solvers converged, and each judged figure and friction of both tables. A figure that
    differs or fails is a failure; an inconclusive one is skipped, with the reason; all are errors
    where a solver did not converge."""
    scene, sentence = outcome.problem.scene.name, headline(outcome).sentence
    found = [("comparison", row, row.difference, row.uncertainty) for row in outcome.comparisons]
    found += [("model_error", s, s.value, s.total_uncertainty) for s in outcome.tolerance_checks]
    for answer in outcome.answers:
        table = f"answers.{answer.name}"
        found += [(table, row, row.difference, row.uncertainty) for row in answer.rows]
    cases = [JunitCase(f"{scene}.solvers", "converged", sentence)]
    for table, row, value, uncertainty in found:
        if row.verdict is None:
            continue
        text = (
            f"{row.verdict}: {error_text(row.quantity, value, uncertainty)} with an uncertainty "
            f"of {percent(uncertainty)}, tolerance {given_percent(row.tolerance)}"
        )
        name = f"{row.quantity}, friction {row.friction:g}"
        cases.append(JunitCase(f"{scene}.{table}", name, text, RESULTS[row.verdict], text))
    if outcome.converged:
        return cases
    return [replace(case, result="error", message=sentence) for case in cases]
