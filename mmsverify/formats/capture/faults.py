"""What a layer could not read, as data. Nothing here knows any layer's format."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Fault:
    """Octets that are not what their layer says. ``layer`` is one of tcp, tpkt, cotp, session, ..., modbus.

    ``lost`` is false where what the octets carry could be read all the same. ``octets`` are those that stand
    where a message of the protocol should, as far as they can be told apart.
    """

    layer: str
    reason: str
    lost: bool = True
    octets: bytes = b""


class UnreadableError(Exception):
    """Raised by the parser of one layer, caught where the layers are joined; never leaves the package."""

    def __init__(self, layer: str, reason: str) -> None:
        super().__init__(reason)
        self.fault = Fault(layer, reason)
