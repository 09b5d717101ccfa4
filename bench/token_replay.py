"""pm4py's token replay on what the routine is as an event log, as a yardstick for an audit.

A case is one job of the robot, from Select to the next Select; its activities are the services by name, a
request and its answer one event, what is told unasked another. The Petri net is what the inductive miner
makes of the first cases. Token replay knows neither arguments nor state nor refusals: it does much less.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from importlib.util import find_spec
from itertools import islice
from pathlib import Path
from typing import Any

from logs import write_routine

from mmsverify.auditing import read_events

SHARE, DISCOVERED = 100, 50
FIRST = "select"


def line(path: Path, count: int) -> str:
    """How fast a part of the routine is replayed, as a row of the table of ``throughput``."""
    if find_spec("pm4py") is None:
        return "token replay: pm4py is not installed (pip install 'mmsverify[bench]')"
    write_routine(path, max(count // SHARE, 2000))
    log = _log(path)
    spoken = int(log["messages"].sum())
    grouped, single = (spoken / seconds / 1000 for seconds in _seconds(log))
    return (
        f"token replay of pm4py, {spoken:,} messages as {len(log):,} events of"
        f" {log['case:concept:name'].nunique():,} cases: {single:,.1f} thousands/s case by case,"
        f" {grouped:,.1f} where equal cases are replayed once"
    )


def _events(path: Path) -> Iterator[dict[str, Any]]:
    """The activities; ``messages`` counts how many messages each stands for."""
    case = -1
    for event in read_events(path):
        answers = event.kind in ("confirmed-ResponsePDU", "confirmed-ErrorPDU")
        if not event.service or answers:
            continue
        case += event.service == FIRST
        if case >= 0:
            asked = event.kind == "confirmed-RequestPDU"
            yield {"case:concept:name": str(case), "concept:name": event.service, "messages": 1 + asked,
                   "time:timestamp": event.time}  # fmt: skip


def _log(path: Path) -> Any:
    import pandas as pd

    log = pd.DataFrame(_events(path))
    log["time:timestamp"] = pd.to_datetime(log["time:timestamp"], utc=True)
    return log


def _seconds(log: Any) -> tuple[float, float]:
    """CPU seconds of the replay, of equal cases once and of every case; the net is found before."""
    import pm4py
    from pm4py.algo.conformance.tokenreplay import algorithm

    names = [*islice(dict.fromkeys(log["case:concept:name"]), DISCOVERED)]
    net = pm4py.discover_petri_net_inductive(log[log["case:concept:name"].isin(names)])
    cases = pm4py.convert_to_event_log(log)
    found = []
    for every in (False, True):
        begin = time.process_time()
        told = {"disable_variants": every, "show_progress_bar": False}
        algorithm.apply(cases, *net, parameters=told)
        found.append(time.process_time() - begin)
    return found[0], found[1]
