"""A recording in the making: a clock that only the conversation moves, and associations that speak.

The clock is part of the script: the same script gives the same times.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, BinaryIO, Literal

from mmsverify.formats import vr
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.mms import Pdu, encode
from mmsverify.formats.trace import Channel, LinkEvent, Role, Sender
from mmsverify.samples import pdus

BEGIN = 1_767_592_800_000_000_000
"""2026-01-05T06:00:00Z, the early shift, in ns."""
MILLISECOND = 1_000_000
Sampling = Literal["scan", "polled"]


class Recording:
    """The messages of one robot or controller, in the order of their times."""

    def __init__(self, vmd: str) -> None:
        self.vmd = vmd
        self._time = BEGIN
        self._messages: list[tuple[int, Channel, bytes]] = []

    @classmethod
    def of(cls, name: str, recordings: Iterable[Recording]) -> Recording:
        """What several have heard, in the order of the times."""
        whole = cls(name)
        heard = [message for each in recordings for message in each.messages]
        whole._messages = sorted(heard, key=lambda message: message[0])
        return whole

    @property
    def count(self) -> int:
        """How many messages there are."""
        return len(self._messages)

    @property
    def messages(self) -> Sequence[tuple[int, Channel, bytes]]:
        """What was said so far: time in ns, channel, octets."""
        return self._messages

    def wait(self, seconds: float) -> None:
        """Nothing is said for a while."""
        self._time += round(seconds * 1000) * MILLISECOND

    def link(self, connection: str, event: LinkEvent, role: Role = "mms") -> None:
        """A connection opens, closes, is reset or has a gap."""
        said = json.dumps({"connection": connection, "event": event, "role": role})
        self._add(Channel.link(self.vmd), said.encode())

    def say(self, association: str, sender: Sender, pdu: Pdu) -> None:
        """One message; a client takes its time before it asks, a robot answers within some milliseconds."""
        self._takes_time(sender)
        self._add(Channel.mms(self.vmd, association, sender), encode(pdu))

    def send(self, connection: str, sender: Sender, adu: bytes) -> None:
        """One Modbus/TCP message."""
        self._takes_time(sender)
        self._add(Channel.modbus(self.vmd, connection, sender), adu)

    def _takes_time(self, sender: Sender) -> None:
        count = len(self._messages)
        self._time += (90 + 37 * count % 160 if sender == "client" else 4 + 7 * count % 19) * MILLISECOND

    def show(self, sampling: Sampling, cells: Mapping[str, float]) -> None:
        """One sample of the VR cells of a controller."""
        self._add(Channel.vr(self.vmd, sampling), vr.encode(cells))

    def _add(self, channel: Channel, data: bytes) -> None:
        self._messages.append((self._time, channel, data))

    def write(
        self, target: str | os.PathLike[str] | BinaryIO, profile: Mapping[str, str] | None = None
    ) -> None:
        """The recording as a trace file, with what it says of the robot where that is not the usual."""
        with TraceWriter(target) as trace:
            if profile:
                trace.add_profile(profile)
            for time, channel, data in self._messages:
                trace.add(time, channel, data)


class Association:
    """One association: requests with their answers, and what the robot tells unasked."""

    def __init__(self, recording: Recording, name: str) -> None:
        self.recording = recording
        self.name = name
        self._asked: dict[Sender, int] = {"client": 0, "server": 0}

    def open(
        self, offered: Mapping[Sender, tuple[str, ...]], additional: tuple[str, ...], outstanding: int
    ) -> None:
        """The connection is made, and Initiate agrees on what each side ``offered``."""
        self.recording.link(self.name, "open")
        self._say("client", pdus.initiation("Request", offered["client"], (), outstanding))
        self._say("server", pdus.initiation("Response", offered["server"], additional, outstanding))

    def close(self) -> None:
        """Conclude, and the end of the connection."""
        self._say("client", Pdu("conclude-RequestPDU"))
        self._say("server", Pdu("conclude-ResponsePDU"))
        self.recording.wait(0.02)
        self.recording.link(self.name, "close")

    def ask(self, service: str, body: Any = None, detail: Any = None) -> int:
        """A request of the client; its invokeID is handed back for the answer."""
        return self._ask("client", service, body, detail)

    def answer(self, invoke_id: int, service: str, body: Any = None, detail: Any = None) -> None:
        """The robot's positive answer."""
        self._say("server", pdus.response(invoke_id, service, body, detail))

    def refuse(self, invoke_id: int, cause: tuple[str, str], info: tuple[str, str] | None = None) -> None:
        """The robot's negative answer."""
        self._say("server", pdus.failure(invoke_id, cause, info))

    def call(
        self, service: str, body: Any = None, detail: Any = None, *, gives: Any = None, extra: Any = None
    ) -> None:
        """A request and its positive answer: ``gives`` the result, ``extra`` the robot's part of it."""
        self.answer(self.ask(service, body, detail), service, gives, extra)

    def serve(self, service: str, body: Any = None, *, gives: Any = None) -> None:
        """A request of the robot and the client's positive answer."""
        asked = self._ask("server", service, body, None)
        self._say("client", pdus.response(asked, service, gives))

    def tell(self, service: str, body: Any, detail: Any = None) -> None:
        """The robot says something unasked."""
        self._say("server", Pdu("unconfirmed-PDU", None, service, body, detail))

    def _ask(self, side: Sender, service: str, body: Any, detail: Any) -> int:
        self._asked[side] += 1
        self._say(side, pdus.request(self._asked[side], service, body, detail))
        return self._asked[side]

    def _say(self, sender: Sender, pdu: Pdu) -> None:
        self.recording.say(self.name, sender, pdu)
