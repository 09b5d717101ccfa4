"""The session layer (ISO 8327-1, X.225): from a TSDU to the kind and the user data of its SPDU."""

from __future__ import annotations

from typing import NamedTuple

from mmsverify.formats.capture.faults import Fault, UnreadableError

CONNECT, ACCEPT, DATA, ABORT = "CONNECT", "ACCEPT", "DATA TRANSFER", "ABORT"
_KINDS = {
    0x05: "EXPEDITED DATA",
    0x08: "NOT FINISHED",
    0x09: "FINISH",
    0x0A: "DISCONNECT",
    0x0C: "REFUSE",
    0x0D: CONNECT,
    0x0E: ACCEPT,
    0x19: ABORT,
    0x1A: "ABORT ACCEPT",
    0x21: "TYPED DATA",
}
_TOKENS_OR_DATA = 0x01  # GIVE TOKENS where it comes first, DATA TRANSFER after it
_PLEASE_TOKENS = 0x02
_USER_DATA, _EXTENDED_USER_DATA, _ENCLOSURE = 0xC1, 0xC2, 0x19
_WHOLE = b"\x03"  # enclosure item: beginning and end of the SSDU
_PRESENTATION = (0x31, 0x61)  # a CP or CPA; fully encoded data
_FOREIGN = {0x32: "S7 communication", 0x72: "S7 communication plus"}


class Spdu(NamedTuple):
    """One SPDU: its kind, the presentation's data, and what was odd about it though it could be read."""

    kind: str
    user: bytes
    remark: Fault | None = None


def read(tsdu: bytes) -> Spdu:
    """Read one TSDU: a single SPDU, or GIVE TOKENS with DATA TRANSFER behind. Raises ``UnreadableError``."""
    if not tsdu:
        raise UnreadableError("session", "an empty TSDU")
    if tsdu[0] in (_TOKENS_OR_DATA, _PLEASE_TOKENS):
        return _data(tsdu)
    kind = _KINDS.get(tsdu[0])
    if kind is None:
        name = _FOREIGN.get(tsdu[0])
        what = f"{name}, not MMS" if name else "no SPDU that carries MMS"
        raise UnreadableError("session", f"first octet {tsdu[0]:02X}: {what}")
    length, begin = _length(tsdu, 1)
    excess = max(begin + length - len(tsdu), 0)
    user, empty = _user_data(tsdu[begin : begin + length])
    return Spdu(kind, user, _remark(kind, excess, salvaged=empty))


def _data(tsdu: bytes) -> Spdu:
    length, at = _length(tsdu, 1)
    at += length
    if at + 2 > len(tsdu):  # tokens alone
        return Spdu("GIVE TOKENS", b"")
    if tsdu[at] != _TOKENS_OR_DATA:
        raise UnreadableError("session", f"an SPDU {tsdu[at]:02X} concatenated to GIVE TOKENS")
    length, begin = _length(tsdu, at + 1)
    if begin + length > len(tsdu):
        raise UnreadableError("session", "DATA TRANSFER is longer than its TSDU")
    if any(
        name == _ENCLOSURE and value != _WHOLE for name, value in _parameters(tsdu[begin : begin + length])
    ):
        raise UnreadableError("session", "a segmented SSDU")
    return Spdu(DATA, tsdu[begin + length :])


def _remark(kind: str, excess: int, *, salvaged: bool) -> Fault | None:
    if excess:
        return Fault("session", f"{kind} claims {excess} octets more than there are", lost=False)
    return Fault("session", f"{kind} claims no user data, but some follows", lost=False) if salvaged else None


def _length(octets: bytes, at: int) -> tuple[int, int]:
    """The length indicator at ``at`` and where what it counts begins: one octet, or FF and two more."""
    if at < len(octets) and octets[at] < 0xFF:
        return octets[at], at + 1
    if at + 3 <= len(octets):
        return octets[at + 1] << 8 | octets[at + 2], at + 3
    raise UnreadableError("session", "the TSDU ends inside a length indicator")


def _parameters(octets: bytes) -> list[tuple[int, bytes]]:
    found: list[tuple[int, bytes]] = []
    at = 0
    while at < len(octets):
        length, begin = _length(octets, at + 1)
        found.append((octets[at], octets[begin : begin + length]))
        at = begin + length
    return found


def _user_data(octets: bytes) -> tuple[bytes, bool]:
    """The user data among an SPDU's parameters, and whether its length had to be guessed.

    Stacks in the field write a user data parameter of length 0 with the presentation's octets behind it.
    """
    at = 0
    while at < len(octets):
        length, begin = _length(octets, at + 1)
        if octets[at] in (_USER_DATA, _EXTENDED_USER_DATA):
            rest = octets[begin:]
            salvaged = not length and rest[:1] != b"" and rest[0] in _PRESENTATION
            return (rest, True) if salvaged else (rest[:length], False)
        at = begin + length
    return b"", False
