"""The engine of several processes of this machine.

A process that dies, killed or out of memory, takes nothing with it: what it had not finished is done again,
and a recording that kills its process alone as well is told as one that cannot be read.
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


def shared(task: Task, paths: Sequence[Location], *, jobs: int) -> Iterator[tuple[int, Done]]:
    """The engine, with so many processes."""
    waiting = dict.fromkeys(range(len(paths)))
    first = True
    while waiting:
        suspects: list[int] = []
        for number, done in _round(task, paths, list(waiting), jobs, suspects, first=first):
            del waiting[number]
            yield number, done
        first = False
        for suspect in suspects:
            again: list[int] = []
            yield from _round(task, paths, [suspect], 1, again)
            if again:
                yield suspect, killed(paths[suspect])
            del waiting[suspect]


def _round(
    task: Task, paths: Sequence[Location], numbers: Sequence[int], jobs: int, broken: list[int], *,
    first: bool = False,
) -> Iterator[tuple[int, Done]]:  # fmt: skip
    """Do these until a process dies; those that were under way then are noted as ``broken``.

    ``first``: no process has been started yet.
    """
    workers = min(jobs, len(numbers))
    pool = _started(workers) if first else _pool(workers)

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


def _pool(workers: int) -> ProcessPoolExecutor:
    return ProcessPoolExecutor(workers, mp_context=get_context("spawn"), initializer=_begin)


def _started(workers: int) -> ProcessPoolExecutor:
    """A pool of which a process has started: tells those that never can from those that something kills."""
    for last in (False, True):
        pool = _pool(workers)
        try:
            with held_back():
                started = pool.submit(int)
            started.result()
            return pool
        except BrokenProcessPool:
            pool.shutdown(cancel_futures=True)
            if last:
                break
    cure = "in a script, call it under if __name__ == '__main__'; or use one process"
    raise UsageError("other processes cannot be started", place="jobs", cure=cure)
