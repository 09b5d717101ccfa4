"""``mmsverify check``: prove or refute every property of the models."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from mmsverify.commands.options import Output, OwnVariant, Profile, Quiet, place
from mmsverify.commands.output import emit, progress, remark, require_writable
from mmsverify.errors import UsageError
from mmsverify.report import CHECK_FORMATS, render_check, require_format
from mmsverify.results import ModelCheck

Models = Annotated[
    list[str] | None,
    typer.Argument(metavar="MODEL", help="Names or model files; all built-in ones if none."),
]
Properties = Annotated[
    list[str] | None, typer.Option("--property", metavar="NAME", help="Only this property; may be repeated.")
]
Scope = Annotated[
    str | None,
    typer.Option("--scope", metavar="PI=4,Client=2", help="Check only up to these numbers of each."),
]
Unbounded = Annotated[bool, typer.Option("--unbounded", help="Only proofs for any number of each.")]
Depth = Annotated[int | None, typer.Option("--depth", metavar="N", min=0, help="At most N steps.")]
Timeout = Annotated[
    float | None,
    typer.Option("--timeout", metavar="S", help="Seconds for each property; it is unknown then."),
]
Counterexamples = Annotated[
    Path | None,
    typer.Option(
        "--counterexamples", metavar="DIR", parser=place("--counterexamples"),
        help="Write each counterexample as a trace.",
    ),
]  # fmt: skip


def check(
    models: Models = None,
    *,
    variant: OwnVariant = None,
    properties: Properties = None,
    scope: Scope = None,
    unbounded: Unbounded = False,
    depth: Depth = None,
    timeout: Timeout = None,
    profile: Profile = None,
    counterexamples: Counterexamples = None,
    format: Annotated[str, typer.Option("--format", metavar="|".join(CHECK_FORMATS))] = "text",
    output: Output = None,
    quiet: Quiet = False,
) -> int:
    """Prove or refute every property of the models.

    Exit status: 0 everything is proved, 1 something is violated, 2 bad request, 3 something is undecided.
    """
    require_format(format, CHECK_FORMATS)
    require_writable(output)
    sizes = _scope(scope, unbounded)
    _require_positive(timeout)
    from mmsverify.checking import check_models

    with progress(quiet=quiet) as report:
        checks = check_models(
            models or [],
            variant=variant,
            properties=properties or [],
            scope=sizes,
            unbounded=unbounded,
            depth=depth,
            timeout=timeout,
            profile=profile,
            progress=report,
        )
    if counterexamples is not None:
        _write_counterexamples(checks, counterexamples, quiet=quiet)
    emit(render_check(checks, format), output)
    return status(checks)


def status(checks: Sequence[ModelCheck]) -> int:
    """1 where a property is violated or a profile has an error, else 3 where one is unknown, else 0."""
    results = {verdict.result for check in checks for verdict in check.verdicts}
    faulty = any(found.severity == "error" for check in checks for found in check.profile)
    return 1 if faulty or "violated" in results else 3 if "unknown" in results else 0


def _scope(text: str | None, unbounded: bool) -> dict[str, int] | None:
    """``PI=4,Client=2`` as sort to number of elements."""
    if text is None:
        return None
    if unbounded:
        raise UsageError("a bound, and --unbounded beside it", place="--scope", cure="leave one of them out")
    sizes: dict[str, int] = {}
    for part in text.split(","):
        sort, equals, number = (piece.strip() for piece in part.partition("="))
        if not (sort.isidentifier() and equals and number.isascii() and number.isdigit()) or sort in sizes:
            raise UsageError(
                f"cannot read {part!r}", place="--scope", cure="write it like PI=4,Client=2, each once"
            )
        sizes[sort] = int(number)
    return sizes


def _require_positive(timeout: float | None) -> None:
    if timeout is not None and not timeout > 0:  # NaN is refused too
        raise UsageError(
            f"{timeout:g} is not a time limit", place="--timeout", cure="give seconds, more than 0"
        )


def _write_counterexamples(checks: Sequence[ModelCheck], folder: Path, *, quiet: bool) -> None:
    from mmsverify.checking import write_counterexamples

    for path in write_counterexamples(checks, folder):
        remark(f"wrote {path}", quiet=quiet)
