"""What each MMS message of a recording says, as flat data. Answers are paired with requests."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from mmsverify.audit import robot
from mmsverify.audit.exchange import OTHER_SIDE
from mmsverify.audit.lookahead import link
from mmsverify.errors import DecodeError
from mmsverify.events import MmsEvent
from mmsverify.formats import mms
from mmsverify.formats.mms import Pdu
from mmsverify.formats.trace import TraceMessage
from mmsverify.model.rows import MINUS, PLUS

ANSWER = {"confirmed-ResponsePDU": PLUS, "confirmed-ErrorPDU": MINUS, "rejectPDU": "reject"}
NAMED_BY_BODY = frozenset({"deleteProgramInvocation", "getProgramInvocationAttributes"})
NAMING_FIELDS = ("programInvocationName", "programInvocation", "controlling")


class Listener:
    """Follows the associations of a recording: to know which request an answer belongs to."""

    def __init__(self) -> None:
        self._asked: dict[tuple[str, str, str, int | None], MmsEvent] = {}

    def events(self, messages: Iterable[TraceMessage]) -> Iterator[MmsEvent]:
        """One event for each MMS message; other messages are passed over."""
        for message in messages:
            if message.message_encoding == "mms-ber":
                yield self.event(message)
            elif (happened := link(message)) is not None:
                self.forget(message.metadata.get("name", ""), happened[0])

    def event(self, message: TraceMessage) -> MmsEvent:
        """One MMS message."""
        names = message.metadata
        vmd, association = names.get("vmd", ""), names.get("association", "")
        sender = names.get("sender", "client")
        try:
            pdu = mms.decode(message.data)
        except DecodeError as error:
            return MmsEvent(message.index, message.time, vmd, association, sender, "", fault=str(error))
        asking = sender if pdu.kind == "confirmed-RequestPDU" else OTHER_SIDE.get(sender, "")
        key = (vmd, association, asking, pdu.invoke_id)
        if pdu.kind == "initiate-RequestPDU":
            self.forget(vmd, association)
        asked = self._asked.get(key) if pdu.kind in ANSWER else None
        if asked is not None and pdu.service not in (None, asked.service):
            asked = None  # another service's answer is none to this request
        elif asked is not None:
            del self._asked[key]
        made = MmsEvent(
            message.index, message.time, vmd, association, sender, pdu.kind,
            service=pdu.service or (asked.service if asked else ""),
            invoke_id=pdu.invoke_id,
            answers=asked.index if asked else None,
            answer=ANSWER.get(pdu.kind, ""),
            programs=asked.programs if asked else programs(pdu),
            **_status(pdu),
        )  # fmt: skip
        if pdu.kind == "confirmed-RequestPDU":
            self._asked.setdefault(key, made)  # of two with one invokeID the first is answered first
        return made

    def forget(self, vmd: str, association: str) -> None:
        """The association begins, ends, or has a gap: what was asked on it will not be answered any more."""
        self._asked = {key: held for key, held in self._asked.items() if key[:2] != (vmd, association)}


def programs(pdu: Pdu) -> tuple[str, ...]:
    """The program invocations that a request or a notification names."""
    body = pdu.body
    if pdu.service in NAMED_BY_BODY and isinstance(body, str):
        return (body,)
    if not isinstance(body, Mapping):
        return ()
    named = [body[field] for field in NAMING_FIELDS if isinstance(body.get(field), str)]
    return (*named, *(name for name in body.get("controlled", ()) if isinstance(name, str)))


def _status(pdu: Pdu) -> dict[str, Any]:
    """What the robot's status shows, where the message carries one."""
    if pdu.service not in ("status", "unsolicitedStatus", "vMDReset") or not isinstance(pdu.body, Mapping):
        return {}
    call = robot.shown_by_status(pdu.body, pdu.detail) if "vmdLogicalStatus" in pdu.body else None
    if call is None:
        return {}
    shown = call.bindings
    return {
        "robot_state": shown["shown_robot"] or "",
        "selected": shown["selected_is"] or "",
        "local_control": shown["shown_local"],
        "logical": shown["shown_logical"],
        "physical": shown["shown_physical"],
    }
