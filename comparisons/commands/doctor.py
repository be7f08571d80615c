"""`crosscheck doctor`: what works here, by trying it."""

from comparisons.commands.arguments import Job
from comparisons.commands.output import show
from comparisons.exit_status import ExitStatus


def doctor() -> Job:
    """Show what is installed, what is missing, and how to get it."""
    return _doctor


def _doctor() -> int:
    from comparisons.doctor import doctor as examined
    from comparisons.doctor import doctor_table

    checks = examined()
    show(doctor_table(checks))
    return ExitStatus.DONE if all(c.ok for c in checks) else ExitStatus.SOMETHING_MISSING
