"""Many recordings on several processes: one recording a task, results in the order of the recordings.

A process that dies, killed or out of memory, takes nothing with it: what it had not finished is done again,
and a recording that kills its process alone as well is told as one that cannot be read.
"""

from __future__ import annotations

import os
import threading
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import connection, get_context, parent_process
from pathlib import Path

from mmsverify.errors import UsageError
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
    pool = ProcessPoolExecutor(
        min(jobs, len(numbers)), mp_context=get_context("spawn"), initializer=_end_with_parent
    )
    try:
        _require_start(pool)
        return _until_broken(lambda number: pool.submit(task, paths[number]), numbers, 2 * jobs, finish)
    finally:
        pool.shutdown(cancel_futures=True)


def _until_broken(
    submit: Callable[[int], Future[Done]],
    numbers: Sequence[int],
    most: int,
    finish: Callable[[int, Done], None],
) -> list[int]:
    """The same with a pool; ``most`` are under way at any moment."""
    waiting = deque(numbers)
    running: dict[Future[Done], int] = {}
    broken: list[int] = []
    while running or (waiting and not broken):
        while waiting and not broken and len(running) < most:
            number = waiting.popleft()
            try:
                running[submit(number)] = number
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


def _end_with_parent() -> None:
    """Let a process end when the one that started it is gone, however that went."""
    parent = parent_process()
    assert parent is not None

    def watch() -> None:
        connection.wait([parent.sentinel])
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def _require_start(pool: ProcessPoolExecutor) -> None:
    """Tell processes that cannot even start from those that a recording kills."""
    try:
        pool.submit(int).result()
    except BrokenProcessPool:
        cure = "in a script, call it under if __name__ == '__main__'; or use one process"
        raise UsageError("other processes cannot be started", place="jobs", cure=cure) from None


def _killed(path: Path) -> Finding:
    cure = "give it more memory, or audit it by itself"
    return Finding(
        path=str(path), index=None, time=None, topic=None, vmd=None,
        severity="error", rule="input.unreadable", clauses=("R-7.3.1-2",),
        message=f"{path}: the process that audited it was killed ({cure})",
    )  # fmt: skip
