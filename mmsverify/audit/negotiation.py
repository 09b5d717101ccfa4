"""What Initiate agrees, and what follows from it: which services are listed, and why they are rejected."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from mmsverify.audit.rules import Breach
from mmsverify.audit.words import title
from mmsverify.formats.mms import Pdu, bits, named

ADDITIONAL = frozenset({"vMDStop", "vMDReset", "select", "alterPI"})
ALTER = "alterProgramInvocationAttributes"
WITH_DETAIL = frozenset({"status", "unsolicitedStatus", "getProgramInvocationAttributes"})
"""Services of which the robot standard extends the answer, or the message itself."""
EXTENDED = WITH_DETAIL | {"createProgramInvocation", "start", "resume", "vMDReset"}
"""Services that the robot standard extends at all."""
FIRST_EDITION = 11
"""The robot standard's own parameter CBBs fill so many bits; a longer string is the 2003 edition's."""
UNRECOGNIZED, INVALID_INVOKE, EXCEEDED = 1, 3, 6
MODIFIER = frozenset({2, 5})


@dataclass(slots=True)
class Negotiated:
    """What Initiate agreed.

    ``outstanding`` counts requests by requesting side; ``services`` and ``additional`` are by answering side.
    ``robot``: the robot standard is agreed, and in its own edition.
    """

    outstanding: dict[str, int] = field(default_factory=dict)
    services: dict[str, frozenset[str]] = field(default_factory=dict)
    additional: dict[str, frozenset[str]] = field(default_factory=dict)
    robot: bool = False
    first_edition: bool = False

    def listed(self, side: str, service: str) -> bool | None:
        """Whether that side says that it performs the service; ``None`` where it says nothing about it."""
        table = self.additional if service in ADDITIONAL else self.services
        return service in table[side] if side in table else None


def negotiated(body: Mapping[str, Any], calling: Mapping[str, Any] | None) -> Negotiated:
    """What the response to Initiate agrees, with the detail of the request."""
    called = body.get("initResponseDetail", {})
    found = Negotiated(
        outstanding={
            "client": body["negotiatedMaxServOutstandingCalling"],
            "server": body["negotiatedMaxServOutstandingCalled"],
        },
        robot="additionalSupportedCalled" in called,
        first_edition=len(called.get("negotiatedParameterCBB", "")) <= FIRST_EDITION,
    )
    for side, detail, suffix in (("server", called, "Called"), ("client", calling or {}, "Calling")):
        if f"servicesSupported{suffix}" in detail:
            found.services[side] = bits("ServiceSupportOptions", detail[f"servicesSupported{suffix}"])
        if f"additionalSupported{suffix}" in detail:
            listed = bits("AdditionalSupportOptions", detail[f"additionalSupported{suffix}"])
            found.additional[side] = frozenset("alterPI" if bit == ALTER else bit for bit in listed)
    return found


# Initiate.


def proposed(body: Mapping[str, Any]) -> Iterator[Breach]:
    """An Initiate request by itself."""
    version = body.get("initRequestDetail", {}).get("proposedVersionNumber", 1)
    if version < 1:
        yield Breach("negotiation.proposed-version", {"proposed": version})


def agreed(request: Mapping[str, Any] | None, body: Mapping[str, Any]) -> Iterator[Breach]:
    """An Initiate response: it may only reduce what was proposed."""
    calling = (request or {}).get("initRequestDetail", {})
    called = body.get("initResponseDetail", {})
    yield from _version(calling, called)
    if request is None:
        return
    yield from _counts(request, body)
    if "additionalSupportedCalled" in called and "additionalSupportedCalling" not in calling:
        yield Breach("negotiation.syntax")
    added = _bits(called, "negotiatedParameterCBB") - _bits(calling, "proposedParameterCBB")
    if added:
        yield Breach("negotiation.parameters", {"added": ", ".join(sorted(added))})


def _bits(detail: Mapping[str, Any], name: str) -> frozenset[str]:
    return bits("ParameterSupportOptions", detail.get(name, ""))


def _version(calling: Mapping[str, Any], called: Mapping[str, Any]) -> Iterator[Breach]:
    wanted, given = calling.get("proposedVersionNumber"), called.get("negotiatedVersionNumber", 1)
    if given < 1 or (wanted is not None and wanted >= 1 and given > wanted):
        words = {"negotiated": given, "proposed": "any" if wanted is None else wanted}
        yield Breach("negotiation.version", words)


def _counts(request: Mapping[str, Any], body: Mapping[str, Any]) -> Iterator[Breach]:
    for word in ("Calling", "Called"):
        wanted = request[f"proposedMaxServOutstanding{word}"]
        given = body[f"negotiatedMaxServOutstanding{word}"]
        if given > wanted:
            yield Breach("negotiation.outstanding", {"negotiated": given, "proposed": wanted})
    wanted = request.get("proposedDataStructureNestingLevel")
    given = body.get("negotiatedDataStructureNestingLevel")
    if wanted is not None and given is not None and given > wanted:
        yield Breach("negotiation.nesting", {"negotiated": given, "proposed": wanted})


# What follows.


@dataclass(frozen=True, slots=True)
class Rejectable:
    """What a request gives a peer to reject: ``None`` where the recording does not tell.

    ``reused``: its invokeID was in use; ``excess``: more requests were outstanding than agreed.
    """

    pdu: Pdu
    index: int
    reused: bool | None
    excess: bool | None


def answered(agreed: Negotiated, side: str, asked: Rejectable, pdu: Pdu) -> Iterator[Breach]:
    """An answer of ``side`` against what it had listed."""
    service = str(asked.pdu.service)
    listed = agreed.listed(side, service)
    words = {"service": title(service), "side": side}
    if listed is None:
        return
    if pdu.kind == "confirmed-ResponsePDU" and not listed:
        rule = "negotiation.additional" if service in ADDITIONAL else "negotiation.service"
        yield Breach(rule, words, (asked.index,))
    elif pdu.kind == "confirmed-ErrorPDU" and not listed:
        yield Breach("negotiation.refused", words, (asked.index,))
    elif pdu.kind == "rejectPDU":
        yield from _rejected(words, asked, pdu, listed=listed)


def _rejected(words: Mapping[str, Any], asked: Rejectable, pdu: Pdu, *, listed: bool) -> Iterator[Breach]:
    kind, reason = pdu.body["rejectReason"]
    if kind != "confirmed-request":
        return
    said = {**words, "reason": named("RejectConfirmedRequest", reason)}
    if not listed and reason != UNRECOGNIZED:
        yield Breach("negotiation.reject-reason", said, (asked.index,))
    elif listed and reason == UNRECOGNIZED:
        yield Breach("negotiation.rejected", words, (asked.index,))
    elif listed:
        why = _unfounded(asked, reason)
        if why:
            yield Breach("negotiation.reject-unfounded", {**said, "why": why}, (asked.index,))


def _unfounded(asked: Rejectable, reason: int) -> str:
    """Why the protocol error that a Reject tells of is none; nothing where it may be one."""
    if reason == INVALID_INVOKE and asked.reused is False:
        return "its invokeID was free"
    if reason == EXCEEDED and asked.excess is False:
        return "no more requests were outstanding than agreed"
    if reason in MODIFIER and not asked.pdu.modifiers:
        return "it had no modifier"
    return ""


def uses_robot_syntax(pdu: Pdu) -> bool:
    """Whether a message is one that only the robot standard has."""
    return pdu.service in ADDITIONAL or (pdu.service in EXTENDED and pdu.detail is not None)


def lacks_detail(agreed: Negotiated, pdu: Pdu) -> bool:
    """Whether the robot's part of a message is missing, which only the 2003 edition allows."""
    shows = pdu.kind in ("confirmed-ResponsePDU", "unconfirmed-PDU") and pdu.service in WITH_DETAIL
    return agreed.robot and agreed.first_edition and shows and pdu.detail is None
