"""What several processes and a Dask cluster of this machine gain over one process.

    python bench/fleet.py [MESSAGES [ROUNDS]]

Eight recordings of a welding robot's routine, each of MESSAGES messages (200,000), audited by one process, by
two, and by a LocalCluster of two workers, in turns, ROUNDS (3) times. Seconds of the wall clock, with
what it takes to start and end processes and cluster: medians, how many times as fast as one process, and as
two. Aims: two processes 1.7 times one, the cluster 0.7 times two.
"""

from __future__ import annotations

import gc
import statistics
import sys
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from throughput import routine

from mmsverify.auditing import audit_traces
from mmsverify.fleet.tasks import SELDOM

RECORDINGS = 8
WAYS: Mapping[str, Mapping[str, Any]] = {
    "one process": {},
    "two processes": {"jobs": 2},
    "Dask, two workers": {"scheduler": "local", "jobs": 2},
}


def seconds(paths: list[Path], options: Mapping[str, Any]) -> float:
    """How long one way takes, of which nothing but notes may come."""
    begin = time.perf_counter()
    audit = audit_traces(paths, profile=None, model=None, **options)
    took = time.perf_counter() - begin
    assert len(audit.inputs) == RECORDINGS, audit.findings
    assert all(finding.severity == "note" for finding in audit.findings), audit.findings[:3]
    return took


def main() -> None:
    """Print the table."""
    gc.set_threshold(*SELDOM)  # as the command does, and every worker
    count, rounds = (int(text) for text in (sys.argv[1:] + ["200000", "3"][len(sys.argv) - 1 :]))
    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(folder) / f"{number}.mcap" for number in range(RECORDINGS)]
        routine(paths[0], count)
        for path in paths[1:]:
            path.write_bytes(paths[0].read_bytes())
        took = [{name: seconds(paths, options) for name, options in WAYS.items()} for _ in range(rounds)]
    medians = {name: statistics.median(each[name] for each in took) for name in WAYS}
    print(f"{RECORDINGS} x {count:<16,}{'seconds':>9}{'times one':>11}{'of two':>8}")
    one, two = medians["one process"], medians["two processes"]
    for name, took_it in medians.items():
        print(f"{name:20}{took_it:9.2f}{one / took_it:11.2f}{two / took_it:8.2f}")


if __name__ == "__main__":
    main()
