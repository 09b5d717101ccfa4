"""Link layers: the same TCP segment is found under each of them, and nothing else is taken for one."""

from __future__ import annotations

import struct
from collections.abc import Callable

import pytest
from capture_wire import ACK, SYN, Talk, ethernet
from hypothesis import given, settings
from hypothesis import strategies as st

from mmsverify.formats.capture import link
from mmsverify.formats.capture.faults import UnreadableError
from mmsverify.formats.capture.link import LINKS, Endpoint, Segment, segment_of
from mmsverify.formats.capture.packets import Packet

V4 = Talk().packet("client", b"hello", seq=77)
V6 = Talk(client=("fd00::9", 40000), server=("fd00::5", 102)).packet("client", b"hello", seq=77)
VLAN = bytes.fromhex("81000005")
QINQ = bytes.fromhex("88a8000581000006")

CASES = {
    "ethernet": (1, ethernet(V4)),
    "ethernet, padded": (1, ethernet(V4) + bytes(9)),
    "ethernet, vlan": (1, bytes(12) + VLAN + b"\x08\x00" + V4),
    "ethernet, two vlan tags": (1, bytes(12) + QINQ + b"\x08\x00" + V4),
    "loopback, little endian": (0, struct.pack("<I", 2) + V4),
    "loopback, big endian": (108, struct.pack(">I", 2) + V4),
    "raw": (101, V4),
    "raw of BSD": (12, V4),
    "IPv4": (228, V4),
    "cooked": (113, bytes(14) + b"\x08\x00" + V4),
    "cooked, vlan": (113, bytes(14) + VLAN + b"\x08\x00" + V4),
    "cooked 2": (276, b"\x08\x00" + bytes(18) + V4),
}
CASES_V6 = {
    "ethernet": (1, ethernet(V6)),
    "loopback": (0, struct.pack("<I", 30) + V6),
    "raw": (101, V6),
    "IPv6": (229, V6),
    "cooked": (113, bytes(14) + b"\x86\xdd" + V6),
}


@pytest.mark.parametrize("case", CASES)
def test_a_segment_is_found_under_every_link_layer(case: str) -> None:
    segment = segment_of(Packet(5, 99, *CASES[case]))
    assert segment is not None
    assert (segment.source, segment.target) == (Endpoint("10.0.0.9", 40000), Endpoint("10.0.0.5", 102))
    assert (segment.packet, segment.time, segment.seq, segment.data, segment.missing) == (
        5,
        99,
        77,
        b"hello",
        0,
    )
    assert (segment.syn, segment.fin, segment.rst) == (False, False, False)
    assert segment.ack is not None


@pytest.mark.parametrize("case", CASES_V6)
def test_a_segment_is_found_in_ip_version_6(case: str) -> None:
    segment = segment_of(Packet(5, 99, *CASES_V6[case]))
    assert segment is not None
    assert (segment.source, segment.data) == (Endpoint("fd00::9", 40000), b"hello")
    assert segment.missing == 0


def test_octets_cut_off_by_the_snap_length_are_counted() -> None:
    for packet in (V4, V6):
        segment = segment_of(Packet(1, 0, 101, packet[:-3]))
        assert segment is not None
        assert (segment.data, segment.missing) == (b"he", 3)


def test_a_syn_without_acknowledgment_has_no_acknowledgment_number() -> None:
    for flags, acknowledged in ((SYN, False), (SYN | ACK, True)):
        segment = segment_of(Packet(1, 0, 101, Talk().packet("client", flags=flags)))
        assert segment is not None
        assert segment.syn
        assert (segment.ack is not None) == acknowledged


def test_other_frames_are_no_segments() -> None:
    arp = bytes(12) + b"\x08\x06" + bytes(28)
    udp = bytes([*V4[:9], 17, *V4[10:]])
    fragment = bytes([*V4[:6], 0, 5, *V4[8:]])
    for kind, data in ((1, arp), (1, ethernet(udp)), (101, fragment), (101, b""), (147, V4)):
        assert segment_of(Packet(1, 0, kind, data)) is None


def test_ip_that_promises_tcp_and_holds_none_is_unreadable() -> None:
    with pytest.raises(UnreadableError):
        segment_of(Packet(1, 0, 101, V4[:30]))


def read(way: Callable[[Packet], Segment | None], data: bytes) -> Segment | str | None:
    try:
        return way(Packet(1, 0, 1, data))
    except UnreadableError as error:
        return error.fault.reason


OPTIONS = bytes.fromhex("01010402")


@settings(max_examples=500, deadline=None)
@given(
    st.binary(max_size=30),
    st.booleans(),
    st.integers(0, 12),
    st.lists(st.tuples(st.integers(12, 70), st.integers(0, 255)), max_size=3),
    st.integers(0, 100),
)
def test_the_short_way_reads_what_dpkt_reads(
    said: bytes, options: bool, padding: int, changes: list[tuple[int, int]], kept: int
) -> None:
    packet = bytearray(Talk().packet("client", (OPTIONS if options else b"") + said, seq=77))
    if options:
        packet[32] = 0x60  # one more word in TCP's head
    frame = bytearray(ethernet(bytes(packet)) + bytes(padding))
    for at, octet in changes:
        frame[at % len(frame)] = octet
    cut = bytes(frame[: max(0, len(frame) - kept)] if kept < 20 else frame)
    short = read(link._usual, cut)
    assert short is None or short == read(link._any, cut)


def test_the_short_way_is_taken() -> None:
    assert link._usual(Packet(1, 0, 1, ethernet(V4))) == link._any(Packet(1, 0, 1, ethernet(V4)))


@settings(max_examples=300, deadline=None)
@given(st.sampled_from(sorted(LINKS)), st.binary(max_size=120), st.integers(0, 60))
def test_hostile_octets_never_crash(kind: int, noise: bytes, kept: int) -> None:
    for data in (noise, V4[:kept] + noise, V6[:kept] + noise, ethernet(V4)[:kept] + noise):
        try:
            segment = segment_of(Packet(1, 0, kind, data))
        except UnreadableError as error:
            segment = None
            assert error.fault.layer == "tcp"  # noqa: PT017
        assert segment is None or len(segment.data) <= len(data)
