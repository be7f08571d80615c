"""`crosscheck verify`: both models, or another code, against exact solutions."""

from pathlib import Path
from typing import Annotated

import typer

from comparisons.commands.arguments import RESULTS, job, json_option, out_option
from comparisons.commands.output import progress, show, show_file, show_json
from comparisons.common.errors import ExitStatus, InputError


@job
def verify(
    out: Annotated[Path | None, out_option("figures", "verify")] = None,
    junit: Annotated[Path | None, typer.Option(help="File for JUnit XML.")] = None,
    export: Annotated[
        Path | None, typer.Option(help="Only write the exact cases for other codes to this folder.")
    ] = None,
    answers: Annotated[
        Path | None, typer.Option(help="Only judge the form of such a folder, filled in.")
    ] = None,
    as_json: Annotated[bool, json_option("verify.json")] = False,
) -> int:
    """Hold both models to exact solutions, and stated uncertainties to true errors."""
    if sum(given is not None for given in (export, answers, out or junit)) > 1:
        raise InputError("verify: allowed is one of --export, --answers, and --out with --junit")
    if export is not None:
        from comparisons.studies.verify.form import export_form

        print(f"{export_form(export)} cases; {export / 'README.md'} says how to answer")
        return ExitStatus.DONE
    if answers is not None:
        from comparisons.studies.verify.form import form_table, judged_form, summary_line

        judged = judged_form(answers)
        if as_json:
            show_json(judged.as_dict())
        else:
            show(form_table(judged))
            print(summary_line(judged))
        return judged.exit_status
    from comparisons.studies.verify.pages import verify_summary
    from comparisons.studies.verify.run import verify as verify_all

    directory = out or RESULTS / "verify"
    with progress() as callback:
        found = verify_all(directory, junit, callback)
    if as_json:
        show_file(directory / "verify.json")
    else:
        show(verify_summary(found))
    return found.exit_status
