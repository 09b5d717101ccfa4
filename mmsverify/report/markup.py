"""Pieces of HTML for who shows results in a page of somebody else's, such as a notebook.

Text is escaped here and nowhere else: whoever makes a piece gives text, and gets markup.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from mmsverify.report.wording import printable

RED, AMBER, GREY, GREEN = "#c62828", "#b26a00", "#5f6368", "#2e7d32"
COLOURS = {
    "error": RED, "warning": AMBER, "note": GREY, "violated": RED, "unknown": AMBER, "proved": GREEN,
}  # fmt: skip
CELL = "text-align:left;vertical-align:top;overflow-wrap:break-word"


class Markup(str):
    """Text that is HTML already."""

    __slots__ = ()


def text(value: object) -> Markup:
    """Any value as text of a page; markup stays what it is."""
    return value if isinstance(value, Markup) else Markup(escape(printable(str(value))))


def element(tag: str, *inside: object, style: str = "") -> Markup:
    """An element with what is inside."""
    shown = f' style="{escape(style)}"' if style else ""
    return Markup(f"<{tag}{shown}>{joined(inside)}</{tag}>")


def joined(parts: Iterable[object], between: str = "") -> Markup:
    """Parts one after the other."""
    return Markup(between.join(map(text, parts)))


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> Markup:
    """A table with a line of names above its rows."""
    names = element("tr", *(element("th", name, style=CELL) for name in head))
    lines = (element("tr", *(element("td", cell, style=CELL) for cell in row)) for row in rows)
    return element("table", element("thead", names), element("tbody", *lines))


def word(value: str) -> Markup:
    """A severity or a result in its colour."""
    return element("b", value, style=f"color:{COLOURS.get(value, GREY)}")


def folding(summary: object, *inside: object) -> Markup:
    """What can be opened by who wants to see it."""
    return element("details", element("summary", summary), *inside)


def code(value: object) -> Markup:
    """A name of a program or a standard."""
    return element("code", value)
