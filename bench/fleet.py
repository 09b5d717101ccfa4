"""What several processes and a Dask cluster of this machine gain over one process.

    python bench/fleet.py [MESSAGES [ROUNDS]]

Eight recordings each: random samples of a controller, of which nothing can be learned (0.15 times MESSAGES,
1,000,000); robots with faults all the time (0.05 times); a robot's routine, mostly looked up (twice).
The command line audits them with one process, with two, and with a LocalCluster of two workers, in turns,
ROUNDS (3) times. Seconds of the wall clock, with all that it takes to start, to learn and to end: medians,
how many times as fast as one process, and as two. What one process learns of a robot each of several learns
anew: the more there is to be learned, and the less to be done, the less they gain. Aims, where there is
nothing to be learned: two processes 1.7 times one, the cluster 0.7 times two.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

from logs import LOGS

RECORDINGS = 8
FLEETS: Mapping[str, float] = {"VR, scan": 0.15, "faulty": 0.05, "routine": 2}
WAYS: Mapping[str, Sequence[str]] = {
    "one process": (),
    "two processes": ("--jobs", "2"),
    "Dask, two workers": ("--engine", "dask", "--scheduler", "local", "--jobs", "2"),
}


def seconds(folder: Path, options: Sequence[str]) -> tuple[float, bytes]:
    """How long one way takes, and what comes of it."""
    begin = time.perf_counter()
    command = [sys.executable, "-m", "mmsverify", "audit", "-q", str(folder), *options]
    done = subprocess.run(command, check=False, capture_output=True)
    assert done.returncode in (0, 1), done.stderr.decode()
    return time.perf_counter() - begin, done.stdout.splitlines()[-1]


def fleet(name: str, count: int, rounds: int) -> None:
    """Print what one fleet takes."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(folder) / f"{number}.mcap" for number in range(RECORDINGS)]
        LOGS[name].write(paths[0], count)
        for path in paths[1:]:
            path.write_bytes(paths[0].read_bytes())
        took = [{way: seconds(Path(folder), options) for way, options in WAYS.items()} for _ in range(rounds)]
    assert len({said for each in took for _, said in each.values()}) == 1
    medians = {way: statistics.median(each[way][0] for each in took) for way in WAYS}
    print(f"{RECORDINGS} x {count:,} {name:<16}".ljust(28) + f"{'seconds':>9}{'times one':>11}{'of two':>8}")
    one, two = medians["one process"], medians["two processes"]
    for way, took_it in medians.items():
        print(f"{way:28}{took_it:9.2f}{one / took_it:11.2f}{two / took_it:8.2f}", flush=True)


def main() -> None:
    """Print the table."""
    count, rounds = (int(text) for text in (sys.argv[1:] + ["1000000", "3"][len(sys.argv) - 1 :]))
    for name, times in FLEETS.items():
        fleet(name, round(count * times), rounds)


if __name__ == "__main__":
    main()
