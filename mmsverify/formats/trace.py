"""A trace as data: channels, messages, and what any reader of recordings offers. No file is opened here.

The four kinds of channel are those of the trace format; their topics and metadata are spelled here and
nowhere else.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Literal, Protocol

from mmsverify.errors import UsageError

Sender = Literal["client", "server"]
Role = Literal["mms", "modbus"]
LinkEvent = Literal["open", "close", "reset", "gap"]

USUAL_PORTS: Mapping[Role, int] = {"mms": 102, "modbus": 502}
LETTERS: Mapping[Role, str] = {"mms": "a", "modbus": "c"}
"""With which the names of connections begin: a1 is an association, c1 a Modbus connection."""

PROFILE_RECORD = "mmsverify.profile"


@dataclass(frozen=True, slots=True)
class Schema:
    """What describes the messages of a channel: a name, its language, the text (may be empty)."""

    name: str
    encoding: str
    data: bytes = b""


MMS_PDU = Schema("mms.MMSpdu", "asn1")
VR_SAMPLE = Schema(
    "vr.Sample", "jsonschema", b'{"type": "object", "additionalProperties": {"type": "number"}}'
)
LINK_EVENT = Schema(
    "link.Event",
    "jsonschema",
    b'{"type": "object", "required": ["connection", "event", "role"], "properties": {'
    b'"connection": {"type": "string"}, '
    b'"event": {"type": "string", "enum": ["open", "close", "reset", "gap"]}, '
    b'"role": {"type": "string", "enum": ["mms", "modbus"]}}}',
)


@dataclass(frozen=True, slots=True)
class Channel:
    """Where messages of one kind and one sender stand. Equal channels of one file are one object."""

    topic: str
    message_encoding: str
    schema: Schema | None = None
    metadata: Mapping[str, str] = field(default_factory=dict, hash=False)

    @property
    def schema_name(self) -> str:
        """The schema's name, or an empty string for a channel without schema."""
        return self.schema.name if self.schema else ""

    @classmethod
    def mms(cls, vmd: str, association: str, sender: Sender) -> Channel:
        """One side of one MMS association: every message is one whole MMS PDU in BER."""
        names = {"vmd": _name(vmd), "association": _name(association), "sender": sender}
        return cls(f"/{vmd}/mms/{association}/{sender}", "mms-ber", MMS_PDU, names)

    @classmethod
    def vr(cls, controller: str, sampling: Literal["scan", "polled"]) -> Channel:
        """The VR cells of one controller: every message is a JSON object, cell name to value."""
        names = {"controller": _name(controller), "sampling": sampling}
        return cls(f"/{controller}/vr", "json", VR_SAMPLE, names)

    @classmethod
    def modbus(cls, controller: str, connection: str, sender: Sender) -> Channel:
        """One side of one Modbus/TCP connection: every message is one whole ADU (MBAP header and PDU)."""
        names = {"controller": _name(controller), "connection": _name(connection), "sender": sender}
        return cls(f"/{controller}/modbus/{connection}/{sender}", "modbus-tcp", None, names)

    @classmethod
    def link(cls, name: str) -> Channel:
        """The life of the connections of one VMD or controller: open, close, reset, gap."""
        return cls(f"/{_name(name)}/link", "json", LINK_EVENT, {"name": name})


def _name(text: str) -> str:
    if not text or "/" in text:
        raise UsageError(f"{text!r} cannot name a channel", cure="use a non-empty name without '/'")
    return text


@dataclass(frozen=True, slots=True)
class TraceMessage:
    """One message of a recording.

    ``index`` counts from 0 over all messages of the file in event order, whoever understands them; ``time``
    is the capture time in ns; ``data`` is the message as recorded.
    """

    index: int
    time: int
    channel: Channel
    data: bytes

    @property
    def topic(self) -> str:
        """The channel's topic."""
        return self.channel.topic

    @property
    def message_encoding(self) -> str:
        """How ``data`` is encoded, such as ``mms-ber``."""
        return self.channel.message_encoding

    @property
    def schema_name(self) -> str:
        """The name of the channel's schema, or an empty string."""
        return self.channel.schema_name

    @property
    def metadata(self) -> Mapping[str, str]:
        """The channel's metadata, such as ``vmd`` or ``sender``."""
        return self.channel.metadata


class Trace(Protocol):
    """A recording, ready to be read any number of times, always in event order.

    ``metadata`` maps the name of each metadata record to its pairs, wherever in the file the record stands.
    ``truncated`` says that the recording was cut off; ``remark`` then says where and how.
    """

    @property
    def path(self) -> str: ...

    @property
    def metadata(self) -> Mapping[str, Mapping[str, str]]: ...

    @property
    def truncated(self) -> bool: ...

    @property
    def remark(self) -> str: ...

    def __iter__(self) -> Iterator[TraceMessage]: ...
