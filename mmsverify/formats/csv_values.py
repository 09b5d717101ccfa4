"""The cells of an exported table: numbers with a point or comma, times as numbers or as date and time."""

from __future__ import annotations

import math
import re
from datetime import UTC, datetime, timedelta, timezone
from decimal import Decimal
from functools import lru_cache

from mmsverify.formats.vr import Number, plain

UNITS = {"ns": 1, "us": 1_000, "ms": 1_000_000, "s": 1_000_000_000}
"""Nanoseconds of each unit of time."""

_SECOND = UNITS["s"]
_NUMBER = re.compile(r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][+-]?\d{1,4})?", re.ASCII)
_CLOCK = r"(\d{1,2}):(\d\d)(?::(\d\d)(?:[.,:](\d{1,12}))?)?"
_DATE_TIME = re.compile(
    rf"(\d{{4}})[-/.](\d{{1,2}})[-/.](\d{{1,2}})(?:T|\s+){_CLOCK}\s*(?:(Z)|([+-])(\d\d):?(\d\d))?",
    re.ASCII | re.IGNORECASE,
)
_DAY_FIRST = re.compile(r"(\d{1,2})\.(\d{1,2})\.(\d{4})(?=\D)", re.ASCII)
_TIME_OF_DAY = re.compile(_CLOCK, re.ASCII)
_UNIT_WORDS = {
    **dict.fromkeys(("ns", "nsec", "nanosecond", "nanoseconds"), "ns"),
    **dict.fromkeys(("us", "µs", "μs", "usec", "microsecond", "microseconds", "微秒"), "us"),
    **dict.fromkeys(("ms", "msec", "millisecond", "milliseconds", "毫秒"), "ms"),
    **dict.fromkeys(("s", "sec", "second", "seconds", "秒"), "s"),
}
LONGEST = 400
"""Characters of a number or a time: what is longer is neither, and is not kept in mind."""
_EPOCH = datetime(1970, 1, 1, tzinfo=UTC)
_FURTHEST = 25
"""The largest power of ten, in ns, that is looked at: beyond what a trace can hold."""


def number(text: str) -> Number | None:
    """A number as controllers and oscilloscopes write it, 6.0 as 6; nothing for what is none."""
    return _number(text) if len(text) <= LONGEST else None


@lru_cache(maxsize=4096)
def _number(text: str) -> Number | None:
    text = text.strip()
    if not _NUMBER.fullmatch(text):
        return None
    value = float(text.replace(",", "."))
    return plain(value) if math.isfinite(value) else None


def nanoseconds(text: str, unit: str) -> int | None:
    """A time in ns: a number of ``unit``, a date with its time (UTC unless it says otherwise), a time of day.

    Nothing for what is no time.
    """
    text = text.strip()
    if not 0 < len(text) <= LONGEST:
        return None
    if _NUMBER.fullmatch(text):
        value = Decimal(text.replace(",", ".")) * UNITS[unit]
        return round(value) if value.adjusted() < _FURTHEST else None
    if found := _DATE_TIME.fullmatch(_DAY_FIRST.sub(r"\3-\2-\1", text, count=1)):
        return _date_time(found)
    if found := _TIME_OF_DAY.fullmatch(text):
        return _time_of_day(*found.groups())
    return None


def is_time_of_day(text: str) -> bool:
    """Whether a time lacks its date."""
    return bool(_TIME_OF_DAY.fullmatch(text.strip()))


def _date_time(found: re.Match[str]) -> int | None:
    year, month, day, *clock, _, sign, hours, minutes = found.groups()
    of_day = _time_of_day(*clock)
    if of_day is None:
        return None
    try:
        ahead = timedelta(hours=int(hours or 0), minutes=int(minutes or 0)) * (-1 if sign == "-" else 1)
        midnight = datetime(int(year), int(month), int(day), tzinfo=timezone(ahead))
    except ValueError:
        return None
    since = midnight - _EPOCH
    return (since.days * 86_400 + since.seconds) * _SECOND + of_day


def _time_of_day(hour: str, minute: str, second: str | None, fraction: str | None) -> int | None:
    whole = (int(hour), int(minute), int(second or 0))
    if whole >= (24,) or whole[1] > 59 or whole[2] > 59:
        return None
    of_second = int((fraction or "0").ljust(9, "0")[:9])
    return ((whole[0] * 60 + whole[1]) * 60 + whole[2]) * _SECOND + of_second


def unit_word(text: str) -> str:
    """The unit of time that a word names, in brackets or not; empty for what is none."""
    return _UNIT_WORDS.get(text.strip().strip("()[]<>").strip().casefold(), "")
