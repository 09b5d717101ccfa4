"""The messages of one device around a finding, by turns: a request with its answer, or a message by itself.

Its indices are spread out, so that there is room for messages that were never said.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from mmsverify.audit.causes.doubting import OF_REQUESTS
from mmsverify.audit.exchange import OTHER_SIDE
from mmsverify.audit.lookahead import link
from mmsverify.errors import DecodeError
from mmsverify.formats import mms
from mmsverify.formats.mms import Pdu
from mmsverify.formats.trace import TraceMessage

SPREAD = 4
INITIATE, INITIATED = "initiate-RequestPDU", ("initiate-ResponsePDU", "initiate-ErrorPDU")
CONCLUDE, CONCLUDED = "conclude-RequestPDU", ("conclude-ResponsePDU", "conclude-ErrorPDU")
Key = tuple[str, str, int | None]


@dataclass(frozen=True, slots=True)
class Turn:
    """Positions in the conversation: ``at`` is that of the answer where there is one, else of the message."""

    at: int
    positions: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Conversation:
    """``turns`` in the order of the messages that say them; ``turn_of`` the number of each position's turn.

    Link events belong to no turn (-1). ``pdus`` are what the messages say, ``None`` for what is no PDU.
    """

    messages: Sequence[TraceMessage]
    pdus: Sequence[Pdu | None]
    turns: Sequence[Turn]
    turn_of: Sequence[int]

    def position(self, index: int) -> int:
        """Where the message with this index of the recording stands."""
        return next(at for at, message in enumerate(self.messages) if message.index == spread_out(index))

    def request(self, position: int) -> int | None:
        """Where the request stands that the message answers."""
        positions = self.turns[self.turn_of[position]].positions
        return positions[0] if len(positions) > 1 and positions[0] != position else None

    def answers_nothing(self, position: int) -> bool:
        """Whether it is an answer to a request that is not there."""
        pdu = self.pdus[position]
        return pdu is not None and pdu.kind in OF_REQUESTS and self.request(position) is None

    def begin(self, first: int) -> int:
        """Where one must begin to listen so that no turn from ``first`` on is missed.

        Turns that are under way there are heard from their beginning.
        """
        begin = min((self.turns[n].positions[0] for n in range(first, len(self.turns))), default=0)
        while True:
            under_way = [t.positions[0] for t in self.turns if t.positions[0] < begin <= t.positions[-1]]
            if not under_way:
                return begin
            begin = min(under_way)


def spread_out(index: int) -> int:
    """The place of a message of the recording, with room before it."""
    return (index + 1) * SPREAD


def recorded(index: int) -> int:
    """The index in the recording of the message at such a place."""
    return index // SPREAD - 1


def conversation(messages: Iterable[TraceMessage]) -> Conversation:
    """The conversation of these messages, whose indices are those of the recording."""
    spaced = [replace(message, index=spread_out(message.index)) for message in messages]
    pdus = [_read(message) for message in spaced]
    waiting: dict[Key, int] = {}
    partner: dict[int, int] = {}
    for at, (message, pdu) in enumerate(zip(spaced, pdus, strict=True)):
        if pdu is None:
            continue
        name, side = message.metadata.get("association", ""), message.metadata.get("sender", "client")
        if pdu.kind in ("confirmed-RequestPDU", INITIATE, CONCLUDE):
            waiting[name, side, _number(pdu)] = at
        elif pdu.kind in OF_REQUESTS or pdu.kind in INITIATED or pdu.kind in CONCLUDED:
            asked = waiting.pop((name, OTHER_SIDE.get(side, ""), _number(pdu)), None)
            if asked is not None:
                partner[asked] = at
    answers = set(partner.values())
    said = [(partner.get(at, at), at) for at, pdu in enumerate(pdus) if at not in answers]
    said = [pair for pair in said if link(spaced[pair[1]]) is None]
    turns = [Turn(at, tuple(sorted({begun, at}))) for at, begun in sorted(said)]
    turn_of = [-1] * len(spaced)
    for number, turn in enumerate(turns):
        for position in turn.positions:
            turn_of[position] = number
    return Conversation(spaced, pdus, turns, turn_of)


def _number(pdu: Pdu) -> int | None:
    """What pairs answers with requests; Initiate and Conclude have numbers of their own here."""
    if pdu.kind == INITIATE or pdu.kind in INITIATED:
        return -1
    return -2 if pdu.kind == CONCLUDE or pdu.kind in CONCLUDED else pdu.invoke_id


def _read(message: TraceMessage) -> Pdu | None:
    if message.message_encoding != "mms-ber":
        return None
    try:
        return mms.decode(message.data)
    except DecodeError:
        return None
