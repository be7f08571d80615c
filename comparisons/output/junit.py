"""JUnit XML for continuous integration: of the verdicts of a run, and of any other testcases."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Literal
from xml.etree import ElementTree

from comparisons.drawing.tables import line_of
from comparisons.figures.figure import FAILED, PASSED, Verdict
from comparisons.judging.study import Run
from comparisons.judging.verdict.headline import headline
from comparisons.studies import meaning

Result = Literal["passed", "failure", "error", "skipped"]
# An inconclusive one is neither red nor green, and shown with its reason.
RESULTS: dict[Verdict, Result] = {"inconclusive": "skipped"}
RESULTS |= dict.fromkeys(PASSED, "passed") | dict.fromkeys(FAILED, "failure")


@dataclass(frozen=True)
class JunitCase:
    """A test as CI systems show it."""

    classname: str  # what they group by, with dots
    name: str
    text: str  # what was found
    result: Result = "passed"
    message: str = ""  # in a line, why it did not pass


def junit_xml(suite: str, testcases: Iterable[JunitCase], seconds: float) -> str:
    """One suite of testcases, which took so many seconds together."""
    root = ElementTree.Element("testsuites", name=f"crosscheck {suite}")
    element = ElementTree.SubElement(root, "testsuite", name=suite)
    counts = {"tests": 0, "failure": 0, "error": 0, "skipped": 0}
    for case in testcases:
        names = {"classname": case.classname, "name": case.name}
        child = ElementTree.SubElement(element, "testcase", names)
        counts["tests"] += 1
        if case.result != "passed":
            ElementTree.SubElement(child, case.result, message=case.message)
            counts[case.result] += 1
        ElementTree.SubElement(child, "system-out").text = case.text
    names = {"failure": "failures", "error": "errors"}
    element.attrib.update({names.get(name, name): str(count) for name, count in counts.items()})
    element.set("time", f"{seconds:.3f}")
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode", xml_declaration=True) + "\n"


def junit_of_run(run: Run) -> str:
    """The verdicts of a run, in the seconds that its models took."""
    seconds = sum(sum(solved.seconds.values()) for solved in run.runs.values())
    return junit_xml(run.problem.scene.name, run_cases_of(run), seconds)


def run_cases_of(run: Run) -> list[JunitCase]:
    """Cases: that the solvers converged, and each judged figure. One that differs or fails is a
    failure; an inconclusive one is skipped, with the reason; all are errors where a solver did not
    converge."""
    scene, said = run.problem.scene.name, headline(run)
    sentence = f"{said.within.sentence} {said.sentence}"
    cases = [JunitCase(f"{scene}.solvers", "converged", sentence)]
    for figure in run.judged:
        table = f"answers.{figure.source}" if figure.study == "answers" else figure.study
        name, of = f"{figure.quantity}, friction {figure.friction:g}", meaning(figure)
        # of a difference with what is not modelled of it
        text = figure.words(figure.total)
        if figure.against is None:
            text = line_of([figure], {figure.quantity: of})
        cases.append(JunitCase(f"{scene}.{table}", name, text, RESULTS[figure.verdict], text))
    if run.converged:
        return cases
    return [replace(case, result="error", message=sentence) for case in cases]
