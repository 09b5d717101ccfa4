"""Other messages that might have been said: one message changed, one service put in or left out.

Candidates only, the nearest first; whether a conversation is legal with one of them is asked by telling it.
Octets are made by the codec, so that each candidate is one that a robot or its client could send.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

from mmsverify.audit import words
from mmsverify.audit.causes.brief import NAMES, brief
from mmsverify.audit.causes.conversation import SPREAD, Conversation, recorded
from mmsverify.formats import mms
from mmsverify.formats.mms import EncodeError, Pdu
from mmsverify.formats.trace import Channel, TraceMessage
from mmsverify.results import Finding

SILENT = {
    "start": None, "stop": None, "resume": None, "reset": None, "kill": None, "select": None, "alterPI": None,
    "createProgramInvocation": None, "deleteProgramInvocation": None, "relinquishControl": None,
    "takeControl": ("noResult", None), "initiateDownloadSequence": None, "deleteDomain": None,
    "vMDStop": None, "loadDomainContent": None, "storeDomainContent": None,
}  # fmt: skip
"""The positive answers of services that answer nothing but that they were performed."""
CONFLICT = ("service", 2)
"""Object state conflict: why a robot refuses what its state does not allow."""
UNRECOGNISED = ("confirmed-request", 1)
OTHER: Mapping[str, Literal["client", "server"]] = {"client": "server", "server": "client"}
SIDES = frozenset(OTHER)
MOST_NAMES = 4
MOST_CHANGED = 12
"""Values of earlier messages, or of one message, that are tried at most."""


@dataclass(frozen=True, slots=True)
class Edit:
    """The messages from position ``begin`` to before ``resume`` are replaced by ``said``.

    ``at`` is the position of the message that the edit is about; ``words`` say what is done.
    """

    kind: Literal["change", "insert", "drop"]
    at: int
    begin: int
    resume: int
    said: tuple[TraceMessage, ...]
    words: str


def changed(talk: Conversation, at: int, expected: Sequence[str]) -> Iterator[Edit]:
    """The message at a position, saying something else: another answer, or other values that it shows.

    ``expected``: what a finding says would have been legal, which is tried first.
    """
    pdu, request = talk.pdus[at], talk.request(at)
    if pdu is None:
        return
    asked = talk.pdus[request] if request is not None else None
    if asked is not None and asked.kind == "confirmed-RequestPDU":
        yield from _answered_otherwise(talk, at, pdu, asked, expected)
    others = [*_shown(pdu, expected), *_named(talk, pdu)]
    for told, what in others[:MOST_CHANGED]:
        yield from _said(talk, at, told, what)


def _answered_otherwise(
    talk: Conversation, at: int, pdu: Pdu, asked: Pdu, expected: Sequence[str]
) -> Iterator[Edit]:
    if pdu.kind == "confirmed-ResponsePDU":
        refusal = Pdu("confirmed-ErrorPDU", pdu.invoke_id, body={"serviceError": {"errorClass": CONFLICT}})
        reject = Pdu("rejectPDU", pdu.invoke_id, body={"rejectReason": UNRECOGNISED})
        if "reject" in expected:
            yield from _said(talk, at, reject, "rejects the request")
        if asked.service in SILENT or "result(-)" in expected:
            yield from _said(talk, at, refusal, "answers result(-)")
    elif asked.service in SILENT:
        told = Pdu("confirmed-ResponsePDU", pdu.invoke_id, asked.service, SILENT[asked.service])
        yield from _said(talk, at, told, "answers result(+)")


def _said(talk: Conversation, at: int, pdu: Pdu, what: str) -> Iterator[Edit]:
    try:
        octets = mms.encode(pdu)
    except EncodeError:
        return
    if octets != talk.messages[at].data:
        message = replace(talk.messages[at], data=octets)
        yield Edit("change", at, at, at + 1, (message,), what)


def agreed(talk: Conversation, turn: int, service: str) -> Iterator[Edit]:
    """The messages of an Initiate with one service more that their senders perform."""
    for at in talk.turns[turn].positions:
        pdu = talk.pdus[at]
        if pdu is None or not isinstance(pdu.body, Mapping):
            continue
        for part, listed in (
            ("initRequestDetail", "servicesSupportedCalling"),
            ("initResponseDetail", "servicesSupportedCalled"),
        ):
            detail = pdu.body.get(part)
            if not isinstance(detail, Mapping) or listed not in detail:
                continue
            known = mms.bits("ServiceSupportOptions", detail[listed])
            try:
                more = mms.bit_string("ServiceSupportOptions", known | {service}, len(detail[listed]))
            except KeyError:
                continue
            told = replace(pdu, body={**pdu.body, part: {**detail, listed: more}})
            yield from _said(talk, at, told, f"lists {words.title(service)} in servicesSupported")


# What is named and shown.


def _named(talk: Conversation, pdu: Pdu) -> Iterator[tuple[Pdu, str]]:
    """A request about something else that the conversation names."""
    if pdu.kind != "confirmed-RequestPDU":
        return
    for key in (None, *NAMES):
        held = pdu.body if key is None else pdu.body.get(key) if isinstance(pdu.body, Mapping) else None
        if not isinstance(held, str):
            continue
        for name in sorted(_names(talk, pdu, key) - {held}, key=lambda name: _unlike(name, held)):
            body = name if key is None else {**pdu.body, key: name}
            yield replace(pdu, body=body), f"names {name}"


def _names(talk: Conversation, like: Pdu, key: str | None) -> set[str]:
    """What stands in the same place of other messages about the same kind of thing."""
    keys = NAMES if key is None else ("domainName",) if key == "domainName" else NAMES[:-1]
    bodies = [pdu.body for pdu in talk.pdus if pdu is not None and pdu.kind == "confirmed-RequestPDU"]
    found = {body.get(each) for body in bodies if isinstance(body, Mapping) for each in keys}
    return {name for name in found if isinstance(name, str)} if like.service else set()


def _unlike(name: str, other: str) -> tuple[bool, str]:
    """Names that differ in capitals only come first."""
    return name.casefold() != other.casefold(), name


def _shown(pdu: Pdu, expected: Sequence[str]) -> Iterator[tuple[Pdu, str]]:
    """The same message with one of its values another, or two that belong together."""
    if not isinstance(pdu.body, Mapping):
        return
    if pdu.service == "getProgramInvocationAttributes":
        yield from _attributes(pdu, expected)
    elif isinstance(pdu.detail, Mapping) and "robotVMDState" in pdu.detail:
        yield from _status(pdu, pdu.detail)


def _attributes(pdu: Pdu, expected: Sequence[str]) -> Iterator[tuple[Pdu, str]]:
    wanted = [text.removeprefix("state=") for text in expected if text.startswith("state=")]
    for state in wanted or words.STATE[1:]:
        if state in words.STATE:
            body = {**pdu.body, "state": words.STATE.index(state)}
            yield replace(pdu, body=body), f"shows state {state}"
    if isinstance(pdu.detail, Mapping):
        others = [("controlled", ("none", None)), ("normal", None)]
        for control in others:
            yield (
                replace(pdu, detail={**pdu.detail, "control": control}),
                f"shows control {control[0].upper()}",
            )


def _status(pdu: Pdu, detail: Mapping[str, Any]) -> Iterator[tuple[Pdu, str]]:
    for number, state in enumerate(words.ROBOT_STATE):
        yield replace(pdu, detail={**detail, "robotVMDState": number}), f"shows {state}"
    chosen = detail.get("selectedProgramInvocation")
    none = ("noneSelected", None)
    if chosen != none:
        for number, state in enumerate(words.ROBOT_STATE):
            told = {**detail, "robotVMDState": number, "selectedProgramInvocation": none}
            yield replace(pdu, detail=told), f"shows {state} with no program invocation selected"


# A service that was not asked for.


def inserted(talk: Conversation, event: int, programs: Sequence[str], arms: Sequence[str]) -> Iterator[Edit]:
    """A service more before the event: asked for on its association, and performed.

    ``programs`` are those that may be named, the likeliest first; ``arms`` are the predefined ones that a
    program controls.
    """
    request = talk.request(event)
    begin = event if request is None else request
    whose = talk.messages[event].channel
    number = 1 + max((pdu.invoke_id or 0 for pdu in talk.pdus if pdu is not None), default=0)
    for service, body, detail, said in _services(programs, arms):
        channels = [_side(whose, side) for side in ("client", "server")]
        pdus = (
            Pdu("confirmed-RequestPDU", number, service, body, detail),
            Pdu("confirmed-ResponsePDU", number, service, SILENT[service]),
        )
        try:
            octets = [mms.encode(pdu) for pdu in pdus]
        except EncodeError:
            continue
        at = talk.messages[begin]
        made = tuple(
            TraceMessage(at.index - SPREAD // 2 + n, at.time, channel, data)
            for n, (channel, data) in enumerate(zip(channels, octets, strict=True))
        )
        yield Edit("insert", begin, begin, begin, made, f"{said}, answered result(+)")


def _side(channel: Channel, sender: str) -> Channel:
    """The channel of that side of the association; its names need not be such as a recorder would give."""
    if channel.metadata.get("sender", "client") == sender:
        return channel
    begin, _, end = channel.topic.rpartition("/")
    topic = f"{begin}/{sender}" if end in SIDES else f"{channel.topic}/{sender}"
    return replace(channel, topic=topic, metadata={**channel.metadata, "sender": sender})


def _other(message: TraceMessage) -> str:
    return OTHER.get(message.metadata.get("sender", "client"), "server")


def answered(talk: Conversation, event: int) -> Iterator[Edit]:
    """An answer to a request that has none, at once."""
    pdu, turn = talk.pdus[event], talk.turn_of[event]
    if pdu is None or pdu.kind != "confirmed-RequestPDU" or len(talk.turns[turn].positions) > 1:
        return
    if event + 1 == len(talk.messages):
        return
    at = talk.messages[event]
    channel = _side(at.channel, _other(at))
    told = [Pdu("confirmed-ErrorPDU", pdu.invoke_id, body={"serviceError": {"errorClass": CONFLICT}})]
    if pdu.service in SILENT:
        told.insert(0, Pdu("confirmed-ResponsePDU", pdu.invoke_id, pdu.service, SILENT[pdu.service]))
    for answer in told:
        message = TraceMessage(at.index + 1, at.time, channel, mms.encode(answer))
        sign = "-" if answer.kind == "confirmed-ErrorPDU" else "+"
        what = f"the answer to #{recorded(at.index)}, result({sign})"
        yield Edit("insert", event + 1, event + 1, event + 1, (message,), what)


def asked_for(talk: Conversation, event: int) -> Iterator[Edit]:
    """The request to an answer that has none: one like another of the same service."""
    pdu = talk.pdus[event]
    if pdu is None or not talk.answers_nothing(event) or pdu.service is None:
        return
    like = [each for each in talk.pdus if each is not None and each.service == pdu.service]
    at = talk.messages[event]
    channel = _side(at.channel, _other(at))
    for request in like:
        if request.kind == "confirmed-RequestPDU":
            made = mms.encode(replace(request, invoke_id=pdu.invoke_id))
            message = TraceMessage(at.index - 1, at.time, channel, made)
            what = f"the request, such as {brief(request).removesuffix(': request')}"
            yield Edit("insert", event, event, event, (message,), what)


def _services(programs: Sequence[str], arms: Sequence[str]) -> Iterator[tuple[str, Any, Any, str]]:
    for name in programs[:MOST_NAMES]:
        if name in arms:
            continue
        yield "select", {"controlling": name, "controlled": list(arms)}, None, f"Select {name}"
        for service in ("reset", "stop", "kill"):
            body = {"programInvocationName": name}
            yield service, body, None, f"{words.title(service)} {name}"
        start = ("controlling", {"startCount": ("noLimit", None)})
        yield "start", {"programInvocationName": name}, start, f"Start {name}"
        resume = ("controlling", {"modeType": ("continueMode", None)})
        yield "resume", {"programInvocationName": name}, resume, f"Resume {name}"
    yield "select", {}, None, "Select without a name, which leaves none selected"
    semaphore = {"semaphoreName": ("vmd-specific", words.SEMAPHORE)}
    taking = {**semaphore, "priority": 64, "relinquishIfConnectionLost": True}
    yield "takeControl", taking, None, "TakeControl"
    yield "relinquishControl", semaphore, None, "RelinquishControl"
    for name in programs[:MOST_NAMES]:
        if name not in arms:
            yield "deleteProgramInvocation", name, None, f"DeleteProgramInvocation {name}"


def statuses(talk: Conversation, event: int) -> Iterator[Edit]:
    """An UnsolicitedStatus more before the event: that something has happened which no message asked for."""
    request = talk.request(event)
    begin = event if request is None else request
    found = next((at for at in range(begin, -1, -1) if _tells_status(talk.pdus[at])), None)
    if found is None:
        return
    last = talk.pdus[found]
    assert last is not None
    channel = _side(talk.messages[event].channel, "server")
    well = {"vmdLogicalStatus": 0, "vmdPhysicalStatus": 0}
    plain = Pdu("unconfirmed-PDU", None, "unsolicitedStatus", well, last.detail)
    for told, what in _status(plain, last.detail):
        at = talk.messages[begin]
        message = TraceMessage(at.index - 1, at.time, channel, mms.encode(told))
        yield Edit("insert", begin, begin, begin, (message,), f"UnsolicitedStatus, which {what}")


def _tells_status(pdu: Pdu | None) -> bool:
    return pdu is not None and isinstance(pdu.detail, Mapping) and "robotVMDState" in pdu.detail


def dropped(talk: Conversation, event: int) -> Iterator[Edit]:
    """The event left out: a request alone, which may stand there twice, or the service with its answer."""
    positions = talk.turns[talk.turn_of[event]].positions if talk.turn_of[event] >= 0 else (event,)
    if event != positions[-1] or len(positions) == 1:
        yield Edit("drop", event, event, event + 1, (), "it is not said")
    if len(positions) > 1:
        begin, resume = positions[0], positions[-1] + 1
        said = tuple(talk.messages[at] for at in range(begin, resume) if at not in positions)
        yield Edit("drop", positions[-1], begin, resume, said, "the service is not asked for")


def programs(talk: Conversation, finding: Finding) -> list[str]:
    """The program invocations of the conversation, those that the finding's sentence names first."""
    found: dict[str, None] = {}
    for pdu in talk.pdus:
        if pdu is not None and isinstance(pdu.body, Mapping):
            for key in ("programInvocationName", "controlling"):
                if isinstance(pdu.body.get(key), str):
                    found[pdu.body[key]] = None
    return sorted(found, key=lambda name: (name not in finding.message, list(found).index(name)))
