"""The composition root of annotated recordings: a recording and its audit in, a copy for viewers out.

Everything that was recorded is in the copy. Beside it stand, on channels of their own:

* ``/mmsverify/findings``: the findings, as ``foxglove.Log``;
* ``/mmsverify/state/<device>``: what was known of a device, each time that it changed;
* ``/mmsverify/decoded/...``: each message of MMS, Modbus and VR as flat JSON, under its own topic;

and the audit itself as the attachment ``mmsverify-report.json``, its verdict as the metadata record
``mmsverify.verdict``. What an earlier annotation added is not copied.

Viewers refuse a file with a message of log time 0 (no clock). Such messages, and nothing else, are put at
1 ns; their data and their time of publishing stay.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import mmsverify
from mmsverify.audit import decoded, words
from mmsverify.audit.decoded import INTEGER, SEVERAL, TEXT, UNKNOWN, enumeration, schema
from mmsverify.errors import InputError
from mmsverify.formats.locations import Location, Url
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.mcap_copy import Original, Recorded
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.trace import Channel, Schema
from mmsverify.incident import DeviceLine, Lane
from mmsverify.incidents import timeline
from mmsverify.report.audit_json import render
from mmsverify.report.order import ordered, tally
from mmsverify.results import Audit, Finding

__all__ = ["FINDINGS", "LOG", "REPORT", "VERDICT", "annotate"]

FINDINGS = "/mmsverify/findings"
STATE = "/mmsverify/state/"
DECODED = "/mmsverify/decoded"
REPORT, VERDICT = "mmsverify-report.json", "mmsverify.verdict"
ADDED = {"mmsverify": "added"}
"""The metadata of channels that are no part of the recording."""
EARLIEST = 1
"""The log time in ns of what has none."""
LEVEL = {"note": 2, "warning": 3, "error": 4}
"""The levels of ``foxglove.Log``: INFO, WARNING, ERROR."""
LEVELS = ("UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL")
SECOND = 1_000_000_000

_COUNT = {"type": "integer", "minimum": 0}
_TIME = {
    "type": "object", "title": "time", "required": ["sec", "nsec"],
    "properties": {"sec": _COUNT, "nsec": {**_COUNT, "maximum": SECOND - 1}},
}  # fmt: skip
LOG = schema(
    "foxglove.Log",
    {
        "timestamp": _TIME, "level": enumeration(LEVELS), "message": TEXT, "name": TEXT, "file": TEXT,
        "line": _COUNT,
    },
)  # fmt: skip
LANES = {
    "robot state": words.ROBOT_STATE,
    "logical status": words.LOGICAL,
    "physical status": words.PHYSICAL,
    "local control": ("FALSE", "TRUE"),
}
"""The lanes whose words have numbers in the standard. Those of programs have them as well."""
PROGRAM = "program "
COMMAND, NO_COMMAND = "command", "none"
"""The lane of which empty words say that there is none, and not that it is unknown."""


def annotate(
    path: Location,
    audit: Audit,
    out: Path,
    *,
    profile: Path | None = None,
    model: str | None = None,
    variant: str = "repaired",
) -> int:
    """Copy the recording at ``path`` to ``out``, with what the ``audit`` tells of it.

    ``profile``, ``model`` and ``variant`` are those of the audit. Everything is copied that can be read;
    raises ``InputError`` only where nothing can. A finding without a time of its own stands at the end. Gives
    back how many messages have been moved from log time 0 to 1 ns.
    """
    trace = read_trace(path)
    own = _own(audit, trace.path)
    states = _States(timeline(path, profile=profile, model=model, variant=variant))
    original = Original(trace)
    with TraceWriter(out, profile=original.profile) as copy:
        for name, pairs in original.metadata:
            if name != VERDICT:
                copy.add_metadata(name, pairs)
        writing = _Writing(copy, own, states)
        for recorded in _readable(original):
            writing.message(recorded)
        writing.end()
        original.define(copy)
        for each in original.attachments:
            if each.name != REPORT:
                copy.add_attachment(each.name, each.media_type, each.data, log=each.log, created=each.created)
        report, last = render(own).encode(), writing.last
        copy.add_attachment(REPORT, "application/json", report, log=last, created=last)
        copy.add_metadata(VERDICT, _verdict(own, path, profile, variant))
    return writing.shifted


def _own(audit: Audit, path: str) -> Audit:
    """What the audit tells of one recording; how long it took is not told: the copy is always the same."""
    inputs = [replace(entry, seconds=0.0) for entry in audit.inputs if entry.path == path]
    findings = [finding for finding in audit.findings if finding.path == path]
    return Audit(inputs, findings, [rest for rest in audit.withheld if rest.path == path])


def _readable(original: Original) -> Iterator[Recorded]:
    """The messages up to where the recording is damaged: the audit has told of that already."""
    try:
        for recorded in original.messages():
            if recorded.sealed.channel.metadata.get("mmsverify") != ADDED["mmsverify"]:
                yield recorded
    except InputError:
        return


def _verdict(audit: Audit, path: Location, profile: Path | None, variant: str) -> dict[str, str]:
    counts = tally(audit.findings, audit.withheld)
    told: dict[str, Any] = {"verdict": "violated" if counts["error"] else "conforms"}
    told |= {f"{severity}s": number for severity, number in counts.items()}
    for entry in audit.inputs:
        told |= {"messages": entry.messages, "events": entry.events, "skipped": entry.skipped}
        told["truncated"] = str(entry.truncated).lower()
    told |= {"variant": variant, "profile": profile or "", "report": REPORT}
    told["version"] = f"mmsverify {mmsverify.__version__}"
    if not isinstance(path, Url) and Path(path).is_file():
        with Path(path).open("rb") as file:
            told["sha256"] = hashlib.file_digest(file, "sha256").hexdigest()
    return {name: _utf8(str(value)) for name, value in told.items()}


class _Writing:
    """The copy while it is written, message by message, in event order."""

    def __init__(self, copy: TraceWriter, audit: Audit, states: _States) -> None:
        self._copy, self._states = copy, states
        self._decoder = decoded.Decoder()
        self._by_index: dict[int | None, list[Finding]] = {}
        for finding in ordered(audit.findings):
            self._by_index.setdefault(finding.index, []).append(finding)
        self._channels: dict[int, Channel] = {}
        self.last, self.shifted = EARLIEST, 0

    def message(self, recorded: Recorded) -> None:
        """A message of the recording, and what stands beside it."""
        message, (channel, number, sequence, publish) = recorded
        self.shifted += not message.time
        self.last = time = max(message.time, EARLIEST)
        copied = self._copy.register(channel, number)
        self._copy.add_copy(time, copied, message.data, publish=publish, sequence=sequence)
        told = self._decoder.decoded(message)
        if told is not None:
            kind, fields = told
            self._copy.add(time, self._beside(number, channel, kind), _json(fields))
        for beside, state in self._states.at(message.index):
            self._copy.add(time, beside, _json(state))
        for finding in self._by_index.pop(message.index, ()):
            self._log(finding)

    def end(self) -> None:
        """The findings that belong to no message that was read."""
        for findings in self._by_index.values():
            for finding in findings:
                self._log(finding)

    def _beside(self, number: int, channel: Channel, kind: Schema) -> Channel:
        known = self._channels.get(number)
        if known is None:
            known = self._channels[number] = Channel(DECODED + channel.topic, "json", kind, ADDED)
        return known

    def _log(self, finding: Finding) -> None:
        seconds, rest = divmod(self.last, SECOND)
        cited = " ".join((*finding.clauses, *finding.readings))
        entry = {
            "timestamp": {"sec": seconds, "nsec": rest},
            "level": LEVEL[finding.severity],
            "message": f"{finding.message} [{cited}]",
            "name": finding.rule,
            "file": finding.topic or finding.path,
            "line": finding.index or 0,
        }
        self._copy.add(self.last, Channel(FINDINGS, "json", LOG, ADDED), _json(entry))


# What was known of the devices.


@dataclass(slots=True)
class _Device:
    """A device's channel, its state as it is written, and the fields of its lanes with their tables."""

    channel: Channel
    state: dict[str, Any]
    fields: Mapping[str, tuple[str, tuple[str, ...]]]


