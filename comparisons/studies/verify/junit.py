"""The verification as JUnit XML, which CI systems read: one testcase for each figure and check.

A figure fails where it is wrong by more than its ceiling. That a stated uncertainty misses the
true error now and then is in its nature: it is told in the testcase's output, and what fails is
the testcase of the coverage.
"""

from xml.etree import ElementTree

from comparisons.studies.verify.pairs import LEAST_COVERAGE, WIDEST, Pair
from comparisons.studies.verify.result import Verification


def junit(found: Verification) -> str:
    """The XML document."""
    suites = ElementTree.Element("testsuites", name="crosscheck verify")
    cases = [
        *(_of_pair(pair) for pair in found.pairs),
        *(
            _case(
                f"verify.{check.group.replace(' ', '_')}",
                check.name,
                f"{check.value:.6g}, expected {check.low:.6g} to {check.high:.6g}",
                None if check.holds else "out of bounds",
            )
            for check in found.checks
        ),
        *(_case(f"verify.{f.model}", f.case, f.message, "no figures") for f in found.failed),
        *_of_coverage(found),
    ]
    failures = sum(case.find("failure") is not None for case in cases)
    suite = ElementTree.SubElement(
        suites,
        "testsuite",
        name="verify",
        tests=str(len(cases)),
        failures=str(failures),
        errors="0",
        skipped="0",
        time=f"{sum(found.seconds.values()):.3f}",
    )
    suite.extend(cases)
    ElementTree.indent(suites)
    return ElementTree.tostring(suites, encoding="unicode", xml_declaration=True) + "\n"


def _of_pair(pair: Pair) -> ElementTree.Element:
    width = "rounding" if pair.width is None else f"{pair.width:.3g}"
    text = (
        f"value {pair.levels[-1]:.12g}, exact {pair.exact:.12g}, relative error {pair.error:.3e}, "
        f"stated uncertainty {pair.stated:.3e}, "
        f"{'covered' if pair.covered else 'NOT covered'}, width {width}, {pair.behaviour}"
    )
    why = None
    if not pair.converged:
        why = "a level did not converge"
    elif not pair.close:
        why = f"error above {pair.ceiling:g}"
    return _case(f"verify.{pair.model}", f"{pair.case}: {pair.quantity}", text, why)


def _of_coverage(found: Verification) -> list[ElementTree.Element]:
    whole = found.coverage
    share, width = f"{whole.covered:.4f}", f"{whole.median_width:.3f}"
    return [
        _case(
            "verify.coverage",
            "share of true errors within the stated uncertainty",
            f"{share} of {whole.tell}, at least {LEAST_COVERAGE:g}",
            None if whole.covered >= LEAST_COVERAGE else "too few",
        ),
        _case(
            "verify.coverage",
            "median of stated uncertainty over true error",
            f"{width}, at most {WIDEST:g}",
            None if whole.median_width <= WIDEST else "too wide",
        ),
        _case(
            "verify.coverage",
            "figures with exact answers",
            f"{whole.tell}, at least {found.fewest}",
            None if whole.tell >= found.fewest else "too few",
        ),
    ]


def _case(group: str, name: str, text: str, why: str | None) -> ElementTree.Element:
    case = ElementTree.Element("testcase", classname=group, name=name)
    if why is not None:
        ElementTree.SubElement(case, "failure", message=f"{why}: {text}")
    ElementTree.SubElement(case, "system-out").text = text
    return case
