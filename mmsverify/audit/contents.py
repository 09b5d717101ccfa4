"""What decodes and yet means nothing to a robot: numbers without a name, missing bits, foreign parts.

The grammar gives names to numbers and no bounds (asn1/README.md), so that such a message is read, and judged
here. Only the message itself is looked at; of a request, also what its answer says.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from mmsverify.audit import words
from mmsverify.audit.rules import Breach
from mmsverify.formats.companion import ADDITIONAL_SERVICES
from mmsverify.formats.mms import Pdu, robot_syntax
from mmsverify.model.rows import Clause

_ROBOT_STATE = Clause.of("R-7.3.2.1.2-3", "R-7.3.2.1.1.1-1")
_CONTROL = Clause.of("R-7.3.3.2.1.1-1", "R-7.3.3.2.4-1")
_BASE = Clause.of("R-7.3.4-3", "B-SYNTAX")
_BITS = {
    "robotSpecificStatus": Clause.of("R-7.3.2.1.1.2-1", "R-7.3.2.1.2-4"),
    "robotSpecificStatusMask": Clause.of("R-7.3.2.1.1.3-1", "R-7.3.2.1.2-4"),
}
STATUS_BITS = 4
_FOREIGN = frozenset({
    "defineEventCondition", "alterEventConditionMonitoring", "defineEventEnrollment", "alterEventEnrollment",
    "getEventConditionAttributes",
})  # fmt: skip
"""Services whose details are NULL for a robot and another companion standard's in the 2003 edition."""


def judge(pdu: Pdu, answers: Pdu | None = None, *, agreed: bool = False) -> Iterator[Breach]:
    """The breaches of one PDU of a robot's association; an answer comes with its request.

    ``agreed``: Initiate shows that both sides speak the robot's abstract syntax.
    """
    if pdu.kind == "confirmed-ErrorPDU":
        yield from _failed(pdu, answers)
    elif pdu.kind == "confirmed-RequestPDU":
        yield from _requested(pdu)
    elif pdu.service == "eventNotification":
        yield from _notified(pdu.body)
    elif pdu.kind in ("confirmed-ResponsePDU", "unconfirmed-PDU"):
        yield from _told(str(pdu.service), pdu.body, pdu.detail)
        if agreed and pdu.service == "identify":
            yield from _identified(pdu.body)
    if pdu.detail is not None and pdu.service in _FOREIGN:
        yield Breach("detail.foreign", {"service": words.title(str(pdu.service))})


def _requested(pdu: Pdu) -> Iterator[Breach]:
    if pdu.service == "createProgramInvocation" and pdu.detail is not None:
        yield from _unnamed("createProgramInvocation", "control", pdu.detail, _CONTROL, words.CONTROL)


def _told(service: str, body: Any, detail: Any) -> Iterator[Breach]:
    """A positive answer, or what is told unasked."""
    match service:
        case "status" | "unsolicitedStatus" | "vMDReset":
            yield from _status(service, body, detail)
        case "getProgramInvocationAttributes":
            yield from _unnamed(service, "state", body["state"], _BASE, words.STATE)


def _identified(body: Mapping[str, Any]) -> Iterator[Breach]:
    """Who lists abstract syntaxes and speaks the robot's should list that one, too."""
    listed = body.get("listOfAbstractSyntaxes")
    if listed and robot_syntax() not in listed:
        yield Breach("identify.syntax", {"listed": ", ".join(listed), "wanted": robot_syntax()})


def _status(service: str, body: Mapping[str, Any], detail: Mapping[str, Any] | None) -> Iterator[Breach]:
    for field, table in (("vmdLogicalStatus", words.LOGICAL), ("vmdPhysicalStatus", words.PHYSICAL)):
        yield from _unnamed(service, field, body[field], _BASE, table)
    if detail is None:
        return
    yield from _unnamed(service, "robotVMDState", detail["robotVMDState"], _ROBOT_STATE, words.ROBOT_STATE)
    for field, clause in _BITS.items():
        size = len(detail[field])
        if size < STATUS_BITS:
            said = {"service": words.title(service), "field": field, "size": size}
            yield Breach("status.bits", said, clause=clause)


def _unnamed(
    service: str, field: str, number: int, clause: Clause, table: tuple[str, ...]
) -> Iterator[Breach]:
    if words.word(table, number) is None:
        said = {"service": words.title(service), "field": field, "found": number}
        yield Breach("value.unnamed", said, clause=clause)


def _notified(body: Mapping[str, Any]) -> Iterator[Breach]:
    """What the event action came to is an answer, too (8.8)."""
    kind, result = (body.get("actionResult") or {}).get("eventActionResult", ("", None))
    if kind == "success":
        service, answer = result["response"]
        yield from _told(service, answer, result.get("detail"))


def _failed(pdu: Pdu, answers: Pdu | None) -> Iterator[Breach]:
    """A robot's own services tell nothing beside the error class (7.4.1.4)."""
    kind, information = pdu.body["serviceError"].get("serviceSpecificInformation", ("", None))
    service = answers.service if answers is not None else None
    if service in ADDITIONAL_SERVICES and kind == "additionalService" and information is not None:
        yield Breach("error.additional", {"service": words.title(service)})
