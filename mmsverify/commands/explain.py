"""``mmsverify explain``: why the findings of a message stand; how a sample of VR cells may follow."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mmsverify.commands.options import Output, Profile, Quiet, Variant
from mmsverify.commands.output import emit, require_writable
from mmsverify.report import EXPLANATION_FORMATS, render_accounts, render_explanation, require_format


def explain(
    trace: Annotated[Path, typer.Argument(metavar="TRACE", help="An MCAP file.")],
    index: Annotated[int, typer.Argument(metavar="INDEX", help="The message, counted as findings count.")],
    *,
    profile: Profile = None,
    variant: Variant = "repaired",
    format: Annotated[str, typer.Option("--format", metavar="text|json")] = "text",
    output: Output = None,
    quiet: Quiet = False,  # noqa: ARG001 (every command takes it; this one has nothing to be quiet about)
) -> int:
    """Explain a message: why its findings stand, and what would have been legal instead.

    Told are the clauses in our words, the earlier messages that exclude what was observed, and the nearest
    legal conversations: one message put in, left out or changed. All of it is found by replaying.

    Of a sample of VR cells, the shortest legal way to it from the sample before, or that there is none.

    Exit status: 0 nothing is wrong with it, 1 something is, 2 bad request or nothing could be read.
    """
    require_format(format, EXPLANATION_FORMATS)
    require_writable(output, [trace])
    from mmsverify.explaining import explain_findings, explain_sample, findings_at, shows_cells

    if shows_cells(trace, index):
        sample = explain_sample(trace, index, profile=profile, variant=variant)
        accounts = explain_findings(trace, sample.findings, profile=profile, variant=variant)
        emit(render_explanation(sample, format, accounts), output)
        return int(sample.way is None)
    found = findings_at(trace, index, profile=profile, variant=variant)
    accounts = explain_findings(trace, found, profile=profile, variant=variant)
    emit(render_accounts(str(trace), index, accounts, format), output)
    return int(any(finding.severity == "error" for finding in found))
