"""The engine of several processes of this machine.

A process that dies, killed or out of memory, takes nothing with it: what it had not finished is done again,
each recording alone. One whose process dies then, too, as often as it is tried, is told as one that cannot be
read. A process that dies while it starts says nothing of any recording.
"""

from __future__ import annotations

import gc
import os
import threading
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import connection, get_context, parent_process

from mmsverify.errors import UsageError
from mmsverify.fleet.interrupts import end_quietly, held_back
from mmsverify.fleet.tasks import SELDOM, Done, Task, killed
from mmsverify.formats.locations import Location

ALONE = 2
"""So often a recording is tried alone: that its process is killed once may be chance."""
FIRST_STARTS, STARTS = 2, 5
"""So often the first process is started, which may be one that never can be, and each later one."""


def shared(task: Task, paths: Sequence[Location], *, jobs: int) -> Iterator[tuple[int, Done]]:
    """The engine, with so many processes."""
    waiting = dict.fromkeys(range(len(paths)))
    starts = FIRST_STARTS
    while waiting:
        suspects: list[int] = []
        for number, done in _round(task, paths, list(waiting), jobs, suspects, starts=starts):
            del waiting[number]
            yield number, done
        starts = STARTS
        for suspect in suspects:
            yield suspect, _alone(task, paths[suspect])
            del waiting[suspect]


def _alone(task: Task, path: Location) -> Done:
    """Do one that was under way when a process died."""
    for _ in range(ALONE):
        for _, done in [*_round(task, [path], [0], 1, [], starts=STARTS)]:
            return done
    return killed(path)


def _round(
    task: Task, paths: Sequence[Location], numbers: Sequence[int], jobs: int, broken: list[int], *,
    starts: int,
) -> Iterator[tuple[int, Done]]:  # fmt: skip
    """Do these until a process dies; those that were under way then are noted as ``broken``."""
    pool = _started(min(jobs, len(numbers)), starts)

    def submit(number: int) -> Future[Done]:
        with held_back():  # this may start a process
            return pool.submit(task, paths[number])

    try:
        yield from _until_broken(submit, numbers, 2 * jobs, broken)
    finally:
        pool.shutdown(cancel_futures=True)


def _until_broken(
    submit: Callable[[int], Future[Done]], numbers: Sequence[int], most: int, broken: list[int]
) -> Iterator[tuple[int, Done]]:
    """The same with a pool; ``most`` are under way at any moment."""
    waiting = deque(numbers)
    running: dict[Future[Done], int] = {}
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
                yield number, future.result()


def _begin() -> None:
    """Let a process end when the one that started it is gone or interrupted, however that went."""
    gc.set_threshold(*SELDOM)
    end_quietly()
    parent = parent_process()
    assert parent is not None

    def watch() -> None:
        connection.wait([parent.sentinel])
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def _started(workers: int, starts: int) -> ProcessPoolExecutor:
    """A pool of which a process has started: tells those that never can from those that something kills."""
    for _ in range(starts):
        pool = ProcessPoolExecutor(workers, mp_context=get_context("spawn"), initializer=_begin)
        try:
            with held_back():
                started = pool.submit(int)
            started.result()
            return pool
        except BrokenProcessPool:
            pool.shutdown(cancel_futures=True)
    cure = "in a script, call it under if __name__ == '__main__'; or use one process"
    raise UsageError("other processes cannot be started", place="jobs", cure=cure)
