"""Targets that take octets as they are: decoders of messages and the layers of captures."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable, Iterator

from two_ways import agree

from fuzzing import seeds
from mmsverify.audit.lookahead import link as link_event
from mmsverify.errors import DecodeError
from mmsverify.formats import ber, mms, modbus, vr
from mmsverify.formats.capture import acse, association, cotp, presentation, session, tlv, tpkt
from mmsverify.formats.capture import modbus as modbus_stream
from mmsverify.formats.capture.faults import Fault, UnreadableError
from mmsverify.formats.capture.link import LINKS, Endpoint, Segment, segment_of
from mmsverify.formats.capture.packets import Packet
from mmsverify.formats.capture.tcp import Connections
from mmsverify.formats.trace import Channel, Sender, TraceMessage
from mmsverify.profiles import from_metadata

SIDES: tuple[Sender, Sender] = ("client", "server")


def decode_mms(octets: bytes) -> bool:
    """One PDU: read both ways, looked for a field, written again; a refusal is told with its statements."""
    agree(octets)
    try:
        pdu = mms.decode(octets)
    except DecodeError as error:
        mms.encoded_statements(error.path)
        str(error)
        raise
    mms.locate(octets, ("programInvocationName",))
    mms.encode(pdu)
    return True


def read_ber(octets: bytes) -> bool:
    """Every reader of contents upon the same octets, and an ANY."""
    return sum(_is_read(reader, octets) for reader in _READERS) > 0


def _is_read(reader: Callable[[bytes, int, int], object], octets: bytes) -> bool:
    try:
        reader(octets, 0, len(octets))
    except ber.Fault as fault:
        str(fault)
        return False
    return True


def _any(octets: bytes, begin: int, end: int) -> None:
    ber.check_element(octets, begin, end, 64)


_READERS = (
    _any,
    ber.read_boolean,
    ber.read_null,
    ber.read_integer,
    ber.read_bits,
    ber.read_octets,
    ber.read_visible,
    ber.read_utf8,
    ber.read_graphic,
    ber.read_time,
    ber.read_oid,
)


def layers(octets: bytes) -> bool:
    """Each layer above TCP upon the same octets."""
    return sum(_is_clear(layer, octets) for layer in _LAYERS) > 0


def _is_clear(layer: Callable[[bytes], object], octets: bytes) -> bool:
    try:
        layer(octets)
    except UnreadableError as error:
        str(error.fault)
        return False
    return True


def _elements(octets: bytes) -> list[tlv.Element]:
    return list(tlv.elements(octets, "tlv"))


_LAYERS: tuple[Callable[[bytes], object], ...] = (
    _elements,
    session.read,
    presentation.connect,
    presentation.accept,
    presentation.values,
    presentation.abort,
    presentation.pdv,
    acse.user_information,
    lambda octets: cotp.Assembler().feed(octets),
    lambda octets: list(tpkt.Framer(aligned=True).feed(octets)),
)


def associations(octets: bytes) -> bool:
    """One side of a connection, aligned or not, as one segment and in small ones."""
    found = list(_spoken(association.Association(aligned=True), [octets]))
    found += _spoken(
        association.Association(aligned=False), [octets[at : at + 97] for at in range(0, len(octets), 97)]
    )
    return any(isinstance(item, bytes) for item in found)


def tsdu(octets: bytes) -> bool:
    """A TSDU of either side of a true association, in whole TPDUs: contexts are negotiated."""
    talk = association.Association(aligned=True)
    for side, begin in zip(SIDES, seeds.agreed(), strict=True):
        list(talk.feed(side, begin))
    parts = [octets[at : at + 60000] for at in range(0, len(octets) or 1, 60000)]
    packed = [
        struct.pack(">BBHBBB", 3, 0, len(part) + 7, 2, 0xF0, 0x80 * (part is parts[-1])) + part
        for part in parts
    ]
    found = [item for side in SIDES for item in talk.feed(side, b"".join(packed))]
    return any(isinstance(item, bytes) for item in found)


def modbus_octets(octets: bytes) -> bool:
    """A stream in segments, then an ADU, taken as a request and as the answer to one."""
    said = list(_spoken(modbus_stream.ModbusConnection(), [octets, octets[:3], octets[3:]]))
    for item in said[:50]:
        if isinstance(item, bytes):
            _asked(modbus.decode(item))
    return _asked(modbus.decode(octets)) is not None


def _asked(adu: modbus.Adu) -> str | None:
    request = modbus.request(adu)
    return None if request is None else request.amiss + modbus.unlike(request, adu)


def _spoken(
    talk: association.Association | modbus_stream.ModbusConnection, parts: Iterable[bytes]
) -> Iterator[bytes | Fault]:
    for part in parts:
        yield from talk.feed("client", part)
    fault = talk.end("client")
    if fault:
        yield fault


def frame(octets: bytes) -> bool:
    """A frame; the octet before it chooses the link among those that are read."""
    known = sorted(LINKS)
    told = octets[0] if octets else 1
    link = told if told in LINKS else 276 if told == 20 else known[told % len(known)]
    return segment_of(Packet(1, 1, link, octets[1:])) is not None


ENDS = (Endpoint("10.0.0.1", 40000), Endpoint("10.0.0.2", 102))
STEP = struct.Struct(">BBIIH")
"""One segment: flags (SYN, FIN, RST, ACK, the other side, much data), pieces of data, seq, ack, missing."""


def tcp(octets: bytes) -> bool:
    """Segments as ``STEP`` tells them, put in order."""
    connections = Connections()
    data = sum(len(one.data) for segment in segments(octets) for _, one in connections.feed(segment))
    return data + sum(len(one.data) for _, one in connections.end()) > 0


def segments(octets: bytes) -> Iterator[Segment]:
    """What the octets tell, segment by segment."""
    for at, (flags, count, seq, ack, missing) in enumerate(
        STEP.iter_unpack(octets[: len(octets) // 12 * 12])
    ):
        source, target = ENDS if flags & 16 else ENDS[::-1]
        data = b"x" * (count * (200 if flags & 32 else 1))
        acked = ack if flags & 8 else None
        yield Segment(
            at,
            at,
            source,
            target,
            seq,
            acked,
            bool(flags & 1),
            bool(flags & 2),
            bool(flags & 4),
            data,
            missing,
        )


def sample(octets: bytes) -> bool:
    """One VR sample."""
    return bool(vr.decode(octets).cells)


def event(octets: bytes) -> bool:
    """What happens to a connection."""
    return link_event(TraceMessage(0, 1, Channel.link("v"), octets)) is not None


def metadata(octets: bytes) -> bool:
    """A profile in a recording's metadata: a line for each key."""
    lines = octets.decode("utf-8", "replace").split("\n")
    told = {key: value for key, _, value in (line.partition("=") for line in lines)}
    return bool(from_metadata(told, "x.mcap"))
