"""Some thousand inputs upon one target in one process, counted; and the processes for many of them.

A process serves one share of one target, so that its greatest size is that target's.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from typing import Any

from fuzzing.targets import TARGETS
from fuzzing.watch import LARGEST, Judgement, Watch, peak

STALLED = 120.0
"""Seconds without a word after which a worker is taken for dead."""
_WORD = 5.0
"""Seconds between words."""
_SAME = 5
"""How many inputs of one and the same fault are kept."""


@dataclass(frozen=True, slots=True)
class Failure:
    """An input that must not have done what it did; ``number`` makes it again."""

    target: str
    number: int
    fault: str


@dataclass(slots=True)
class Tally:
    """What became of the inputs of one target."""

    target: str
    inputs: int = 0
    accepted: int = 0
    slowest: float = 0.0
    slowest_number: int = -1
    peak: float = 0.0
    failures: list[Failure] = field(default_factory=list)
    failed: int = 0

    def note(self, number: int, judged: Judgement) -> None:
        """Count one input."""
        self.inputs += 1
        self.peak = peak()
        self.accepted += judged.accepted and not judged.fault
        self.failed += bool(judged.fault)
        if judged.milliseconds > self.slowest:
            self.slowest, self.slowest_number = judged.milliseconds, number

    def add(self, other: Tally) -> None:
        """Join another share of the same target."""
        self.inputs += other.inputs
        self.accepted += other.accepted
        self.failed += other.failed
        self.peak = max(self.peak, other.peak)
        self.failures += other.failures
        if other.slowest > self.slowest:
            self.slowest, self.slowest_number = other.slowest, other.slowest_number

    @property
    def refused(self) -> int:
        """Inputs that a documented error refused."""
        return self.inputs - self.accepted - self.failed


@dataclass(frozen=True, slots=True)
class Share:
    """The inputs of one target from one number to another."""

    target: str
    begin: int
    end: int


def run(share: Share, seed: int, *, largest: float | None = LARGEST) -> Tally:
    """Judge a share in this process; ``largest`` as for a `Watch`."""
    whole = Tally(share.target)
    for part in parts(share, seed, largest=largest):
        whole.add(part)
    return whole


def parts(
    share: Share,
    seed: int,
    *,
    largest: float | None = LARGEST,
    begins: Callable[[int], None] = lambda _: None,
) -> Iterator[Tally]:
    """The tallies of a share, one for some seconds each; the last is early where the process grew too large.

    ``begins`` hears the number of each input before it is judged.
    """
    target, kinds = TARGETS[share.target], Counter[str]()
    with Watch(largest) as watch:
        target.warm(watch, seed)
        tally, since = Tally(share.target), time.monotonic()
        for number in range(share.begin, share.end):
            begins(number)
            judged = watch.judge(target.run, target.input(seed, number))
            tally.note(number, judged)
            if judged.fault:
                kinds[judged.fault] += 1
                if kinds[judged.fault] <= _SAME:
                    tally.failures.append(Failure(share.target, number, judged.fault))
            if largest is not None and peak() > largest:
                break  # a new process, so that what follows is measured again
            if time.monotonic() - since > _WORD:
                yield tally
                tally, since = Tally(share.target), time.monotonic()
        yield tally


def _work(pipe: Connection, share: Share, seed: int, current: Any) -> None:
    """What a process does: tallies go through the pipe, and in the end nothing."""

    def begins(number: int) -> None:
        current.value = number

    for part in parts(share, seed, begins=begins):
        pipe.send(part)
    pipe.send(None)


class _Worker:
    """A process and what was heard of it."""

    def __init__(self, share: Share, seed: int) -> None:
        context = get_context("spawn")
        self.share = share
        self.done = share.begin
        self._current = context.Value("q", share.begin, lock=False)
        self.pipe, there = context.Pipe(duplex=False)
        self._process = context.Process(target=_work, args=(there, share, seed, self._current), daemon=True)
        self._process.start()
        there.close()
        self._heard = time.monotonic()

    @property
    def silent(self) -> bool:
        return time.monotonic() - self._heard > STALLED

    def hears(self) -> tuple[Tally | None, list[Share]]:
        """One more tally, if there is one; and what is left to do, once the process is through or dead."""
        self._heard = time.monotonic()
        try:
            part: Tally | None = self.pipe.recv()
        except EOFError:
            return self.lost("the worker died")
        if part is None:
            return None, self._end([Share(self.share.target, self.done, self.share.end)])
        self.done += part.inputs
        return part, []

    def lost(self, fault: str) -> tuple[Tally, list[Share]]:
        """The input at hand is the culprit; those before it since the last word are judged again."""
        number = self._current.value
        failure = Failure(self.share.target, number, fault)
        tally = Tally(self.share.target, inputs=1, failed=1, failures=[failure])
        before, after = (self.done, number), (number + 1, self.share.end)
        return tally, self._end([Share(self.share.target, *span) for span in (before, after)])

    def _end(self, left: list[Share]) -> list[Share]:
        self._process.kill()
        self._process.join()
        self.pipe.close()
        return [share for share in left if share.begin < share.end]


def campaign(shares: Iterable[Share], seed: int, processes: int) -> Iterator[Tally]:
    """The tallies of shares, part by part. A worker that dies or goes silent is the fault of its input."""
    waiting, busy = list(reversed(list(shares))), list[_Worker]()
    while waiting or busy:
        while waiting and len(busy) < processes:
            busy.append(_Worker(waiting.pop(), seed))
        ready = wait([worker.pipe for worker in busy], 1.0)
        for worker in [one for one in busy if one.pipe in ready or one.silent]:
            tally, left = worker.hears() if worker.pipe in ready else worker.lost("the worker went silent")
            if worker.pipe.closed:
                busy.remove(worker)
                waiting += left
            if tally is not None:
                yield tally
