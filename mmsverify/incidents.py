"""The composition root of reports: a recording and its findings in, what a reader needs to see of it out.

The recording is replayed once more, watched, and read once more for what was said around the findings.
"""

from __future__ import annotations

import hashlib
from bisect import bisect_left
from collections import defaultdict, deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

from mmsverify.audit.parts import FRAMEWORK, ROBOT, SIGNALS
from mmsverify.audit.replay import Replay
from mmsverify.audit.saying import Reader
from mmsverify.audit.spoken import Listener
from mmsverify.audit.whose import Place, whose
from mmsverify.errors import InputError
from mmsverify.explaining import explain_findings
from mmsverify.formats.locations import Location, located
from mmsverify.formats.mcap import McapTrace, read_trace
from mmsverify.formats.trace import TraceMessage
from mmsverify.incident import SERVER, Change, DeviceLine, Dossier, Incident, Lane, Origin, Saying
from mmsverify.model.load import find
from mmsverify.profiles import for_recording, within_framework
from mmsverify.register.readings import read_readings
from mmsverify.register.statements import read_statements
from mmsverify.resources import models_dir
from mmsverify.results import Account, Audit, Finding

__all__ = ["dossier", "reconstruct", "statements", "timeline"]

REPORTED = "robot state, reported"
REPORTING = frozenset({b"\xa1", b"\xa3"})
"""What the PDUs begin with that a robot's status comes in: a response, and what nobody has asked for."""
BEFORE, AFTER = 8, 3
"""So many messages of the device before that of a finding, and after it, are shown."""
MOST_EXPLAINED, MOST_ACCOUNTS = 8, 40
"""Findings of one recording, and of an audit, of which it is found out why they stand: that takes seconds."""
MOST_WINDOWS = 400
"""Findings of one recording whose surroundings are kept."""
NOBODY: Place = ("", "")
"""Whose the messages are that no model knows."""
Kept = tuple[Place, int, TraceMessage]
"""A message with its device, and the number that it has among that device's messages."""


def reconstruct(
    path: str | Path | Location,
    findings: Sequence[Finding],
    *,
    profile: Path | None = None,
    model: str | None = None,
    variant: str = "repaired",
) -> Incident:
    """What there is to be seen of one recording, around those of the ``findings`` that are its own.

    Raises ``InputError`` where the recording cannot be read at all, ``ProfileError`` for a bad profile.
    """
    location = located(path)
    trace = read_trace(location)
    own = [found for found in findings if found.path == trace.path]
    surroundings = Surroundings(_centres(own))
    devices = _devices(trace, profile, model, variant, surroundings)
    return Incident(_origin(trace), devices, surroundings.sayings, surroundings.windows)


def timeline(
    path: str | Path | Location,
    *,
    profile: Path | None = None,
    model: str | None = None,
    variant: str = "repaired",
) -> list[DeviceLine]:
    """What is known of each device of a recording, from message to message."""
    return _devices(read_trace(located(path)), profile, model, variant, Surroundings([]))


def dossier(
    audit: Audit,
    *,
    profile: Path | None = None,
    model: str | None = None,
    variant: str = "repaired",
) -> Dossier:
    """What a report shows beside an audit, which was made with this profile, model and variant.

    Of a recording that cannot be read any more there is nothing to show; its findings stand.
    """
    incidents: dict[str, Incident] = {}
    by_path: dict[str, list[Finding]] = {}
    for found in audit.findings:
        by_path.setdefault(found.path, []).append(found)
    for entry in audit.inputs:
        own = by_path.get(entry.path, [])
        with suppress(InputError):
            incidents[entry.path] = reconstruct(
                entry.path, own, profile=profile, model=model, variant=variant
            )
    models = sorted({device.model for each in incidents.values() for device in each.devices} - {""})
    judged = [("model", ", ".join(models)), ("variant", variant)]
    judged.append(("profile", str(profile) if profile else "what each recording says of itself"))
    accounts = _accounts({path: by_path.get(path, []) for path in incidents}, profile, variant)
    return Dossier(incidents, statements(audit), judged, accounts)


