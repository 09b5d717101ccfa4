"""The models that have a mutation score, and where it is kept."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import robot_page
import robot_score
from modbus_shelf import SIGNALS
from mutation_fate import Any_Mutant, Fate, Score
from mutation_table import HERE, ROBOT, read
from small_page import PAGES, Page
from small_score import SmallScore, numbered_mutants
from vr_shelf import TASKS, TEMPLATE

DOCS = HERE.parents[1] / "docs"
TABLES = {name: HERE / f"mutants-{name}.tsv" for page in PAGES for name in page.models}
"""Those of the small models."""
SMALL = {small.name: small for small in (TEMPLATE, TASKS, SIGNALS)}


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


def text(page: Page) -> str:
    """A page about small models; one that was never judged is a model without mutants."""
    tables = {name: TABLES[name] for name in page.models}
    return page.text({name: read(table) if table.exists() else [] for name, table in tables.items()})


def _small(name: str, page: Page) -> Subject:
    return Subject(
        mutants=lambda: numbered_mutants(name),
        score=lambda _: SmallScore(SMALL[name], alone=True),
        table=TABLES[name],
        written=DOCS / page.file,
        shown=lambda fates: page.section(name, fates),
        page=lambda: text(page),
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
    **{name: _small(name, page) for page in PAGES for name in page.models},
}
"""By the model's name."""
