"""Markdown tables and the text in their cells; no text of a model can end a cell or begin a tag."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

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


def cited(ids: Iterable[str], page: str) -> str:
    """Clause ids, each a link to its statement in the register at ``page``; readings to theirs."""
    return " ".join(_link(name, page) for name in ids)


def _link(name: str, page: str) -> str:
    if name.startswith(("R-", "V-", "M-")):
        return f"[{name}]({page}#{anchor(name)})"
    return name


def anchor(statement: str) -> str:
    """Where a statement stands on the page of its register."""
    return statement.lower()
