"""One server: its connections, the requests that wait on each, the answers. Messages in, findings out."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from mmsverify.audit.modbus.access import Access, Plan
from mmsverify.audit.modbus.memory import Memory, writes
from mmsverify.audit.modbus.rules import MODBUS_RULES
from mmsverify.audit.rule import Breach
from mmsverify.audit.telling import Place, of_rule
from mmsverify.errors import DecodeError
from mmsverify.formats import modbus
from mmsverify.formats.modbus import EXCEPTION, Adu, Request
from mmsverify.formats.trace import TraceMessage
from mmsverify.model.rows import Conjunct
from mmsverify.results import Finding

LOCAL_REASONS = frozenset({4, 5, 6, 8, 10, 11})
"""Exceptions for reasons that no message shows: a failure, a long job, a busy server, a gateway."""


@dataclass(slots=True)
class Asked:
    """A request that waits: its message and what it says.

    ``passed``: a later one has been answered. ``lost``: its answer may be missing in the recording.
    """

    message: TraceMessage
    adu: Adu
    request: Request | None
    passed: bool = False
    lost: bool = False

    @property
    def writes(self) -> bool:
        """Whether it asks for a change, or may."""
        return self.request is None or bool(self.request.amiss) or writes(self.request)

    @property
    def overdue(self) -> bool:
        """Whether its answer should have come."""
        return self.passed and not self.lost


@dataclass(slots=True)
class Connection:
    """What is known of one connection.

    ``state``: "" where its opening is not in the recording, else "open", or how it ended; ``number`` counts
    the openings. ``blind``: requests
    may be missing, so that an answer may be to one of them. ``excess``: it was opened while as many as may be
    served were open, and has not been answered since.
    """

    state: str = ""
    blind: bool = True
    number: int = -1
    told_closed: bool = False
    excess: TraceMessage | None = None
    asked: dict[int, Asked] = field(default_factory=dict)

    def lose(self) -> None:
        """Messages are missing."""
        self.blind = True
        for asked in self.asked.values():
            asked.lost = True


@dataclass(slots=True)
class Crowd:
    """More connections than may be served at once seem to be, since ``at``.

    By their numbers: ``proven`` are those that certainly were, ``others`` those of which it may yet show.
    """

    at: TraceMessage
    others: set[int]
    proven: set[int]


class Server:
    """The replay of one server's messages."""

    def __init__(self, place: Place, access: Access, plan: Plan) -> None:
        self._place, self._access, self._plan = place, access, plan
        self._connections: dict[str, Connection] = {}
        self._most = plan.profile["max_clients"]
        self._memory = Memory()
        self._opened = 0
        self._crowds: list[Crowd] = []
        self._strays: set[int] = set()
        self._overdue: list[Asked] = []
        self._overtakes = False

    # Connections.

    def link(self, name: str, event: str, message: TraceMessage) -> None:
        """A connection opens, closes, is reset, or has a gap: messages may be missing before this point."""
        connection = self._connections.setdefault(name, Connection())
        if event == "gap":
            connection.lose()
            self._memory.lose()
            return
        self._pass_over(connection)
        self._leave(connection)
        if event == "open":
            served = sum(
                other.state == "open" for other in self._connections.values() if other is not connection
            )
            excess = message if served >= self._most else None
            self._opened += 1
            self._connections[name] = Connection("open", blind=False, number=self._opened, excess=excess)
        else:
            self._connections[name] = Connection("closed" if event == "close" else "reset", blind=False)

    def end(self) -> Iterator[Finding]:
        """The recording ends: what was not answered, though a later request was.

        The server of the text answers one request after the other. Of one that lets answers overtake each
        other nothing is told: a client may leave before the last ones come.
        """
        for connection in self._connections.values():
            self._pass_over(connection)
        if not self._overtakes:
            overdue = (asked for asked in self._overdue if asked.adu.transaction not in self._strays)
            yield from (self._found(asked.message, "modbus.unanswered") for asked in overdue)

    def _leave(self, connection: Connection) -> None:
        """A connection is over: of whether it was served at some time nothing more will show."""
        for crowd in self._crowds:
            crowd.others.discard(connection.number)
        self._crowds = [c for c in self._crowds if len(c.proven) + len(c.others) > self._most]

    def _pass_over(self, connection: Connection) -> None:
        """The requests of a connection are not answered any more."""
        self._overdue += [asked for asked in connection.asked.values() if asked.overdue]
        for asked in connection.asked.values():
            self._memory.give_up(asked.message.index)

    # Messages.

    def message(self, message: TraceMessage) -> Iterator[Finding]:
        """The findings of one ADU."""
        sender = message.metadata.get("sender", "client")
        connection = self._connections.setdefault(message.metadata.get("connection", ""), Connection())
        if connection.state in ("closed", "reset"):
            self._memory.lose()
            if not connection.told_closed:
                connection.told_closed = True
                yield self._found(message, "modbus.closed", sender=sender, event=connection.state)
            return
        try:
            adu = modbus.decode(message.data)
        except DecodeError as error:
            connection.lose()  # whatever it was, it may have been a request, or an answer
            self._memory.lose()
            yield self._found(message, "modbus.undecodable", cause=error.cause)
            return
        if sender == "client":
            self._asked(connection, Asked(message, adu, modbus.request(adu)))
            return
        yield from self._served(connection)
        yield from self._answered(connection, adu, message)

    def doubt(self, message: TraceMessage) -> None:
        """A message comes that is not believed: it occupies nothing, but may have written something."""
        if message.metadata.get("sender", "client") != "client":
            return
        try:
            asked = Asked(message, adu := modbus.decode(message.data), modbus.request(adu))
        except DecodeError:
            self._memory.lose()
            return
        if asked.writes:
            sound = asked.request is not None and not asked.request.amiss
            self._memory.ask(message.index, asked.request if sound else None)
            self._memory.give_up(message.index)

    def _served(self, connection: Connection) -> Iterator[Finding]:
        """The server says something on a connection: it holds a socket for it.

        Clients are accepted in the order in which they came: one is served once another one has left. That
        others have not left is certain only when they are answered later: a client's leaving may be
        recorded late.
        """
        for crowd in self._crowds:
            if connection.number in crowd.others:
                crowd.others.discard(connection.number)
                crowd.proven.add(connection.number)
        if connection.excess is not None:
            at, connection.excess = connection.excess, None
            held = (c for c in self._connections.values() if c.state == "open" and c.excess is None)
            others = {c.number for c in held} - {connection.number}
            if len(others) >= self._most:
                self._crowds.append(Crowd(at, others, {connection.number}))
        for crowd in [crowd for crowd in self._crowds if len(crowd.proven) > self._most]:
            self._crowds.remove(crowd)
            yield self._found(crowd.at, "modbus.too-many", count=len(crowd.proven), most=self._most)

    def _asked(self, connection: Connection, asked: Asked) -> None:
        # The first request of a transaction that is used again is not answered any more.
        again = connection.asked.pop(asked.adu.transaction, None)
        if again is not None:
            self._memory.give_up(again.message.index)
            self._overdue += [again] if again.overdue else []
        if asked.writes:
            sound = asked.request is not None and not asked.request.amiss
            self._memory.ask(asked.message.index, asked.request if sound else None)
        connection.asked[asked.adu.transaction] = asked

    def _answered(self, connection: Connection, adu: Adu, message: TraceMessage) -> Iterator[Finding]:
        asked = connection.asked.pop(adu.transaction, None)
        if asked is None:
            self._memory.lose()
            if not connection.blind:
                self._strays.add(adu.transaction)  # it may have been meant for another connection
                yield self._found(message, "modbus.unasked", transaction=adu.transaction)
            return
        connection.blind = False
        self._overtakes = self._overtakes or asked.passed
        for other in connection.asked.values():
            other.passed = other.passed or other.message.index < asked.message.index
        wrong = list(self._judged(asked, adu))
        yield from (of_rule(self._place, message, MODBUS_RULES[each.rule], each) for each in wrong)
        told = list(self._accessed(asked, adu, message))
        yield from told
        yield from self._remembered(asked, adu, message, amiss=bool(wrong or told))

    def _judged(self, asked: Asked, adu: Adu) -> Iterator[Breach]:
        """An answer against its request, the access apart; the first thing that is wrong."""
        related = (asked.message.index,)
        if adu.unit != asked.adu.unit:
            yield Breach("modbus.unit", {"found": adu.unit, "wanted": asked.adu.unit}, related)
        elif adu.function & ~EXCEPTION != asked.adu.function:
            yield Breach(
                "modbus.function",
                {"found": f"{adu.function:#04x}", "wanted": f"{asked.adu.function:#04x}"},
                related,
            )
        elif adu.exception:
            if len(adu.data) != 1 or adu.data[0] == 0:
                yield Breach("modbus.exception", {"cause": f"data {adu.data.hex() or 'missing'}"}, related)
        elif (
            asked.request is not None
            and not asked.request.amiss
            and (cause := modbus.unlike(asked.request, adu))
        ):
            yield Breach("modbus.response", {"cause": cause}, related)

    def _accessed(self, asked: Asked, adu: Adu, message: TraceMessage) -> Iterator[Finding]:
        """Whether the request had to be refused, by the model."""
        if asked.request is None or adu.function & ~EXCEPTION != asked.adu.function:
            return
        points = self._plan.points(asked.request)
        refusal = self._access.refusal(asked.request, points)
        if adu.exception:
            if refusal is None and adu.data[:1] and adu.data[0] not in LOCAL_REASONS:
                yield self._found(message, "modbus.refused", code=adu.data[0], related=(asked.message.index,))
        elif refusal is not None:
            yield self._wrongly_accepted(asked, asked.request, message, refusal)

    def _remembered(self, asked: Asked, adu: Adu, message: TraceMessage, *, amiss: bool) -> Iterator[Finding]:
        """Keep what was written; tell what is read back as something else. What is amiss teaches nothing."""
        number = asked.message.index
        if amiss:
            self._memory.give_up(number)
            self._memory.lose()
        elif asked.writes and (adu.exception or asked.request is None):
            self._memory.refuse(number)
        elif asked.writes:
            self._memory.accept(number, asked.adu, message.index)
        elif asked.request is not None and not adu.exception:
            yield from self._read_back(asked, asked.request, adu, message)

    def _read_back(
        self, asked: Asked, request: Request, adu: Adu, message: TraceMessage
    ) -> Iterator[Finding]:
        found = self._memory.read(request, adu, asked.message.index)
        for (bit, address), value, written in found[:1]:
            more = f" (and {len(found) - 1} more with it)" if found[1:] else ""
            yield self._found(
                message,
                "modbus.read-back",
                related=(written.asked, asked.message.index),
                what="coil" if bit else "register",
                address=address,
                found=value,
                written=written.value,
                more=more,
            )

    def _wrongly_accepted(
        self, asked: Asked, request: Request, message: TraceMessage, refusal: Conjunct
    ) -> Finding:
        what = f"{request.function:#04x}, {request.quantity} from {request.address}"
        amiss = f" ({request.amiss})" if request.amiss else ""
        says = f"{what}, is answered by no exception, but {refusal.says}{amiss}"
        return Finding(
            path=self._place.path, vmd=self._place.vmd,
            index=message.index, time=message.time, topic=message.topic,
            severity="error", rule=refusal.rule, message=says,
            clauses=refusal.clause.ids, readings=refusal.clause.readings,
            expected=("result(-)",), observed="result(+)", related=(asked.message.index,),
        )  # fmt: skip

    def _found(
        self, message: TraceMessage, name: str, related: tuple[int, ...] = (), **words: object
    ) -> Finding:
        return of_rule(self._place, message, MODBUS_RULES[name], Breach(name, words, related))