def _accounts(
    by_path: Mapping[str, Sequence[Finding]], profile: Path | None, variant: str
) -> dict[tuple[str, int | None, str], Account]:
    """Why the first findings of each recording stand: of each rule and device the first."""
    told: dict[tuple[str, int | None, str], Account] = {}
    for path, findings in by_path.items():
        own = sorted(findings, key=lambda found: found.index or 0)
        first = {(found.vmd, found.rule): found for found in reversed(own) if found.index is not None}
        some = sorted(first.values(), key=lambda found: found.index or 0)[:MOST_EXPLAINED]
        try:
            accounts = explain_findings(path, some, profile=profile, variant=variant) if some else []
        except Exception:  # an account is an addition: whatever is wrong with one, the report must be had
            accounts = []
        told |= {(a.finding.path, a.finding.index, a.finding.rule): a for a in accounts}
        if len(told) >= MOST_ACCOUNTS:
            break
    return told


def statements(audit: Audit, models: Sequence[str] = (ROBOT, FRAMEWORK, SIGNALS)) -> dict[str, str]:
    """What the statements of these models, and readings, say that the findings cite, by id."""
    cited = {each for found in audit.findings for each in (*found.clauses, *found.readings)}
    said = dict(read_readings())
    for model in models:
        said |= {each.id: each.says for each in read_statements(find(model, models_dir())).values()}
    return {each: said[each] for each in sorted(cited & said.keys())}


# What is known from message to message.


@dataclass(slots=True)
class Watched:
    """A watch over all devices: what is known of each, kept where it changes."""

    lanes: dict[Place, dict[str, list[Change]]] = field(default_factory=dict)

    def begin(self) -> None:
        """All begins again."""
        self.lanes.clear()

    def of(self, device: str, model: str) -> partial[None]:
        """Who takes down what is known of one device."""
        return partial(_take_down, self.lanes.setdefault((device, model), {}))


def _take_down(lanes: dict[str, list[Change]], index: int, time: int, shows: Mapping[str, str]) -> None:
    for name, words in shows.items():
        changes = lanes.setdefault(name, [])
        if (changes[-1].words if changes else "") != words:
            changes.append(Change(index, time, words))


@dataclass(slots=True)
class Span:
    """The messages of one device: how many, the times in ns of the first and the last, its links' events."""

    begin: int
    end: int = 0
    messages: int = 0
    links: list[Change] = field(default_factory=list)
    reported: list[Change] = field(default_factory=list)

    def report(self, message: TraceMessage) -> None:
        """Take down the robot state that a message reports, whatever is thought of it."""
        event = Listener().event(message)
        if (
            event.sender == SERVER
            and event.robot_state
            and (self.reported[-1].words if self.reported else "") != event.robot_state
        ):
            self.reported.append(Change(message.index, message.time, event.robot_state))


def _devices(
    trace: McapTrace, profile: Path | None, model: str | None, variant: str, surroundings: Surroundings
) -> list[DeviceLine]:
    tables = within_framework(for_recording(profile, trace.profile, trace.path))
    watched = Watched()
    try:
        for _ in Replay(trace, tables, model, variant, watch=watched).run():
            pass
    except InputError:
        pass  # the audit has told of it; what was read until then is shown
    spans = _spans(trace, surroundings)
    return [
        _line(place, span, watched.lanes.get(place, {}), judged=model in (None, place[1]))
        for place, span in spans.items()
        if place[1]
    ]


def _line(place: Place, span: Span, lanes: Mapping[str, list[Change]], *, judged: bool) -> DeviceLine:
    reported = {REPORTED: span.reported, **lanes}
    shown = [Lane(name, tuple(changes)) for name, changes in reported.items() if changes]
    name, model = place
    return DeviceLine(
        name, model if judged else "", span.begin, span.end, span.messages, shown, tuple(span.links)
    )


