"""Findings and events as pandas DataFrames, for notebooks and further analysis. One row each."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, fields
from typing import Any

import pandas as pd

from mmsverify.events import MmsEvent
from mmsverify.report.order import ordered
from mmsverify.results import Audit, Finding

FINDING_COLUMNS = [field.name for field in fields(Finding)]
EVENT_COLUMNS = [field.name for field in fields(MmsEvent)]


def findings_frame(audit: Audit) -> pd.DataFrame:
    """One row for each finding, columns as in the JSON results; ``time`` is UTC, missing where unknown."""
    return _frame(ordered(audit.findings), FINDING_COLUMNS, ["index", "count"])


def events_frame(events: Iterable[MmsEvent]) -> pd.DataFrame:
    """One row for each MMS message; integers that a message does not have are missing, ``time`` is UTC."""
    return _frame(list(events), EVENT_COLUMNS, ["index", "invoke_id", "answers"])


def _frame(rows: Sequence[Any], columns: list[str], integers: list[str]) -> pd.DataFrame:
    frame = pd.DataFrame([asdict(row) for row in rows], columns=columns)
    frame["time"] = pd.to_datetime(frame["time"], unit="ns", utc=True)
    return frame.astype(dict.fromkeys(integers, "Int64"))
