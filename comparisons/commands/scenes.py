"""`crosscheck scenes`: what comes along."""

from typing import Annotated

from comparisons.commands.arguments import job, json_option
from comparisons.commands.output import show_json
from comparisons.common.errors import ExitStatus


@job
def scenes(as_json: Annotated[bool, json_option("names and titles as JSON")] = False) -> int:
    """List the scenes that come with crosscheck."""
    from comparisons.scenes.files import scene_titles

    titles = scene_titles()
    if as_json:
        show_json(titles)
        return ExitStatus.DONE
    width = max(map(len, titles))
    for name, title in titles.items():
        print(f"{name:{width}}  {title}")
    return ExitStatus.DONE
