"""The exit statuses of `crosscheck`."""

from enum import IntEnum


class ExitStatus(IntEnum):
    DONE = 0
    OUTSIDE_TOLERANCE = 1
    BAD_INPUT = 2
    NOT_CONVERGED = 3
    DEFECT = 70  # EX_SOFTWARE of sysexits.h: an error of the program, never of the input
    INTERRUPTED = 130  # 128 + SIGINT, as a shell reports it
    BROKEN_PIPE = 141  # 128 + SIGPIPE
