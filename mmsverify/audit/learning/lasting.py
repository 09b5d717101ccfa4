"""What a thread keeps from one recording to the next: automata and what was learned.

Nothing in it depends on which recordings were audited before, or in which order, but the time that it saves.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Any, TypeVar, cast

T = TypeVar("T")
MOST = 12
"""Things that are kept: tables for each variant and profile, and the arrays of the kernel."""


class Lasting:
    """Things by what they depend on; those that were used longest ago make room."""

    def __init__(self) -> None:
        self._things: OrderedDict[Hashable, Any] = OrderedDict()

    def get(self, key: Hashable, make: Callable[[], T]) -> T:
        """The thing of that key, made where there is none yet."""
        if key not in self._things:
            self._things[key] = make()
            if len(self._things) > MOST:
                self._things.popitem(last=False)
        self._things.move_to_end(key)
        return cast(T, self._things[key])

    def clear(self) -> None:
        """Keep nothing: after an interrupt in the middle of something nobody knows what is whole."""
        self._things.clear()


class _OfThread(threading.local):
    def __init__(self) -> None:
        self.lasting = Lasting()


_OF_THREAD = _OfThread()


def of_thread() -> Lasting:
    """What this thread keeps: nothing of it can be used by two at once."""
    return _OF_THREAD.lasting
