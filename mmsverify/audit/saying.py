"""Messages of any kind in words: for people who look at what was said around a finding."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from typing import Any, NamedTuple

from mmsverify.audit import words
from mmsverify.audit.lookahead import link
from mmsverify.audit.spoken import Listener
from mmsverify.audit.whose import SAMPLES
from mmsverify.errors import DecodeError
from mmsverify.events import MmsEvent
from mmsverify.formats import mms, modbus, vr
from mmsverify.formats.trace import TraceMessage
from mmsverify.incident import Saying

DEEPEST, LONGEST, MOST_FIELDS = 12, 200, 200
"""Levels of a PDU, characters of a value, and values of a message, that are shown."""
Fields = list[tuple[str, str]]


class Reader:
    """Puts messages in words, in event order: it knows which request an answer belongs to."""

    def __init__(self) -> None:
        self._listener = Listener()
        self._asked: dict[tuple[str, str, int], tuple[int, str]] = {}

    def saying(self, message: TraceMessage) -> Saying:
        """One message; one that nobody can read has a ``fault``."""
        if message.message_encoding == "mms-ber":
            return self._mms(message)
        if message.message_encoding == "modbus-tcp":
            return self._modbus(message)
        if message.schema_name == SAMPLES:
            return _sample(message)
        said = _beside(message)
        self._listener.forget(said.device, said.partner)
        self._asked = {
            key: held for key, held in self._asked.items() if key[:2] != (said.device, said.partner)
        }
        return said

    def _mms(self, message: TraceMessage) -> Saying:
        event = self._listener.event(message)
        who = _Who(message, event.vmd, event.association, event.sender)
        if event.fault:
            return who.says("octets that are no PDU", fault=event.fault)
        pdu = mms.decode(message.data)
        fields = [*_shown(event), *_some(flat(pdu.body, ())), *_some(flat(pdu.detail, ("detail",)))]
        fields += [("remark", remark) for remark in pdu.remarks]
        about = ", ".join(event.programs) or event.robot_state
        return who.says(_title(event.service, event.kind, event.answer), fields, event.answers, about=about)

    def _modbus(self, message: TraceMessage) -> Saying:
        names = message.metadata
        device, connection = names.get("controller", ""), names.get("connection", "")
        who = _Who(message, device, connection, names.get("sender", "client"))
        try:
            adu = modbus.decode(message.data)
        except DecodeError as error:
            return who.says("octets that are no ADU", fault=str(error))
        name = _function(adu.function)
        key = device, connection, adu.transaction
        fields = [("transaction", str(adu.transaction)), ("unit", str(adu.unit))]
        if who.sender == "client":
            self._asked.setdefault(key, (message.index, name))
            asking = _request(adu)
            return who.says(
                f"{name} request", fields + asking, about=" ".join(" ".join(f) for f in asking[:2])
            )
        answers, asked = self._asked.pop(key, (None, name))
        if adu.exception:
            code = str(adu.data[0]) if adu.data else "missing"
            return who.says(f"{asked} exception {code}", [*fields, ("exception", code)], answers)
        return who.says(f"{name} response", [*fields, ("data", adu.data.hex(" "))], answers)


class _Who(NamedTuple):
    """A message, with who says it."""

    message: TraceMessage
    device: str
    partner: str
    sender: str = ""

    def says(
        self,
        title: str,
        fields: Sequence[tuple[str, str]] = (),
        answers: int | None = None,
        *,
        about: str = "",
        fault: str = "",
    ) -> Saying:
        index, time, data = self.message.index, self.message.time, self.message.data
        who = self.device, self.partner, self.sender
        return Saying(index, time, *who, title, data, about, answers, tuple(fields), fault)


def _some(fields: Iterator[tuple[str, str]]) -> Fields:
    """The first of many values."""
    shown = list(islice(fields, MOST_FIELDS))
    return [*shown, ("...", "and more")] if next(fields, None) is not None else shown


def _title(service: str, kind: str, answer: str) -> str:
    if answer:
        return f"{words.title(service) if service else 'answer (request not shown)'} {answer}"
    if kind == "confirmed-RequestPDU":
        return f"{words.title(service)} request"
    return words.title(service) if service else kind.removesuffix("PDU").replace("-", " ").strip()


def _shown(event: MmsEvent) -> Fields:
    """What a status shows of the robot, in the words of the standard."""
    if not event.logical:
        return []
    told = [("robot state", event.robot_state), ("selected", event.selected or "none")]
    told += [("logical status", event.logical), ("physical status", event.physical)]
    if event.local_control is not None:
        told.append(("local control", str(event.local_control).upper()))
    return [(name, value) for name, value in told if value]


def _function(code: int) -> str:
    code &= modbus.EXCEPTION - 1
    known = code in set(modbus.Function)
    return modbus.Function(code).name.replace("_", " ").lower() if known else f"function {code:#04x}"


def _request(adu: modbus.Adu) -> Fields:
    asked = modbus.request(adu)
    if asked is None:
        return [("data", adu.data.hex(" "))]
    told = [("address", str(asked.address)), ("quantity", str(asked.quantity))]
    if asked.function in modbus.SINGLE:
        told[1] = ("value", f"{asked.value:#06x}")
    elif asked.function in modbus.MULTIPLE:
        told.append(("values", adu.data[5:].hex(" ")))
    return told + ([("amiss", asked.amiss)] if asked.amiss else [])


def _sample(message: TraceMessage) -> Saying:
    who = _Who(message, message.metadata.get("controller", ""), message.metadata.get("sampling", ""))
    try:
        sample = vr.decode(message.data)
    except DecodeError as error:
        return who.says("octets that are no sample", fault=str(error))
    fields = [(name, str(vr.plain(value))) for name, value in sample.cells.items()]
    bad = [(each.name, f"{each.found} (no number)") for each in sample.bad]
    return who.says("sample", _some(iter(fields)) + _some(iter(bad)))


def _beside(message: TraceMessage) -> Saying:
    for role in ("mms", "modbus"):
        happened = link(message, role)
        if happened is not None:
            return _Who(message, message.metadata.get("name", ""), happened[0]).says(f"link: {happened[1]}")
    return _Who(message, "", message.topic).says(message.schema_name or message.message_encoding or "message")


def flat(value: Any, path: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """The values of a decoded PDU with their dotted paths; deep ones are cut off, long ones shortened."""
    if len(path) > DEEPEST or (value is None and len(path) < 2):
        return
    if value is None:
        yield ".".join(path), ""
    elif isinstance(value, Mapping):
        for name, inner in value.items():
            yield from flat(inner, (*path, str(name)))
    elif isinstance(value, tuple) and len(value) == 2 and isinstance(value[0], str):
        yield from flat(value[1], (*path, value[0]))
    elif isinstance(value, list | tuple):
        for number, inner in enumerate(value):
            yield from flat(inner, (*path, str(number)))
    else:
        text = value.hex(" ") if isinstance(value, bytes) else str(value)
        yield ".".join(path) or "value", text if len(text) <= LONGEST else f"{text[:LONGEST]}..."
