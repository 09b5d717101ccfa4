"""The case of one finding of a robot: what is asked of its conversation, by telling it again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from mmsverify.audit.causes.conversation import Conversation, recorded, spread_out
from mmsverify.audit.causes.edits import Edit
from mmsverify.audit.causes.evidence import Found, GivenUpError, smallest
from mmsverify.audit.causes.retelling import Retelling, SpentError
from mmsverify.formats.trace import TraceMessage
from mmsverify.results import Finding

OF_ASSOCIATIONS = ("protocol.", "negotiation.", "association.", "conformance.")
"""Rules of which what was agreed when the association began is likely to be the reason."""
FOR_THE_FIRST, FOR_THE_OTHERS = 400, 320
"""So many steps are worked out at most for the first set, and for all others; one takes 3 ms or so."""
Mark = tuple[int | None, str]
"""A finding by its index, in the spread counting, and its rule."""


@dataclass(slots=True)
class Case:
    """A finding, the conversation around it, and who tells that again.

    ``event`` is the position of the message that the finding is told of, ``until`` that of the message by
    which it shows (of what is missing, a later one). ``states`` are those before each message of the
    conversation as it was, ``found`` what was found by each.
    """

    finding: Finding
    talk: Conversation
    retelling: Retelling
    event: int = 0
    until: int = 0
    states: list[int] = field(default_factory=list)
    found: list[set[Mark]] = field(default_factory=list)

    def listen(self) -> bool:
        """Tell it as it was; whether the finding comes."""
        self.event = self.talk.position(int(self.finding.index or 0))
        state = Retelling.NOTHING
        for message in self.talk.messages:
            self.states.append(state)
            state, told = self.retelling.step(state, message)
            self.found.append({(each.index, each.rule) for each in told})
        self.states.append(state)
        self.until = next((at for at, marks in enumerate(self.found) if self._mark in marks), -1)
        return self.until >= self.event

    @property
    def _mark(self) -> Mark:
        return spread_out(int(self.finding.index or 0)), self.finding.rule

    def evidence(self, most: int) -> list[Found]:
        """The sets of turns before the event that exclude it, each by itself, at most so many.

        No turn is in two of them; each is found with those of the sets before in doubt. None where all turns
        together do not exclude it: then it is out of the window what does.
        """
        sets: list[Found] = []
        left = self._earlier()
        self.retelling.allow(FOR_THE_FIRST)
        while len(sets) < most:
            found = self._evidence(left)
            if found is None or (sets and not found.irreducible):
                break
            sets.append(found)
            if len(sets) == 1:
                self.retelling.allow(FOR_THE_OTHERS)
            if not found.turns or not found.irreducible:
                break
            left = [turn for turn in left if turn not in found.turns]
        return sets

    def _evidence(self, turns: Sequence[int]) -> Found | None:
        related = {spread_out(index) for index in self.finding.related}
        likely = {
            self.talk.turn_of[at] for at, said in enumerate(self.talk.messages) if said.index in related
        }

        def asks(first: int, kept: frozenset[int]) -> bool:
            heard = turns[first] if first < len(turns) else None
            return self._comes(heard, {turns[n] for n in kept}) is not None

        agreed = self.finding.rule.startswith(OF_ASSOCIATIONS)
        alone = [n for n, turn in enumerate(turns) if agreed and self._is_initiate(turn)]
        likely_ones = [n for n, turn in enumerate(turns) if turn in likely]
        found = smallest(len(turns), asks, likely_ones, alone[::-1])
        return None if found is None else Found(tuple(turns[n] for n in found.turns), found.irreducible)

    def _is_initiate(self, turn: int) -> bool:
        pdu = self.talk.pdus[self.talk.turns[turn].at]
        return pdu is not None and pdu.kind.startswith("initiate")

    def _earlier(self) -> list[int]:
        own = self.talk.turn_of[self.event]
        return [n for n, turn in enumerate(self.talk.turns) if turn.positions[0] < self.until and n != own]

    def _comes(self, first: int | None, believed: set[int]) -> Finding | None:
        """The finding, if it comes when these turns are believed, and those before the first unheard."""
        own = self.talk.turn_of[self.event]
        heard = own if first is None else min(own, first)
        begin = self.talk.begin(heard) if first is not None else self.talk.turns[own].positions[0]
        state = Retelling.NOTHING
        try:
            for at in range(begin, self.until + 1):
                turn = self.talk.turn_of[at]
                doubted = turn >= 0 and turn != own and turn not in believed
                state, told = self.retelling.step(state, self.talk.messages[at], doubted=doubted)
                for each in told:
                    if (each.index, each.rule) == self._mark:
                        return each
        except SpentError:
            raise GivenUpError from None
        return None

    def instead(self, edit: Edit, after: int) -> tuple[bool, list[int]]:
        """Tell it with an edit.

        Whether what is said otherwise, and the event, then go without a finding; and which other messages, up
        to ``after`` after the event, then have findings that they did not have.
        """
        state, later = self.states[edit.begin], set[int]()
        own = {message.index for message in edit.said} | {self.talk.messages[self.event].index}
        old = set[Mark]().union(*self.found) - {self._mark}
        end = min(len(self.talk.messages), self.until + 1 + after)
        told_then: list[tuple[int | None, TraceMessage]] = [(None, message) for message in edit.said]
        told_then += [(at, self.talk.messages[at]) for at in range(edit.resume, end)]
        for at, message in told_then:
            if at is not None and at > self.until and state == self.states[at]:
                break  # from here on it is as it was
            state, told = self.retelling.step(state, message)
            new = {(each.index, each.rule) for each in told} - old
            if any(index in own for index, _ in new):
                return False, []
            later |= {recorded(int(index or 0)) for index, _ in new}
        return True, sorted(later)
