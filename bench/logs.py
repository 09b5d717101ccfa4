"""Logs to measure with, of any length, written as they go: MCAP with zstd.

``LOGS`` lists them by name; each is written by a function of a path and a number of messages, of which a few
more may come, as a batch is never broken off.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from batches import BEGINNING, FAULTS, Logger, diverse, faulty
from rendering import Player, Script, script

from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.trace import Channel
from mmsverify.formats.vr import encode
from mmsverify.samples import shift
from mmsverify.samples.cell import Cell
from mmsverify.samples.recording import BEGIN, Recording

TESTS = Path(__file__).parent.parent / "tests"
sys.path[:0] = [str(TESTS), str(TESTS / "quality")]

from vr_random import Cells, Run  # noqa: E402

SCAN, POLL = 40_000_000, 7
_ALL_INVOKE_IDS = 1 << 31
GAP_EVERY = 50
"""Batches from one gap to the next."""


@dataclass(frozen=True, slots=True)
class Log:
    """How a log is written; ``share`` of the messages asked for; ``clean``: nothing but notes is found in it.

    ``exact`` says that it is audited the exact way only.
    """

    write: Callable[[Path, int], None]
    share: int = 1
    clean: bool = True
    exact: bool = False


def write_routine(path: Path, count: int) -> None:
    """A robot's routine: what an early shift begins with, and then batches."""
    cell = Cell(Recording("weld7"))
    _repeated(path, count, script(cell, *BEGINNING), [script(cell, shift.routine)])


def write_diverse(path: Path, count: int) -> None:
    """Batches in which no message is like another, with invokeIDs from all that Unsigned32 has."""
    cell = Logger(Recording("weld8"))
    beginning, batch = script(cell, *BEGINNING), script(cell, diverse)
    # About every other message has an invokeID that no other has; an odd stride meets all of them.
    stride = max(1, 2 * _ALL_INVOKE_IDS // max(count, 1)) | 1
    _repeated(path, count, beginning, [batch], stride)


def write_faulty(path: Path, count: int) -> None:
    """The routine with a fault after every batch, which is about one message in eighty."""
    cell = Cell(Recording("weld9"))
    beginning = script(cell, *BEGINNING)
    _repeated(path, count, beginning, [script(cell, faulty(fault)) for fault in FAULTS])


def write_mid_operation(path: Path, count: int) -> None:
    """The routine from the middle of a batch on, with a gap now and then, of which the recorder knows."""
    cell = Cell(Recording("weld7"))
    script(cell, *BEGINNING)
    batch = script(cell, shift.routine)
    gap = script(cell, lambda one: one.recording.link(one.name, "gap"))
    middle = len(batch) // 2
    _repeated(path, count, batch[middle:], [*[batch] * GAP_EVERY, (*batch[:middle], *gap, *batch[-9:])])


def _repeated(path: Path, count: int, beginning: Script, batches: Sequence[Script], stride: int = 1) -> None:
    with TraceWriter(path) as trace:
        player = Player(trace, stride)
        player.play(beginning)
        number = 0
        while trace.count < count:
            player.play(batches[number % len(batches)])
            number += 1


def write_scan(path: Path, count: int) -> None:
    """Samples of a controller, every scan."""
    _sampled(path, Run(1).samples(count), Channel.vr("press", "scan"), SCAN)


def write_polled(path: Path, count: int) -> None:
    """Samples of a controller, every seventh scan."""
    samples = (cells for number, cells in enumerate(Run(1).samples(count * POLL)) if number % POLL == 0)
    _sampled(path, samples, Channel.vr("press", "polled"), SCAN * POLL)


def _sampled(path: Path, samples: Iterator[Cells], channel: Channel, step: int) -> None:
    with TraceWriter(path) as trace:
        for number, cells in enumerate(samples):
            trace.add(BEGIN + number * step, channel, encode(cells))


def write_polls(path: Path, count: int) -> None:
    """A Modbus client that reads the same signals over and over."""
    client, server = (Channel.modbus("robot4", "c1", side) for side in ("client", "server"))
    with TraceWriter(path) as trace:
        for number in range(count // 2):
            head, time = (number & 0xFFFF).to_bytes(2), BEGIN + number * SCAN
            trace.add(time, client, head + b"\0\0\0\6\1\1\0\1\0\x40")
            trace.add(time + SCAN // 8, server, head + b"\0\0\0\x0b\1\1\x08" + bytes(8))


LOGS: Mapping[str, Log] = {
    "routine": Log(write_routine),
    "routine, exact way": Log(write_routine, 500, exact=True),
    "mid-operation": Log(write_mid_operation),
    "diverse": Log(write_diverse, 3),
    "faulty": Log(write_faulty, 20, clean=False),
    "VR, scan": Log(write_scan, 5),
    "VR, polled": Log(write_polled, 20),
    "Modbus, polls": Log(write_polls, 5),
}
