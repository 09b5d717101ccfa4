"""TPKT (RFC 1006, RFC 2126): from an octet stream to TPDUs. What a TPDU says is ``cotp``'s business.

The format has no mark to find again: after a hole the next boundary is where a TPKT head is followed by a
TPDU that fits it.
"""

from __future__ import annotations

from collections.abc import Iterator

from mmsverify.formats.capture.faults import Fault

HEAD = 4
_SHORTEST = 7
_PROBE = 7  # octets needed to recognise a boundary
_DATA, _CONNECT, _CONFIRM, _DISCONNECT = 0xF0, 0xE0, 0xD0, 0x80


def boundary(octets: bytes | bytearray, at: int = 0) -> bool:
    """Whether a TPKT that holds a class 0 TPDU seems to begin at ``at``, as far as seven octets can tell.

    Where fewer are there, it is true as long as more octets could make it so.
    """
    if bytes(octets[at : at + 2]) != b"\x03\x00"[: len(octets) - at]:
        return False
    if len(octets) - at < _PROBE:
        return True
    length = octets[at + 2] << 8 | octets[at + 3]
    indicator, kind = octets[at + 4], octets[at + 5]
    if kind == _DATA:
        return indicator == 2 and length >= _SHORTEST and not octets[at + 6] & 0x7F
    return kind in (_CONNECT, _CONFIRM, _DISCONNECT) and 6 <= indicator <= length - HEAD - 1


class Framer:
    """One direction of a connection. ``aligned`` says that the first octet is known to begin a TPKT."""

    def __init__(self, *, aligned: bool) -> None:
        self._aligned = aligned
        self._held = bytearray()

    def feed(self, data: bytes) -> Iterator[bytes | Fault]:
        """Take in octets; give TPDUs, and a fault where octets were skipped."""
        self._held += data
        while self._held:
            if not self._aligned:
                yield from self._search()
                if not self._aligned:
                    return
            if self._held[0] != 3 or (len(self._held) >= HEAD and self._length < _SHORTEST):
                self._aligned = False
                yield self._skip(1, self._misfit())
                continue
            if len(self._held) < HEAD or len(self._held) < self._length:
                return
            length = self._length
            tpdu = bytes(self._held[HEAD:length])
            del self._held[:length]
            yield tpdu

    @property
    def idle(self) -> bool:
        """Whether the next octet is known to begin a TPKT."""
        return self._aligned and not self._held

    def lose(self) -> None:
        """Octets are missing: forget the TPKT in hand, look for the next one."""
        self._held.clear()
        self._aligned = False

    def end(self) -> Fault | None:
        """The stream ends: what of a TPKT is left over?"""
        left = len(self._held)
        self._held.clear()
        return Fault("tpkt", f"the stream ends after {left} octets of a TPKT") if left else None

    @property
    def _length(self) -> int:
        return self._held[2] << 8 | self._held[3]

    def _misfit(self) -> str:
        if self._held[0] != 3:
            return f"{self._held[0]:02X} where a TPKT begins (03)"
        return f"a TPKT of {self._length} octets, fewer than {_SHORTEST}"

    def _search(self) -> Iterator[Fault]:
        size = len(self._held)
        at = self._held.find(3)
        while at >= 0 and not boundary(self._held, at):
            at = self._held.find(3, at + 1)
        at = size if at < 0 else at
        self._aligned = at + _PROBE <= size
        if at:
            yield self._skip(at, f"{at} octets that belong to no TPKT")

    def _skip(self, count: int, reason: str) -> Fault:
        del self._held[:count]
        return Fault("tpkt", reason)
