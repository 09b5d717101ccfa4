"""The statements of a standard, one a row, in a table that lies beside its model file.

Beside a package ``robot/`` it is ``robot/clauses.tsv``, beside a file ``robot.py`` ``robot.clauses.tsv``.
A statement that cannot be checked says why, by one of the words below and a sentence of its own; nothing else
about the coverage of a clause is written down anywhere.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from mmsverify.errors import ModelError
from mmsverify.results import Statement

COLUMNS = ("id", "clause", "kind", "checks", "statement", "reason", "because")

REASONS: Mapping[str, str] = {
    "informative": "It explains, describes or announces; nothing follows for a robot or its client.",
    "local": "It leaves a choice to the implementer or the operator, so that nothing can break it.",
    "unseen": "Whether it is kept shows in no message, and no message depends on it.",
    "repeated": "It repeats another statement, which is checked.",
}

CHECKS = frozenset({"model", "invariant", "replay", "decode", "static"})
"""Ways in which a statement can be checked; one that names none of them (``doc``) is there to be read."""

IN_PART = "In part: "
"""How the sentence begins where a statement is encoded as far as it can be, and has a reason for the rest."""


def beside(model: Path, table: str) -> Path:
    """The place of a table that belongs to the model at ``model``."""
    return model.with_name(table) if model.name == "__init__.py" else model.with_name(f"{model.stem}.{table}")


def read_statements(model: Path) -> dict[str, Statement]:
    """The statements beside a model file, by id in the order of the table; none where there is no table."""
    path = beside(model, "clauses.tsv")
    if not path.is_file():
        return {}
    statements: dict[str, Statement] = {}
    for place, fields in table_rows(path, COLUMNS):
        statement = _statement(fields, place)
        if statement.id in statements:
            raise ModelError(f"{statement.id} stands there twice", place=place, cure="keep one row")
        statements[statement.id] = statement
    return statements


def table_rows(path: Path, columns: tuple[str, ...]) -> Iterator[tuple[str, list[str]]]:
    """The rows of a table with their places; its first line names the columns."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise ModelError(f"cannot be read: {error}", place=str(path), cure="give a UTF-8 text") from None
    if not lines or tuple(lines[0].split("\t")) != columns:
        raise ModelError("other columns", place=f"{path}:1", cure=f"begin with {' '.join(columns)}, by tabs")
    for number, line in enumerate(lines[1:], start=2):
        fields = line.split("\t")
        if len(fields) != len(columns):
            raise ModelError(
                f"{len(fields)} fields where {len(columns)} are meant",
                place=f"{path}:{number}",
                cure="separate fields by one tab each",
            )
        yield f"{path}:{number}", fields


def _statement(fields: list[str], place: str) -> Statement:
    name, clause, kind, checks, says, reason, because = fields
    if not name or not says:
        raise ModelError("a statement without id or words", place=place, cure="give both")
    if reason and reason not in REASONS:
        raise ModelError(f"unknown reason {reason}", place=place, cure=f"use one of {', '.join(REASONS)}")
    if bool(reason) != bool(because):
        raise ModelError(
            f"{name} has a reason without a sentence, or the reverse",
            place=place,
            cure="give both or neither",
        )
    ways = tuple(checks.split(",")) if checks else ()
    return Statement(name, clause, kind, ways, says, reason, because, bool(CHECKS & set(ways)))
