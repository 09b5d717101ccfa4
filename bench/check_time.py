"""How long ``mmsverify check mms-robot`` takes, for both variants: user CPU seconds and seconds of the clock.

    python bench/check_time.py

Every run is a process of its own, start of the interpreter included. The clock is that of a machine that may
have other things to do; the CPU time is comparable.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import time

VARIANTS = ("repaired", "as-written")
TARGET = {"repaired": 30.0, "as-written": 60.0}


def measured(variant: str) -> tuple[float, float, int]:
    """CPU seconds, clock seconds and exit status of one check."""
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime, time.perf_counter()
    command = [sys.executable, "-m", "mmsverify", "check", "mms-robot", "--variant", variant, "-q"]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, check=False)
    spent = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    return spent, time.perf_counter() - begin, done.returncode


def main() -> None:
    """Print one line a variant."""
    for variant in VARIANTS:
        cpu, clock, status = measured(variant)
        print(
            f"{variant:10}  {cpu:6.1f} s CPU  {clock:6.1f} s  exit {status}  (target {TARGET[variant]:.0f} s)"
        )


if __name__ == "__main__":
    main()
