"""Citations of the ASN.1 modules: a comment with ids counts for the type or field at or below it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from mmsverify.model import Clause
from mmsverify.register.citations import Cited

CITED = re.compile(r"\bR-[A-Za-z0-9.]+-[A-Za-z0-9]+\b")
TYPE = re.compile(r"\s*([A-Z][\w-]*)\s*::=")
FIELD = re.compile(r"\s+([a-z][\w-]*)\s+(?=\S)")
RULE = "decode rule"


def of_modules(folder: Path) -> Iterator[Cited]:
    """What the modules in ``folder`` cite, file by file."""
    for path in sorted(folder.glob("*.asn")):
        yield from of_module(path.stem, path.read_text(encoding="utf-8"))


def of_module(name: str, text: str) -> Iterator[Cited]:
    """What one module cites; ids above its first type, and those at its end, count for the module."""
    waiting: list[str] = []
    place = name
    for line in text.splitlines():
        code, _, comment = line.partition("--")
        waiting += CITED.findall(comment)
        if not code.strip():
            continue
        place = _place(code, place, name)
        yield from _told(place, waiting)
        waiting = []
    yield from _told(name, waiting)


def _place(code: str, before: str, module: str) -> str:
    """The type that a line defines, or the field of the present type; else where the line before was."""
    defined = TYPE.match(code)
    if defined:
        return defined[1]
    field = FIELD.match(code)
    owner = before.partition(".")[0]
    return f"{owner}.{field[1]}" if field and owner != module else before


def _told(place: str, ids: list[str]) -> Iterator[Cited]:
    if ids:
        yield RULE, place, Clause.of(*ids)
