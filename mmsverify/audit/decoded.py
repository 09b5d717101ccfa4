"""Messages as flat data that log viewers can draw: numbers, words, and enumerations as both.

Viewers such as Foxglove and Lichtblick show neither BER nor Modbus. What they read of a JSON schema is the
type of each property: so each has one, nothing is nested but lists of numbers, and the words that a number
stands for are its description.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

from mmsverify.audit.saying import Reader
from mmsverify.audit.spoken import Listener
from mmsverify.audit.whose import SAMPLES
from mmsverify.audit.words import LOGICAL, PHYSICAL, ROBOT_STATE
from mmsverify.errors import DecodeError
from mmsverify.events import MmsEvent
from mmsverify.formats import modbus, vr
from mmsverify.formats.trace import Schema, TraceMessage
from mmsverify.incident import CLIENT, SERVER, Saying

SECOND = 1_000_000_000
UNKNOWN, SEVERAL = -1, -2
"""Stand where no number of an enumeration can: nothing is known, or one of several."""
SENDERS = (CLIENT, SERVER)
ANSWERS = ("", "result(+)", "result(-)", "reject")
LONGEST = 4000
"""Characters of a message in words: the octets themselves are in the recording."""
Fields = dict[str, Any]

TEXT, INTEGER, NUMBER, FLAG = ({"type": kind} for kind in ("string", "integer", "number", "boolean"))
NUMBERS = {"type": "array", "items": INTEGER}


def enumeration(words: tuple[str, ...]) -> Mapping[str, Any]:
    """A whole number that stands for a word of a table, with what each one means."""
    meant = ", ".join(f"{number} {word or 'none'}" for number, word in enumerate(words))
    return {"type": "integer", "minimum": SEVERAL, "maximum": len(words) - 1, "description": meant}


def code(words: tuple[str, ...], word: str) -> int:
    """The number of a word in a table; negative for one that does not stand there."""
    return words.index(word) if word in words else UNKNOWN


def schema(title: str, properties: Mapping[str, Any], optional: frozenset[str] = frozenset()) -> Schema:
    """A JSON schema of flat objects; what is not ``optional`` is always there."""
    told = {
        "title": title,
        "type": "object",
        "properties": dict(properties),
        "required": [name for name in properties if name not in optional],
    }
    return Schema(title, "jsonschema", json.dumps(told, separators=(",", ":")).encode())


# What all messages have. ``answers`` is the index of the request, ``response_time`` its age in seconds.
_COMMON: Mapping[str, Any] = {
    "index": INTEGER, "title": TEXT, "sender": TEXT, "sender_code": enumeration(SENDERS), "octets": INTEGER,
    "answers": INTEGER, "response_time": NUMBER, "text": TEXT, "fault": TEXT,
}  # fmt: skip
_ANSWERED = frozenset({"answers", "response_time"})
_STATUS: Mapping[str, Any] = {
    "robot_state": TEXT, "robot_state_code": enumeration(ROBOT_STATE),
    "logical": TEXT, "logical_code": enumeration(LOGICAL),
    "physical": TEXT, "physical_code": enumeration(PHYSICAL),
    "selected": TEXT, "local_control": FLAG,
}  # fmt: skip
MMS = schema(
    "mmsverify.Mms",
    {
        **_COMMON, "association": TEXT, "kind": TEXT, "kind_tag": INTEGER, "service": TEXT,
        "invoke_id": INTEGER, "answer": TEXT, "answer_code": enumeration(ANSWERS), "programs": TEXT,
        **_STATUS,
    },
    _ANSWERED | {"invoke_id", "kind_tag"} | _STATUS.keys(),
)  # fmt: skip
_ASKED: Mapping[str, Any] = {
    "transaction": INTEGER, "unit": INTEGER, "function": INTEGER, "exception": INTEGER,
    "address": INTEGER, "quantity": INTEGER, "value": INTEGER, "values": NUMBERS,
}  # fmt: skip
MODBUS = schema("mmsverify.Modbus", {**_COMMON, "connection": TEXT, **_ASKED}, _ANSWERED | frozenset(_ASKED))
_NAMES = {cell.name: cell.name.replace("(", "_").rstrip(")") for cell in vr.CELLS}
VR = schema(
    "mmsverify.Vr",
    {"index": INTEGER, "fault": TEXT, **dict.fromkeys(_NAMES.values(), NUMBER)},
    frozenset(_NAMES.values()),
)


class Decoder:
    """Decodes messages in event order: it knows the requests that wait, and the last values of cells."""

    def __init__(self) -> None:
        self._listener, self._reader = Listener(), Reader()
        self._times: dict[int, int] = {}
        self._asked: dict[tuple[str, int], tuple[int, modbus.Request]] = {}
        self._cells: dict[str, dict[str, vr.Number]] = {}

    def decoded(self, message: TraceMessage) -> tuple[Schema, Fields] | None:
        """What a viewer can draw of a message of MMS, Modbus or VR; of another one nothing."""
        how: tuple[Schema, Callable[[TraceMessage], Fields]]
        if message.message_encoding == "mms-ber":
            how = MMS, self._mms
        elif message.message_encoding == "modbus-tcp":
            how = MODBUS, self._modbus
        elif message.schema_name == SAMPLES:
            how = VR, self._sample
        else:
            return None
        return how[0], how[1](message)

    def _common(self, message: TraceMessage, said: Saying) -> Fields:
        told: Fields = {
            "index": message.index, "title": said.title, "sender": said.sender,
            "sender_code": code(SENDERS, said.sender), "octets": len(message.data),
            "text": "\n".join(f"{name}: {value}" for name, value in said.fields)[:LONGEST],
            "fault": said.fault,
        }  # fmt: skip
        if said.answers is not None:
            told["answers"] = said.answers
            told["response_time"] = (message.time - self._times.pop(said.answers, message.time)) / SECOND
        elif said.title.endswith(" request"):
            self._times[message.index] = message.time
        return told

    def _mms(self, message: TraceMessage) -> Fields:
        event, said = self._listener.event(message), self._reader.saying(message)
        told = self._common(message, said)
        told |= {
            "association": event.association, "kind": event.kind, "service": event.service,
            "answer": event.answer, "answer_code": code(ANSWERS, event.answer),
            "programs": ", ".join(event.programs),
        }  # fmt: skip
        if not event.fault:
            told["kind_tag"] = message.data[0] & 0x1F  # the alternatives of MMSpdu are tagged 0 to 13
        if event.invoke_id is not None:
            told["invoke_id"] = event.invoke_id
        return told | _shown(event)

    def _modbus(self, message: TraceMessage) -> Fields:
        said = self._reader.saying(message)
        told = {**self._common(message, said), "connection": said.partner}
        try:
            adu = modbus.decode(message.data)
        except DecodeError:
            return told
        told |= {"transaction": adu.transaction, "unit": adu.unit}
        told["function"] = adu.function & (modbus.EXCEPTION - 1)
        key = f"{said.device}/{said.partner}", adu.transaction
        if said.sender == CLIENT:
            asked = modbus.request(adu)
            if asked is None:
                return told
            self._asked[key] = message.index, asked
            written = adu.data[5:] if asked.function in modbus.MULTIPLE else b""
            return told | _asked(asked) | _values(asked, written)
        return told | self._answered(key, said, adu)

    def _answered(self, key: tuple[str, int], said: Saying, adu: modbus.Adu) -> Fields:
        index, asked = self._asked.pop(key, (None, None))
        place = _asked(asked) if asked is not None and index == said.answers else {}
        if adu.exception:
            return place | ({"exception": adu.data[0]} if adu.data else {})
        if not place or asked is None or modbus.unlike(asked, adu):
            return place
        read = asked.function not in modbus.SINGLE | modbus.MULTIPLE
        return place | _values(asked, adu.data[1:] if read else b"")

    def _sample(self, message: TraceMessage) -> Fields:
        """All cells that are known: a cell that is missing in a sample kept its last value."""
        cells = self._cells.setdefault(message.metadata.get("controller", ""), {})
        fault = ""
        try:
            sample = vr.decode(message.data)
            cells.update(sample.cells)
            fault = ", ".join(f"{bad.name}: {bad.found}" for bad in sample.bad)
        except DecodeError as error:
            fault = str(error)
        shown = {field: cells[name] for name, field in _NAMES.items() if name in cells}
        return {"index": message.index, "fault": fault[:LONGEST], **shown}


def _shown(event: MmsEvent) -> Fields:
    """What a status shows of the robot, where the message is one."""
    told: Fields = {}
    tables = {"robot_state": ROBOT_STATE, "logical": LOGICAL, "physical": PHYSICAL}
    for name, words in tables.items():
        word = getattr(event, name)
        if word:
            told |= {name: word, f"{name}_code": code(words, word)}
    if event.local_control is not None:
        told["local_control"] = event.local_control
    return told | ({"selected": event.selected} if event.logical and event.robot_state else {})


def _asked(asked: modbus.Request) -> Fields:
    if asked.amiss:
        return {"address": asked.address}
    told: Fields = {"address": asked.address, "quantity": asked.quantity}
    return told | ({"value": asked.value} if asked.function in modbus.SINGLE else {})


def _values(asked: modbus.Request, octets: bytes) -> Fields:
    """The signals (0 or 1) or words of a message, in the order of their addresses."""
    if asked.amiss or not octets:
        return {}
    if asked.function in modbus.BITS:
        return {"values": [octets[n // 8] >> n % 8 & 1 for n in range(asked.quantity)]}
    words = range(0, 2 * asked.quantity, 2)
    return {"values": [int.from_bytes(octets[at : at + 2], "big") for at in words]}
