"""``mmsverify clauses``: the clause register of the models."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fnmatch import fnmatchcase
from typing import Annotated

import typer

from mmsverify.commands.options import Output, Quiet
from mmsverify.commands.output import emit, require_writable
from mmsverify.errors import UsageError
from mmsverify.report import CLAUSES_FORMATS, render_clauses, require_format
from mmsverify.results import Entry, Register

Models = Annotated[
    list[str] | None,
    typer.Argument(metavar="[MODEL]", help="Names or model files; all built-in ones if none."),
]
Pattern = Annotated[
    str | None,
    typer.Option(
        "--clause", metavar="ID", help="Only this id or clause number, told in full; * stands for any text."
    ),
]


def clauses(
    models: Models = None,
    *,
    uncovered: Annotated[
        bool, typer.Option("--uncovered", help="Only what could be checked and is not.")
    ] = False,
    clause: Pattern = None,
    long: Annotated[bool, typer.Option("--long", help="Every statement in words, with all details.")] = False,
    format: Annotated[str, typer.Option("--format", metavar="|".join(CLAUSES_FORMATS))] = "text",
    output: Output = None,
    quiet: Quiet = False,  # noqa: ARG001 (every command takes it; this one has nothing to be quiet about)
) -> int:
    """Tell for every clause what encodes it, which tests exercise it, or why it cannot be checked.

    Exit status: 0; with --uncovered 1 where a checkable statement is uncovered or a cited id is unknown;
    2 bad request.
    """
    require_format(format, CLAUSES_FORMATS)
    require_writable(output)
    from mmsverify.register import clause_registers

    registers = clause_registers(models or [])
    if clause is not None:
        registers = _matching(registers, clause)
    if uncovered:
        registers = [_cut(r, [e for e in r.entries if e.uncovered]) for r in registers]
    emit(render_clauses(registers, format, long=long or clause is not None), output)
    return status(registers) if uncovered else 0


def status(registers: Sequence[Register]) -> int:
    """1 where something is uncovered, or cited and unknown."""
    return int(any(r.unknown or any(entry.uncovered for entry in r.entries) for r in registers))


def _matching(registers: Sequence[Register], pattern: str) -> list[Register]:
    cut = [_cut(r, [e for e in r.entries if _matches(e, pattern)]) for r in registers]
    if not any(r.entries for r in cut):
        raise UsageError(
            f"no statement is called {pattern!r}",
            place="--clause",
            cure="give an id like R-7.4.4.2-d, a clause like 7.4.4.2, or a pattern like 'R-7.4.*'",
        )
    return cut


def _matches(entry: Entry, pattern: str) -> bool:
    return any(fnmatchcase(text, pattern) for text in (entry.statement.id, entry.statement.clause))


def _cut(register: Register, entries: Sequence[Entry]) -> Register:
    """The register with these entries only, and the repairs that mend one of them."""
    kept = {entry.statement.id for entry in entries}
    repairs = tuple(mended for mended in register.repairs if kept & set(mended.mends))
    return replace(register, entries=tuple(entries), repairs=repairs)
