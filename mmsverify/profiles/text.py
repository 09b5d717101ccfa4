"""The text of a profile as plain values: TOML, and what in a recording's metadata may be JSON as well.

A profile may come with a recording, and so from anybody: what is nested without end, or a number that nobody
could print, is no profile.
"""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Callable
from typing import Any

LONGEST = 1 << 18
"""Characters of a profile: the longest that is shipped has some two thousand."""
DEEPEST = 16
"""Tables and lists inside each other; a profile's own keys need five."""
# tomllib takes the square of the parts of a key in time and memory. Looked for from the begin of a word only.
_LONG_KEY = re.compile(r"""(?<![\w"'-])(?:[\w"'-]+\s*\.\s*){32}""")
_INTEGERS = range(-(1 << 63), 1 << 63)


def toml(text: str) -> dict[str, Any]:
    """The tables of a TOML text. Raises ``ValueError`` where it is none, or is no profile by its size."""
    tables: dict[str, Any] = _parsed(tomllib.loads, text)
    return tables


def toml_or_json(text: str) -> Any:
    """A single value as TOML or JSON writes it. Raises ``ValueError`` where it is none."""
    _require_short(text)
    try:
        return toml(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return _parsed(json.loads, text)


def shown(value: Any) -> str:
    """A value for a message, not at any length."""
    text = repr(value)
    return text if len(text) <= 200 else f"{text[:200]}..."


def _parsed(parse: Callable[[str], Any], text: str) -> Any:
    _require_short(text)
    try:
        value = parse(text)
    except RecursionError:
        raise ValueError("it is nested too deeply") from None
    _require_plain(value)
    return value


def _require_short(text: str) -> None:
    if len(text) > LONGEST:
        raise ValueError(f"it has {len(text)} characters, and {LONGEST} is the most")
    if _LONG_KEY.search(text):
        raise ValueError("it has a key of more than 32 parts")


def _require_plain(value: Any) -> None:
    """Refuse depths and numbers, level by level: a recursion would itself go too deep."""
    level = [value]
    for _ in range(DEEPEST):
        for one in level:
            if isinstance(one, int) and one not in _INTEGERS:
                raise ValueError("it has an integer of more than 64 bits")
        level = [inside for one in level for inside in _inside(one)]
        if not level:
            return
    raise ValueError("it is nested too deeply")


def _inside(value: Any) -> list[Any]:
    if isinstance(value, dict):
        return list(value.values())
    return value if isinstance(value, list) else []
