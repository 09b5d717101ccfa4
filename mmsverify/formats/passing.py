"""How far a file has been read, told now and then to whoever watches: once a slice, never once a message."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator
from typing import TypeVar

Passed = Callable[[int, int], None]
"""Takes the octets of the file that are passed, and the messages so far."""

PAUSE = 0.1
"""Seconds between two tellings, at least."""
_SLICE = 256  # messages; a batch may be a whole file, and judging one message may take milliseconds

T = TypeVar("T")


def told(
    batches: Iterable[list[T]],
    position: Callable[[], int],
    passed: Passed,
    clock: Callable[[], float] = time.monotonic,
) -> Iterator[list[T]]:
    """The same messages in slices. ``position`` says how far the file has been read for the last batch.

    Told at the begin, then at most ten times a second, and at the end.
    """
    octets = messages = 0
    passed(octets, messages)
    due = clock() + PAUSE
    for batch in batches:
        begin, octets = octets, position()
        for at in range(0, len(batch), _SLICE):
            part = batch[at : at + _SLICE]
            yield part
            messages += len(part)
            if clock() >= due:
                passed(begin + (octets - begin) * (at + len(part)) // len(batch), messages)
                due = clock() + PAUSE
    passed(octets, messages)
