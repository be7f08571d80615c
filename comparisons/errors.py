"""What the user gave is wrong: one line that says where, what, and what is allowed."""


class InputError(ValueError):
    """Wrong input of any kind; `str` is one line, and the command line ends with status 2."""

    def __init__(self, message: str) -> None:
        super().__init__(" ".join(message.split()))


class SceneError(InputError):
    """A scene, or a file it names, is wrong: "file: section.field: problem; allowed is …"."""
