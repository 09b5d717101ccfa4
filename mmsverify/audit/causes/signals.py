"""The account of findings of one Modbus server: replayed with messages left out, or said otherwise.

A server's replay is quick, so each question is a replay of the whole conversation, and none is remembered.
A request and its answer are doubted together: then they are not heard, and what a write may have written is
unknown.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from mmsverify.audit.causes.evidence import smallest
from mmsverify.audit.lookahead import link
from mmsverify.audit.parts import Parts
from mmsverify.audit.saying import Reader
from mmsverify.audit.telling import Place
from mmsverify.errors import DecodeError
from mmsverify.formats import modbus
from mmsverify.formats.modbus import EXCEPTION, Adu
from mmsverify.formats.trace import TraceMessage
from mmsverify.incident import Saying
from mmsverify.results import Account, Edit, Evidence, Finding, Ground, Statement

ILLEGAL_ADDRESS = 2
NO_EDIT = "no single message, changed or left out, would make this conversation legal"
Marks = set[tuple[int | None, str]]


@dataclass(frozen=True, slots=True)
class _Trial:
    """Messages said in place of those at some positions, none for one that is left out."""

    edit: Edit
    instead: Mapping[int, TraceMessage | None]


class Signals:
    """Tells of the findings of one server; ``messages`` are all of its conversation."""

    def __init__(self, parts: Parts, place: Place, messages: Sequence[TraceMessage]) -> None:
        self._parts, self._place, self._messages = parts, place, messages
        reader = Reader()
        self._sayings = [reader.saying(message) for message in messages]
        self._at = {message.index: at for at, message in enumerate(messages)}
        self._asked = {
            at: self._at[said.answers] for at, said in enumerate(self._sayings) if said.answers is not None
        }
        self._found = self._marks(self._messages)

    def account(self, finding: Finding, statements: tuple[Statement, ...]) -> Account | None:
        """Why the finding stands; ``None`` where it does not come of these messages."""
        if (finding.index, finding.rule) not in self._found or finding.index is None:
            return None
        event = self._at[finding.index]
        legal = [trial.edit for trial in self._trials(event) if self._is_legal(finding, trial)]
        firsts = {edit.kind: edit for edit in reversed(legal)}
        edits = tuple(edit for edit in legal if firsts[edit.kind] is edit)
        right = next((edit for edit in edits if edit.kind == "change"), None)
        return Account(
            finding=finding,
            event=_words(self._sayings[event]),
            asked=self._sayings[event].answers,
            statements=statements,
            grounds=tuple(self._grounds(finding, event)),
            right=right,
            edits=edits,
            remarks=() if edits else (NO_EDIT,),
        )

    def _marks(self, messages: Sequence[TraceMessage], unheard: Collection[int] = ()) -> Marks:
        """The findings of a conversation, some of whose positions are in doubt."""
        server = self._parts.server(self._place)
        found: list[Finding] = []
        for at, message in enumerate(messages):
            happened = link(message, "modbus")
            if happened is not None:
                server.link(*happened, message)
            elif message.message_encoding == "modbus-tcp" and at in unheard:
                server.doubt(message)
            elif message.message_encoding == "modbus-tcp":
                found += server.message(message)
        return {(each.index, each.rule) for each in (*found, *server.end())}

    # What excludes it.

    def _grounds(self, finding: Finding, event: int) -> Iterator[Ground]:
        own = {event, self._asked.get(event, event)}
        said = [at for at, each in enumerate(self._sayings) if each.sender and at not in own]
        answered = {asked: at for at, asked in self._asked.items()}
        turns = [{at, answered.get(at, at)} for at in said if at not in self._asked and at < event]

        def asks(_: int, kept: frozenset[int]) -> bool:
            doubted = set[int]().union(*(turn for n, turn in enumerate(turns) if n not in kept))
            return (finding.index, finding.rule) in self._marks(self._messages, doubted)

        likely = [
            n for n, turn in enumerate(turns) if {self._sayings[at].index for at in turn} & {*finding.related}
        ]
        found = smallest(len(turns), asks, likely)
        if found is not None:
            yield Ground(tuple(self._evidence(turns[n]) for n in found.turns), found.irreducible)

    def _evidence(self, turn: Collection[int]) -> Evidence:
        said = self._sayings[max(turn)]
        return Evidence(said.index, _words(said), said.answers)

    # What would have been legal.

    def _trials(self, event: int) -> Iterator[_Trial]:
        """The answer an exception; the same on the connection that waits for it; none at all."""
        message, said = self._messages[event], self._sayings[event]
        adu = _read(message)
        if adu is not None and said.sender == "server" and not adu.exception:
            refusal = Adu(adu.transaction, adu.unit, adu.function | EXCEPTION, bytes([ILLEGAL_ADDRESS]))
            other = replace(message, data=modbus.encode(refusal))
            yield self._changed(event, other, f"answers exception {ILLEGAL_ADDRESS}")
        if adu is not None and said.sender == "server":
            yield from self._elsewhere(event, adu)
        dropped = {event: None, self._asked.get(event, event): None}
        what = "the request is not made" if len(dropped) > 1 else "it is not said"
        yield _Trial(Edit("drop", said.index, what, (), said.answers), dropped)

    def _changed(self, event: int, other: TraceMessage, what: str) -> _Trial:
        said = self._sayings[event]
        edit = Edit("change", said.index, what, ((other.topic, other.data),), said.answers)
        return _Trial(edit, {event: other})

    def _elsewhere(self, event: int, adu: Adu) -> Iterator[_Trial]:
        """Said on another connection, where a request of the same transaction waits."""
        waiting: dict[str, tuple[int, TraceMessage]] = {}
        for at in range(event):
            asked, said = _read(self._messages[at]), self._sayings[at]
            if asked is None or asked.transaction != adu.transaction:
                continue
            if said.sender == "client":
                waiting[said.partner] = said.index, self._messages[at]
            else:
                waiting.pop(said.partner, None)
        channels = {self._sayings[at].partner: m.channel for at, m in enumerate(self._messages)
                    if self._sayings[at].sender == "server"}  # fmt: skip
        for name, (index, _) in sorted(waiting.items()):
            if name != self._sayings[event].partner and name in channels:
                other = replace(self._messages[event], channel=channels[name])
                yield self._changed(event, other, f"is said to {name}, whose request #{index} waits for it")

    def _is_legal(self, finding: Finding, trial: _Trial) -> bool:
        told = (trial.instead.get(at, message) for at, message in enumerate(self._messages))
        return self._marks([message for message in told if message is not None]) <= self._found - {
            (finding.index, finding.rule)
        }


def _read(message: TraceMessage) -> Adu | None:
    if message.message_encoding != "modbus-tcp":
        return None
    try:
        return modbus.decode(message.data)
    except DecodeError:
        return None


def _words(said: Saying) -> str:
    shown = [f"{name} {value}" for name, value in said.fields if name in ("address", "quantity", "value")]
    return f"{said.title} ({', '.join(shown)})" if shown else said.title
