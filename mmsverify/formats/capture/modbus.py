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
                yield Fault("modbus", f"{left} octets that are no ADU: {reason}", octets=held[at:])
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
        left, self._held[sender] = self._held[sender], b""
        reason = f"the stream ends after {len(left)} octets of an ADU"
        return Fault("modbus", reason, octets=left) if left else None


def _wrong(held: bytes) -> str:
    """Why no ADU begins here, as far as the octets that are there can tell."""
    if any(held[2:4]):
        return f"protocol {held[2:4].hex()}, not 0"
    if len(held) >= _HEAD and not _SHORTEST <= int.from_bytes(held[4:6]) <= _LONGEST:
        return f"a length of {int.from_bytes(held[4:6])}"
    return ""


def asks(data: bytes) -> bool | None:
    """Whether octets are Modbus requests (true) or answers (false); ``None`` where they are neither.

    For ports where nobody expects Modbus: they must be whole ADUs and nothing else, and one of them a request
    that is right in every field, or an answer whose counts are. Two octets of zeros and a length alone stand
    in many protocols.
    """
    try:
        found = {_asks(adu) for adu in _whole(data)}
    except DecodeError:
        return None
    return True if True in found else False if False in found else None


def _whole(data: bytes) -> Iterator[modbus.Adu]:
    at = 0
    while at < len(data):
        size = _HEAD + int.from_bytes(data[at + 4 : at + _HEAD])
        yield modbus.decode(data[at : at + size])
        at += size


def _asks(adu: modbus.Adu) -> bool | None:
    """Whether an ADU is a request, or an answer; ``None`` where it does not show."""
    code = adu.function & ~modbus.EXCEPTION
    if adu.exception:
        return False if code in set(modbus.Function) and len(adu.data) == 1 and adu.data[0] < 12 else None
    asked = modbus.request(adu)
    if asked is not None and not asked.amiss:
        return True
    if asked is not None and code in modbus.MULTIPLE:
        return False if len(adu.data) == 4 else None
    even = code in modbus.BITS or len(adu.data) % 2 == 1
    counted = len(adu.data) > 1 and adu.data[0] == len(adu.data) - 1
    return False if asked is not None and even and counted else None
