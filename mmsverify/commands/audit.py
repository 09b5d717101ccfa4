"""``mmsverify audit``: replay traces against the models and report every violation."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from mmsverify.commands.bar import audit_bar
from mmsverify.commands.dataset import PARQUET, Dataset
from mmsverify.commands.options import Output, Profile, Quiet, Variant, place
from mmsverify.commands.output import emit, remark, replacing, require_writable
from mmsverify.errors import InputError, UsageError
from mmsverify.fleet.tasks import LOCAL, UNREADABLE
from mmsverify.formats.locations import Location, local
from mmsverify.formats.paths import trace_locations
from mmsverify.incident import Dossier
from mmsverify.report import AUDIT_FORMATS, render_audit, require_format
from mmsverify.report.capping import capped
from mmsverify.report.wording import counted
from mmsverify.results import Audit, AuditedInput, Finding

PROCESSES, DASK = "processes", "dask"
ENGINES = (PROCESSES, DASK)
FORMATS = (*AUDIT_FORMATS, PARQUET)
Options = dict[str, Any]
"""What is passed on to the audit."""


Traces = Annotated[
    list[str], typer.Argument(metavar="TRACE", help="MCAP files, folders of them, or patterns; also URLs.")
]
ModelName = Annotated[
    str | None,
    typer.Option("--model", metavar="NAME", help="Judge by this model, whatever the trace says."),
]
Format = Annotated[
    str,
    typer.Option("--format", metavar="|".join(FORMATS), help=f"{PARQUET}: a folder of files, with -o DIR."),
]
Annotate = Annotated[
    Path | None,
    typer.Option(
        "--annotate", metavar="OUT.mcap", parser=place("--annotate"),
        help="Copy the trace with its violations added.",
    ),
]  # fmt: skip
Jobs = Annotated[
    int | None,
    typer.Option("--jobs", metavar="N", min=1, max=256, help="So many processes share the traces."),
]
Engine = Annotated[
    str,
    typer.Option("--engine", metavar="|".join(ENGINES), help="Who shares them; dask: a cluster's workers."),
]
Scheduler = Annotated[
    str | None,
    typer.Option(
        "--scheduler", metavar="ADDRESS|local", help="The cluster's, or local: one of --jobs processes."
    ),
]
Resume = Annotated[
    Path | None,
    typer.Option(
        "--resume", metavar="DIR", parser=place("--resume"),
        help="Keep results in DIR; go on from there after a break.",
    ),
]  # fmt: skip
Exact = Annotated[bool, typer.Option("--exact", help="Judge each message anew: slow, and the same findings.")]
Kernel = Annotated[
    bool, typer.Option("--kernel", help="Compiled loops (extra fast); without this, for long traces only.")
]
NoKernel = Annotated[bool, typer.Option("--no-kernel", help="No compiled loops.")]
MaxPerRule = Annotated[
    int | None,
    typer.Option(
        "--max-per-rule", metavar="N", min=1,
        help="Tell at most N findings of a rule and device in a trace; count the rest.",
    ),
]  # fmt: skip
Strict = Annotated[bool, typer.Option("--strict", help="Warnings count as errors for the exit status.")]
ExitZero = Annotated[bool, typer.Option("--exit-zero", help="End with 0 in spite of violations; 2 stays 2.")]


def audit(
    traces: Traces,
    *,
    profile: Profile = None,
    model: ModelName = None,
    variant: Variant = "repaired",
    format: Format = "text",
    annotate: Annotate = None,
    jobs: Jobs = None,
    engine: Engine = PROCESSES,
    scheduler: Scheduler = None,
    resume: Resume = None,
    exact: Exact = False,
    kernel: Kernel = False,
    no_kernel: NoKernel = False,
    max_per_rule: MaxPerRule = None,
    strict: Strict = False,
    exit_zero: ExitZero = False,
    output: Output = None,
    quiet: Quiet = False,
) -> int:
    """Replay traces against the models and report every violation.

    Exit status: 0 no error-level violation, 1 at least one, 2 bad request or nothing could be read.
    """
    require_format(format, FORMATS)
    failing = _failing(strict=strict, exit_zero=exit_zero)
    paths = trace_locations(traces)
    if annotate is not None:
        _require_one(annotate, paths, format)
    given: Options = {
        "profile": profile, "model": model, "variant": variant,
        "exact": exact, "kernel": _compiled(exact=exact, kernel=kernel, no_kernel=no_kernel),
        "jobs": jobs, "scheduler": _scheduler(engine, scheduler, jobs), "resume": resume,
    }  # fmt: skip
    if format == PARQUET:
        result = _to_dataset(paths, output, given, max_per_rule, quiet=quiet)
    else:
        require_writable(output, local(paths))
        result = _audited(paths, given, quiet=quiet)
        told = capped(result, max_per_rule)
        emit(render_audit(told, format, _dossier(told, format, given)), output)
        if annotate is not None:
            _annotate(paths[0], told, annotate, given, quiet=quiet)
    return int(any(finding.severity in failing for finding in result.findings))


def _failing(*, strict: bool, exit_zero: bool) -> frozenset[str]:
    """The severities that make the exit status 1."""
    if strict and exit_zero:
        raise UsageError("not with --exit-zero", place="--strict", cure="leave out one of them")
    return frozenset() if exit_zero else frozenset({"error", *(("warning",) if strict else ())})


def _compiled(*, exact: bool, kernel: bool, no_kernel: bool) -> bool | None:
    """Whether compiled loops are wanted; ``None``: nothing is said of it."""
    if kernel and no_kernel:
        raise UsageError("not with --no-kernel", place="--kernel", cure="leave out one of them")
    if exact and kernel:
        raise UsageError("looks nothing up", place="--exact", cure="leave out --kernel, or --exact")
    return kernel or (False if no_kernel else None)


def _scheduler(engine: str, scheduler: str | None, jobs: int | None) -> str | None:
    """The address of the cluster that shares the work, ``None``: processes do."""
    if engine not in ENGINES:
        raise UsageError(f"no engine {engine!r}", place="--engine", cure=f"one of {', '.join(ENGINES)}")
    if engine == PROCESSES:
        if scheduler is not None:
            raise UsageError(f"is for {DASK}", place="--scheduler", cure=f"add --engine {DASK}")
        return None
    if scheduler == "":
        raise UsageError("is empty", place="--scheduler", cure=f"give an address, or {LOCAL}")
    if scheduler not in (None, LOCAL) and jobs is not None:
        cure = f"leave it out, or use --scheduler {LOCAL}"
        raise UsageError("a cluster has the workers that it has", place="--jobs", cure=cure)
    return scheduler or LOCAL


def _sharing(given: Options) -> int:
    """How many processes share the recordings; how many a cluster has, nobody need know."""
    return given["jobs"] or (1 if given["scheduler"] is None else 2)


def _audited(paths: list[Location], given: Options, *, quiet: bool) -> Audit:
    from mmsverify.auditing import audit_traces

    with audit_bar(paths, _sharing(given), quiet=quiet) as report:
        result = audit_traces(paths, progress=report, **given)
    _require_read(result)
    return result


def _dossier(result: Audit, format: str, given: Options) -> Dossier | None:
    """What the format tells beside the findings."""
    if format not in ("html", "sarif"):
        return None
    from mmsverify.incidents import dossier, statements

    if format == "sarif":
        return Dossier(statements=statements(result))
    return dossier(result, profile=given["profile"], model=given["model"], variant=given["variant"])


def _to_dataset(
    paths: list[Location], folder: Path | None, given: Options, most: int | None, *, quiet: bool
) -> Audit:
    """Write the results as they come; gives back of the findings those that decide how it ends."""
    from mmsverify.auditing import audit_each

    inputs: list[AuditedInput] = []
    kept: list[Finding] = []
    found = 0
    with audit_bar(paths, _sharing(given), quiet=quiet) as report:
        audits = audit_each(paths, progress=report, **given)
        with Dataset(folder) as dataset:
            for audit in audits:
                dataset.add(capped(audit, most))
                found += len(audit.findings)
                inputs += audit.inputs
                worst = {finding.severity: finding for finding in reversed(audit.findings)}
                kept += [f for f in audit.findings if f.rule == UNREADABLE] or worst.values()
    result = Audit(inputs, kept)
    _require_read(result)
    remark(f"wrote {folder}: {counted(len(paths), 'recording')}, {counted(found, 'finding')}", quiet=quiet)
    return result


def _require_one(annotate: Path, paths: list[Location], format: str) -> None:
    require_writable(annotate, local(paths))
    if format == PARQUET:
        raise UsageError(
            f"not with --format {PARQUET}", place="--annotate", cure="annotate the trace by itself"
        )
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


def _annotate(path: Location, audit: Audit, out: Path, given: Options, *, quiet: bool) -> None:
    from mmsverify.annotating import annotate

    manner = {name: given[name] for name in ("profile", "model", "variant")}
    with replacing(out) as part:
        shifted = annotate(path, audit, part, **manner)
    remark(f"wrote {out}", quiet=quiet)
    if shifted:
        remark(f"{out}: {counted(shifted, 'message')} of log time 0 put at 1 ns, for viewers", quiet=quiet)
