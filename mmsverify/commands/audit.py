"""``mmsverify audit``: replay traces against the models and report every violation."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mmsverify.commands.bar import audit_bar
from mmsverify.commands.options import Output, Profile, Quiet, Variant
from mmsverify.commands.output import emit, remark, require_writable
from mmsverify.commands.paths import trace_locations
from mmsverify.errors import InputError, UsageError
from mmsverify.formats.locations import Location, local
from mmsverify.report import AUDIT_FORMATS, render_audit, require_format
from mmsverify.results import Audit

UNREADABLE = "input.unreadable"


def audit(
    traces: Annotated[
        list[str],
        typer.Argument(metavar="TRACE", help="MCAP files, folders of them, or patterns; also URLs."),
    ],
    *,
    profile: Profile = None,
    model: Annotated[
        str | None,
        typer.Option("--model", metavar="NAME", help="Judge by this model, whatever the trace says."),
    ] = None,
    variant: Variant = "repaired",
    format: Annotated[str, typer.Option("--format", metavar="|".join(AUDIT_FORMATS))] = "text",
    annotate: Annotated[
        Path | None,
        typer.Option("--annotate", metavar="OUT.mcap", help="Copy the trace with its violations added."),
    ] = None,
    jobs: Annotated[
        int, typer.Option("--jobs", metavar="N", min=1, max=256, help="So many processes share the traces.")
    ] = 1,
    exact: Annotated[
        bool, typer.Option("--exact", help="Judge each message anew: slow, and the same findings.")
    ] = False,
    output: Output = None,
    quiet: Quiet = False,
) -> int:
    """Replay traces against the models and report every violation.

    Exit status: 0 no error-level violation, 1 at least one, 2 bad request or nothing could be read.
    """
    require_format(format, AUDIT_FORMATS)
    paths = trace_locations(traces)
    require_writable(output, local(paths))
    if annotate is not None:
        _require_one(annotate, paths)
    from mmsverify.auditing import audit_traces

    with audit_bar(paths, jobs, quiet=quiet) as report:
        result = audit_traces(
            paths, profile=profile, model=model, variant=variant, progress=report, exact=exact, jobs=jobs
        )
    _require_read(result)
    if annotate is not None:
        _annotate(paths[0], result, annotate, quiet=quiet)
    emit(render_audit(result, format), output)
    return int(any(finding.severity == "error" for finding in result.findings))


def _require_one(annotate: Path, paths: list[Location]) -> None:
    require_writable(annotate, local(paths))
    if len(paths) != 1:
        raise UsageError(
            f"takes one trace, {len(paths)} given", place="--annotate", cure="annotate them one by one"
        )


def _require_read(audit: Audit) -> None:
    """One trace that can be read is enough to go on; none is a bad request."""
    failures = [finding for finding in audit.findings if finding.rule == UNREADABLE]
    unread = {failure.path for failure in failures}
    if not failures or any(entry.path not in unread for entry in audit.inputs):
        return
    first = failures[0]
    place = "" if first.message.startswith(first.path) else first.path
    others = f"and {len(unread) - 1} more that cannot be read" if len(unread) > 1 else ""
    raise InputError(first.message, place=place, cure=others)


def _annotate(path: Location, result: Audit, out: Path, *, quiet: bool) -> None:
    from mmsverify.auditing import annotate

    annotate(path, result.findings, out)
    remark(f"wrote {out}", quiet=quiet)
