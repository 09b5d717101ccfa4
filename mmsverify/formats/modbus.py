"""Modbus/TCP: octets to ADUs, and the PDUs of the function codes that open signals and registers.

An ADU is the MBAP header (transaction, protocol and length of two octets each, unit of one) and a PDU, which
is a function code and its data (section 2.2 of the text on the server; Modbus application protocol 1.1b3,
section 6, for the layouts). Reading is strict: a length, a count or a value that disagrees with the octets is
an error, for that is what an audit looks for.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from enum import IntEnum

from mmsverify.errors import DecodeError


@dataclass(frozen=True, slots=True)
class Field:
    """A field of the MBAP header. ``code`` is its size, as ``struct`` writes it."""

    name: str
    code: str
    cites: tuple[str, ...]


MBAP = (
    Field("transaction identifier", "H", ("M-2.2-5", "M-2.2-2")),
    Field("protocol identifier", "H", ("M-2.2-5", "M-2.2-2")),
    Field("length", "H", ("M-2.2-5", "M-2.2-2", "M-2.2-6")),
    # What the unit identifier leads to lies behind the server; the device itself is found by its connection.
    Field("unit identifier", "B", ("M-2.2-5", "M-2.2-2", "M-2.2-4")),
)
HEADER = struct.Struct(">" + "".join(field.code for field in MBAP))
EXCEPTION = 0x80
LARGEST_PDU = 253
ON, OFF = 0xFF00, 0x0000


class Function(IntEnum):
    """The function codes that the text, or a reading of it, opens to clients."""

    READ_COILS = 0x01
    READ_DISCRETE_INPUTS = 0x02
    READ_HOLDING_REGISTERS = 0x03
    READ_INPUT_REGISTERS = 0x04
    WRITE_SINGLE_COIL = 0x05
    WRITE_SINGLE_REGISTER = 0x06
    WRITE_MULTIPLE_COILS = 0x0F
    WRITE_MULTIPLE_REGISTERS = 0x10


BITS = frozenset({Function.READ_COILS, Function.READ_DISCRETE_INPUTS, Function.WRITE_SINGLE_COIL,
                  Function.WRITE_MULTIPLE_COILS})  # fmt: skip
"""The function codes for signals; the others are for words."""
SINGLE = frozenset({Function.WRITE_SINGLE_COIL, Function.WRITE_SINGLE_REGISTER})
MULTIPLE = frozenset({Function.WRITE_MULTIPLE_COILS, Function.WRITE_MULTIPLE_REGISTERS})
MOST = {
    Function.READ_COILS: 2000, Function.READ_DISCRETE_INPUTS: 2000, Function.WRITE_MULTIPLE_COILS: 1968,
    Function.READ_HOLDING_REGISTERS: 125, Function.READ_INPUT_REGISTERS: 125,
    Function.WRITE_MULTIPLE_REGISTERS: 123,
}  # fmt: skip
"""How many points or words one request may name."""


@dataclass(frozen=True, slots=True)
class Adu:
    """One ADU: the header without its length, the function code, and the data after it."""

    transaction: int
    unit: int
    function: int
    data: bytes

    @property
    def exception(self) -> bool:
        """Whether a server refuses with it."""
        return self.function >= EXCEPTION


@dataclass(frozen=True, slots=True)
class Request:
    """What a request asks for: ``address`` as the PDU holds it, ``value`` of a single write.

    ``amiss`` says what of its data no client may send; such a request must be refused.
    """

    function: Function
    address: int
    quantity: int
    value: int = 0
    amiss: str = ""


def decode(octets: bytes) -> Adu:
    """One whole ADU. Raises ``DecodeError`` where the octets are none, or more than one."""
    if len(octets) <= HEADER.size:
        raise DecodeError("too short for a header and a function code", offset=len(octets))
    transaction, protocol, length, unit = HEADER.unpack_from(octets)
    if protocol != 0:
        raise DecodeError(f"the protocol identifier is {protocol}, not 0", offset=2)
    if length != len(octets) - HEADER.size + 1:
        raise DecodeError(
            f"the length says {length} octets, and {len(octets) - HEADER.size + 1} follow it", offset=4
        )
    if length > LARGEST_PDU + 1:
        raise DecodeError(f"a PDU of {length - 1} octets, and {LARGEST_PDU} is the most", offset=4)
    return Adu(transaction, unit, octets[HEADER.size], octets[HEADER.size + 1 :])


def encode(adu: Adu) -> bytes:
    """The octets of an ADU."""
    header = HEADER.pack(adu.transaction, 0, len(adu.data) + 2, adu.unit)
    return header + bytes([adu.function]) + adu.data


def request(adu: Adu) -> Request | None:
    """What an ADU asks for; ``None`` for a function code that is none of ``Function``."""
    try:
        function = Function(adu.function)
    except ValueError:
        return None
    if len(adu.data) < 4:
        return Request(function, 0, 1, amiss="its data are too short")
    address, second = struct.unpack_from(">HH", adu.data)
    if function in SINGLE:
        return Request(function, address, 1, second, _of_single(function, second, adu.data))
    return Request(function, address, second, amiss=_of_many(function, second, adu.data[4:]))


def _of_single(function: Function, value: int, data: bytes) -> str:
    if len(data) != 4:
        return f"it has {len(data)} octets of data, not 4"
    if function is Function.WRITE_SINGLE_COIL and value not in (ON, OFF):
        return f"the value is {value:#06x}, neither ON nor OFF"
    return ""


def _of_many(function: Function, quantity: int, rest: bytes) -> str:
    if not 1 <= quantity <= MOST[function]:
        return f"it names {quantity} points, and 1 to {MOST[function]} are possible"
    writes = function in MULTIPLE
    octets = size(function, quantity) if writes else 0
    if len(rest) != (1 + octets if writes else 0):
        return f"{len(rest)} octets follow the quantity"
    if writes and rest[0] != octets:
        return f"the byte count is {rest[0]}, not {octets}"
    return ""


def size(function: Function, quantity: int) -> int:
    """The octets that hold so many points or words."""
    return (quantity + 7) // 8 if function in BITS else 2 * quantity


def unlike(asked: Request, answer: Adu) -> str:
    """What of a normal response does not belong to the request; nothing if it is right."""
    data = answer.data
    if asked.function not in SINGLE | MULTIPLE:
        octets = size(asked.function, asked.quantity)
        counted = data[0] if data else "missing"
        right = counted == octets == len(data) - 1
        return (
            "" if right else f"{max(0, len(data) - 1)} octets of values, byte count {counted}, not {octets}"
        )
    if len(data) != 4:
        return f"{len(data)} octets of data, not 4"
    address, second = struct.unpack(">HH", data)
    what, wanted = ("value", asked.value) if asked.function in SINGLE else ("quantity", asked.quantity)
    if address != asked.address:
        return f"address {address}, not {asked.address}"
    return "" if second == wanted else f"{what} {second}, not {wanted}"
