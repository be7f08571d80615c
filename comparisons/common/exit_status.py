"""The exit statuses of `crosscheck`."""

from enum import IntEnum


class ExitStatus(IntEnum):
    """0 to 3 are for scripts to branch on; the others follow sysexits.h and the shells."""

    DONE = 0
    OUTSIDE_TOLERANCE = 1
    SOMETHING_MISSING = 1  # of `doctor`
    BAD_INPUT = 2
    NOT_CONVERGED = 3
    DEFECT = 70  # EX_SOFTWARE: an error of the program, never of the input
    CANNOT_WRITE = 74  # EX_IOERR
    INTERRUPTED = 130  # 128 + SIGINT
    BROKEN_PIPE = 141  # 128 + SIGPIPE
