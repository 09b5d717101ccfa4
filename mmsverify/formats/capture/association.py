"""MMS on one TCP connection: the layers joined, from octets to MMS PDUs. No layer's format is spelled here.

What a layer cannot read becomes a fault; the connection goes on. Without the association's beginning (a
recording that starts in the middle) contexts are unknown, and a value is taken for what its first octets say.
"""

from __future__ import annotations

from collections.abc import Iterator

from mmsverify.formats import ber
from mmsverify.formats.capture import acse, cotp, presentation, session, tpkt
from mmsverify.formats.capture.faults import Fault, UnreadableError
from mmsverify.formats.capture.presentation import Value
from mmsverify.formats.trace import Sender

PDU_TAGS = frozenset((*range(0xA0, 0xA5), 0x85, 0x86, *range(0xA7, 0xAB), 0x8B, 0x8C, 0xAD))
"""The first octets of an MMS PDU (ISO 9506-2, MMSpdu): every alternative is told by one octet."""

_TPKT = b"\x03\x00"
_DATA_TRANSFER = bytes.fromhex(
    "02f080 01000100"
)  # a data TPDU that ends its TSDU; GIVE TOKENS, DATA TRANSFER


class _Side:
    def __init__(self, *, aligned: bool) -> None:
        self.framer = tpkt.Framer(aligned=aligned)
        self.assembler = cotp.Assembler()


class Association:
    """One MMS association. ``aligned``: the connection's first octets are in the capture."""

    def __init__(self, *, aligned: bool) -> None:
        self._sides: dict[Sender, _Side] = {
            "client": _Side(aligned=aligned),
            "server": _Side(aligned=aligned),
        }
        self._proposed: list[tuple[int, bytes]] = []
        self._contexts: dict[int, bytes] | None = None  # accepted ones: identifier, abstract syntax

    def feed(self, sender: Sender, data: bytes) -> Iterator[bytes | Fault]:
        """Take in octets of one side; give MMS PDUs and faults in order."""
        side = self._sides[sender]
        plain = self._plain(side, data)
        if plain is not None:
            yield plain
            return
        for tpdu in side.framer.feed(data):
            if isinstance(tpdu, Fault):
                side.assembler.lose()
                yield tpdu
                continue
            try:
                tsdu = side.assembler.feed(tpdu)
                if tsdu is not None:
                    yield from self._tsdu(tsdu)
            except UnreadableError as error:
                side.assembler.lose()
                yield error.fault

    def _plain(self, side: _Side, data: bytes) -> bytes | Fault | None:
        """The PDU of octets that are one TPKT with every layer as plain as it mostly is; else nothing.

        What it gives is what the layers would give, one after the other, in three times the time.
        """
        whole = data[:2] == _TPKT and data[4:11] == _DATA_TRANSFER and data[2] << 8 | data[3] == len(data)
        if not whole or not side.framer.idle or side.assembler.pending:
            return None
        value = presentation.plain(data, 11)
        if value is None or (self._contexts is not None and value.context not in self._contexts):
            return None
        return None if self._is_acse(value) else _pdu(value.octets)

    def lose(self, sender: Sender) -> None:
        """Octets of this side are missing from here on back."""
        self._sides[sender].framer.lose()
        self._sides[sender].assembler.lose()

    def end(self, sender: Sender) -> Fault | None:
        """The stream of this side ends: what is left over?"""
        side = self._sides[sender]
        left, pending = side.framer.end(), side.assembler.pending
        side.assembler.lose()
        return left or (
            Fault("cotp", f"the stream ends after {pending} octets of a TSDU") if pending else None
        )

    def _tsdu(self, tsdu: bytes) -> Iterator[bytes | Fault]:
        if tsdu and tsdu[0] in PDU_TAGS:  # MMS directly on transport: no SPDU begins with these octets
            yield _pdu(tsdu)
            return
        spdu = session.read(tsdu)
        if spdu.remark is not None:
            yield spdu.remark
        for value in self._values(spdu):
            yield from self._value(value)

    def _values(self, spdu: session.Spdu) -> list[Value]:
        if spdu.kind == session.CONNECT:
            return self._connect(spdu.user)
        if spdu.kind == session.ACCEPT:
            return self._accept(spdu.user)
        if spdu.kind == session.ABORT:
            return presentation.abort(spdu.user)
        return presentation.values(spdu.user) if spdu.user else []

    def _connect(self, user: bytes) -> list[Value]:
        self._proposed, values = presentation.connect(user)
        self._contexts = dict(self._proposed)
        return values

    def _accept(self, user: bytes) -> list[Value]:
        results, values = presentation.accept(user)
        if self._proposed and results:
            pairs = zip(self._proposed, results, strict=False)
            self._contexts = dict(context for context, accepted in pairs if accepted)
        return values

    def _value(self, value: Value) -> Iterator[bytes | Fault]:
        if not self._is_acse(value):
            yield _pdu(value.octets)
            return
        for inner in acse.user_information(value.octets):
            self._check_context(inner)
            yield _pdu(inner.octets)

    def _is_acse(self, value: Value) -> bool:
        if self._contexts is None:
            return value.octets[:1] != b"" and value.octets[0] in acse.APDUS
        self._check_context(value)
        return self._contexts.get(value.context) == presentation.ACSE

    def _check_context(self, value: Value) -> None:
        if self._contexts is not None and value.context not in self._contexts:
            raise UnreadableError("presentation", f"context {value.context} was not negotiated")


def _pdu(octets: bytes) -> bytes | Fault:
    """Octets that look like one whole MMS PDU, or why they do not; what is inside is not looked at."""
    if not octets:
        return Fault("mms", "an empty presentation data value")
    if octets[0] not in PDU_TAGS:
        return Fault("mms", f"{octets[0]:02X} begins no MMS PDU", octets=octets)
    try:
        _, _, end = ber.header(octets, 0, len(octets))
    except ber.Fault as fault:
        return Fault("mms", f"octet {fault.offset}: {fault.cause}", octets=octets)
    left = len(octets) - end
    return Fault("mms", f"{left} octets after an MMS PDU", octets=octets) if left else octets
