"""Single messages that tell more than they say: what stops a robot, who calls whom, what cannot be read."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from mmsverify.audit.rules import Breach
from mmsverify.audit.words import ROBOT_STATE
from mmsverify.errors import DecodeError
from mmsverify.formats.mms import Pdu
from mmsverify.model.rows import Clause

UNCONFIRMED = 0xA3
ADDITIONAL = frozenset({0x83, 0xA3})
"""[3] inside an unconfirmed PDU, primitive or constructed."""
LONG_LENGTH = 0x80


def alarming(pdu: Pdu) -> str:
    """What stops the robot, where the message tells of it."""
    if pdu.kind == "confirmed-ResponsePDU" and pdu.service == "vMDStop":
        return "VMD Stop"
    detail = pdu.detail
    if isinstance(detail, Mapping) and detail.get("robotVMDState") == len(ROBOT_STATE) - 1:
        return f"it told of {ROBOT_STATE[-1]}"
    return ""


def of_caller(pdu: Pdu) -> Iterator[Breach]:
    """An unconfirmed service of the side that opened the connection: no robot's status belongs there."""
    if pdu.service == "unsolicitedStatus" and pdu.detail is not None:
        yield Breach("protocol.status-of-caller")


def undecodable(octets: bytes, error: DecodeError, clause: Clause) -> Breach:
    """Octets that are no PDU, against what ``clause`` encodes; an additional service has its own rule."""
    if octets[:1] == bytes([UNCONFIRMED]) and len(octets) > 2:
        long = octets[1] - LONG_LENGTH
        begin = 2 + max(0, long)
        if octets[begin : begin + 1] and octets[begin] in ADDITIONAL:
            return Breach("protocol.additional-unconfirmed")
    return Breach("protocol.undecodable", {"cause": str(error)}, clause=clause)
