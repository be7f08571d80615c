"""`crosscheck verify` and `crosscheck stability`: what must hold before anything is believed."""

from pathlib import Path
from typing import Annotated

from typer import Option

from comparisons.commands.arguments import RESULTS, Junit, json_option, out_option
from comparisons.commands.output import progress, show_either
from comparisons.common.numbers import finite


def stability(
    out: Annotated[Path | None, out_option("rows", "stability")] = None,
    junit: Junit = None,
    as_json: Annotated[bool, json_option("stability.json")] = False,
) -> int:
    """Solve stiff and extreme cases. Ends with 0 only if every one holds."""
    from comparisons import api

    with progress() as callback:
        campaign = api.stability(out=out or RESULTS / "stability", junit=junit, progress=callback)
    show_either(as_json, lambda: finite(campaign.as_dict()), campaign.tables)
    return campaign.exit_status


def verify(
    out: Annotated[Path | None, out_option("figures", "verify")] = None,
    junit: Junit = None,
    benchmarks: Annotated[
        bool, Option("--benchmarks", help="Solve published benchmarks instead.")
    ] = False,
    as_json: Annotated[bool, json_option("verify.json, or benchmarks.json")] = False,
) -> int:
    """Hold both models to exact solutions. Stated uncertainties are held to true errors."""
    from comparisons import api

    folder = out or RESULTS / ("benchmarks" if benchmarks else "verify")
    with progress() as callback:
        campaign = api.verify(benchmarks=benchmarks, out=folder, junit=junit, progress=callback)
    show_either(as_json, lambda: finite(campaign.as_dict()), campaign.tables)
    return campaign.exit_status
