"""Random runs of a controller that keeps the template rules, audited: a finding would be a false alarm.

    python bench/vr_runs.py [RUNS [SAMPLES [FIRST_SEED]]]

They are made from the model's own rows, with an operator who asks for lawful and unlawful things, as in the
tests of quality: scan by scan, and then the same run as it looks to somebody who samples it now and then.
Either is written with unchanged cells left out at times and integers as floats. One line is printed for each
finding, notes apart, and a last one for all; the exit code tells whether there was any. Times are of the CPU.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

TESTS = Path(__file__).parent.parent / "tests"
sys.path[:0] = [str(TESTS), str(TESTS / "quality")]

from vr_runs import KINDS, blamed, recording  # noqa: E402


def main() -> int:
    """Audit them, one after the other; how many were blamed."""
    given = [int(word) for word in sys.argv[1:4]]
    count, length, first = (*given, *(200, 2000, 0)[len(given) :])
    accused = samples = 0
    slowest = 0.0
    begin = time.process_time()
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + count):
            for kind in KINDS:
                path = Path(folder) / "made.mcap"
                samples += len(recording(seed, length, kind, path))
                before = time.process_time()
                findings = blamed(path)
                slowest = max(slowest, time.process_time() - before)
                accused += bool(findings)
                for found in findings:
                    print(
                        f"seed {seed}, {kind}, sample {found.index}: {found.rule}: {found.message}",
                        flush=True,
                    )
    print(
        f"{count} runs, scan by scan and polled, {samples} samples, seeds {first} to {first + count - 1}:"
        f" {accused} recordings blamed;"
        f" {time.process_time() - begin:.0f} s in all, the slowest audit {slowest:.1f} s"
    )
    return accused


if __name__ == "__main__":
    sys.exit(min(1, main()))
