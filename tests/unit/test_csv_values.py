"""Times and numbers as tables of VR samples hold them."""

from __future__ import annotations

import pytest

from mmsverify.formats.csv_values import nanoseconds, number

MS = 1_000_000


@pytest.mark.parametrize(
    ("text", "unit", "expected"),
    [
        ("1764000000.123456789", "s", 1764000000123456789),
        ("2.5e-3", "ms", 2500),
        (" 0,5 ", "us", 500),
        ("-.5", "s", -500 * MS),
        ("1970-01-01T00:00:01Z", "s", 1000 * MS),
        ("1970/01/01 00:00:01.5", "ms", 1500 * MS),
        ("1970-1-1 0:00:01,000000005", "s", 1000 * MS + 5),
        ("01.02.1970 00:00", "s", 31 * 86_400_000 * MS),
        ("1970-01-01T01:00:00+01:00", "s", 0),
        ("1970-01-01T00:00:00-0030", "s", 1_800_000 * MS),
        ("06:00:00.250", "s", 21_600_250 * MS),
        ("2026-02-30 00:00:00", "s", None),
        ("2026-01-01 24:00:00", "s", None),
        ("2026-01-01", "s", None),
        ("12:61", "s", None),
        ("1e9999", "s", None),
        ("1.000,5", "s", None),
        ("1_000", "s", None),
        ("\uff11", "s", None),
        ("", "s", None),
    ],
)
def test_a_time_is_a_number_or_a_date_and_time(text: str, unit: str, expected: int | None) -> None:
    assert nanoseconds(text, unit) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [("6.0", 6), ("6,0", 6), ("+6", 6), ("6.", 6), (".5", 0.5), ("1.01E+02", 101), ("6.5", 6.5)]
    + [(text, None) for text in ("", "x", "nan", "inf", "1e999", "6 V", "0x06", "1,234.5", "TRUE", "\u0666")],
)
def test_a_number_is_read_as_controllers_store_it(text: str, expected: float | None) -> None:
    assert number(text) == expected
    assert type(number(text)) is type(expected)
