"""How fast long recordings are audited, beside reading them only.

    python bench/throughput.py [MESSAGES [ROUNDS]]

A welding robot's routine, batch after batch, of MESSAGES messages (1,000,000; zstd); the same by the exact
way, a 500th of it; samples of a press; polls of a Modbus server. For each the median of ROUNDS (3) rounds, in
thousands of messages a second of CPU time: bare decompression of the chunks, ``iter_messages`` of the mcap
package, the audit. Every round is a process of its own, whose greatest size is told, too.
"""

from __future__ import annotations

import multiprocessing
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import zstandard
from mcap.reader import make_reader
from mcap.records import Chunk
from mcap.stream_reader import StreamReader

from mmsverify.auditing import audit_traces
from mmsverify.formats.mcap import TraceWriter, read_trace
from mmsverify.formats.trace import Channel
from mmsverify.samples import shift
from mmsverify.samples.cell import Cell
from mmsverify.samples.recording import BEGIN, Recording

TESTS = Path(__file__).parent.parent / "tests"
sys.path[:0] = [str(TESTS), str(TESTS / "quality")]

from vr_random import Run  # noqa: E402

from mmsverify.formats.vr import encode  # noqa: E402

STEP = 40_000_000
Work = Callable[[Path], Callable[[], object]]
"""Makes ready for what is then timed."""


def routine(path: Path, count: int) -> None:
    """A robot's routine: what an early shift begins with, and then batches."""
    recording = Recording("weld7")
    cell = Cell(recording)
    for part in (shift.morning, shift.calibration, shift.loading, shift.first_batch):
        part(cell)
    while recording.count < count:
        shift.routine(cell)
    recording.write(path)


def press(path: Path, count: int) -> None:
    """Samples of a controller, every scan."""
    with TraceWriter(path) as writer:
        for number, cells in enumerate(Run(1).samples(count)):
            writer.add(BEGIN + number * STEP, Channel.vr("press", "scan"), encode(cells))


def polls(path: Path, count: int) -> None:
    """A client that reads the same signals over and over."""
    sides = [Channel.modbus("robot4", "c1", side) for side in ("client", "server")]
    with TraceWriter(path) as writer:
        for number in range(count // 2):
            head = (number & 0xFFFF).to_bytes(2)
            asked, answered = head + b"\0\0\0\6\1\1\0\1\0\x40", head + b"\0\0\0\x0b\1\1\x08" + bytes(8)
            for side, data in zip(sides, (asked, answered), strict=True):
                writer.add(BEGIN + number * STEP, side, data)


def decompressed(path: Path) -> Callable[[], object]:
    """Unpack the chunks and look at nothing."""
    with path.open("rb") as file:
        records = StreamReader(file, emit_chunks=True).records
        chunks = [(chunk.data, chunk.uncompressed_size) for chunk in records if isinstance(chunk, Chunk)]
    return lambda: [zstandard.decompress(data, max_output_size=size) for data, size in chunks] and None


def iterated(path: Path) -> Callable[[], object]:
    """What the mcap package takes to read."""

    def work() -> None:
        with path.open("rb") as file:
            for _ in make_reader(file).iter_messages():
                pass

    return work


def audited(path: Path, *, exact: bool = False) -> Callable[[], object]:
    """The whole audit, of which nothing but notes may come."""

    def work() -> None:
        audit = audit_traces([path], profile=None, model=None, exact=exact)
        assert all(finding.severity == "note" for finding in audit.findings), audit.findings[:3]

    return work


def measured(prepare: Work, path: Path) -> tuple[float, float]:
    """CPU seconds and MiB of the process."""
    work = prepare(path)
    begin = time.process_time()
    work()
    return time.process_time() - begin, peak()


def peak() -> float:
    """The most that this process has held, in MiB; ``getrusage`` would count the one that started it, too."""
    lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    return sum(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) / 1024


def median(work: Work, path: Path, rounds: int) -> tuple[float, float]:
    """The medians of some rounds, each in a process of its own."""
    context = multiprocessing.get_context("spawn")
    found = []
    for _ in range(rounds):
        with context.Pool(1) as pool:
            found.append(pool.apply(measured, (work, path)))
    seconds, sizes = zip(*found, strict=True)
    return statistics.median(seconds), statistics.median(sizes)


def logs(folder: Path, count: int) -> Iterator[tuple[str, Path, Work]]:
    """The recordings, and how each is audited."""
    makers = (("MMS, routine", routine, 1), ("MMS, exact way", routine, 500), ("VR, scan", press, 5),
              ("Modbus, polls", polls, 5))  # fmt: skip
    for name, make, part in makers:
        path = folder / f"{make.__name__}-{part}.mcap"
        make(path, count // part)
        yield name, path, partial(audited, exact=True) if part == 500 else audited


def main() -> None:
    """Print the table."""
    count, rounds = (int(text) for text in (sys.argv[1:] + ["1000000", "3"][len(sys.argv) - 1 :]))
    print(f"{'thousands/s':18}{'messages':>10}{'bare':>9}{'mcap':>8}{'audit':>8}{'audit/mcap':>12}{'MiB':>6}")
    with tempfile.TemporaryDirectory() as folder:
        for name, path, audit in logs(Path(folder), count):
            number = sum(len(batch) for batch in read_trace(path).batches())
            bare, read = (median(work, path, rounds)[0] for work in (decompressed, iterated))
            seconds, size = median(audit, path, rounds)
            rates = [number / each / 1000 for each in (bare, read, seconds)]
            print(
                f"{name:18}{number:10,}{rates[0]:9,.0f}{rates[1]:8,.0f}{rates[2]:8,.1f}"
                f"{rates[2] / rates[1]:12.2f}{size:6.0f}"
            )


if __name__ == "__main__":
    main()
