"""What a first look over a recording tells, before any of it is judged: who is no robot, and what is missing.

Where a recording begins in mid-operation or has a gap, requests may wait that it does not show. Such a
request may be performed at any instant until its answer; until the last of these answers, nothing is known
of the robot's state (RP-31). Only requests that may change it matter.
"""

from __future__ import annotations

import json
import struct
from collections import defaultdict
from collections.abc import Iterator, Mapping, Set
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from mmsverify.audit.exchange import ANSWERS, OTHER_SIDE
from mmsverify.audit.negotiation import ADDITIONAL
from mmsverify.errors import DecodeError, InputError
from mmsverify.formats import mcap_records as rec
from mmsverify.formats import mms
from mmsverify.formats.mcap import McapTrace
from mmsverify.formats.mms import Pdu
from mmsverify.formats.passing import Tick
from mmsverify.formats.stretch import Stretch
from mmsverify.formats.trace import Channel, TraceMessage

INITIATES = (b"\xa8", b"\xa9")
_INITIATES = frozenset(octet[0] for octet in INITIATES)
_HEAD = struct.Struct("<BQHIQQB")  # the head of a message record, and the first octet of a PDU
WAITS = 100
"""So many messages of its association may come before the answer to a request that is missing."""
INQUIRIES = ("get", "identify", "read", "report", "status")
"""So begin the names of the services that change nothing."""

Key = tuple[str, str]
"""A device and an association of it."""
Span = tuple[int, int]
"""Two indices of messages, both within."""


@dataclass
class _Requests:
    """The requests of one association; ``since``: from that index on, messages before it are missing.

    ``heard`` counts its messages from there.
    """

    since: int | None = 0
    shown: set[tuple[str, int]] = field(default_factory=set)
    heard: int = 0

    def begin(self, since: int | None) -> None:
        """A gap, or an association that the recording shows as a whole (``None``)."""
        self.since, self.heard = since, 0
        self.shown.clear()

    def hears(self) -> bool:
        """Whether one more message may be the answer to a request that is missing."""
        self.heard += 1
        if self.heard > WAITS:
            self.since = None
        return self.since is not None

    def answers_unseen(self, sender: str, pdu: Pdu) -> bool:
        """Whether it is the answer to a missing request that may have changed the robot's state.

        The invokeID of such a request has not been used since.
        """
        if pdu.invoke_id is None:
            return False
        if pdu.kind == "confirmed-RequestPDU":
            self.shown.add((sender, pdu.invoke_id))
            return False
        key = OTHER_SIDE[sender], pdu.invoke_id
        # An error does not say of which service, and one that fails may leave a transient state.
        asks_only = pdu.service is not None and pdu.service.startswith(INQUIRIES)
        return pdu.kind in ANSWERS and not asks_only and key not in self.shown


