"""How fast long recordings are audited, beside reading them only and beside token replay.

    python bench/throughput.py [MESSAGES [ROUNDS]] [--log NAME ...] [--memory]

The logs of ``logs.py``, of MESSAGES messages (1,000,000) or a share of that, are unpacked only (bare), read
by ``iter_messages`` of the mcap package, and audited: in pure Python, and by the kernel where there is one.
Told are thousands of messages a second of CPU time, the median of ROUNDS (3) rounds. Each measurement is a
process of its own; in it the same audit is done ``WARM`` times, and the last is called warm: nothing is
learned any more, as in the later recordings of a fleet. The ratios are those of the warm audit; the size is
the greatest of that process. pm4py's token replay gets the routine as an event log, where pm4py is installed
(extra ``bench``).

``--memory`` audits the routine of MESSAGES and of five times as many instead, and tells the processes' sizes;
the exit code tells whether the longer took more than 400 MB, or more than the shorter.
"""

from __future__ import annotations

import argparse
import inspect
import multiprocessing
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import zstandard
from mcap.reader import make_reader
from mcap.records import Chunk
from mcap.stream_reader import StreamReader

from mmsverify.auditing import audit_traces
from mmsverify.formats.mcap import read_trace

sys.path[:0] = [str(Path(__file__).parent)]

import token_replay  # noqa: E402
from logs import LOGS, Log, write_routine  # noqa: E402

Work = Callable[[Path], Callable[[], object]]
"""Makes ready for what is then timed."""
WARM = 8
LONGER, MOST, SLACK = 5, 400e6, 1.05
HEADS = (
    f"{'thousands/s':19}{'way':8}{'messages':>10}{'MiB':>6}{'bare':>8}{'mcap':>7}{'cold':>8}{'warm':>9}"
    f"{'warm/mcap':>11}{'warm/bare':>11}{'peak MiB':>10}"
)


class Measured(NamedTuple):
    """CPU seconds of the first time and of the second, and MiB of the process."""

    cold: float
    warm: float
    size: float


def decompressed(path: Path) -> Callable[[], None]:
    """Unpack the chunks, which are in memory, and look at nothing."""
    with path.open("rb") as file:
        records = StreamReader(file, emit_chunks=True).records
        chunks = [(chunk.data, chunk.uncompressed_size) for chunk in records if isinstance(chunk, Chunk)]

    def work() -> None:
        for data, size in chunks:
            zstandard.decompress(data, max_output_size=size)

    return work


def iterated(path: Path) -> Callable[[], None]:
    """What the mcap package takes to read."""

    def work() -> None:
        with path.open("rb") as file:
            for _ in make_reader(file).iter_messages():
                pass

    return work


def audited(path: Path, *, clean: bool = True, exact: bool = False, **way: Any) -> Callable[[], None]:
    """The whole audit, of which nothing but notes may come where the log is ``clean``."""

    def work() -> None:
        audit = audit_traces([path], profile=None, model=None, exact=exact, **way)
        assert not clean or all(one.severity == "note" for one in audit.findings), audit.findings[:3]

    return work


def ways() -> Mapping[str, Mapping[str, bool]]:
    """The ways to audit that there are, each with what `audit_traces` is told for it."""
    if "kernel" not in inspect.signature(audit_traces).parameters:
        return {"python": {}}
    found = {"python": {"kernel": False}, "kernel": {"kernel": True}}
    return found if find_spec("numba") else {"python": found["python"]}


def measured(work: Work, path: Path, times: int) -> Measured:
    """Do the same so many times."""
    do, seconds = work(path), []
    for _ in range(times):
        begin = time.process_time()
        do()
        seconds.append(time.process_time() - begin)
    return Measured(seconds[0], seconds[-1], peak())


def peak() -> float:
    """The most that this process has held, in MiB; ``getrusage`` would count the one that started it, too."""
    lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    return sum(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) / 1024


def median(work: Work, path: Path, rounds: int, times: int = WARM) -> Measured:
    """The medians of some rounds, each in a process of its own."""
    context = multiprocessing.get_context("spawn")
    found = []
    for _ in range(rounds):
        with context.Pool(1) as pool:
            found.append(pool.apply(measured, (work, path, times)))
    return Measured(*map(statistics.median, zip(*found, strict=True)))


def lines(name: str, log: Log, path: Path, rounds: int) -> Iterator[str]:
    """The rows of the table for one log."""
    count = sum(len(batch) for batch in read_trace(path).batches())
    bare, read = (count / median(work, path, rounds, 2).warm / 1000 for work in (decompressed, iterated))
    size = path.stat().st_size / (1 << 20)
    for way, told in ways().items():
        if log.exact and way != "python":
            continue
        found = median(partial(audited, clean=log.clean, exact=log.exact, **told), path, rounds)
        cold, warm = (count / seconds / 1000 for seconds in (found.cold, found.warm))
        yield (
            f"{name:19}{way:8}{count:10,}{size:6.1f}{bare:8,.0f}{read:7,.0f}{cold:8,.1f}{warm:9,.1f}"
            f"{warm / read:11.2f}{warm / bare:11.3f}{found.size:10.0f}"
        )


def table(names: Sequence[str], count: int, rounds: int) -> None:
    """Write each log, measure it and print its rows."""
    print(HEADS)
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            path = Path(folder) / "log.mcap"
            LOGS[name].write(path, count // LOGS[name].share)
            for line in lines(name, LOGS[name], path, rounds):
                print(line, flush=True)
        if "routine" in names:
            print(token_replay.line(Path(folder) / "tokens.mcap", count))


def memory(count: int) -> bool:
    """Whether the audit of a log that is five times as long stays as small."""
    sizes: dict[tuple[str, int], float] = {}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "log.mcap"
        for number in (count, LONGER * count):
            begin = time.perf_counter()
            write_routine(path, number)
            written = time.perf_counter() - begin
            for way, told in ways().items():
                found = median(partial(audited, **told), path, 1, 1)
                sizes[way, number] = found.size * (1 << 20)
                print(
                    f"{way:8}{number:12,} messages, written in {written:.0f} s, audited in {found.cold:.0f} s"
                    f" of CPU: at most {sizes[way, number] / 1e6:.0f} MB",
                    flush=True,
                )
    return all(sizes[way, LONGER * count] <= min(MOST, SLACK * sizes[way, count]) for way in ways())


def main() -> int:
    """Print the table, or the sizes."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("messages", type=int, nargs="?", default=1_000_000)
    parser.add_argument("rounds", type=int, nargs="?", default=3)
    parser.add_argument("--log", action="append", choices=LOGS, help="only this one; may be given repeatedly")
    parser.add_argument("--memory", action="store_true", help="sizes instead of speeds")
    given = parser.parse_args()
    if given.memory:
        return int(not memory(given.messages))
    table(given.log or [*LOGS], given.messages, given.rounds)
    return 0


if __name__ == "__main__":
    sys.exit(main())
