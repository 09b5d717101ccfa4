"""Small captures for the tests of the importer, built layer by layer. What stands here claims nothing."""

from __future__ import annotations

import io
import socket
from collections.abc import Iterable
from dataclasses import dataclass, field

import dpkt

from mmsverify.formats.ber import element

ACK, FIN, SYN, RST = dpkt.tcp.TH_ACK, dpkt.tcp.TH_FIN, dpkt.tcp.TH_SYN, dpkt.tcp.TH_RST
ACSE_SYNTAX, MMS_SYNTAX, BER = "52010001", "28ca220201", bytes.fromhex("06025101")
INITIATE, INITIATED = bytes.fromhex("a803800101"), bytes.fromhex("a903800101")
STATUS, STATUS_ANSWER = bytes.fromhex("a0060201018001ff"), bytes.fromhex("a1050201018000")
CONCLUDE, CONCLUDED = b"\x8b\x00", b"\x8c\x00"


def tpkt(tpdu: bytes) -> bytes:
    return b"\x03\x00" + (len(tpdu) + 4).to_bytes(2) + tpdu


CR = tpkt(bytes.fromhex("11e00000000100c0010dc2020001c1020001"))
CC = tpkt(bytes.fromhex("11d00001000200c0010dc2020001c1020001"))


def dt(tsdu: bytes, size: int = 8000) -> bytes:
    """A TSDU in as many data TPDUs as the size asks for."""
    parts = [tsdu[at : at + size] for at in range(0, len(tsdu) or 1, size)]
    ends = [b"\x00"] * (len(parts) - 1) + [b"\x80"]
    return b"".join(tpkt(b"\x02\xf0" + end + part) for part, end in zip(parts, ends, strict=True))


def li(contents: bytes) -> bytes:
    """A session length indicator and what it counts."""
    size = len(contents)
    return (bytes([size]) if size < 255 else b"\xff" + size.to_bytes(2)) + contents


def pdvs(context: int, value: bytes) -> bytes:
    """Fully encoded data with one value."""
    inside = b"\x02\x01" + bytes([context]) + element(0xA0, value)
    return element(0x61, element(0x30, inside))


def mms(pdu: bytes, context: int = 3) -> bytes:
    """An MMS PDU as it travels in the data phase."""
    return b"\x01\x00\x01\x00" + pdvs(context, pdu)


def acse(tag: int, pdu: bytes, context: int = 3) -> bytes:
    """An AARQ (60) or AARE (61) with an Initiate PDU."""
    external = element(0x28, BER + b"\x02\x01" + bytes([context]) + element(0xA0, pdu))
    return element(tag, bytes.fromhex("a107060528ca220203") + element(0xBE, external))


def connect(contexts: tuple[int, int] = (1, 3), pdu: bytes = INITIATE) -> bytes:
    """CONNECT with CP, AARQ and Initiate; ACSE and MMS stand in the given contexts."""
    listed = b"".join(
        element(0x30, b"\x02\x01" + bytes([number]) + element(6, bytes.fromhex(syntax)) + element(0x30, BER))
        for number, syntax in zip(contexts, (ACSE_SYNTAX, MMS_SYNTAX), strict=True)
    )
    user = pdvs(contexts[0], acse(0x60, pdu, contexts[1]))
    cp = element(0x31, bytes.fromhex("a003800101") + element(0xA2, element(0xA4, listed) + user))
    return b"\x0d" + li(bytes.fromhex("0506130100160102140200023302000134020001") + b"\xc1" + li(cp))


def accept(contexts: tuple[int, int] = (1, 3), results: str = "00", pdu: bytes = INITIATED) -> bytes:
    """ACCEPT with CPA, AARE and Initiate; ``results`` has one digit for each proposed context."""
    listed = b"".join(
        element(0x30, bytes([0x80, 1, int(result)]) + b"\x81\x02\x51\x01") for result in results
    )
    user = pdvs(contexts[0], acse(0x61, pdu, contexts[1]))
    cpa = element(0x31, bytes.fromhex("a003800101") + element(0xA2, element(0xA5, listed) + user))
    return b"\x0e" + li(bytes.fromhex("050613010016010214020002") + b"\xc1" + li(cpa))


@dataclass(slots=True)
class Talk:
    """A TCP connection, written down packet by packet as IP packets."""

    client: tuple[str, int] = ("10.0.0.9", 40000)
    server: tuple[str, int] = ("10.0.0.5", 102)
    packets: list[bytes] = field(default_factory=list)
    seqs: dict[str, int] = field(default_factory=lambda: {"client": 1000, "server": (1 << 32) - 20})

    def packet(self, sender: str, data: bytes = b"", flags: int = ACK, seq: int | None = None) -> bytes:
        """Add one packet; without ``seq`` it goes on where the sender stands."""
        other = "server" if sender == "client" else "client"
        source, target = (self.client, self.server) if sender == "client" else (self.server, self.client)
        begin = self.seqs[sender] if seq is None else seq
        tcp = dpkt.tcp.TCP(sport=source[1], dport=target[1], seq=begin, ack=self.seqs[other], flags=flags)
        tcp.data = data
        if seq is None:
            self.seqs[sender] = (begin + len(data) + bool(flags & (SYN | FIN))) % (1 << 32)
        raw = bytes(_ip(source[0], target[0], tcp))
        self.packets.append(raw)
        return raw

    def shake(self) -> Talk:
        """The TCP handshake."""
        self.packet("client", flags=SYN)
        self.packet("server", flags=SYN | ACK)
        self.packet("client")
        return self

    def say(self, *turns: tuple[str, bytes]) -> Talk:
        """Packets with data, in turn."""
        for sender, data in turns:
            self.packet(sender, data)
        return self

    def associate(self) -> Talk:
        """Handshake, COTP, and the association with Initiate."""
        self.shake().say(("client", CR), ("server", CC))
        return self.say(("client", dt(connect())), ("server", dt(accept())))

    def close(self) -> Talk:
        """Both sides finish."""
        self.packet("client", flags=FIN | ACK)
        self.packet("server", flags=FIN | ACK)
        self.packet("client")
        return self


def _ip(source: str, target: str, tcp: dpkt.tcp.TCP) -> dpkt.Packet:
    if ":" in source:
        ends = (socket.inet_pton(socket.AF_INET6, end) for end in (source, target))
        src, dst = ends
        return dpkt.ip6.IP6(src=src, dst=dst, nxt=6, plen=len(tcp), hlim=64, data=tcp)
    return dpkt.ip.IP(src=socket.inet_aton(source), dst=socket.inet_aton(target), p=6, data=tcp)


def ethernet(packet: bytes) -> bytes:
    kind = dpkt.ethernet.ETH_TYPE_IP6 if packet[0] >> 4 == 6 else dpkt.ethernet.ETH_TYPE_IP
    return bytes(12) + int(kind).to_bytes(2) + packet


def pcap(frames: Iterable[bytes], link: int = 1, start: float = 1_700_000_000) -> bytes:
    """A capture file; packets follow each other by a millisecond."""
    out = io.BytesIO()
    writer = dpkt.pcap.Writer(out, linktype=link)
    for number, frame in enumerate(frames):
        writer.writepkt_time(frame, start + number / 1000)
    return out.getvalue()


def captured(*talks: Talk) -> bytes:
    """The packets of some connections, one after the other, on Ethernet."""
    return pcap(ethernet(packet) for talk in talks for packet in talk.packets)
