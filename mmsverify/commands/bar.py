"""The bar on stderr while recordings are audited: which one, octets, events a second, time left.

Over the octets of all recordings. Where these are not known beforehand, or several processes share the
recordings, over their number.
"""

from __future__ import annotations

import logging
import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

from mmsverify.formats.locations import Location, Url
from mmsverify.formats.passing import AUDITING, Watcher
from mmsverify.formats.remote import size_of
from mmsverify.report.wording import printable

if TYPE_CHECKING:
    from rich.console import Console
    from rich.progress import Progress


_WIDE = 110  # columns of a terminal; on a narrower one the name needs them more than the bar


@contextmanager
def audit_bar(locations: Sequence[Location], jobs: int, *, quiet: bool) -> Iterator[Watcher | None]:
    """A bar for as long as the audit runs; ``None`` where nobody watches."""
    if quiet:
        with _hushed():
            yield None
        return
    if sys.stderr is None or not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console

    with progress_on(Console(stderr=True)) as progress:
        yield Bar(progress, locations, shared=jobs > 1)


@contextmanager
def _hushed() -> Iterator[None]:
    """Without the warnings that a fleet logs, which go to stderr."""
    logger = logging.getLogger("mmsverify.fleet")
    level = logger.level
    logger.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        logger.setLevel(level)


def progress_on(console: Console, clock: Callable[[], float] = time.monotonic) -> Progress:
    """The columns; what stands in them is a `Bar`'s. The lines are gone when the work is done."""
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn
    from rich.table import Column

    name = TextColumn(
        "{task.description}", markup=False, table_column=Column(no_wrap=True, overflow="ellipsis", ratio=1)
    )
    told = [TextColumn(f"{{task.fields[{field}]}}", markup=False) for field in ("files", "octets", "events")]
    columns = (name, BarColumn(bar_width=24 if console.width >= _WIDE else 8), *told, TimeRemainingColumn())
    return Progress(*columns, console=console, transient=True, expand=True, get_time=clock)


class Bar:
    """A watcher of an audit. ``shared``: several processes share the recordings."""

    def __init__(self, progress: Progress, locations: Sequence[Location], *, shared: bool = False) -> None:
        self._progress = progress
        self._clock = progress.get_time
        self._begun = self._clock()
        self._files, self._done = len(locations), 0
        sizes = [_size(location) for location in locations]
        self._counted = self._files > 1 and (shared or None in sizes)
        self._total = sum(size or 0 for size in sizes)
        self._octets = self._messages = 0  # of the recordings that are done
        self._name, self._size, self._seen = "", 0, (0, 0)
        description = f"auditing {self._files} recordings" if shared else ""
        self._task = progress.add_task(
            description, total=self._files if self._counted else self._total,
            files=self._of_files(), octets="", events="",
        )  # fmt: skip

    def begin(self, location: Location) -> None:
        """A recording is opened."""
        size = _size(location)
        if size is None and isinstance(location, Url) and not self._counted:
            size = size_of(location) or 0
            self._total += size
            self._progress.update(self._task, total=self._total)
        self._name, self._size, self._seen = printable(location.name), size or 0, (0, 0)
        self._progress.update(self._task, description=f"opening {self._name}")

    def wait(self, text: str) -> None:
        """Nothing can begin yet."""
        self._progress.update(self._task, description=printable(text))

    def passed(self, stage: str, octets: int, messages: int) -> None:
        """How far it is; looking over it counts for nothing yet."""
        if stage != AUDITING:
            part = f": {100 * octets // self._size} %" if self._size else ""
            self._progress.update(self._task, description=f"{stage} {self._name}{part}")
            return
        self._seen = octets, messages
        self._show(self._name, self._octets + octets, self._messages + messages)

    def finish(self) -> None:
        """A recording is done, whatever became of it."""
        self._done += 1
        self._octets += self._size or self._seen[0]
        self._messages += self._seen[1]
        self._show(None, self._octets, self._messages)

    def _show(self, description: str | None, octets: int, messages: int) -> None:
        seconds = self._clock() - self._begun
        self._progress.update(
            self._task,
            description=description,
            completed=self._done if self._counted else octets,
            files=self._of_files(),
            octets=_of(octets, 0 if self._counted else self._total) if octets else "",
            events=f"{messages / seconds:,.0f} events/s" if messages and seconds else "",
        )

    def _of_files(self) -> str:
        return f"{self._done}/{self._files} files" if self._files > 1 else ""


def _of(octets: int, total: int) -> str:
    """``12.3/56.0 MB``"""
    from rich.filesize import decimal

    part, whole = decimal(octets), decimal(total)
    if not total:
        return part
    number, _, unit = part.partition(" ")
    return f"{number if whole.endswith(f' {unit}') else part}/{whole}"


def _size(location: Location) -> int | None:
    """The octets of a recording, as far as they are known without asking another machine."""
    if isinstance(location, Url):
        return location.size
    try:
        return os.stat(location).st_size
    except (OSError, ValueError):
        return 0
