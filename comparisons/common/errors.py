"""What the user gave is wrong: one line that says where, what, and what is allowed."""

import re


class InputError(ValueError):
    """Wrong input of any kind; `str` is one line, and the command line ends with status 2."""

    def __init__(self, message: str) -> None:
        super().__init__(one_line(message))


class SceneError(InputError):
    """A scene, or a file it names, is wrong: "file: section.field: problem; allowed is …"."""


class SolverError(RuntimeError):
    """A solver did not converge; `str` is one line, and the command line ends with status 3."""

    def __init__(self, message: str) -> None:
        super().__init__(one_line(message))


def one_line(text: str) -> str:
    """The text without line breaks, and with what a terminal would obey written as escapes."""
    line = re.sub(r"[ \t\r\n]+", " ", text).strip()
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in line)
