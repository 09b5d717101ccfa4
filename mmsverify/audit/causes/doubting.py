"""A robot of which some messages are not believed: what they say may be so or not.

To ask whether a message was needed for a finding, the message is doubted. That does not mean that it was not
there, for then a robot would have done nothing where it did something, and a finding could come of what was
left out. It means that nobody knows how the robot answered: the request may have been performed or refused at
any instant until its answer, and the robot may be as a message shows it or not. The states that are possible
then hold those that are possible with it, so whatever is excluded with messages in doubt is excluded the more
by the whole recording.

A request and its answer are doubted together. Of a request that is doubted the association takes no notice:
it occupies no invokeID, and does not count as outstanding.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from mmsverify.audit import robot, variables
from mmsverify.audit.device import Device
from mmsverify.audit.exchange import ANSWERS, OTHER_SIDE, Asked
from mmsverify.audit.learning.marks import marked
from mmsverify.audit.lookahead import link
from mmsverify.audit.notifications import ENROLLING
from mmsverify.audit.transfers import ASKED_BY_ROBOT, download, upload
from mmsverify.concrete.belief.several import distinct, widened
from mmsverify.errors import DecodeError
from mmsverify.formats import mms
from mmsverify.formats.mms import Pdu
from mmsverify.formats.trace import TraceMessage
from mmsverify.model.sorts import ElementSort
from mmsverify.results import Finding

MOST_STATES = 8
"""Doubt multiplies the states: above so many the nearest are joined, which only adds to what is possible."""
BEGINS_UPLOAD = "initiateUploadSequence"
OF_REQUESTS = ANSWERS | {"rejectPDU"}
"""The kinds of PDU that answer a request."""

Name = tuple[ElementSort, str]


class Doubtful(Device):
    """A device that is also told which messages not to believe."""

    def __init__(self, *args: Any, **named: Any) -> None:
        super().__init__(*args, **named)
        self._doubted: dict[tuple[str, str, int], Asked] = {}
        self._proposed: set[str] = set()

    def hear(self, message: TraceMessage, *, doubted: bool) -> Iterator[Finding]:
        """The findings of a message or a link event; one that is doubted has none."""
        happened = link(message)
        if happened is not None:
            yield from self.link(*happened, message)
            return
        pdu = _read(message)
        if pdu is None or not self._is_in_doubt(message, pdu, doubted):
            yield from self.message(message) if not doubted else ()
            return
        self.belief.listen()
        self._doubt(message, pdu)
        if _who(message)[0] not in self.base_only:
            self._notifications.doubt()
        if len(self.belief.states) > MOST_STATES:
            self.belief.states = widened(self.belief.states, MOST_STATES // 2)
        if any(first <= message.index <= last for first, last in self.blind):
            self._lose_sight()

    def names(self) -> Sequence[Name]:
        """The names that have been seen, with their sorts."""
        return [grown for grown in self.grown if len(grown) == 2]

    def _is_in_doubt(self, message: TraceMessage, pdu: Pdu, doubted: bool) -> bool:
        """Whether the message is doubted, or answers a request that is."""
        name, side = _who(message)
        if pdu.kind in OF_REQUESTS and pdu.invoke_id is not None:
            return (name, OTHER_SIDE.get(side, ""), pdu.invoke_id) in self._doubted or doubted
        if pdu.kind in ("initiate-ResponsePDU", "initiate-ErrorPDU"):
            return name in self._proposed or doubted
        return doubted

    def _doubt(self, message: TraceMessage, pdu: Pdu) -> None:
        name, side = _who(message)
        known = name not in self.base_only
        slot = f"{name}?{side}{pdu.invoke_id}"
        if pdu.kind == "confirmed-RequestPDU" and pdu.invoke_id is not None:
            asked = Asked(message.index, side, pdu, slot)
            self._doubted[name, side, pdu.invoke_id] = asked
            if known and side == "client":
                self._ask(name, asked)
        elif pdu.kind in OF_REQUESTS and pdu.invoke_id is not None:
            asked_for = self._doubted.pop((name, OTHER_SIDE.get(side, ""), pdu.invoke_id), None)
            if asked_for is not None and known:
                self._answer(name, asked_for, pdu, message)
        elif pdu.kind == "initiate-RequestPDU":
            self._proposed.add(name)
            self._drop(list(self._association(name).end()))
        elif pdu.kind in ("initiate-ResponsePDU", "initiate-ErrorPDU"):
            self._proposed.discard(name)
            if known:
                self.belief.indicate(slot, "initiate", {"user": name})
                self.belief.drop(slot)
        elif pdu.kind == "conclude-ResponsePDU":
            before = self.belief.states
            self._drop(self._association(name).end())
            self._notifications.ended(name)
            self._release(name)
            self.belief.states = distinct([*self.belief.states, *before])
        elif pdu.kind == "unconfirmed-PDU" and known and side == "server":
            self._perhaps(message, pdu, pdu, None)
            if pdu.service == "eventNotification":
                self._notifications.lose()  # what is not heard is not missing

    def _perhaps(self, message: TraceMessage, asked: Pdu, pdu: Pdu, request: Asked | None) -> None:
        """What a message shows may be so: with all that must have happened unseen, as it says it, or not."""
        before, closed = self.belief.states, self._acquaintance.closed
        for _ in self._shown(message, asked, pdu, request):
            pass
        self._acquaintance.closed = closed and self._acquaintance.closed
        self.belief.states = distinct([*before, *self.belief.states])

    def _shown(self, message: TraceMessage, asked: Pdu, pdu: Pdu, request: Asked | None) -> Iterator[object]:
        if pdu.kind not in ("confirmed-ResponsePDU", "unconfirmed-PDU") or pdu.service != asked.service:
            return
        slot = "" if request is None else request.slot
        match asked.service:
            case "status" | "unsolicitedStatus" | "vMDReset":
                yield from self._showing.status(pdu.body, pdu.detail, message)
            case "getProgramInvocationAttributes":
                yield from self._showing.attributes(asked.body, pdu, message, slot)
            case "getDomainAttributes" if request is not None:
                yield from self._transfers.attributes(request, pdu, message)
            case "read" | "informationReport":
                for name, data in robot.read_values(asked, pdu):
                    call = variables.shows(name, data)
                    yield self.belief.show(call.service, call.bindings) if call is not None else None

    def _ask(self, name: str, asked: Asked) -> None:
        """The request may be performed from now on."""
        for _ in self._performing.requested(name, asked):
            pass
        self._transfers.requested(name, asked)
        if asked.pdu.service in ENROLLING:
            self._notifications.lose()

    def _answer(self, name: str, asked: Asked, pdu: Pdu, message: TraceMessage) -> None:
        """It has been performed by now, or refused."""
        if asked.side == "client":
            self._transfers.forget(asked)
            if asked.pdu.service == BEGINS_UPLOAD and pdu.kind == "confirmed-ResponsePDU":
                bindings = {"request": asked.slot, "user": name, "panel": False}
                self.belief.indicate(asked.slot, BEGINS_UPLOAD, bindings | upload(name, asked.pdu, pdu))
            self.belief.drop(asked.slot)
            self._perhaps(message, asked.pdu, pdu, asked)
            if asked.pdu.service in ENROLLING:
                self._notifications.lose()
        elif asked.pdu.service in ASKED_BY_ROBOT:
            told = pdu.body if isinstance(pdu.body, dict) else {}
            bindings = {**download(name, asked.pdu), "more": told.get("moreFollows", False)}
            self.belief.indicate(asked.slot, str(asked.pdu.service), bindings)
            self.belief.drop(asked.slot)


def _read(message: TraceMessage) -> Pdu | None:
    """The PDU; ``None`` for octets that are none, which the device tells of."""
    try:
        return marked(mms.decode(message.data))
    except DecodeError:
        return None


def _who(message: TraceMessage) -> tuple[str, str]:
    return message.metadata.get("association", ""), message.metadata.get("sender", "client")
