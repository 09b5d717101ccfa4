"""Cancel: a request that its sender no longer wants, and how the peer answers.

A Cancel that succeeds is answered, and so is the request: by an error. One that comes too late, or for an
invokeID that nobody uses, fails.
"""

from __future__ import annotations

from collections.abc import Container, Iterator
from dataclasses import dataclass

from mmsverify.audit.rules import Breach
from mmsverify.formats.mms import Pdu, error_class_code

Key = tuple[str, int]
"""The side that asked, and its invokeID."""
UNKNOWN = ("cancel", 1)
PDU_UNKNOWN = ("pdu-error", 0)


@dataclass(slots=True)
class _Pending:
    """A Cancel that waits for its answer: whether it came in time, and whether the request was performed."""

    index: int
    in_time: bool
    performed: bool = False


class Cancels:
    """The Cancels of one association."""

    def __init__(self) -> None:
        self._pending: dict[Key, _Pending] = {}
        self._granted: dict[Key, int] = {}

    def clear(self) -> None:
        """The association ends, or messages may be missing."""
        self._pending.clear()
        self._granted.clear()

    def requested(self, key: Key, index: int, outstanding: Container[Key]) -> None:
        """Cancel is asked for."""
        self._pending[key] = _Pending(index, key in outstanding)

    def answered(self, key: Key, pdu: Pdu) -> Iterator[Breach]:
        """The request itself is answered."""
        granted = self._granted.pop(key, None)
        performed = pdu.kind == "confirmed-ResponsePDU"
        if granted is not None and performed:
            yield Breach("cancel.performed", {"invoke": key[1]}, (granted,))
        elif key in self._pending:
            self._pending[key].performed = performed

    def granted(self, key: Key, outstanding: Container[Key], *, begun: bool) -> Iterator[Breach]:
        """Cancel is answered positively; ``begun``: the recording shows the association as a whole."""
        pending = self._pending.pop(key, None)
        words = {"invoke": key[1]}
        if pending is None:
            if begun:
                yield Breach("cancel.unasked", words)
        elif pending.performed:
            yield Breach("cancel.performed", words, (pending.index,))
        elif begun and not pending.in_time:
            yield Breach("cancel.unknown", words, (pending.index,))
        elif key in outstanding:
            self._granted[key] = pending.index

    def refused(self, key: Key, pdu: Pdu, outstanding: Container[Key], *, begun: bool) -> Iterator[Breach]:
        """Cancel is answered negatively."""
        pending = self._pending.pop(key, None)
        cause = error_class_code(pdu.body)
        if pending is None:
            if begun:
                yield Breach("cancel.unasked", {"invoke": key[1]})
        elif (cause.class_name, cause.code) == UNKNOWN and key in outstanding:
            yield Breach("cancel.known", {"invoke": key[1]}, (pending.index,))

    def rejected(self, asker: str, pdu: Pdu) -> int | None:
        """The Cancel that a Reject without an invokeID calls an unknown PDU, if there is just one."""
        mine = [key for key in self._pending if key[0] == asker]
        if pdu.invoke_id is not None or pdu.body["rejectReason"] != PDU_UNKNOWN or len(mine) != 1:
            return None
        return self._pending.pop(mine[0]).index