def _spans(trace: McapTrace, surroundings: Surroundings) -> dict[Place, Span]:
    """When each device was heard; on the way, what was said around the findings is taken down."""
    spans: dict[Place, Span] = {}
    for message in _readable(trace):
        place = whose(message) or NOBODY
        span = spans.get(place)
        if span is None:
            span = spans[place] = Span(message.time)
        span.end = message.time
        span.messages += 1
        if message.data[:1] in REPORTING and message.message_encoding == "mms-ber":
            span.report(message)
        surroundings.pass_by(place, message, span)
    surroundings.end()
    return spans


def _readable(trace: McapTrace) -> Iterator[TraceMessage]:
    """The messages up to where the recording is damaged: the audit has told of that already."""
    try:
        yield from trace
    except InputError:
        return


# What was said around the findings.


def _centres(findings: Iterable[Finding]) -> list[tuple[int, tuple[int, ...]]]:
    """The indices of the messages with findings, each with those that are related: the first so many."""
    related: dict[int, set[int]] = defaultdict(set)
    for found in findings:
        if found.index is not None:
            related[found.index].update(found.related)
    return [(index, tuple(sorted(related[index]))) for index in sorted(related)[:MOST_WINDOWS]]


class Surroundings:
    """Takes down the messages around some, while all of them pass by in order."""

    def __init__(self, centres: Sequence[tuple[int, tuple[int, ...]]]) -> None:
        self.sayings: dict[int, Saying] = {}
        self.windows: dict[int, list[int]] = {index: [] for index, _ in centres}
        self._related = dict(centres)
        self._alone = sorted({other for _, related in centres for other in related})
        self._lately: dict[Place, deque[Kept]] = {}
        self._open: dict[Place, list[int]] = {}
        self._kept: dict[int, Kept] = {}

    def pass_by(self, device: Place, message: TraceMessage, span: Span) -> None:
        """The next message, of that device."""
        if message.schema_name == "link.Event":
            said = Reader().saying(message)
            what = said.title.removeprefix("link: ")
            span.links.append(Change(message.index, message.time, f"{what} {said.partner}"))
        if not self.windows:
            return
        lately = self._lately.setdefault(device, deque(maxlen=BEFORE + 1))
        waiting = self._open.setdefault(device, [])
        kept = device, span.messages, message
        lately.append(kept)
        index, follows = message.index, bool(waiting)
        for centre in list(waiting):
            self.windows[centre].append(index)
            if sum(later > centre for later in self.windows[centre]) >= AFTER:
                waiting.remove(centre)
        if index in self.windows:
            self.windows[index] = [each.index for _, _, each in lately]
            self._kept |= {each.index: (device, number, each) for _, number, each in lately}
            waiting.append(index)
        elif follows or self._is_related(index):
            self._kept[index] = kept

    def _is_related(self, index: int) -> bool:
        at = bisect_left(self._alone, index)
        return at < len(self._alone) and self._alone[at] == index

    def end(self) -> None:
        """All have passed: put what was kept in words."""
        readers: dict[Place, tuple[int, Reader]] = {}
        for index, (device, number, message) in sorted(self._kept.items()):
            last, reader = readers.get(device, (0, Reader()))
            if number != last + 1:  # of messages in between, nobody knows which answers are whose
                reader = Reader()
            readers[device] = number, reader
            self.sayings[index] = replace(reader.saying(message), number=number)
        for centre, window in self.windows.items():
            known = [index for index in self._related[centre] if index in self.sayings]
            window[:] = sorted({*window, *known})


def _origin(trace: McapTrace) -> Origin:
    path = Path(trace.path)
    if not path.is_file():
        return Origin(trace.path, trace.octets, "")
    with path.open("rb") as file:
        digest = hashlib.file_digest(file, "sha256").hexdigest()
    return Origin(trace.path, path.stat().st_size, digest)
