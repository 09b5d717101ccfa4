"""How fast samples of a controller are audited, and that the memory does not grow with their number.

    python bench/vr_samples.py [SAMPLES [SHORT [SEED]]]

A random run that keeps the rules, of SAMPLES samples (1,000,000) and of SHORT ones (100,000), scan by scan
and polled. Each is written, and then audited in a process of its own, which tells its greatest size
(ru_maxrss). The exit code tells whether a long recording took a quarter more memory than a short one, or
was blamed.
"""

from __future__ import annotations

import multiprocessing
import resource
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

TESTS = Path(__file__).parent.parent / "tests"
sys.path[:0] = [str(TESTS), str(TESTS / "quality")]

from vr_random import BEGIN, NAME, SCAN, Cells, Run  # noqa: E402
from vr_runs import KINDS, Sampling, blamed  # noqa: E402

from mmsverify.formats.mcap_write import TraceWriter  # noqa: E402
from mmsverify.formats.trace import Channel  # noqa: E402
from mmsverify.formats.vr import encode  # noqa: E402

EVERY = {"scan": 1, "polled": 7}


def changes(samples: Iterator[Cells], every: int) -> Iterator[Cells]:
    """What changed from sample to sample, of every so many."""
    held = Cells()
    for number, cells in enumerate(samples):
        if number % every == 0:
            yield {name: value for name, value in cells.items() if held.get(name) != value}
            held = cells


def write(path: Path, kind: Sampling, count: int, seed: int) -> None:
    """A recording of so many samples, which are never all in memory."""
    every = EVERY[kind]
    with TraceWriter(path) as trace:
        for number, cells in enumerate(changes(Run(seed).samples(count * every), every)):
            trace.add(BEGIN + number * SCAN, Channel.vr(NAME, kind), encode(cells))


def measured(path: Path) -> tuple[float, float, int]:
    """Seconds of the audit, megabytes of the process, and findings."""
    begin = time.perf_counter()
    found = blamed(path)
    seconds = time.perf_counter() - begin
    return seconds, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024, len(found)


def main() -> int:
    """Print the table; whether anything is wrong with it."""
    given = [int(word) for word in sys.argv[1:4]]
    most, short, seed = (*given, *(1_000_000, 100_000, 1)[len(given) :])
    wrong = False
    print(f"{'recording':10} {'samples':>10} {'seconds':>9} {'samples/s':>10} {'MiB':>8} {'findings':>9}")
    with tempfile.TemporaryDirectory() as folder:
        for kind in KINDS:
            sizes = []
            for count in (short, most):
                path = Path(folder) / f"{kind}.mcap"
                write(path, kind, count, seed)
                with multiprocessing.get_context("spawn").Pool(1) as pool:
                    seconds, size, found = pool.apply(measured, (path,))
                sizes.append(size)
                wrong |= found > 0
                speed = count / seconds
                print(f"{kind:10} {count:10} {seconds:9.1f} {speed:10.0f} {size:8.0f} {found:9}", flush=True)
            wrong |= sizes[1] > 1.25 * sizes[0]
    return int(wrong)


if __name__ == "__main__":
    sys.exit(main())
