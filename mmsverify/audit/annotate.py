"""A recording with its findings: the same messages, and channels that log viewers can draw.

Viewers such as Foxglove and Lichtblick cannot show BER. So beside the copied channels stand the violations
(``foxglove.Log``), each MMS message as JSON, and the state that the robot showed, as flat fields.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from mmsverify.audit.spoken import Listener
from mmsverify.audit.words import ROBOT_STATE
from mmsverify.errors import InputError
from mmsverify.events import MmsEvent
from mmsverify.formats.locations import Location
from mmsverify.formats.mcap import McapTrace, TraceWriter, read_trace
from mmsverify.formats.trace import Channel, Schema, TraceMessage
from mmsverify.results import Finding

LEVEL = {"note": 2, "warning": 3, "error": 4}
"""The levels of ``foxglove.Log``: INFO, WARNING, ERROR."""
SECOND = 1_000_000_000


def _schema(title: str, /, **properties: Mapping[str, Any]) -> Schema:
    text = json.dumps({"type": "object", "properties": properties}, separators=(",", ":"))
    return Schema(title, "jsonschema", text.encode())


_TEXT, _INTEGER, _FLAG = {"type": "string"}, {"type": "integer"}, {"type": "boolean"}
_TEXTS = {"type": "array", "items": _TEXT}
_TIME = {"type": "object", "title": "time", "properties": {"sec": _INTEGER, "nsec": _INTEGER}}

LOG = _schema(
    "foxglove.Log", timestamp=_TIME, level=_INTEGER, message=_TEXT, name=_TEXT, file=_TEXT, line=_INTEGER
)
EVENT = _schema(
    "mmsverify.MmsEvent", index=_INTEGER, association=_TEXT, sender=_TEXT, kind=_TEXT, service=_TEXT,
    invoke_id=_INTEGER, answers=_INTEGER, answer=_TEXT, programs=_TEXTS, fault=_TEXT,
)  # fmt: skip
STATE = _schema(
    "mmsverify.RobotState", robot_state=_TEXT, robot_state_number=_INTEGER, selected=_TEXT,
    local_control=_FLAG, logical=_TEXT, physical=_TEXT,
)  # fmt: skip
_SHOWN = frozenset({"robot_state", "selected", "local_control", "logical", "physical"})


def annotate(path: Location, findings: Sequence[Finding], out: Path) -> None:
    """Copy the recording at ``path`` to ``out`` with those findings that are its own.

    Everything is copied that can be read; raises ``InputError`` only where nothing can. A finding without a
    time of its own stands at the end.
    """
    trace = read_trace(path)
    own = [finding for finding in findings if finding.path == str(path)]
    with TraceWriter(out) as copy:
        for name, pairs in trace.metadata.items():
            copy.add_metadata(name, pairs)
        last = _copied(trace, own, copy)
        for finding in own:
            if finding.index is None:
                copy.add(last, _log(finding.vmd), _entry(finding, last))


def _copied(trace: McapTrace, findings: Sequence[Finding], copy: TraceWriter) -> int:
    """Write every message and what is said beside it; the time of the last one."""
    by_index: dict[int | None, list[Finding]] = {}
    for finding in findings:
        by_index.setdefault(finding.index, []).append(finding)
    listener, last = Listener(), 0
    for message in _readable(trace):
        last = message.time
        copy.add(last, message.channel, message.data)
        if message.message_encoding == "mms-ber":
            _beside(listener.event(message), copy)
        for finding in by_index.get(message.index, ()):
            copy.add(last, _log(finding.vmd), _entry(finding, last))
    return last


def _readable(trace: McapTrace) -> Iterator[TraceMessage]:
    """The messages up to where the recording is damaged: the audit has told of that already."""
    try:
        yield from trace
    except InputError:
        return


def _beside(event: MmsEvent, copy: TraceWriter) -> None:
    """The event as JSON; the robot's state where the message shows one."""
    told = {
        k: v for k, v in asdict(event).items() if k not in _SHOWN | {"time", "vmd"} and v not in (None, "")
    }
    copy.add(event.time, Channel(f"/{event.vmd}/mmsverify/events", "json", EVENT), _json(told))
    if event.robot_state:
        shown: dict[str, Any] = {k: v for k, v in asdict(event).items() if k in _SHOWN}
        shown["robot_state_number"] = ROBOT_STATE.index(event.robot_state)
        copy.add(event.time, Channel(f"/{event.vmd}/mmsverify/state", "json", STATE), _json(shown))


def _log(vmd: str | None) -> Channel:
    return Channel(f"/{vmd or 'recording'}/mmsverify/violations", "json", LOG)


def _entry(finding: Finding, time: int) -> bytes:
    seconds, rest = divmod(time, SECOND)
    cited = " ".join((*finding.clauses, *finding.readings))
    return _json(
        {
            "timestamp": {"sec": seconds, "nsec": rest},
            "level": LEVEL[finding.severity],
            "message": f"{finding.message} [{cited}]",
            "name": finding.rule,
            "file": finding.topic or finding.path,
            "line": finding.index or 0,
        }
    )


def _json(value: Mapping[str, Any]) -> bytes:
    return json.dumps(value, separators=(",", ":"), ensure_ascii=False).encode()
