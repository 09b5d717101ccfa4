"""What the mutators begin with: the samples' messages, captures built in code, tables, profiles."""

from __future__ import annotations

import gzip
import io
import json
from functools import cache
from pathlib import Path

from capture_wire import (
    CC,
    CR,
    INITIATE,
    STATUS,
    STATUS_ANSWER,
    Talk,
    accept,
    acse,
    captured,
    connect,
    dt,
    ethernet,
    pdvs,
)
from capture_wire import mms as in_data_phase

from fuzzing import wire
from fuzzing.wire import Said
from mmsverify.formats import mms
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.modbus import HEADER
from mmsverify.formats.trace import Channel
from mmsverify.profiles import shipped

ROOT = Path(__file__).resolve().parents[3]


@cache
def messages(encoding: str) -> tuple[bytes, ...]:
    """The different messages of one encoding in the sample recordings."""
    found: dict[bytes, None] = {}
    for path in sorted((ROOT / "traces").glob("*.mcap")):
        found.update((m.data, None) for m in read_trace(path) if m.message_encoding == encoding)
    return tuple(found)


@cache
def pdus() -> tuple[bytes, ...]:
    """One PDU of each kind and service of the samples, and those worked out by hand elsewhere."""
    found: dict[tuple[str, str | None, bool], bytes] = {}
    for octets in messages("mms-ber"):
        pdu = mms.decode(octets)
        found.setdefault((pdu.kind, pdu.service, pdu.detail is None), octets)
    return (*found.values(), INITIATE, STATUS, STATUS_ANSWER)


@cache
def adus() -> tuple[bytes, ...]:
    """Requests and answers of every function code, and an exception."""
    asked = (
        "0100010008",
        "0200010008",
        "0300010002",
        "0400010002",
        "050001ff00",
        "0600010003",
        "0f0001000801ff",
        "1000010002040001 0002",
        "010105",
        "0304 00010002",
        "8102",
        "0f00010008",
    )
    told = [bytes.fromhex(pdu) for pdu in asked]
    return (*messages("modbus-tcp"), *(HEADER.pack(7, 0, len(pdu) + 1, 1) + pdu for pdu in told))


@cache
def tsdus() -> tuple[bytes, ...]:
    """SPDUs of an association's life."""
    return (
        connect(),
        accept(),
        in_data_phase(STATUS),
        b"\x19\x06\x11\x01\x03\xc1\x01\xa0" + pdvs(1, acse(0x64, STATUS)),
        b"\x01\x00\x02\x00" + pdvs(3, STATUS),
        connect((5, 7)),
        accept(results="02"),
        *pdus()[:4],
    )


@cache
def agreed() -> tuple[bytes, bytes]:
    """What client and server say until an association is there."""
    return CR + dt(connect()), CC + dt(accept())


@cache
def streams() -> tuple[bytes, ...]:
    """One side of an association on TCP."""
    asked = CR + dt(connect()) + b"".join(dt(in_data_phase(pdu)) for pdu in pdus()[:6])
    return (
        asked,
        dt(in_data_phase(pdus()[0]), 20) + dt(STATUS),
        dt(connect(), 60) + dt(in_data_phase(STATUS), 5),
    )


def talk() -> Talk:
    """An association with two requests, and its end."""
    said = (("client", dt(in_data_phase(STATUS))), ("server", dt(in_data_phase(STATUS_ANSWER), 12)))
    return Talk().associate().say(*said).close()


def signals() -> Talk:
    """A Modbus connection: ADUs alone, together and in two parts."""
    one, other = adus()[:2]
    said = (("client", one), ("server", other), ("client", one + one[:5]), ("client", one[5:]))
    return Talk(server=("10.0.0.6", 502), client=("10.0.0.9", 40001)).shake().say(*said).close()


@cache
def frames() -> tuple[bytes, ...]:
    """Frames with the octet before them that tells their link."""
    packets = [
        *talk().packets[:6],
        *Talk(("fe80::1", 4), ("fe80::2", 102)).shake().say(("client", CR)).packets,
    ]
    plain = [bytes([1]) + ethernet(packet) for packet in packets]
    tagged = [bytes([1]) + bytes(12) + b"\x81\x00\x00\x07\x81\x00\x00\x08\x08\x00" + packets[4]]
    others = [
        bytes([link]) + head + packets[3]
        for link, head in (
            (12, b""),
            (113, bytes(14) + b"\x08\x00"),
            (0, b"\x02\x00\x00\x00"),
            (20, b"\x08\x00" + bytes(18)),
        )
    ]
    return (*plain, *tagged, *others)


@cache
def pcaps() -> tuple[bytes, ...]:
    """Captures in pcap."""
    return (captured(talk()), captured(signals()), captured(talk(), signals()))


@cache
def pcapngs() -> tuple[bytes, ...]:
    """Captures in pcapng."""
    both = [ethernet(packet) for one in (talk(), signals()) for packet in one.packets]
    return (wire.pcapng(both[:14]), wire.pcapng(both[14:]), wire.pcapng(talk().packets, 101))


