"""Texts and elements of the report: the only place where something of it becomes markup."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from mmsverify.report.wording import instant, printable

LONGEST = 2000
"""Characters of one name or value that are shown: a name may fill a whole message."""


def text(value: object) -> str:
    """Other people's words as text of the page, also within the quotes of an attribute."""
    shown = printable(str(value))
    return escape(shown if len(shown) <= LONGEST else f"{shown[:LONGEST]}...")


def element(name: str, content: str = "", **attributes: object) -> str:
    """An element around markup. Values of attributes are escaped; those that are ``None`` are left out.

    An underscore after a name is dropped (``class_``), one within it is a hyphen (``data_begin``).
    """
    written = "".join(
        f' {key.rstrip("_").replace("_", "-")}="{text(value)}"'
        for key, value in attributes.items()
        if value is not None
    )
    return f"<{name}{written}>{content}</{name}>"


def pairs(told: Iterable[tuple[str, str]]) -> str:
    """Names with their values (markup already), as a list; nothing where none has a value."""
    items = "".join(f"<dt>{text(name)}</dt><dd>{value}</dd>\n" for name, value in told if value)
    return f"<dl>\n{items}</dl>\n" if items else ""


def folded(title: str, content: str, *, opened: bool = False) -> str:
    """Something that is read on demand; nothing where there is nothing to read."""
    if not content:
        return ""
    return f"<details{' open' if opened else ''}><summary>{title}</summary>\n{content}</details>\n"


def clock(time: int | None) -> str:
    """A capture time (ns) as an element that is read as an instant; nothing for none."""
    if time is None:
        return ""
    told = instant(time)
    shown = told.replace("T", " ").rstrip("Z").removesuffix("000000")
    return element("time", shown, datetime=told)
