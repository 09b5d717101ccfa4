"""A message in one line: the service, whom it is about, how it was answered, what it shows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from mmsverify.audit import words
from mmsverify.formats.mms import Pdu

NAMES = ("programInvocationName", "programInvocation", "controlling", "domainName")
NO_PDU = "octets that are no PDU"


def brief(pdu: Pdu | None, asked: Pdu | None = None) -> str:
    """The message, and of an answer what was asked."""
    if pdu is None:
        return NO_PDU
    service = pdu.service or (asked.service if asked is not None else None)
    name = words.title(service) if service else pdu.kind.removesuffix("PDU").replace("-", " ").strip()
    about = _about(asked.body if asked is not None else pdu.body)
    head = f"{name} {about}" if about else name
    told = [*_answer(pdu, asked), *_shown(pdu)]
    return f"{head}: {', '.join(told)}" if told else head


def _about(body: Any) -> str:
    if isinstance(body, str):
        return body
    if not isinstance(body, Mapping):
        return ""
    return next((body[key] for key in NAMES if isinstance(body.get(key), str)), "")


def _answer(pdu: Pdu, asked: Pdu | None) -> Iterator[str]:
    if pdu.kind == "confirmed-RequestPDU":
        yield "request"
    elif asked is not None and pdu.kind in ANSWERED:
        yield ANSWERED[pdu.kind]


ANSWERED = {
    "confirmed-ResponsePDU": "result(+)",
    "confirmed-ErrorPDU": "result(-)",
    "rejectPDU": "reject",
}


def _shown(pdu: Pdu) -> Iterator[str]:
    """What it shows of the state."""
    if pdu.kind not in ("confirmed-ResponsePDU", "unconfirmed-PDU") or not isinstance(pdu.body, Mapping):
        return
    if pdu.service == "getProgramInvocationAttributes":
        state = words.word(words.STATE, pdu.body["state"])
        yield f"state {state or pdu.body['state']}"
        if isinstance(pdu.detail, Mapping) and "control" in pdu.detail:
            yield f"control {str(pdu.detail['control'][0]).upper()}"
    elif isinstance(pdu.detail, Mapping) and "robotVMDState" in pdu.detail:
        number = pdu.detail["robotVMDState"]
        yield words.word(words.ROBOT_STATE, number) or str(number)
        kind, name = pdu.detail["selectedProgramInvocation"]
        yield f"{name if kind == 'programInvocation' else 'none'} selected"
