"""`crosscheck verify` and `crosscheck stability`: what must hold before anything is believed."""

from pathlib import Path
from typing import Annotated

from typer import Option

from comparisons.commands.arguments import RESULTS, Junit, job, json_option, out_option
from comparisons.commands.output import progress, show_either, show_written
from comparisons.common.errors import ExitStatus, InputError


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
    export: Annotated[
        Path | None, Option(help="Only write the exact cases for other codes to this folder.")
    ] = None,
    answers: Annotated[
        Path | None, Option(help="Only judge the form of such a folder, filled in.")
    ] = None,
    benchmarks: Annotated[
        bool, Option("--benchmarks", help="Solve published benchmarks instead.")
    ] = False,
    as_json: Annotated[bool, json_option("verify.json, or benchmarks.json")] = False,
) -> int:
    """Hold both models to exact solutions. Stated uncertainties are held to true errors."""
    others = benchmarks or out or junit
    if sum(option is not None for option in (export, answers, others or None)) > 1:
        raise InputError(
            "verify: allowed is one of --export, --answers, and --benchmarks, --out, --junit"
        )
    if export is not None:
        from comparisons.campaigns.verify.form import export_form

        print(f"{export_form(export)} cases; {export / 'README.md'} says how to answer")
        return ExitStatus.DONE
    if answers is not None:
        from comparisons.campaigns.verify.form import form_table, judged_form

        judged = judged_form(answers)
        show_either(as_json, judged.as_dict(), lambda: form_table(judged))
        return judged.exit_status
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
