"""`crosscheck verify` and `crosscheck stability`: what must hold before anything is believed."""

from pathlib import Path
from typing import Annotated

from typer import Option

from comparisons.commands.arguments import RESULTS, Junit, job, json_option, out_option
from comparisons.commands.output import progress, show_written


@job
def stability(
    out: Annotated[Path | None, out_option("rows", "stability")] = None,
    junit: Junit = None,
    as_json: Annotated[bool, json_option("stability.json")] = False,
) -> int:
    """Solve stiff and extreme cases. Ends with 0 only if every one holds."""
    from comparisons.campaigns.cases import carry_out
    from comparisons.campaigns.robustness import all_cases

    directory = out or RESULTS / "stability"
    with progress() as callback:
        campaign = carry_out("stability", all_cases(), directory, junit, callback)
    show_written(as_json, directory / "stability.json", lambda: campaign.summary())
    return campaign.exit_status


@job
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
        from comparisons.campaigns.benchmarks import run_benchmarks

        directory = out or RESULTS / "benchmarks"
        with progress() as callback:
            solved = run_benchmarks(directory, junit, callback)
        show_written(as_json, directory / "benchmarks.json", lambda: solved.summary())
        return solved.exit_status
    from comparisons.campaigns.verify.run import verify as verify_all

    directory = out or RESULTS / "verify"
    with progress() as callback:
        verification = verify_all(directory, junit, callback)
    show_written(as_json, directory / "verify.json", lambda: verification.summary())
    return verification.exit_status
