"""`crosscheck verify` and `crosscheck stability`: what must hold before anything is believed."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from comparisons.commands.arguments import RESULTS, Junit, json_option, out_option
from comparisons.commands.output import progress, show_either
from comparisons.common.numbers import finite

if TYPE_CHECKING:
    from comparisons.campaigns.cases import Campaign


def stability(
    out: Annotated[Path | None, out_option("rows", "stability")] = None,
    junit: Junit = None,
    as_json: Annotated[bool, json_option("stability.json")] = False,
) -> int:
    """Solve stiff and extreme cases. Ends with 0 only if every one holds."""
    from comparisons.campaigns.cases import carry_out
    from comparisons.campaigns.robustness import all_cases

    solve = partial(carry_out, "stability", all_cases())
    return _solved("stability", solve, out, junit, as_json)


def verify(
    out: Annotated[Path | None, out_option("figures", "verify")] = None,
    junit: Junit = None,
    benchmarks: Annotated[
        bool, Option("--benchmarks", help="Solve published benchmarks instead.")
    ] = False,
    as_json: Annotated[bool, json_option("verify.json, or benchmarks.json")] = False,
) -> int:
    """Hold both models to exact solutions. Stated uncertainties are held to true errors."""
    if benchmarks:
        from comparisons.campaigns.benchmarks import Benchmarks, cases
        from comparisons.campaigns.cases import carry_out

        solve = partial(carry_out, "benchmarks", cases(), concluded=Benchmarks)
        return _solved("benchmarks", solve, out, junit, as_json)
    from comparisons.campaigns.verify.run import verify as verify_all

    return _solved("verify", verify_all, out, junit, as_json)


def _solved(
    name: str, solve: Callable[..., "Campaign"], out: Path | None, junit: Path | None, as_json: bool
) -> int:
    """Carry out a campaign, show it and return its exit status."""
    with progress() as callback:
        campaign = solve(out or RESULTS / name, junit, callback)
    show_either(as_json, finite(campaign.as_dict()), campaign.summary)
    return campaign.exit_status
