"""`crosscheck scenes`: what comes along."""

from comparisons.commands.arguments import Job
from comparisons.exit_status import ExitStatus


def scenes() -> Job:
    """List the scenes that come with crosscheck."""
    return _scenes


def _scenes() -> int:
    from comparisons.scene_file import scene_titles

    titles = scene_titles()
    width = max(map(len, titles))
    for name, title in titles.items():
        print(f"{name:{width}}  {title}")
    return ExitStatus.DONE