class _States:
    """The changes of all devices by the index of the message that shows them, each one told once."""

    def __init__(self, devices: Sequence[DeviceLine]) -> None:
        self._changes: dict[int, dict[str, list[tuple[str, str]]]] = {}
        self._devices: dict[str, _Device] = {}
        for line in devices:
            if not line.lanes:
                continue
            # A robot and a controller may have one name: the second one's topic tells its model, too.
            name = line.device if line.device not in self._devices else f"{line.device}/{line.model}"
            self._devices[name] = _device(name, line)
            for lane in line.lanes:
                for change in lane.changes:
                    at = self._changes.setdefault(change.index, {})
                    at.setdefault(name, []).append((lane.name, change.words))

    def at(self, index: int) -> Iterator[tuple[Channel, Mapping[str, Any]]]:
        """The devices of which another thing is known from this message on, with all that is known."""
        for name, changes in self._changes.pop(index, {}).items():
            device = self._devices[name]
            device.state["index"] = index
            for lane, said in changes:
                field, table = device.fields[lane]
                device.state[field] = _words(lane, said)
                if table:
                    device.state[f"{field}_code"] = _code(table, said)
            yield device.channel, device.state


def _device(name: str, line: DeviceLine) -> _Device:
    fields: dict[str, tuple[str, tuple[str, ...]]] = {}
    properties: dict[str, Any] = {"index": INTEGER}
    state: dict[str, Any] = {"index": 0}
    for lane in line.lanes:
        field, table = _field(lane, properties), _table(lane)
        fields[lane.name] = field, table
        properties[field] = {**TEXT, "title": lane.name}
        state[field] = _words(lane.name, "")
        if table:
            properties[f"{field}_code"] = {**enumeration(table), "title": lane.name}
            state[f"{field}_code"] = UNKNOWN
    kind = schema(f"mmsverify.State.{name}", properties)
    return _Device(Channel(STATE + name, "json", kind, ADDED), state, fields)


def _field(lane: Lane, taken: Mapping[str, Any]) -> str:
    """A name that can stand in a viewer's message path, and no two lanes share."""
    plain = re.sub(r"[^A-Za-z0-9_]", "_", lane.name)
    name, number = plain, 1
    while name in taken or f"{name}_code" in taken:
        number += 1
        name = f"{plain}_{number}"
    return name


def _table(lane: Lane) -> tuple[str, ...]:
    return words.STATE if lane.name.startswith(PROGRAM) else LANES.get(lane.name, ())


def _words(lane: str, said: str) -> str:
    return said or (NO_COMMAND if lane == COMMAND else "unknown")


def _code(table: tuple[str, ...], said: str) -> int:
    return SEVERAL if " | " in said else decoded.code(table, said)


def _json(value: Mapping[str, Any]) -> bytes:
    # ASCII: a name that is no text, out of octets of a recording, is escaped rather than refused.
    return json.dumps(value, separators=(",", ":")).encode("ascii")


def _utf8(text: str) -> str:
    return text.encode("utf-8", "backslashreplace").decode("utf-8")
