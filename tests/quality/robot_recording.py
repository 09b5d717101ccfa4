"""What was said to a robot and by it, as a recording: MMS PDUs and link events."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.mms import Pdu, encode
from mmsverify.formats.trace import Channel, LinkEvent, Sender

VMD = "robot"
BEGIN, PAUSE = 1_764_000_000_000_000_000, 10_000_000


@dataclass(frozen=True, slots=True)
class Link:
    """An event of a connection."""

    connection: str
    event: LinkEvent


@dataclass(frozen=True, slots=True)
class Said:
    """A message on an association."""

    association: str
    sender: Sender
    pdu: Pdu


Message = Link | Said


def write(path: Path, profile: Mapping[str, str], spoken: Iterable[Message]) -> Path:
    """Messages as a recording of the device ``robot``."""
    with TraceWriter(path) as trace:
        trace.add_profile(profile)
        for number, message in enumerate(spoken):
            channel, data = _recorded(message)
            trace.add(BEGIN + number * PAUSE, channel, data)
    return path


def _recorded(message: Message) -> tuple[Channel, bytes]:
    if isinstance(message, Said):
        return Channel.mms(VMD, message.association, message.sender), encode(message.pdu)
    said = f'{{"connection": "{message.connection}", "event": "{message.event}", "role": "mms"}}'
    return Channel.link(VMD), said.encode()
