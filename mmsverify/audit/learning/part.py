"""What is audited, as the tables see it: a device or a controller."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, ClassVar, Protocol, TypeVar

from mmsverify.audit.telling import History
from mmsverify.formats.trace import TraceMessage
from mmsverify.results import Finding


class Part(Protocol):
    """What is audited: its messages go in, findings come out. ``SHARED`` are the types of what is no state.

    ``grown`` is what it has met: states mean the same only where that is the same, in the same order.
    """

    SHARED: ClassVar[tuple[type, ...]]

    @property
    def history(self) -> History: ...
    @property
    def grown(self) -> Sequence[Any]: ...
    def grow(self, grown: Iterable[Any]) -> None: ...
    def settle(self) -> None: ...
    def shows(self) -> Mapping[str, str]: ...


P = TypeVar("P", bound=Part)
Read = Callable[[TraceMessage], Any]
"""Decodes a message."""
Judge = Callable[[P, TraceMessage, Read | None], Iterator[Finding]]
"""Gives the findings of a message, which is read in that way, where one is given."""
Watch = Callable[[int, int, Mapping[str, str]], None]
"""Is told what is known of a part after a message: its index, its time in ns, each lane with its words."""
