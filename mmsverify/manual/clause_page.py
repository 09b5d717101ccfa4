"""The page of a clause register: every statement, what encodes it and what exercises it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mmsverify.manual.markdown import anchor, code, stacked, table, text
from mmsverify.report.wording import counted
from mmsverify.results import Entry, Register

SHOWN = 3
"""How many of those that encode a statement are named."""
TEST = "test"


def page(register: Register) -> str:
    """The page of one register."""
    return "\n\n".join(_parts(register)) + "\n"


def _parts(register: Register) -> Iterator[str]:
    counts = register.counts
    yield f"# Clauses of {register.model}"
    yield (
        f"{text(register.standard)}: {counts['statements']} statements in words of our own, "
        f"{counts['encoded']} encoded by rows, properties and rules, "
        f"{counts['reasoned']} with a reason why not, "
        f"{counts['exercised']} exercised by tests or samples. "
        f"`mmsverify clauses {register.model} --clause ID` tells one in full."
    )
    head = ("statement", "says", "encoded by", "exercised by")
    yield table(head, map(_row, register.entries))


def _row(entry: Entry) -> tuple[str, ...]:
    statement = entry.statement
    name = f'<a id="{anchor(statement.id)}"></a>{code(statement.id)}'
    encoded = [f"{encoding.kind} {encoding.name}" for encoding in entry.encoded]
    if statement.reason and not encoded:
        encoded = [f"not checked ({statement.reason}): {statement.because}"]
    return name, text(statement.says), _first(encoded), text(", ".join(_exercised(entry)))


def _exercised(entry: Entry) -> Iterator[str]:
    """The samples by name, and how many tests."""
    yield from (e.name.removesuffix(".mcap") for e in entry.exercised if e.by != TEST)
    tests = sum(exercise.by == TEST for exercise in entry.exercised)
    if tests:
        yield counted(tests, "test")


def _first(names: Sequence[str]) -> str:
    more = len(names) - SHOWN
    return stacked([*map(text, names[:SHOWN]), *([f"and {more} more"] if more > 0 else [])])