@cache
def zipped() -> tuple[bytes, ...]:
    """Captures in gzip."""
    return tuple(gzip.compress(octets, mtime=0) for octets in (*pcaps()[:2], pcapngs()[0]))


@cache
def samples() -> tuple[bytes, ...]:
    """VR samples."""
    said = [{"VR(0)": 3, "C_RunMD": 6.0, "VR_5": -1e300}, {"CS_RunSTA": True, "CF_Err": None, "x": "y"}, {}]
    return (*messages("json")[:40], *(json.dumps(cells).encode() for cells in said))


@cache
def links() -> tuple[bytes, ...]:
    """Events of connections."""
    events = [{"connection": "a1", "event": event, "role": "mms"} for event in ("open", "close", "gap", "x")]
    return tuple(json.dumps(event).encode() for event in events)


@cache
def tables() -> tuple[bytes, ...]:
    """Tables as oscilloscopes and panels write them."""
    head = "Time (ms),C_RunMD,VR1,CS_ErrId\n"
    rows = "".join(f"{at},{at % 7},{at % 3},0\n" for at in range(6))
    comma = "Zeit;C_RunMD;CS_RunSTA\n0,5;1;2\n1,5;2,0;\n\n# remark\n2,5;3;4\n"
    panel = 'Date\tTime\tmsec\tVR(0)\n2026-01-05\t06:00:00\t5\t1\n2026-01-05\t06:00:01\t7\t"2"\n'
    dated = "timestamp,C_RunMD\n2026-01-05T06:00:00.25+08:00,1\n05.01.2026 06:00:01,2\n"
    scope = "Model,XY\nInterval,1e-3\n\nsecond,C_RunMD\ns,V\n-1e-3,1\n0,2\n"
    plain = "1,2,3\n2,3,4\n3,4,5\n"
    texts = (head + rows, comma, panel, dated, scope, plain, "时间 (微秒),C_RunMD\n1,2\n2,3\n")
    octets = [text.encode() for text in texts]
    return (*octets, texts[0].encode("utf-16"), texts[6].encode("gb18030"), comma.encode("utf-16-le"))


@cache
def profiles() -> tuple[bytes, ...]:
    """The shipped profiles, each without its remarks."""
    return tuple(path.read_bytes() for path in shipped().values())


@cache
def stated() -> tuple[bytes, ...]:
    """Profiles as a recording's metadata tells them: a line for each key."""
    return (
        b"model=mms-robot\nassociations=multiple\nstep_limited=true\nnest=3\narms=['R_ARM']",
        b"model=mms-robot\npredefined=[{name='R_ARM', domains=['R_ARM']}]\nnest=1",
        b"model=vr-template\nsub_action_status=11-14\ncommands=[{number=101,name='jog',sub_mode=1}]",
        b"model=modbus-signals\ndedicated=[9, 10]",
    )


BEGIN = 1_767_592_800_000_000_000


def said_mms(octets: list[bytes]) -> list[Said]:
    """Messages in turn of client and server, after the connection opened."""
    opened = BEGIN, Channel.link("v"), links()[0]
    spoken = (
        (BEGIN + 10**7 * at, Channel.mms("v", "a1", "server" if at % 2 else "client"), data)
        for at, data in enumerate(octets)
    )
    return [opened, *spoken]


def said_vr(octets: list[bytes]) -> list[Said]:
    """Samples of one controller, polled."""
    return [(BEGIN + 10**7 * at, Channel.vr("v", "polled"), data) for at, data in enumerate(octets)]


def said_modbus(octets: list[bytes]) -> list[Said]:
    """Requests and answers in turn."""
    return [
        (BEGIN + 10**7 * at, Channel.modbus("v", "c1", "server" if at % 2 else "client"), data)
        for at, data in enumerate(octets)
    ]


@cache
def recordings() -> tuple[bytes, ...]:
    """Small recordings: without chunks, in chunks of each compression, with and without a profile."""
    said = [*said_mms(list(pdus()[:6])), *said_vr(list(samples()[:3])), *said_modbus(list(adus()[:4]))]
    plain = wire.records(said, {"model": "mms-robot", "associations": "multiple"})
    first, rest = wire.records(said[:5]), wire.records(said[5:])
    halves = wire.chunk(first, "lz4") + wire.chunk(rest, "zstd")
    return (wire.file(plain), wire.file(wire.chunk(plain, "", crc=False)), wire.file(halves), _shipped())


@cache
def _shipped() -> bytes:
    """A recording as the project's own writer makes it, with indexes and summary."""
    from mmsverify.formats.mcap_write import TraceWriter

    out = io.BytesIO()
    with TraceWriter(out, compress=False) as trace:
        for time, channel, data in said_mms(list(pdus()[:3])):
            trace.add(time, channel, data)
    return out.getvalue()
