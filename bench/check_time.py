"""How long ``mmsverify check mms-robot`` takes: user CPU seconds and seconds of the clock.

    python bench/check_time.py                   both variants, then repaired with each shipped profile
    python bench/check_time.py single-arm ...    repaired with these profiles

Every run is a process of its own, start of the interpreter included. The clock is that of a machine that may
have other things to do; the CPU time is comparable.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import time
from collections.abc import Sequence

from mmsverify.profiles import ROBOT_TABLE, shipped

TARGET = {"repaired": 30.0, "as-written": 60.0}
PROFILE_TARGET = 60.0


def measured(*options: str) -> tuple[float, float, int]:
    """CPU seconds, clock seconds and exit status of one check."""
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime, time.perf_counter()
    command = [sys.executable, "-m", "mmsverify", "check", "mms-robot", *options, "-q"]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, check=False)
    spent = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    return spent, time.perf_counter() - begin, done.returncode


def tell(name: str, target: float, *options: str) -> None:
    """Measure one check and print a line about it."""
    cpu, clock, status = measured(*options)
    print(f"{name:16}  {cpu:6.1f} s CPU  {clock:6.1f} s  exit {status}  (target {target:.0f} s)", flush=True)


def main(profiles: Sequence[str]) -> None:
    """One line a variant, then one a profile; those profiles only that are named."""
    if not profiles:
        for variant, target in TARGET.items():
            tell(variant, target, "--variant", variant)
    for profile in profiles or shipped(ROBOT_TABLE):
        tell(profile, PROFILE_TARGET, "--profile", profile)


if __name__ == "__main__":
    main(sys.argv[1:])
