"""``mmsverify explain``: the shortest legal way from one sample of VR cells to the next."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mmsverify.commands.options import Output, Profile, Quiet, Variant
from mmsverify.commands.output import emit, require_writable
from mmsverify.report import EXPLANATION_FORMATS, render_explanation, require_format


def explain(
    trace: Annotated[Path, typer.Argument(metavar="TRACE", help="An MCAP file.")],
    index: Annotated[int, typer.Argument(metavar="INDEX", help="The sample, counted as findings count.")],
    *,
    profile: Profile = None,
    variant: Variant = "repaired",
    format: Annotated[str, typer.Option("--format", metavar="text|json")] = "text",
    output: Output = None,
    quiet: Quiet = False,  # noqa: ARG001 (every command takes it; this one has nothing to be quiet about)
) -> int:
    """Show the shortest legal way from one sample of VR cells to the next, or why there is none.

    Exit status: 0 there is a way, 1 there is none, 2 bad request or nothing could be read.
    """
    require_format(format, EXPLANATION_FORMATS)
    require_writable(output, [trace])
    from mmsverify.explaining import explain_sample

    found = explain_sample(trace, index, profile=profile, variant=variant)
    emit(render_explanation(found, format), output)
    return int(found.way is None)
