"""Modbus/TCP on one connection: from octets to ADUs by the MBAP header's length. They are not read.

MODBUS Messaging on TCP/IP Implementation Guide V1.0b, 3.1.3: transaction, protocol (0), length, unit, PDU.
"""

from __future__ import annotations

from collections.abc import Iterator

from mmsverify.errors import DecodeError
from mmsverify.formats import modbus
from mmsverify.formats.capture.faults import Fault
from mmsverify.formats.trace import Sender

_HEAD = 6  # up to and including the length
_SHORTEST, _LONGEST = 2, 254  # unit identifier and PDU: at least a function code, at most 253 octets


class ModbusConnection:
    """One connection. Where no ADU can begin, the rest of the segment is skipped."""

    def __init__(self) -> None:
        self._held: dict[Sender, bytes] = {"client": b"", "server": b""}

    def feed(self, sender: Sender, data: bytes) -> Iterator[bytes | Fault]:
        """Take in octets of one side; give ADUs and faults in order."""
        held, at = self._held[sender] + data, 0
        self._held[sender] = b""
        while at < len(held):
            head, left = held[at : at + _HEAD], len(held) - at
            reason = _wrong(head)
            if reason:
                yield Fault("modbus", f"{left} octets that are no ADU: {reason}")
                return
            size = _HEAD + int.from_bytes(head[4:6])
            if left < _HEAD or left < size:
                self._held[sender] = held[at:]
                return
            yield held[at : at + size]
            at += size

    def lose(self, sender: Sender) -> None:
        """Octets of this side are missing from here on back."""
        self._held[sender] = b""

    def end(self, sender: Sender) -> Fault | None:
        """The stream of this side ends: what is left over?"""
        left = len(self._held[sender])
        self._held[sender] = b""
        return Fault("modbus", f"the stream ends after {left} octets of an ADU") if left else None


def _wrong(held: bytes) -> str:
    """Why no ADU begins here, as far as the octets that are there can tell."""
    if any(held[2:4]):
        return f"protocol {held[2:4].hex()}, not 0"
    if len(held) >= _HEAD and not _SHORTEST <= int.from_bytes(held[4:6]) <= _LONGEST:
        return f"a length of {int.from_bytes(held[4:6])}"
    return ""


def looks_like_modbus(data: bytes) -> bool:
    """Whether a side's first octets are those of Modbus on a port where nobody expects it.

    They must be one whole ADU and nothing else, and either a request that is right in every field or an
    answer whose counts are: two octets of zeros and a length alone stand in many protocols.
    """
    try:
        adu = modbus.decode(data)
    except DecodeError:
        return False
    asked = modbus.request(adu)
    return asked is not None and (not asked.amiss or _counts(adu))


def _counts(adu: modbus.Adu) -> bool:
    """Whether an ADU is the answer to a read: as many octets as it says, of words an even number."""
    reads = adu.function <= modbus.Function.READ_INPUT_REGISTERS
    even = adu.function in modbus.BITS or len(adu.data) % 2 == 1
    return reads and even and len(adu.data) > 1 and adu.data[0] == len(adu.data) - 1
