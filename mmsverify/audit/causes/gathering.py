"""The messages around findings, device by device, in one pass over the recording.

Of a robot that is a stretch of its messages around each finding, with the Initiates of the associations that
are open where it begins; of a server or a controller, whose replay is quick, a long one. Stretches that
overlap are one.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from mmsverify.audit.lookahead import INITIATES, link
from mmsverify.audit.parts import ROBOT
from mmsverify.audit.whose import Place, whose
from mmsverify.formats.trace import TraceMessage
from mmsverify.results import Finding

AFTER, LONG_AFTER = 30, 130
LATE = frozenset({"event.missing", "protocol.unanswered"})
"""Rules that are told of a message only when others have gone by."""
ENDS = ("close", "reset")
LONGEST = 4000
"""Messages of a server or a controller before a finding that are kept."""


@dataclass(slots=True)
class Stretch:
    """Some messages of one device, and the findings among them. ``whole``: they begin with its first."""

    model: str
    device: str
    messages: list[TraceMessage]
    findings: list[Finding] = field(default_factory=list)
    left: int = 0
    whole: bool = False


@dataclass(slots=True)
class _Device:
    """What is kept of a device that goes by. ``initiates``: the last of each open association."""

    model: str
    lately: deque[TraceMessage]
    passed: int = 0
    initiates: dict[str, list[TraceMessage]] = field(default_factory=dict)
    open: Stretch | None = None


def gather(messages: Iterable[TraceMessage], findings: Sequence[Finding], before: int) -> Iterator[Stretch]:
    """The stretches around the findings, each with at least ``before`` messages before its findings."""
    wanted: dict[int, list[Finding]] = {}
    for finding in findings:
        if finding.index is not None:
            wanted.setdefault(finding.index, []).append(finding)
    names = {finding.vmd for finding in findings}
    devices: dict[Place, _Device] = {}
    last = max(wanted, default=-1)
    for message in messages:
        if message.index > last and all(device.open is None for device in devices.values()):
            break
        place = whose(message)
        if place is None or place[0] not in names:
            continue
        device = devices.get(place)
        if device is None:
            kept = deque[TraceMessage](maxlen=before + 1 if place[1] == ROBOT else LONGEST)
            device = devices[place] = _Device(place[1], kept)
        yield from _pass_by(device, place[0], message, wanted.get(message.index, []))
    for device in devices.values():
        if device.open is not None:
            yield device.open


def _pass_by(device: _Device, name: str, message: TraceMessage, found: list[Finding]) -> Iterator[Stretch]:
    device.lately.append(message)
    device.passed += 1
    stretch = device.open
    if stretch is not None:
        stretch.messages.append(message)
        stretch.left -= 1
    if found:
        if stretch is None:
            stretch = device.open = _opened(device, name)
        stretch.findings += found
        late = any(finding.rule in LATE for finding in found)
        stretch.left = max(stretch.left, LONG_AFTER if late else AFTER)
    elif stretch is not None and stretch.left <= 0:
        device.open = None
        yield stretch
    if device.model == ROBOT:
        _remember(device, message)


def _opened(device: _Device, name: str) -> Stretch:
    lately = list(device.lately)
    begin = lately[0].index
    agreed = [said for pair in device.initiates.values() for said in pair if said.index < begin]
    agreed.sort(key=lambda said: said.index)
    return Stretch(device.model, name, agreed + lately, whole=len(lately) == device.passed)


def _remember(device: _Device, message: TraceMessage) -> None:
    happened = link(message)
    if happened is not None and happened[1] in ENDS:
        device.initiates.pop(happened[0], None)
    elif message.data[:1] in INITIATES and happened is None:
        pair = device.initiates.setdefault(message.metadata.get("association", ""), [])
        pair[:] = [*pair[-1:], message]
