"""A recording as a list until it is written: it can be mixed with another, cut off, begun in the middle."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.mms import Pdu, encode
from mmsverify.formats.trace import Channel, LinkEvent, Sender

BEGIN, PAUSE = 1_764_100_000_000_000_000, 7_000_000


@dataclass(frozen=True)
class Said:
    """One message on a channel; ``pdu`` is what it means, if anything."""

    channel: Channel
    octets: bytes
    pdu: Pdu | None = None


@dataclass
class Tape:
    """The messages of one robot, in order; ``faults`` are the places where something is wrong."""

    vmd: str = "cell"
    messages: list[Said] = field(default_factory=list)
    faults: list[int] = field(default_factory=list)

    def say(self, association: str, sender: Sender, pdu: Pdu, octets: bytes | None = None) -> int:
        """Add a message; its index comes back. ``octets`` replace what it would be encoded as."""
        channel = Channel.mms(self.vmd, association, sender)
        self.messages.append(Said(channel, encode(pdu) if octets is None else octets, pdu))
        return len(self.messages) - 1

    def link(self, association: str, event: LinkEvent) -> int:
        said = json.dumps({"connection": association, "event": event, "role": "mms"}).encode()
        self.messages.append(Said(Channel.link(self.vmd), said))
        return len(self.messages) - 1

    def wrong(self) -> None:
        """The last message is the fault."""
        self.faults.append(len(self.messages) - 1)


def write(path: Path, messages: Sequence[Said], profile: Mapping[str, str]) -> Path:
    """The messages as a trace file; what is unlike the default stands in its metadata."""
    with TraceWriter(path) as trace:
        trace.add_profile({"model": "mms-robot", **profile})
        for count, said in enumerate(messages):
            trace.add(BEGIN + count * PAUSE, said.channel, said.octets)
    return path
