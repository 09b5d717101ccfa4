"""Hostile octets for every decoder and importer, by the million: none may crash, hang, or take much memory.

    python bench/fuzz.py [--inputs N] [--seed S] [--target NAME ...] [--failures FOLDER]

An input is a function of the seed, the target and its number. Two processes share the work. A line for each
target tells how many inputs were accepted and refused, the slowest in milliseconds (of the processor), and
the most memory that a process held. Exit status 1 where an input did what none may: another error than the
documented ones, more than 1 s, more than 1 GiB. Its octets are written into FOLDER.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

TESTS = Path(__file__).parent.parent / "tests"
sys.path[:0] = [str(TESTS), str(TESTS / "quality")]

from fuzzing.campaign import Failure, Share, Tally, campaign  # noqa: E402
from fuzzing.targets import TARGETS, shares  # noqa: E402

PROCESSES = 2


def parted(target: str, count: int) -> list[Share]:
    """The inputs of a target, a share for each process."""
    half = (count + 1) // 2
    return [
        share for share in (Share(target, 0, half), Share(target, half, count)) if share.begin < share.end
    ]


def keep(failure: Failure, seed: int, folder: Path) -> None:
    """Write a failing input down."""
    folder.mkdir(parents=True, exist_ok=True)
    octets = TARGETS[failure.target].input(seed, failure.number)
    (folder / f"{failure.target}-{seed}-{failure.number}.bin").write_bytes(octets)


def line(tally: Tally) -> str:
    """One row of the table."""
    return (
        f"{tally.target:14} {tally.inputs:9} {tally.accepted:9} {tally.refused:9} {tally.failed:7}"
        f" {tally.slowest:9.1f} {tally.peak:8.0f}"
    )


def main() -> int:
    """Run them all, and tell."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--inputs", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--target", nargs="+", choices=TARGETS, default=list(TARGETS))
    parser.add_argument("--failures", type=Path, default=Path("fuzz-failures"))
    given = parser.parse_args()
    begin, counts = time.perf_counter(), shares(given.inputs, given.target)
    tallies = {name: Tally(name) for name in counts}
    left = dict(counts)
    print(
        f"{'target':14} {'inputs':>9} {'accepted':>9} {'refused':>9} {'failed':>7} {'slowest':>9} {'MiB':>8}"
    )
    for part in campaign(
        [s for name, count in counts.items() for s in parted(name, count)], given.seed, PROCESSES
    ):
        tallies[part.target].add(part)
        for failure in part.failures:
            print(f"FAILED {failure.target} {failure.number}: {failure.fault}", flush=True)
            keep(failure, given.seed, given.failures)
        left[part.target] -= part.inputs
        if not left[part.target]:
            print(line(tallies[part.target]), flush=True)
    total = sum(tally.inputs for tally in tallies.values())
    failed = sum(tally.failed for tally in tallies.values())
    print(f"{total} inputs, {failed} failed, seed {given.seed}, {time.perf_counter() - begin:.0f} s")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
