"""What became of all mutants of a model when they were last judged, as a table: pages are made from it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mutation_fate import Fate

HERE = Path(__file__).parent
ROBOT = HERE / "mutants.tsv"
COLUMNS = "what\tkind\tplace\tfate\tby"
TOLD = "\ttold"
"""A column of those tables only for which audits were asked of every mutant."""


def write(fates: Sequence[Fate], table: Path = ROBOT) -> None:
    """Keep the fates, in the order of the mutants."""
    audited = any(f.told for f in fates)
    lines = ("\t".join((f.what, f.kind, f.place, f.fate, f.by, *[f.told] * audited)) for f in fates)
    table.write_text("\n".join((COLUMNS + TOLD * audited, *lines)) + "\n", encoding="utf-8")


def read(table: Path = ROBOT) -> list[Fate]:
    """The fates that were kept."""
    lines = table.read_text(encoding="utf-8").splitlines()[1:]
    return [_fate(number, *line.split("\t")) for number, line in enumerate(lines)]


def _fate(number: int, what: str, kind: str, place: str, fate: str, by: str, told: str = "") -> Fate:
    return Fate(number, what, kind, place, fate, by, 0.0, told)
