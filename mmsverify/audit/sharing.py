"""Many recordings on several processes: one recording a task, results in the order of the recordings.

A process that dies, killed or out of memory, takes nothing with it: what it had not finished is done again,
and a recording that kills its process alone as well is told as one that cannot be read.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context
from pathlib import Path

from mmsverify.results import AuditedInput, Finding

Done = tuple[AuditedInput | None, list[Finding]]
Task = Callable[[Path], Done]


def shared(
    task: Task, paths: Sequence[Path], jobs: int, progress: Callable[[str], None] | None = None
) -> list[Done]:
    """The results of a task for each path, in their order."""
    results: dict[int, Done] = {}

    def finish(number: int, done: Done) -> None:
        results[number] = done
        if progress is not None:
            progress(f"audited {len(results)} of {len(paths)}")

    waiting = list(range(len(paths)))
    while waiting:
        for suspect in _round(task, paths, waiting, jobs, finish):
            if _round(task, paths, [suspect], 1, finish):
                finish(suspect, (None, [_killed(paths[suspect])]))
        waiting = [number for number in waiting if number not in results]
    return [results[number] for number in range(len(paths))]


def _round(
    task: Task, paths: Sequence[Path], numbers: Sequence[int], jobs: int, finish: Callable[[int, Done], None]
) -> list[int]:
    """Do these until a process dies; gives those that were under way then."""
    waiting = deque(numbers)
    running: dict[Future[Done], int] = {}
    broken: list[int] = []
    with ProcessPoolExecutor(min(jobs, len(numbers)), mp_context=get_context("spawn")) as pool:
        while running or (waiting and not broken):
            while waiting and not broken and len(running) < 2 * jobs:
                number = waiting.popleft()
                try:
                    running[pool.submit(task, paths[number])] = number
                except BrokenProcessPool:
                    broken.append(number)
            finished, _ = wait(running, return_when=FIRST_COMPLETED) if running else ((), ())
            for future in finished:
                number = running.pop(future)
                if isinstance(future.exception(), BrokenProcessPool):
                    broken.append(number)
                else:
                    finish(number, future.result())
    return broken


def _killed(path: Path) -> Finding:
    cure = "give it more memory, or audit it by itself"
    return Finding(
        path=str(path), index=None, time=None, topic=None, vmd=None,
        severity="error", rule="input.unreadable", clauses=("R-7.3.1-2",),
        message=f"{path}: the process that audited it was killed ({cure})",
    )  # fmt: skip
