"""Imports against tshark, PDU by PDU: what both can read of a capture is the same octets at the same time.

The captures are made here, and any that lie in ``shared/captures`` beside the project, or in the folder that
``MMSVERIFY_CAPTURES`` names. Without tshark there is nothing to compare.
"""

from __future__ import annotations

import json
import os
import random
import shutil
import subprocess
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from capture_wire import (
    CONCLUDE,
    INITIATED,
    STATUS,
    STATUS_ANSWER,
    Talk,
    captured,
    dt,
    ethernet,
    mms,
    pcap,
)

from mmsverify.formats.capture import import_captures
from mmsverify.formats.mcap import TraceWriter, read_trace

TSHARK = shutil.which("tshark")
ROOT = Path(__file__).parents[2]
FOLDER = Path(os.environ.get("MMSVERIFY_CAPTURES", ROOT.parent / "shared" / "captures"))
OWN = sorted(FOLDER.glob("*.pcap*")) if FOLDER.is_dir() else []
# Stacks that are broken: of each of them tshark gives up one PDU that can be told apart all the same.
BEYOND_TSHARK = {"mms-startRequest.pcap", "mms-killRequest.pcap", "iec61850_read.pcap"}

pytestmark = pytest.mark.skipif(TSHARK is None, reason="tshark is not installed")
Pdu = tuple[int, str]


def layer(packet: dict[str, Any], name: str) -> Iterator[str]:
    """The octets of one protocol in a packet, as often as it stands there."""
    raw = packet.get(f"{name}_raw", [])
    for item in raw if raw and isinstance(raw[0], list) else [raw] if raw else []:
        yield item[0]


def tshark(path: Path) -> list[Pdu]:
    """Time in ns and octets of every MMS PDU and Modbus ADU that tshark finds."""
    command = [str(TSHARK), "-r", str(path), "-T", "json", "-x", "--no-duplicate-keys", "-Y", "mms || modbus"]
    command += ["-J", "frame mbtcp modbus mms", "-o", "tcp.reassemble_out_of_order:TRUE"]
    out = subprocess.run(command, capture_output=True, check=True).stdout
    found: list[Pdu] = []
    for packet in json.loads(out):
        layers = packet["_source"]["layers"]
        seconds, _, fraction = layers["frame"]["frame.time_epoch"].partition(".")
        time = int(seconds) * 10**9 + int(fraction.ljust(9, "0"))
        found += [(time, octets) for octets in layer(layers, "mms")]
        headers, pdus = layer(layers, "mbtcp"), layer(layers, "modbus")
        found += [(time, head[:14] + pdu) for head, pdu in zip(headers, pdus, strict=True)]
    return sorted(found, key=lambda pdu: pdu[0])


def ours(path: Path, folder: Path) -> tuple[list[Pdu], dict[str, int]]:
    """The same of an import, and its counts."""
    trace = folder / "out.mcap"
    with TraceWriter(trace) as writer:
        counts = dict(import_captures([path], writer)[0].pdus)
    messages = (message for message in read_trace(trace) if message.schema_name != "link.Event")
    return [(message.time, message.data.hex()) for message in messages], counts


@pytest.mark.parametrize("path", OWN, ids=lambda path: path.name[:40])
def test_a_real_capture_is_read_as_tshark_reads_it(path: Path, tmp_path: Path) -> None:
    found, counts = ours(path, tmp_path)
    expected = tshark(path)
    assert sum(counts.values()) == len(found)
    if path.name in BEYOND_TSHARK:
        assert len(found) == len(expected) + 1
        found = [pdu for pdu in found if pdu in expected]
    assert found == expected


def asked(number: int) -> bytes:
    return bytes([0, number]) + bytes.fromhex("00000006010100000010")


def answered(number: int) -> bytes:
    return bytes([0, number]) + bytes.fromhex("0000000501010205") + bytes([number])


def modbus() -> Talk:
    """Requests one by one, several in a segment, and one that a segment's border cuts."""
    talk = Talk(server=("10.0.0.5", 502)).shake()
    for number in range(1, 20):
        talk.say(("client", asked(number)), ("server", answered(number)))
    many = [asked(number) for number in range(20, 40)]
    talk.say(("client", b"".join(many)), ("server", b"".join(answered(n) for n in range(20, 40))))
    talk.say(("client", asked(40)[:8]), ("client", asked(40)[8:]), ("server", answered(40)[:8]))
    return talk.say(("server", answered(40)[8:])).close()


def association(size: int) -> Talk:
    """MMS in TPDUs of that size."""
    talk = Talk().associate()
    for _ in range(10):
        talk.say(("client", dt(mms(STATUS), size)), ("server", dt(mms(STATUS_ANSWER), size)))
    return talk.say(("client", dt(mms(CONCLUDE), size))).close()


def straight(talk: Talk) -> bytes:
    return captured(talk)


def repeated(talk: Talk) -> bytes:
    """Every packet twice: retransmissions."""
    return pcap(ethernet(packet) for packet in talk.packets for _ in range(2))


def shuffled(talk: Talk) -> bytes:
    """Neighbours with data change places here and there."""
    frames = [ethernet(packet) for packet in talk.packets]
    mixed = random.Random(5)
    for at, (one, other) in enumerate(pairwise(frames)):
        if 8 < at < len(frames) - 8 and mixed.random() < 0.2 and one[26:30] == other[26:30]:
            frames[at], frames[at + 1] = other, one
    return pcap(frames)


@pytest.mark.parametrize("way", [straight, repeated, shuffled])
@pytest.mark.parametrize("make", [modbus, lambda: association(8000), lambda: association(11)])
def test_a_made_capture_is_read_as_tshark_reads_it(
    make: Callable[[], Talk], way: Callable[[Talk], bytes], tmp_path: Path
) -> None:
    path = tmp_path / "made.pcap"
    path.write_bytes(way(make()))
    found, counts = ours(path, tmp_path)
    # The short AARE of these captures is not one that tshark looks into.
    assert [pdu for pdu in found if pdu[1] != INITIATED.hex()] == tshark(path)
    assert counts["mms"] + counts["modbus"] == len(found) > 20
