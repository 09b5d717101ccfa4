"""COTP class 0 (ISO/IEC 8073, X.224): from TPDUs to TSDUs. What a TSDU says is ``session``'s business."""

from __future__ import annotations

from mmsverify.formats.capture.faults import UnreadableError

DATA, CONNECT, CONFIRM = 0xF0, 0xE0, 0xD0
_CONTROL = {
    CONNECT: 6,
    CONFIRM: 6,
    0x80: 6,
    0xC0: 5,
    0x70: 4,
}  # with DR, DC, ER: the shortest length indicator
_LARGEST = 16 << 20  # octets of one TSDU; MMS negotiates some 64 KiB


class Assembler:
    """One direction of a connection: joins the data TPDUs up to the one that ends the TSDU (EOT)."""

    def __init__(self) -> None:
        self._held = bytearray()

    def feed(self, tpdu: bytes) -> bytes | None:
        """Take in one TPDU; give the TSDU that it completes, if any. Raises ``UnreadableError``."""
        if len(tpdu) < 2:
            raise UnreadableError("cotp", f"a TPDU of {len(tpdu)} octets")
        indicator, kind = tpdu[0], tpdu[1] & 0xF0
        if indicator + 1 > len(tpdu):
            raise UnreadableError("cotp", f"a TPDU head of {indicator + 1} octets in {len(tpdu)}")
        if kind == DATA and tpdu[1] == DATA and indicator == 2:
            return self._data(tpdu)
        if indicator < _CONTROL.get(kind, 255):
            raise UnreadableError("cotp", f"octets {tpdu[:3].hex()} begin no TPDU of class 0")
        return None

    def lose(self) -> None:
        """Something is missing: what was joined so far will never be whole."""
        self._held.clear()

    @property
    def pending(self) -> int:
        """Octets of a TSDU whose end has not come."""
        return len(self._held)

    def _data(self, tpdu: bytes) -> bytes | None:
        self._held += tpdu[3:]
        if len(self._held) > _LARGEST:
            self._held.clear()
            raise UnreadableError("cotp", f"a TSDU of more than {_LARGEST} octets")
        if not tpdu[2] & 0x80:
            return None
        tsdu = bytes(self._held)
        self._held.clear()
        return tsdu
