"""Markdown tables and the text in their cells; no text of a model can end a cell or begin a tag."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from html import escape

_READING = re.compile(r"^\| ((?:[A-Z]{1,2}-[A-Z0-9-]+(?:, )?)+) \|", re.MULTILINE)

LONG = 220
"""Letters of a formula after which it is folded away."""


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table; empty where there are no rows."""
    lines = [_line(row) for row in rows]
    return "\n".join([_line(head), _line(["---"] * len(head)), *lines]) if lines else ""


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def text(words: str) -> str:
    """Words as they stand: nothing in them is markup."""
    safe = escape(" ".join(words.split()), quote=False)
    for letter in "\\`*_[]{}|":
        safe = safe.replace(letter, f"&#{ord(letter)};")
    return safe


def code(words: str) -> str:
    """A name or a formula."""
    return f"<code>{text(words)}</code>" if words else ""


def formula(words: str) -> str:
    """A formula; a long one is opened by who wants to read it."""
    if len(words) <= LONG:
        return code(words)
    return f"<details><summary>formula</summary>{code(words)}</details>"


def stacked(parts: Iterable[str]) -> str:
    """Several things in one cell, one below the other."""
    return "<br>".join(parts)


def cited(ids: Iterable[str], page: str, readings: str) -> str:
    """Ids of statements as links to the register at ``page``, those of readings as links to theirs."""
    return " ".join(f"[{name}]({page if _is_statement(name) else readings}#{anchor(name)})" for name in ids)


def _is_statement(name: str) -> bool:
    return name.startswith(("R-", "V-", "M-"))


def anchored(page: str) -> str:
    """The page of readings with a place to link to for each id in the first cell of a row."""
    return _READING.sub(lambda row: f"| {''.join(map(_place, row[1].split(', ')))}{row[1]} |", page)


def _place(name: str) -> str:
    return f'<a id="{anchor(name)}"></a>'


def anchor(statement: str) -> str:
    """Where a statement or a reading stands on its page."""
    return statement.lower()
