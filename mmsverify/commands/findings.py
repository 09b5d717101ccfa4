"""``mmsverify findings``: where the text of a model breaks its own rules."""

from __future__ import annotations

from typing import Annotated

import typer

from mmsverify.commands.options import VARIANT_HELP, Output, Quiet
from mmsverify.commands.output import emit, progress, remark, require_writable
from mmsverify.report import FINDINGS_FORMATS, render_findings, require_format


def findings(
    model: Annotated[str, typer.Argument(metavar="MODEL", help="The name of a model, or a model file.")],
    variant: Annotated[
        str, typer.Option("--variant", metavar="as-written|repaired", help=VARIANT_HELP)
    ] = "as-written",
    format: Annotated[str, typer.Option("--format", metavar="|".join(FINDINGS_FORMATS))] = "text",
    output: Output = None,
    quiet: Quiet = False,
) -> int:
    """Hold every property of a model against every procedure; tell what breaks, by which run, what mends it.

    Exit status: 0 nothing is broken, 1 something is, 2 bad request.
    """
    require_format(format, FINDINGS_FORMATS)
    require_writable(output)
    from mmsverify.faults import find_faults

    with progress(quiet=quiet) as report:
        survey = find_faults(model, variant=variant, progress=report or _Begun(quiet))
    emit(render_findings(survey, format), output)
    return 1 if survey.faults else 0


class _Begun:
    """Says once that the work has begun and may take long, where no line can be kept up to date."""

    def __init__(self, quiet: bool) -> None:
        self.quiet = quiet

    def __call__(self, what: str) -> None:
        remark(f"{what}, then property by property: a large model takes minutes", quiet=self.quiet)
        self.quiet = True
