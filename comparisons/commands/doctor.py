"""`crosscheck doctor`: what works here, by trying it."""

from dataclasses import asdict
from functools import partial
from typing import Annotated

from comparisons.commands.arguments import Job, json_option
from comparisons.commands.output import progress, show, show_json
from comparisons.common.exit_status import ExitStatus


def doctor(as_json: Annotated[bool, json_option("the findings as JSON")] = False) -> Job:
    """Show what is installed, what is missing, and how to get it."""
    return partial(_doctor, as_json)


def _doctor(as_json: bool) -> int:
    from comparisons.commands.doctor_checks import doctor as examined
    from comparisons.commands.doctor_checks import doctor_table

    with progress() as callback:
        checks = examined(callback)
    if as_json:
        show_json([asdict(check) for check in checks])
    else:
        show(doctor_table(checks))
    return ExitStatus.DONE if all(c.ok for c in checks) else ExitStatus.SOMETHING_MISSING
