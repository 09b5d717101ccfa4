"""The clause register for a reader: a table of the statements, or each in full; then what a variant mends."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from textwrap import wrap

from mmsverify.report.wording import columns, counted, printable
from mmsverify.results import Encoding, Entry, Exercise, Register

WIDTH = 110
INDENT = " " * 4
HEAD = ("id", "clause", "kind", "encoded by", "exercised by")


def render(registers: Sequence[Register], *, long: bool = False) -> str:
    """The registers; ``long`` tells every statement in words, with all that encodes and exercises it."""
    return "\n\n".join("\n".join(_model(register, long)) for register in registers) + "\n"


def _model(register: Register, long: bool) -> Iterator[str]:
    standard = f" ({printable(register.standard)})" if register.standard else ""
    yield f"{printable(register.model)}{standard}: {_summary(register.counts)}"
    if long:
        for entry in register.entries:
            yield ""
            yield from _full(entry)
    elif register.entries:
        yield ""
        yield from (f"  {line}" for line in columns([HEAD, *map(_row, register.entries)]))
    if register.unknown:
        yield ""
        yield f"cited, but in no table of statements: {', '.join(map(printable, register.unknown))}"
    if register.repairs:
        yield ""
        yield from _repairs(register)


def _summary(counts: Mapping[str, int]) -> str:
    parts = [
        counted(counts["statements"], "statement"),
        f"{counts['encoded']} encoded",
        f"{counts['reasoned']} with a reason why not",
        f"{counts['uncovered']} uncovered",
        f"{counts['exercised']} exercised",
    ]
    return ", ".join(parts)


def _row(entry: Entry) -> tuple[str, ...]:
    statement = entry.statement
    encoded = [printable(encoding.name) for encoding in entry.encoded] or [_why_not(entry)]
    exercised = [exercise.name.rpartition("/")[2] for exercise in entry.exercised]
    return statement.id, statement.clause, statement.kind, _first(encoded), _first(exercised)


def _why_not(entry: Entry) -> str:
    """Why nothing encodes a statement; for one that is uncovered, how it could be checked."""
    if entry.uncovered:
        return f"- ({', '.join(entry.statement.checks)})"
    return f"({entry.statement.reason})" if entry.statement.reason else ""


def _first(names: Sequence[str]) -> str:
    """The first of several names, and how many more there are."""
    return f"{names[0]} +{len(names) - 1}" if len(names) > 1 else "".join(names)


def _full(entry: Entry) -> Iterator[str]:
    statement = entry.statement
    where = f"clause {statement.clause}, {statement.kind}" if statement.clause else "no statement at hand"
    yield f"{statement.id}  ({where})"
    yield from _told("", statement.says)
    if statement.reason:
        yield from _told(f"not checked ({statement.reason}): ", statement.because)
    if entry.uncovered:
        yield f"{INDENT}uncovered; could be checked by {', '.join(statement.checks)}"
    yield from (line for e in entry.encoded for line in _told("encoded by ", _encoding(e)))
    yield from (line for e in entry.exercised for line in _told("exercised by ", _exercise(e)))


def _told(label: str, text: str) -> list[str]:
    return wrap(
        label + printable(text), WIDTH, initial_indent=INDENT, subsequent_indent=INDENT * 2,
        break_long_words=False, break_on_hyphens=False,
    )  # fmt: skip


def _encoding(encoding: Encoding) -> str:
    variants = f" ({', '.join(encoding.variants)})" if encoding.variants else ""
    return f"{encoding.kind} {encoding.name}{variants}"


def _exercise(exercise: Exercise) -> str:
    return f"{exercise.by} {exercise.name}"


def _repairs(register: Register) -> Iterator[str]:
    yield "repairs:"
    for mended in register.repairs:
        ids = " ".join((*mended.readings, *mended.mends))
        yield from _told("", f"{mended.name} ({mended.variant}; {ids}): {mended.because}")
