"""Findings and events as pandas DataFrames, for notebooks and further analysis. One row each.

What has ``by_time`` in its name is indexed by the capture time (UTC, ns), columns of few words categorical.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, fields
from typing import Any

import pandas as pd

from mmsverify.events import MmsEvent
from mmsverify.incident import Saying
from mmsverify.report.order import SEVERITIES, ordered
from mmsverify.results import Audit, AuditedInput, Finding, Verdict

FINDING_COLUMNS = [field.name for field in fields(Finding)]
EVENT_COLUMNS = [field.name for field in fields(MmsEvent)]
INPUT_COLUMNS = [field.name for field in fields(AuditedInput)]
VERDICT_COLUMNS = ["name", "kind", "result", "method", "scope", "depth", "seconds", "clauses", "statement"]
MESSAGE_COLUMNS = [
    "path", "index", "device", "partner", "sender", "what", "answers", "robot_state", "selected", "fields",
    "fault",
]  # fmt: skip
FEW_WORDS = {
    "path", "device", "partner", "sender", "what", "robot_state", "selected", "topic", "vmd", "rule",
}  # fmt: skip


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


def findings_by_time(audit: Audit) -> pd.DataFrame:
    """The same by time: a finding about a file as a whole has none (``NaT``)."""
    frame = _by_time(findings_frame(audit))
    severities = pd.CategoricalDtype([*reversed(SEVERITIES)], ordered=True)  # so that errors are the greatest
    return frame.astype({"severity": severities})


def inputs_frame(inputs: Iterable[AuditedInput]) -> pd.DataFrame:
    """One row for each recording that could be read."""
    return pd.DataFrame([asdict(entry) for entry in inputs], columns=INPUT_COLUMNS)


def verdicts_frame(verdicts: Iterable[Verdict]) -> pd.DataFrame:
    """One row for each property that was checked."""
    rows = [[getattr(verdict, name) for name in VERDICT_COLUMNS] for verdict in verdicts]
    frame = pd.DataFrame(rows, columns=VERDICT_COLUMNS).astype({"depth": "Int64"})
    return frame.astype(dict.fromkeys(("kind", "result", "method"), "category"))


def messages_by_time(messages: Iterable[tuple[str, Saying]]) -> pd.DataFrame:
    """One row for each message, whatever its kind, with the path of its recording.

    ``what`` says what it is, ``fields`` what it carries, ``answers`` the index of the request that it
    answers; ``robot_state`` and ``selected`` are those that an MMS status shows.
    """
    columns: dict[str, list[Any]] = {name: [] for name in ("time", *MESSAGE_COLUMNS)}
    for path, said in messages:
        shown = dict(said.fields)
        row = (
            said.time, path, said.index, said.device, said.partner, said.sender, said.title, said.answers,
            shown.get("robot state", ""), shown.get("selected", ""),
            ", ".join(f"{name}={value}" for name, value in said.fields), said.fault,
        )  # fmt: skip
        for column, value in zip(columns.values(), row, strict=True):
            column.append(value)
    frame = pd.DataFrame(columns)
    frame["time"] = pd.to_datetime(frame["time"], unit="ns", utc=True)
    return _by_time(frame.astype({"index": "int64", "answers": "Int64"}))


def _by_time(frame: pd.DataFrame) -> pd.DataFrame:
    frame["time"] = frame["time"].dt.as_unit("ns")
    kinds = {name: "category" for name in frame.columns if name in FEW_WORDS}
    return frame.astype(kinds).set_index("time")
