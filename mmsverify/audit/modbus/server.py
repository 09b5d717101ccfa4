"""One server: its connections, the requests that wait on each, the answers. Messages in, findings out."""

from __future__ import annotations

from collections import defaultdict
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
    ``contested``: another one that writes was under way meanwhile, and which was performed last is not known.
    """

    message: TraceMessage
    adu: Adu
    request: Request | None
    passed: bool = False
    lost: bool = False
    contested: bool = False

    @property
    def writes(self) -> bool:
        """Whether it asks for a change."""
        return self.request is not None and writes(self.request)

    @property
    def overdue(self) -> bool:
        """Whether its answer should have come."""
        return self.passed and not self.lost


@dataclass(slots=True)
class Connection:
    """What is known of one connection.

    ``state``: "" where its opening is not in the recording, else "open", or how it ended. ``blind``: requests
    may be missing, so that an answer may be to one of them. ``excess``: it was opened while as many as may be
    served were open, and has not been answered since.
    """

    state: str = ""
    blind: bool = True
    told_closed: bool = False
    excess: TraceMessage | None = None
    asked: dict[int, Asked] = field(default_factory=dict)

    def lose(self) -> None:
        """Messages are missing."""
        self.blind = True
        for asked in self.asked.values():
            asked.lost = True


class Server:
    """The replay of one server's messages."""

    def __init__(self, place: Place, access: Access, plan: Plan) -> None:
        self._place, self._access, self._plan = place, access, plan
        self._connections: dict[str, Connection] = {}
        self._most = plan.profile["max_clients"]
        self._memory = defaultdict[int, Memory](Memory)  # by unit
        self._strays: set[int] = set()
        self._overdue: list[Asked] = []
        self._overtakes = False

    # Connections.

    def link(self, name: str, event: str, message: TraceMessage) -> None:
        """A connection opens, closes, is reset, or has a gap: messages may be missing before this point."""
        connection = self._connections.setdefault(name, Connection())
        if event == "gap":
            connection.lose()
            self._memory.clear()
            return
        self._pass_over(connection)
        if event == "open":
            served = sum(
                other.state == "open" for other in self._connections.values() if other is not connection
            )
            excess = message if served >= self._most else None
            self._connections[name] = Connection("open", blind=False, excess=excess)
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

    def _pass_over(self, connection: Connection) -> None:
        """The requests of a connection are not answered any more."""
        self._overdue += [asked for asked in connection.asked.values() if asked.overdue]

    # Messages.

    def message(self, message: TraceMessage) -> Iterator[Finding]:
        """The findings of one ADU."""
        sender = message.metadata.get("sender", "client")
        connection = self._connections.setdefault(message.metadata.get("connection", ""), Connection())
        if connection.state in ("closed", "reset"):
            if not connection.told_closed:
                connection.told_closed = True
                yield self._found(message, "modbus.closed", sender=sender, event=connection.state)
            return
        try:
            adu = modbus.decode(message.data)
        except DecodeError as error:
            connection.lose()  # whatever it was, it may have been a request, or an answer
            self._memory.clear()
            yield self._found(message, "modbus.undecodable", cause=error.cause)
            return
        if sender == "client":
            self._asked(connection, Asked(message, adu, modbus.request(adu)))
            return
        if connection.excess is not None:
            at, connection.excess = connection.excess, None
            # Clients are accepted in the order in which they came: it is served once another one has left.
            count = sum(c.state == "open" and c.excess is None for c in self._connections.values())
            if count > self._most:
                yield self._found(at, "modbus.too-many", count=count, most=self._most)
        yield from self._answered(connection, adu, message)

    def _asked(self, connection: Connection, asked: Asked) -> None:
        again = connection.asked.pop(
            asked.adu.transaction, None
        )  # its first request is not answered any more
        if again is not None and again.overdue:
            self._overdue.append(again)
        if asked.writes and asked.request is not None:
            self._memory[asked.adu.unit].ask(asked.request)
            waiting = (other for each in self._connections.values() for other in each.asked.values())
            for other in waiting:
                asked.contested |= other.writes
                other.contested |= other.writes
        connection.asked[asked.adu.transaction] = asked

    def _answered(self, connection: Connection, adu: Adu, message: TraceMessage) -> Iterator[Finding]:
        asked = connection.asked.pop(adu.transaction, None)
        if asked is None:
            if not connection.blind:
                self._strays.add(adu.transaction)  # it may have been meant for another connection
                yield self._found(message, "modbus.unasked", transaction=adu.transaction)
            return
        connection.blind = False
        self._overtakes = self._overtakes or asked.passed
        for other in connection.asked.values():
            other.passed = other.passed or other.message.index < asked.message.index
        for breach in self._judged(asked, adu):
            yield of_rule(self._place, message, MODBUS_RULES[breach.rule], breach)
        yield from self._accessed(asked, adu, message)

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
        elif not modbus.unlike(asked.request, adu):
            yield from self._remembered(asked, asked.request, adu, message)

    def _remembered(
        self, asked: Asked, request: Request, adu: Adu, message: TraceMessage
    ) -> Iterator[Finding]:
        """Keep what was written; tell what is read back as something else."""
        memory = self._memory[adu.unit]
        if asked.writes:
            if not (asked.contested or asked.lost):
                memory.accept(request, asked.adu.data, asked.message.index, message.index)
            return
        for (bit, address), value, written in memory.read(request, adu, asked.message.index):
            yield self._found(
                message,
                "modbus.read-back",
                related=(written.asked, asked.message.index),
                what="signal at" if bit else "register",
                address=address,
                found=value,
                written=written.value,
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
