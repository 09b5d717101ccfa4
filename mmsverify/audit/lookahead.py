"""What a first look over a recording tells, before any of it is judged: who is no robot, and what is missing.

Where a recording begins in mid-operation or has a gap, requests may wait that it does not show. Such a
request may be performed at any instant until its answer; until the last of these answers, nothing is known
of the robot's state (RP-31). Only requests that may change it matter.
"""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from mmsverify.audit.exchange import ANSWERS, OTHER_SIDE
from mmsverify.audit.negotiation import ADDITIONAL
from mmsverify.errors import DecodeError, InputError
from mmsverify.formats import mms
from mmsverify.formats.mcap import McapTrace
from mmsverify.formats.mms import Pdu
from mmsverify.formats.trace import Channel, TraceMessage

INITIATES = (b"\xa8", b"\xa9")
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

    Their Initiate shows no additional services, and no robot detail follows.
    """

    def __init__(self, trace: McapTrace) -> None:
        self._begun: dict[Key, bool] = {}
        self._requests: dict[Key, _Requests] = defaultdict(_Requests)
        self._blind: dict[Key, list[Span]] = defaultdict(list)
        with suppress(InputError):  # what cannot be read on is told when it is judged
            self._look(trace)
        self.base_only = frozenset(key for key, robot in self._begun.items() if not robot)

    def _look(self, trace: McapTrace) -> None:
        """Look at all messages; of an association of which all is known, at those of Initiate only."""
        index = -1
        keys: dict[int, tuple[Channel, Key | None]] = {}
        settled: set[Key | None] = set()
        for batch in trace.batches():
            for time, _, channel, data in batch:
                index += 1
                known = keys.get(id(channel))
                if known is None:
                    known = keys[id(channel)] = channel, _association(channel)
                key = known[1]
                if key in settled and data[:1] not in INITIATES:
                    continue
                message = TraceMessage(index, time, channel, data)
                if key is None:
                    self._linked(message, settled)
                    continue
                self._heard(key, message)
                if self._settled(key):
                    settled.add(key)
                else:
                    settled.discard(key)

    def _settled(self, key: Key) -> bool:
        """Whether no message but Initiate and links can tell anything new."""
        return self._requests[key].since is None and self._begun.get(key, True)

    def _linked(self, message: TraceMessage, settled: set[Key | None]) -> None:
        if (happened := link(message)) is not None:
            key = message.metadata.get("name", ""), happened[0]
            self._requests[key].begin(message.index if happened[1] == "gap" else None)
            settled.discard(key)

    def blind(self, vmd: str) -> list[Span]:
        """Where requests to that device may be waiting that the recording does not show."""
        spans = [(k, s) for k, found in self._blind.items() for s in found]
        return sorted(span for key, span in spans if key[0] == vmd and key not in self.base_only)

    def _heard(self, key: Key, message: TraceMessage) -> None:
        requests = self._requests[key]
        if message.data[:1] in INITIATES:
            self._begun[key] = self._begun.get(key, False) or _offers_additional(message.data)
            requests.begin(None)
            return
        if key in self._begun and not self._begun[key] and _may_have_detail(message.data):
            self._begun[key] = _has_detail(message.data)
        if requests.hears():
            for pdu in _decoded(message.data):
                if requests.answers_unseen(message.metadata.get("sender", "client"), pdu):
                    self._blind[key].append((requests.since or 0, message.index))


def _association(channel: Channel) -> Key | None:
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


def _offers_additional(octets: bytes) -> bool:
    for pdu in _decoded(octets):
        body: Mapping[str, Any] = pdu.body
        details = (body.get("initRequestDetail"), body.get("initResponseDetail"))
        return any(d and any(key.startswith("additionalSupported") for key in d) for d in details)
    return True


def _may_have_detail(octets: bytes) -> bool:
    return b"\xbf\x4f" in octets or b"\xbf\x4e" in octets


def _has_detail(octets: bytes) -> bool:
    return any(pdu.detail is not None or pdu.service in ADDITIONAL for pdu in _decoded(octets))
