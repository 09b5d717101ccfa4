"""Findings and messages as data frames."""

from __future__ import annotations

import pandas as pd

from mmsverify.events import MmsEvent
from mmsverify.report.frame import EVENT_COLUMNS, FINDING_COLUMNS, events_frame, findings_frame
from mmsverify.results import Audit, Finding


def finding(index: int | None, time: int | None) -> Finding:
    return Finding(
        path="a.mcap", index=index, time=time, topic="/t", vmd="v", severity="error", rule="r",
        clauses=("R-1",), message="m", related=(1, 2),
    )  # fmt: skip


def test_findings_stand_in_the_order_of_the_report() -> None:
    frame = findings_frame(Audit([], [finding(9, 90), finding(None, None), finding(4, 40)]))
    assert list(frame.columns) == FINDING_COLUMNS
    assert [None if value is pd.NA else value for value in frame["index"]] == [None, 4, 9]
    assert frame["time"].isna().tolist() == [True, False, False]
    assert frame["related"].tolist() == [(1, 2)] * 3


def test_times_keep_their_nanoseconds() -> None:
    frame = findings_frame(Audit([], [finding(0, 1_767_592_800_123_456_789)]))
    assert frame["time"][0] == pd.Timestamp("2026-01-05T06:00:00.123456789Z")


def test_nothing_found_is_an_empty_frame_with_all_columns() -> None:
    frame = findings_frame(Audit([], []))
    assert frame.empty
    assert list(frame.columns) == FINDING_COLUMNS
    assert str(frame["index"].dtype) == "Int64"


def test_a_message_without_an_invoke_id_has_a_missing_one() -> None:
    events = [
        MmsEvent(0, 5, "v", "a", "client", "confirmed-RequestPDU", service="start", invoke_id=3),
        MmsEvent(1, 6, "v", "a", "client", "conclude-RequestPDU"),
    ]
    frame = events_frame(events)
    assert list(frame.columns) == EVENT_COLUMNS
    assert frame["invoke_id"].isna().tolist() == [False, True]
    assert frame["service"].tolist() == ["start", ""]
