"""What became of all mutants when they were last judged, as a table: the page about them is made from it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mutation_score import CLAIM, Any_Mutant, Fate
from robot_mutation import Mutant

TABLE = Path(__file__).parent / "mutants.tsv"
COLUMNS = "what\tkind\tplace\tfate\tby"

Key = tuple[str, str, str]


def key(mutant: Any_Mutant) -> Key:
    """A mutant's name in the table: what was changed, how, where. Several of a claim may have the same."""
    if isinstance(mutant, Mutant):
        return mutant.what, mutant.kind, mutant.place
    kind, claim = mutant
    return CLAIM, kind, claim.name


def write(fates: Sequence[Fate]) -> None:
    """Keep the fates, in the order of the mutants."""
    lines = ("\t".join((f.what, f.kind, f.place, f.fate, f.by)) for f in fates)
    TABLE.write_text("\n".join((COLUMNS, *lines)) + "\n", encoding="utf-8")


def read() -> list[Fate]:
    """The fates that were kept."""
    lines = TABLE.read_text(encoding="utf-8").splitlines()[1:]
    return [_fate(number, *line.split("\t")) for number, line in enumerate(lines)]


def _fate(number: int, what: str, kind: str, place: str, fate: str, by: str) -> Fate:
    return Fate(number, what, kind, place, fate, by, 0.0)
