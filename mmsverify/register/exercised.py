"""Which tests and samples exercise a clause: found in a checkout, shipped in a table beside the model.

An installed mmsverify has no tests, so that this part of the register is generated
(``python -m mmsverify.register``); a test of the documentation fails when it is stale.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from mmsverify.register.statements import beside, table_rows
from mmsverify.results import Exercise

COLUMNS = ("id", "by", "name")


def read_exercised(model: Path) -> dict[str, tuple[Exercise, ...]]:
    """What exercises each statement, by id; nothing where no table lies beside the model."""
    path = beside(model, "exercised.tsv")
    found: dict[str, list[Exercise]] = {}
    if path.is_file():
        for _, (statement, by, name) in table_rows(path, COLUMNS):
            found.setdefault(statement, []).append(Exercise(by, name))
    return {statement: tuple(exercises) for statement, exercises in found.items()}


def written(found: Iterable[tuple[str, Exercise]]) -> str:
    """The table of what was found, sorted."""
    rows = sorted({(statement, exercise.by, exercise.name) for statement, exercise in found})
    return "".join("\t".join(row) + "\n" for row in (COLUMNS, *rows))
