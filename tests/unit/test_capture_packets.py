"""Capture files: every container gives the same packets; a cut one gives those that are whole."""

from __future__ import annotations

import gzip
import struct
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mmsverify.errors import InputError
from mmsverify.formats.capture.packets import Capture, Packet

FRAMES = [b"first", b"second!", b""]


def classic(order: str, magic: int, unit: int, extra: bytes = b"") -> bytes:
    out = struct.pack(order + "IHHIIII", magic, 2, 4, 0, 0, 65535, 1)
    for number, frame in enumerate(FRAMES):
        out += struct.pack(order + "IIII", 100 + number, 7 * unit, len(frame), len(frame)) + extra + frame
    return out


def block(order: str, kind: int, body: bytes) -> bytes:
    body += bytes(-len(body) % 4)
    return struct.pack(order + "II", kind, len(body) + 12) + body + struct.pack(order + "I", len(body) + 12)


def enhanced(order: str, interface: int, ticks: int, frame: bytes) -> bytes:
    head = struct.pack(order + "IIIII", interface, ticks >> 32, ticks & 0xFFFFFFFF, len(frame), len(frame))
    return block(order, 6, head + frame)


def section(order: str) -> bytes:
    return block(order, 0x0A0D0D0A, struct.pack(order + "IHHq", 0x1A2B3C4D, 1, 0, -1))


def interface(order: str, link: int, options: bytes = b"") -> bytes:
    return block(order, 1, struct.pack(order + "HHI", link, 0, 0) + options)


def nano(order: str) -> bytes:
    return struct.pack(order + "HHB3xHH", 9, 1, 9, 0, 0)


def read(tmp_path: Path, content: bytes) -> tuple[list[Packet], str]:
    path = tmp_path / "c.pcap"
    path.write_bytes(content)
    capture = Capture(path)
    return list(capture), capture.cut


@pytest.mark.parametrize(
    ("order", "magic", "unit", "extra"),
    [
        ("<", 0xA1B2C3D4, 1, b""),
        (">", 0xA1B2C3D4, 1, b""),
        ("<", 0xA1B23C4D, 1000, b""),
        (">", 0xA1B23C4D, 1000, b""),
        ("<", 0xA1B2CD34, 1, bytes(8)),
    ],
)
def test_pcap_of_either_byte_order_and_resolution_is_read(
    tmp_path: Path, order: str, magic: int, unit: int, extra: bytes
) -> None:
    packets, cut = read(tmp_path, classic(order, magic, unit, extra))
    assert [packet.data for packet in packets] == FRAMES
    assert [packet.number for packet in packets] == [1, 2, 3]
    assert packets[1].time == 101_000_007_000
    assert not cut


@pytest.mark.parametrize("order", ["<", ">"])
def test_pcapng_interfaces_have_link_type_and_clock_of_their_own(tmp_path: Path, order: str) -> None:
    content = section(order) + interface(order, 1) + interface(order, 113, nano(order))
    content += enhanced(order, 0, 5_000_001, b"micro") + block(order, 5, bytes(12))
    content += enhanced(order, 1, 6_000_000_002, b"nano") + block(
        order, 3, struct.pack(order + "I", 6) + b"simple"
    )
    packets, cut = read(tmp_path, content)
    assert [(packet.time, packet.link, packet.data) for packet in packets] == [
        (5_000_001_000, 1, b"micro"),
        (6_000_000_002, 113, b"nano"),
        (6_000_000_002, 1, b"simple"),
    ]
    assert not cut


def test_a_new_section_forgets_the_interfaces(tmp_path: Path) -> None:
    content = (
        section("<") + interface("<", 1) + section(">") + interface(">", 101) + enhanced(">", 0, 1, b"x")
    )
    assert [packet.link for packet in read(tmp_path, content)[0]] == [101]


def test_a_zipped_capture_is_read_and_a_cut_one_up_to_the_cut(tmp_path: Path) -> None:
    content = classic("<", 0xA1B2C3D4, 1)
    assert len(read(tmp_path, gzip.compress(content))[0]) == 3
    packets, cut = read(tmp_path, gzip.compress(content, 0)[:-20])
    assert len(packets) == 2
    assert "ends inside" in cut


def test_a_capture_cut_anywhere_gives_the_whole_packets(tmp_path: Path) -> None:
    content = classic("<", 0xA1B2C3D4, 1)
    for size in range(24, len(content)):
        packets, cut = read(tmp_path, content[:size])
        assert [packet.data for packet in packets] == FRAMES[: len(packets)]
        assert bool(cut) == (size not in (24, 45, 68))


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\xd4",
        b"MThd" + bytes(30),
        section("<")[:8] + bytes(20),
        section("<") + enhanced("<", 3, 0, b""),
    ],
)
def test_what_is_no_capture_is_an_error_of_one_line(tmp_path: Path, content: bytes) -> None:
    with pytest.raises(InputError, match=r"c\.pcap: ") as caught:
        read(tmp_path, content)
    assert "\n" not in str(caught.value)


def test_a_packet_that_claims_gigabytes_ends_the_capture(tmp_path: Path) -> None:
    lie = struct.pack("<IIII", 0, 0, 0xFFFFFFFF, 0xFFFFFFFF)
    packets, cut = read(tmp_path, classic("<", 0xA1B2C3D4, 1) + lie + bytes(100))
    assert len(packets) == 3
    assert "claims 4294967295" in cut


def test_folders_and_missing_files_are_input_errors(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "absent.pcap", "a\0b"):
        with pytest.raises(InputError):
            list(Capture(path))


@settings(max_examples=200, deadline=None)
@given(st.binary(max_size=200), st.booleans())
def test_random_blocks_never_crash(tmp_path_factory: pytest.TempPathFactory, tail: bytes, new: bool) -> None:
    head = section("<") + interface("<", 1) + enhanced("<", 0, 1, b"ok")
    path = tmp_path_factory.mktemp("any") / "c.pcap"
    path.write_bytes((head if new else classic("<", 0xA1B2C3D4, 1)) + tail)
    packets = list(Capture(path))
    assert packets[0].data in (b"ok", b"first")
    assert all(0 <= packet.time < 1 << 64 for packet in packets)
