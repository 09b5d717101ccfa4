"""A line controller and a panel that read and write a robot's signals over Modbus/TCP, with three faults."""

from __future__ import annotations

import struct

from mmsverify.formats.trace import Sender
from mmsverify.samples.recording import Recording

READ_COILS, READ_INPUTS, WRITE_COIL, WRITE_COILS = 0x01, 0x02, 0x05, 0x0F
ON = 0xFF00
ILLEGAL_ADDRESS = 2
LINE, PANEL = "line", "panel"
DEDICATED = [9, 10]


class Talk:
    """Two clients and the server; each transaction has the next number of its connection."""

    def __init__(self, server: str = "robot4") -> None:
        self.recording = Recording(server)
        self._transactions = {LINE: 0, PANEL: 0}

    def opens(self, client: str) -> None:
        """A client connects."""
        self.recording.wait(0.4)
        self.recording.link(client, "open", "modbus")

    def asks(self, client: str, function: int, first: int, second: int, rest: bytes = b"") -> None:
        """A request: a function code, an address, and a quantity or a value."""
        self._transactions[client] += 1
        self._say(client, "client", struct.pack(">BHH", function, first, second) + rest)

    def answers(self, client: str, function: int, data: bytes) -> None:
        """The server's answer to the last request of a client."""
        self._say(client, "server", bytes([function]) + data)

    def _say(self, client: str, sender: Sender, pdu: bytes) -> None:
        header = struct.pack(">HHHB", self._transactions[client], 0, len(pdu) + 1, 1)
        self.recording.send(client, sender, header + pdu)

    def polls(self, client: str, pattern: int) -> None:
        """Eight inputs are read."""
        self.asks(client, READ_INPUTS, 1001, 8)
        self.answers(client, READ_INPUTS, bytes([1, pattern]))

    def sets(self, client: str, signal: int) -> None:
        """A signal is set, and the server says so."""
        self.asks(client, WRITE_COIL, signal, ON)
        self.answers(client, WRITE_COIL, struct.pack(">HH", signal, ON))


def faulty_signals() -> Recording:
    """A dedicated signal is written, 0x02 reads internal signals, an answer goes the wrong way."""
    talk = Talk()
    talk.opens(LINE)
    for pattern in (0b1, 0b11, 0b111):
        talk.polls(LINE, pattern)
    talk.sets(LINE, 17)
    talk.opens(PANEL)
    talk.asks(PANEL, WRITE_COIL, 961, ON)
    talk.answers(PANEL, WRITE_COIL | 0x80, bytes([ILLEGAL_ADDRESS]))
    talk.sets(PANEL, DEDICATED[0])
    talk.polls(LINE, 0b1111)
    talk.asks(PANEL, READ_INPUTS, 2001, 16)
    talk.answers(PANEL, READ_INPUTS, bytes([2, 0, 1]))
    talk.asks(LINE, READ_COILS, 17, 8)
    talk.recording.send(PANEL, "server", struct.pack(">HHHBBBB", 6, 0, 4, 1, READ_COILS, 1, 1))
    talk.polls(PANEL, 0b1111)
    talk.recording.link(PANEL, "close", "modbus")
    talk.recording.link(LINE, "close", "modbus")
    return talk.recording