class Lookahead:
    """``base_only`` are the associations of devices that are no robots.

    Their Initiate shows no additional services, and no robot detail follows. ``tick`` is told how far it is.
    """

    def __init__(self, trace: McapTrace, *, merged: bool = False, tick: Tick | None = None) -> None:
        self._begun: dict[Key, bool] = {}
        self._requests: dict[Key, _Requests] = defaultdict(_Requests)
        self._blind: dict[Key, list[Span]] = defaultdict(list)
        with suppress(InputError):  # what cannot be read on is told when it is judged
            for stretch in trace.stretches(merged=merged):
                self._look(stretch)
                if tick is not None:
                    tick(stretch.octets(stretch.size), stretch.index + len(stretch.places))
        if tick is not None:
            tick.end()
        self.base_only = frozenset(key for key, robot in self._begun.items() if not robot)

    def _look(self, stretch: Stretch) -> None:
        """Look at all messages; of an association of which all is known, at those of Initiate only."""
        at, quiet = 0, set[int]()
        while at < stretch.size:
            at = _passed_by(stretch, at, quiet)
            if at < stretch.size:
                number = stretch.number(at)
                at, message = stretch.next(at)
                if message is None or self._begins(message):
                    quiet.clear()
                elif self._is_quiet(message):
                    quiet.add(number)

    def _begins(self, message: TraceMessage) -> bool:
        """Take a message in; whether more is to be looked at from here on than before."""
        key = association(message.channel)
        if key is None:
            return self._linked(message)
        self._heard(key, message)
        return message.data[:1] in INITIATES

    def _is_quiet(self, message: TraceMessage) -> bool:
        key = association(message.channel)
        return key is not None and self._settled(key)

    def _settled(self, key: Key) -> bool:
        """Whether no message but Initiate and links can tell anything new."""
        return self._requests[key].since is None and self._begun.get(key, True)

    def _linked(self, message: TraceMessage) -> bool:
        happened = link(message)
        if happened is not None:
            key = message.metadata.get("name", ""), happened[0]
            self._requests[key].begin(message.index if happened[1] == "gap" else None)
        return happened is not None

    def blind(self, vmd: str) -> list[Span]:
        """Where requests to that device may be waiting that the recording does not show."""
        spans = [(k, s) for k, found in self._blind.items() for s in found]
        return sorted(span for key, span in spans if key[0] == vmd and key not in self.base_only)

    def _heard(self, key: Key, message: TraceMessage) -> None:
        requests = self._requests[key]
        if message.data[:1] in INITIATES:
            self._begun[key] = self._begun.get(key, False) or offers_additional(message.data)
            requests.begin(None)
            return
        if key in self._begun and not self._begun[key] and _may_have_detail(message.data):
            self._begun[key] = _has_detail(message.data)
        if requests.hears():
            for pdu in _decoded(message.data):
                if requests.answers_unseen(message.metadata.get("sender", "client"), pdu):
                    self._blind[key].append((requests.since or 0, message.index))


def _passed_by(stretch: Stretch, at: int, quiet: Set[int]) -> int:
    """Pass the messages that tell nothing: the offset of the first that may tell something."""
    data, size, last, passed = stretch.data, stretch.size, stretch.last, stretch.places.append
    while at + _HEAD.size <= size:
        opcode, length, number, _, time, _, kind = _HEAD.unpack_from(data, at)
        end = at + rec.HEAD.size + length
        if number not in quiet or kind in _INITIATES or opcode != rec.MESSAGE or end > size or time < last:
            break
        last = time
        passed(at)
        at = end
    stretch.last = last
    return at


def association(channel: Channel) -> Key | None:
    """Whose messages stand on an MMS channel; ``None`` for any other channel."""
    if channel.message_encoding != "mms-ber":
        return None
    return channel.metadata.get("vmd", ""), channel.metadata.get("association", "")


def link(message: TraceMessage, wanted: str = "mms") -> tuple[str, str] | None:
    """The connection of a link and what happens to it; ``None`` where it is none of this role."""
    if message.schema_name != "link.Event":
        return None
    try:
        event = json.loads(message.data)
        connection, what, role = str(event["connection"]), str(event["event"]), event["role"]
    except (ValueError, KeyError, TypeError, RecursionError):
        return None
    return (connection, what) if role == wanted else None


def _decoded(octets: bytes) -> Iterator[Pdu]:
    """The PDU, if it is one: that it is none is told when the message is judged."""
    try:
        yield mms.decode(octets)
    except DecodeError:
        return


def offers_additional(octets: bytes) -> bool:
    """Whether an Initiate shows services of the companion standard; one that cannot be read may."""
    for pdu in _decoded(octets):
        body: Mapping[str, Any] = pdu.body
        details = (body.get("initRequestDetail"), body.get("initResponseDetail"))
        return any(d and any(key.startswith("additionalSupported") for key in d) for d in details)
    return True


def _may_have_detail(octets: bytes) -> bool:
    return b"\xbf\x4f" in octets or b"\xbf\x4e" in octets


def _has_detail(octets: bytes) -> bool:
    return any(pdu.detail is not None or pdu.service in ADDITIONAL for pdu in _decoded(octets))
