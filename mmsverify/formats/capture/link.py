"""From a captured packet to a TCP segment: link layers, IPv4 and IPv6, by dpkt. No state is kept here.

What nearly all packets are, TCP on IPv4 without options on Ethernet, is read at once: dpkt takes ten times as
long for it. Everything else, and whatever is odd about such a packet, goes to dpkt.
"""

from __future__ import annotations

import ipaddress
import struct
from functools import lru_cache
from typing import Any, NamedTuple

import dpkt

from mmsverify.formats.capture.faults import UnreadableError
from mmsverify.formats.capture.packets import Packet

_ETHERNET, _SLL, _SLL2 = 1, 113, 276
_WITH_FAMILY = (
    0,
    108,
)  # BSD loopback: the address family in four octets, of either byte order
_RAW = (12, 14, 101, 228, 229)
LINKS = frozenset({_ETHERNET, _SLL, _SLL2, *_WITH_FAMILY, *_RAW})
_VLAN_TYPES = (b"\x81\x00", b"\x88\xa8", b"\x91\x00")
_TCP = 6


class Endpoint(NamedTuple):
    """One end of a TCP connection."""

    address: str
    port: int


class Segment(NamedTuple):
    """One TCP segment as captured. ``missing`` octets of its data were cut off by the snap length."""

    packet: int
    time: int
    source: Endpoint
    target: Endpoint
    seq: int
    ack: int | None
    syn: bool
    fin: bool
    rst: bool
    data: bytes
    missing: int = 0


def segment_of(packet: Packet) -> Segment | None:
    """The TCP segment in a packet; ``None`` for whatever is not TCP.

    Raises ``UnreadableError`` where IP says TCP and there is none.
    """
    return (packet.link == _ETHERNET and _usual(packet)) or _any(packet)


# Ethernet type; version and header length, total length, fragment, protocol and addresses of IP; ports,
# sequence and acknowledgement numbers, data offset and flags of TCP.
_USUAL = struct.Struct(">12xHBxHxxHxBxx4s4sHHIIBB")
_ETHERNET_HEAD, _IP_HEAD = 14, 20


def _usual(packet: Packet) -> Segment | None:
    """The segment, if the packet is whole and as plain as most are; else nothing."""
    data = packet.data
    if len(data) < _USUAL.size:
        return None
    kind, version, length, fragment, protocol, source, target, sport, dport, seq, ack, offset, flags = (
        _USUAL.unpack_from(data)
    )
    begin, end = _ETHERNET_HEAD + _IP_HEAD + (offset >> 4) * 4, _ETHERNET_HEAD + length
    if kind != 0x0800 or version != 0x45 or protocol != _TCP or fragment & 0x3FFF:
        return None
    if not _ETHERNET_HEAD + 2 * _IP_HEAD <= begin <= end <= len(data):
        return None
    return Segment(
        packet.number,
        packet.time,
        _endpoint(source, sport),
        _endpoint(target, dport),
        seq,
        ack if flags & dpkt.tcp.TH_ACK else None,
        bool(flags & dpkt.tcp.TH_SYN),
        bool(flags & dpkt.tcp.TH_FIN),
        bool(flags & dpkt.tcp.TH_RST),
        data[begin:end],
    )


@lru_cache(maxsize=1 << 14)
def _endpoint(address: bytes, port: int) -> Endpoint:
    return Endpoint(str(ipaddress.ip_address(address)), port)


def _any(packet: Packet) -> Segment | None:
    try:
        network = _network(packet.link, packet.data)
    except (
        Exception
    ):  # on hostile octets dpkt raises what it likes; a frame without IP is nobody's frame here
        return None
    if network is None or getattr(network, "p", None) != _TCP or _later_fragment(network):
        return None
    tcp = network.data
    if not isinstance(tcp, dpkt.tcp.TCP):
        raise UnreadableError("tcp", "IP says TCP, but no whole TCP header follows")
    return _segment(packet, network, tcp)


def _network(link: int, data: bytes) -> Any:
    if link == _ETHERNET:
        inner = dpkt.ethernet.Ethernet(data).data
        return inner if isinstance(inner, (dpkt.ip.IP, dpkt.ip6.IP6)) else None
    if link == _SLL:
        return _by_type(data[14:16], data[16:])
    if link == _SLL2:
        return _by_type(data[0:2], data[20:])
    if link in _WITH_FAMILY:
        return _by_version(data[4:])
    return _by_version(data) if link in _RAW else None


def _by_type(kind: bytes, data: bytes) -> Any:
    while kind in _VLAN_TYPES:
        kind, data = data[2:4], data[4:]
    return _by_version(data) if kind in (b"\x08\x00", b"\x86\xdd") else None


def _by_version(data: bytes) -> Any:
    version = data[0] >> 4
    if version == 4:
        return dpkt.ip.IP(data)
    return dpkt.ip6.IP6(data) if version == 6 else None


def _later_fragment(network: Any) -> bool:
    # The octets of a fragment are missing from the stream of its connection: a hole there, told as a gap.
    if isinstance(network, dpkt.ip.IP):
        return bool(network.offset)
    return any(getattr(header, "frag_off", 0) for header in network.all_extension_headers)


def _segment(packet: Packet, network: Any, tcp: Any) -> Segment:
    flags = tcp.flags
    data = bytes(tcp.data)
    return Segment(
        packet=packet.number,
        time=packet.time,
        source=_endpoint(network.src, tcp.sport),
        target=_endpoint(network.dst, tcp.dport),
        seq=tcp.seq,
        ack=tcp.ack if flags & dpkt.tcp.TH_ACK else None,
        syn=bool(flags & dpkt.tcp.TH_SYN),
        fin=bool(flags & dpkt.tcp.TH_FIN),
        rst=bool(flags & dpkt.tcp.TH_RST),
        data=data,
        missing=max(0, _claimed(network, tcp) - len(data)),
    )


def _claimed(network: Any, tcp: Any) -> int:
    """Octets of data by IP's own length; zero where the length was left to the card (offload)."""
    head = int(tcp.off) * 4
    if isinstance(network, dpkt.ip.IP):
        return int(network.len) - int(network.hl) * 4 - head if network.len else 0
    extensions = sum(int(header.length) for header in network.all_extension_headers)
    return int(network.plen) - extensions - head if network.plen else 0
