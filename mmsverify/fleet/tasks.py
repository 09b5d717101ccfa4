"""What is shared among processes, and what each way of sharing must do."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Protocol

from mmsverify.formats.locations import Location
from mmsverify.formats.passing import Watcher
from mmsverify.results import AuditedInput, Finding

UNREADABLE = "input.unreadable"
"""The rule of a file that is no recording, or of the point at which one cannot be read on."""

LOCAL = "local"
"""In the place of a scheduler's address: a cluster of this machine, for one audit."""

SELDOM = (50_000, 20, 100)
"""When the garbage collector looks, in a process that audits or checks: states, rows and formulas are made by
the thousand and are no garbage, and seldom looking saves a tenth."""

Done = tuple[AuditedInput | None, list[Finding]]
"""How a recording was read (``None``: not at all), and what was found in it."""
Task = Callable[..., Done]
"""What is done with a `Location`; in this process it may also be given who is told how far it is."""


class Engine(Protocol):
    """Does a task for every path. The numbers of the paths come with their results, each once, in any order.

    What a task raises ends the work and is raised; a process that dies under it does not: see `killed`.
    """

    def __call__(self, task: Task, paths: Sequence[Location]) -> Iterator[tuple[int, Done]]: ...


def here(
    task: Task, paths: Sequence[Location], *, progress: Watcher | None = None
) -> Iterator[tuple[int, Done]]:
    """The engine of this process: one after the other, and how far each is."""
    for number, path in enumerate(paths):
        if progress is None:
            yield number, task(path)
        else:
            progress.begin(path)
            done = task(path, progress.passed)
            progress.finish()
            yield number, done


def unreadable(path: str, message: str) -> Finding:
    """What is told of a recording that cannot be read, or not to its end."""
    return Finding(
        path=path, index=None, time=None, topic=None, vmd=None, severity="error", rule=UNREADABLE,
        clauses=("R-7.3.1-2",), message=message,
    )  # fmt: skip


def killed(path: Location) -> Done:
    """The result of a recording under which a process dies that had no other to do."""
    cure = "give it more memory, or audit it by itself"
    return None, [unreadable(str(path), f"{path}: the process that audited it was killed ({cure})")]
