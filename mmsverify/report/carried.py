"""What a message carries, as far as it tells a reader something: of a status its words, not its numbers."""

from __future__ import annotations

from collections.abc import Iterable

from mmsverify.incident import Saying
from mmsverify.report.wording import printable

DULL = (
    "invoke", "transaction", "unit", "exception", "vmdLogicalStatus", "vmdPhysicalStatus", "detail.robot",
    "detail.selectedProgramInvocation",
)  # fmt: skip
"""Beginnings of the names of fields that repeat what stands elsewhere."""
EMPTY = frozenset({"", "True", "False"})
LONGEST = 120


def carried(said: Saying, *, held: Iterable[tuple[str, str]] = ()) -> list[tuple[str, str]]:
    """The fields worth telling; of a sample of cells those that are not ``held`` already, or not 0."""
    if said.sender:
        return [
            (name, value)
            for name, value in said.fields
            if not name.startswith(DULL) and not (name == "value" and value in EMPTY)
        ]
    known = set(held)
    return [
        (name, value)
        for name, value in said.fields
        if (name, value) not in known and (known or value not in ("0", "0.0"))
    ]


def in_short(said: Saying) -> str:
    """The same on one line, cut off where it is long."""
    told = ", ".join(f"{name} = {value}" if value else name for name, value in carried(said))
    told = printable(" ".join(part for part in (told, said.fault) if part))
    return told if len(told) <= LONGEST else f"{told[:LONGEST]}..."
