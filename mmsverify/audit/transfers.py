"""Domains in messages: the robot's requests for segments, uploads, and what GetDomainAttributes shows.

In a download it is the robot that asks (A5.1): what its request needs of the state is judged when it asks,
what comes of it when the client answers. An upload is known by its ulsmID and its association together.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from mmsverify.audit import robot, words
from mmsverify.audit.exchange import Asked
from mmsverify.audit.robot import Call
from mmsverify.audit.telling import Telling
from mmsverify.concrete.belief import Belief
from mmsverify.formats.mms import Pdu
from mmsverify.formats.trace import TraceMessage
from mmsverify.model.rows import MINUS, PLUS
from mmsverify.results import Finding

UPLOADING = frozenset({"initiateUploadSequence", "uploadSegment", "terminateUploadSequence"})
ASKED_BY_ROBOT = frozenset({"downloadSegment", "terminateDownloadSequence"})


class Transfers:
    """The downloads and uploads of one device."""

    def __init__(self, belief: Belief, telling: Telling) -> None:
        self._belief = belief
        self._telling = telling
        self._beginning: dict[str, str] = {}

    def requested(self, association: str, asked: Asked) -> None:
        """A client asks for an upload, or for more of it; it may be performed at once, and answered later.

        An upload that is to begin has no number yet.
        """
        service = str(asked.pdu.service)
        if service == "initiateUploadSequence":
            self._beginning[asked.slot] = asked.pdu.body
            self._belief.watch(asked.slot)
        elif service in UPLOADING:
            upload = f"{association}#{asked.pdu.body}"
            bindings = {"request": asked.slot, "user": association, "upload": upload, "panel": False}
            self._belief.indicate(asked.slot, service, bindings)

    def forget(self, asked: Asked) -> None:
        """How the robot has answered one of these services is not known."""
        self._beginning.pop(asked.slot, None)

    def asked_by_robot(self, association: str, asked: Asked, message: TraceMessage) -> Iterator[Finding]:
        """A request of the robot: it says that a download is going on."""
        service = str(asked.pdu.service)
        if service in ASKED_BY_ROBOT:
            shown = self._belief.show(f"{service}Asked", download(association, asked.pdu))
            yield from self._telling.outcome(message, service, "", shown)

    def answered_by_client(self, association: str, asked: Asked, pdu: Pdu) -> None:
        """The client's answer to such a request: a segment has come, or none; the sequence has ended."""
        service = str(asked.pdu.service)
        if service not in ASKED_BY_ROBOT:
            return
        bindings = download(association, asked.pdu)
        if pdu.kind == "confirmed-ResponsePDU":
            if service == "downloadSegment":
                bindings["more"] = pdu.body["moreFollows"]
            self._belief.respond(asked.slot, service, bindings, PLUS)
        elif service == "downloadSegment":
            self._belief.respond(asked.slot, service, bindings, MINUS, local=True)

    def uploaded(self, association: str, asked: Asked, pdu: Pdu, message: TraceMessage) -> Iterator[Finding]:
        """The robot's answer to one of the three upload services."""
        service = str(asked.pdu.service)
        self._beginning.pop(asked.slot, None)
        accepted = pdu.kind == "confirmed-ResponsePDU"
        bindings = {"request": asked.slot, "user": association, **upload(association, asked.pdu, pdu)}
        answer = PLUS if accepted else MINUS
        local = pdu.kind == "rejectPDU" or (not accepted and robot.failure(pdu).local)
        if "upload" not in bindings:
            yield from self._not_begun(asked, message, local=local)
            return
        outcome = self._belief.respond(asked.slot, service, bindings, answer, local=local)
        yield from self._telling.outcome(message, service, answer, outcome, (asked.index,))

    def _not_begun(self, asked: Asked, message: TraceMessage, *, local: bool) -> Iterator[Finding]:
        """Refused, an upload has no number; it shows that the domain was not to be had."""
        if local or asked.pdu.body in self._beginning.values():
            self._belief.drop(asked.slot)
            return
        outcome = self._belief.show("uploadRefused", {"domain": asked.pdu.body}, asked.slot)
        yield from self._telling.outcome(message, "initiateUploadSequence", MINUS, outcome, (asked.index,))

    def attributes(self, asked: Asked, pdu: Pdu, message: TraceMessage) -> Iterator[Finding]:
        """The answer to GetDomainAttributes: nothing certain while an upload of the domain may just begin."""
        domain, answer = asked.pdu.body, ""
        if domain in self._beginning.values():
            self._belief.drop(asked.slot)
            return
        if pdu.kind == "confirmed-ResponsePDU":
            call = shown_of_domain(domain, pdu.body)
        elif pdu.kind == "confirmed-ErrorPDU" and robot.failure(pdu).unknown_object:
            call, answer = Call("noDomainAttributes", {"domain": domain}), MINUS
        else:
            self._belief.drop(asked.slot)
            return
        outcome = self._belief.show(call.service, call.bindings, asked.slot)
        yield from self._telling.outcome(message, "getDomainAttributes", answer, outcome)


def download(association: str, request: Pdu) -> dict[str, Any]:
    """What a request of the robot in a download is about, as the model takes it."""
    if request.service == "downloadSegment":
        return {"user": association, "domain": request.body}
    return {"user": association, "domain": request.body["domainName"], "discard": "discard" in request.body}


def upload(association: str, request: Pdu, answer: Pdu) -> dict[str, Any]:
    """What an answer in an upload is about, as the model takes it; one without a number has no ``upload``."""
    accepted = answer.kind == "confirmed-ResponsePDU"
    if request.service == "initiateUploadSequence":
        named = {"upload": f"{association}#{answer.body['ulsmID']}"} if accepted else {}
        return {"domain": request.body, **named}
    more = accepted and request.service == "uploadSegment" and answer.body["moreFollows"]
    return {"upload": f"{association}#{request.body}", "more": bool(more)}


def shown_of_domain(domain: str, body: Mapping[str, Any]) -> Call:
    """What GetDomainAttributes shows of ``domain``; the model names none of its transient states."""
    number = body["state"]
    word = words.word(words.DOMAIN_STATE, number)
    return Call("getDomainAttributes", {
        "domain": domain, "shown_domain": word or "READY", "transient": word is None,
        "shown_in_use": number == 3,
        "shown_deletable": body["mmsDeletable"], "shown_sharable": body["sharable"],
        "users": frozenset(body["listOfProgramInvocations"]), "shown_uploading": body["uploadInProgress"] > 0,
    })  # fmt: skip
