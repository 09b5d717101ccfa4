"""The models that have a mutation score, and where it is kept."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import robot_page
import robot_score
import vr_page
import vr_score
from mutation_fate import Any_Mutant, Fate, Score
from mutation_table import HERE, ROBOT, read

DOCS = HERE.parents[1] / "docs"
VR_TABLES = {name: HERE / f"mutants-{name}.tsv" for name in (vr_score.TEMPLATE, vr_score.TASKS)}


@dataclass(frozen=True)
class Subject:
    """One model: its mutants, who judges them, and the table and the page in which the fates are kept.

    ``shown`` makes a text of fates; ``page`` makes the page anew, from tables.
    """

    mutants: Callable[[], tuple[Any_Mutant, ...]]
    score: Callable[[Path], Score]
    table: Path
    written: Path
    shown: Callable[[Sequence[Fate]], str]
    page: Callable[[], str]


def vr_text() -> str:
    """The page about both VR models; one that was never judged is a model without mutants."""
    return vr_page.page({name: read(table) if table.exists() else [] for name, table in VR_TABLES.items()})


def _vr(name: str) -> Subject:
    return Subject(
        mutants=lambda: vr_score.numbered_mutants(name),
        score=lambda _: vr_score.VrScore(name, alone=True),
        table=VR_TABLES[name],
        written=DOCS / "mutation-vr.md",
        shown=lambda fates: vr_page.section(name, fates),
        page=vr_text,
    )


ROBOT_MODEL = "mms-robot"
SUBJECTS = {
    ROBOT_MODEL: Subject(
        mutants=robot_score.numbered_mutants,
        score=robot_score.RobotScore,
        table=ROBOT,
        written=DOCS / "mutation.md",
        shown=robot_page.page,
        page=lambda: robot_page.page(read(ROBOT)),
    ),
    **{name: _vr(name) for name in VR_TABLES},
}
"""By the model's name."""
