"""A device or controller whose automaton builds itself: what it has seen once it need not think about again.

A step that told nothing is remembered: from which state, by which class of events, to which state. Where the
conversation repeats itself, a look into a table is all; where it does not, the device itself is asked. Tables
are bounded: what is forgotten costs time, never a finding.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Generic

from mmsverify.audit.learning.classes import Classes, Split, whole
from mmsverify.audit.learning.indifference import attempt, compared
from mmsverify.audit.learning.leaves import Span as Place
from mmsverify.audit.learning.leaves import TouchedError, read, real
from mmsverify.audit.learning.marks import Index, InvokeId
from mmsverify.audit.learning.part import Judge, P, Read, Watch
from mmsverify.audit.learning.snapshots import Mark, Own
from mmsverify.audit.learning.tables import NEW, PRESENT, State, Step, Tables, event
from mmsverify.audit.learning.trail import ListedTrail, Trail
from mmsverify.audit.telling import History
from mmsverify.formats.stretch import Stretch
from mmsverify.formats.trace import TraceMessage
from mmsverify.results import Finding

LONGEST = 2048
"""Octets of a message that may have a class: of longer ones few are said twice, and all would be kept."""
_TRIAL = 256  # so many messages are not known, and then it is seen how many were
_REST = 8192  # messages
MOST_LOOKED_AT = 4096
"""Values that are remembered to have been looked at; then only those of messages that still matter are."""
COMPARES = False
"""Whether it is seen to that values which nobody looks at make no difference. They cannot; it takes long."""

Span = tuple[int, int]
"""Two indices of messages, both within."""


class Learned(Generic[P]):
    """A part, and what was learned of such parts.

    ``make`` makes a part that has not seen anything, where one is needed; parts of one ``kind`` are then in
    the same state. ``whole``: its messages have no invokeIDs, and all that they say counts. ``exact``:
    nothing is learned, and every message is judged by itself; so it is within the spans ``blind``. ``watch``
    is told what is known after every message; the tables must then be ones that nobody has used unwatched.

    Whoever follows a conversation by the tables alone moves ``state`` and ``invokes`` (the invokeIDs that are
    among the marks of the state), and adds the steps to the ``trail``.
    """

    def __init__(
        self,
        make: Callable[[History], P],
        tables: Tables,
        judge: Judge[P],
        *,
        kind: Hashable = None,
        whole: bool = False,
        exact: bool = False,
        blind: Sequence[Span] = (),
        watch: Watch | None = None,
    ) -> None:
        self.tables = tables
        self.state: State | None = None
        self.invokes: tuple[int, ...] = ()
        self.trail: Trail = ListedTrail()
        self._exact, self._blind, self._judge, self._whole = exact, blind, judge, whole
        self._watch = watch
        self._history = History()
        self._make = make
        self._heard: dict[str, tuple[Split, Classes]] = {}
        self._looked_at: set[tuple[int, Place]] = set()
        self._part: P | None = None
        self._own: Own = {}
        self._grown = tables.root
        self._marks: list[Mark] = []
        self._written: dict[Step, int] = {}  # what the history does not know yet
        self._missed = self._began_trial = self._rests_until = 0
        if not exact:
            self.state = tables.initial.get(kind)
        if self.state is None:
            self._part = make(self._history)
            if not exact:
                self._intern(self._part)
                tables.initial[kind] = self.state

    def listener(self, role: Hashable, split: Split, topic: str = "") -> Listener:
        """Who takes in the messages of one channel.

        ``role`` tells it from the other channels of the device, in this recording and in any other. ``split``
        takes the invokeID out of a message. ``topic`` is the channel's.
        """
        classes = self.tables.classes(role)
        self._heard[topic] = split, classes
        return Listener(self, classes, split, self._whole)

    def hear(
        self,
        message: TraceMessage,
        stretch: Stretch,
        parts: tuple[bytes, int | None] | None,
        classes: Classes,
        judge: Judge[P] | None = None,
    ) -> Iterator[Finding]:
        """The findings of a message that was not followed by the tables alone.

        ``parts``: the message without its invokeID, and that; ``None`` where the message has no class.
        ``judge``: who judges it, where it is not the usual one, and looks at all of it.
        """
        act, marked = judge or self._judge, _marked(message)
        if parts is None or self._alone(message):
            part = self.awake(stretch)
            self.state = None
            yield from act(part, marked, None)
        else:
            whole = judge is not None or self._whole
            number = self.tables.number(classes, parts[0], message.data, whole=whole)
            yield from self._classed(act, number, parts, marked, stretch)
        if self._watch is not None:
            self._look(self._watch, message, stretch)

    def _classed(
        self,
        act: Judge[P],
        number: int,
        parts: tuple[bytes, int | None],
        marked: TraceMessage,
        stretch: Stretch,
    ) -> Iterator[Finding]:
        """The findings of a message that has a class."""
        if number not in self.tables.seen:  # the first of a class is only noted
            self.tables.seen.add(number)
            part = self.awake(stretch)
            self.state = None
            yield from act(part, marked, self._reading(number))
            return
        if self.state is None:
            self._intern(self.awake(stretch))
        if not self._known(number, parts[1], stretch):
            yield from self._learn(act, number, parts, marked, stretch)

    def _look(self, watch: Watch, message: TraceMessage, stretch: Stretch) -> None:
        """Tell what is known after a message, if no trail is left that tells it."""
        if not self.trail:
            state = self.state
            shows = state.shows if state is not None else None
            watch(message.index, message.time, self.awake(stretch).shows() if shows is None else shows)

    def _reading(self, number: int) -> Read | None:
        """How messages of a class are read, so that the values that it leaves out can be told from others."""
        spans = self.tables.leaves.get(number)
        return None if spans is None else partial(read, spans=spans, make=real)

    def _known(self, number: int, invoke: int | None, stretch: Stretch) -> bool:
        """Take the step of an event if the tables know it, as whoever follows by them would."""
        state = self.state
        step = state.steps.get(event(number, self.relation(invoke))) if state is not None else None
        if step is None:
            return False
        if step.moves is not None:
            self.invokes = tuple(invoke if m == PRESENT else self.invokes[m] for m in step.moves)  # type: ignore[misc]
        self.state = step.target
        self.trail.append(step, stretch.places[-1])
        return True

    def relation(self, invoke: int | None) -> int:
        """Which of the state's invokeIDs it is: the last one, should two sides use the same."""
        return max((n for n, held in enumerate(self.invokes) if held == invoke), default=NEW)

    def awake(self, stretch: Stretch) -> P:
        """The part itself, in the state that the tables have led to."""
        self.catch_up(stretch)
        self._history.write_down((step.wrote, index) for step, index in self._written.items())
        self._written.clear()
        if self._part is None:
            assert self.state is not None
            if not self._own:  # of the part that is made only what no state changes is used
                self.tables.snapshots.take(self._make(self._history), self._own)
            part: P = self.tables.snapshots.put_back(self.state.octets, self._marks, self._own)
            self._grown = self.state.grown
            part.grow(self._grown.path[len(part.grown) :])
            self._part = part
        return self._part

    def blinded(self, spans: Sequence[Span]) -> None:
        """Within these spans of indices, too, every message is judged by itself."""
        self._blind = spans
        self.state = None

    # The exact way.

    def _alone(self, message: TraceMessage) -> bool:
        """Whether a message is one of which nothing can be learned."""
        index = message.index
        blind = any(first <= index <= last for first, last in self._blind)
        return self._exact or blind or len(message.data) > LONGEST or self._rests(index)

    def _learn(
        self,
        judge: Judge[P],
        number: int,
        parts: tuple[bytes, int | None],
        message: TraceMessage,
        stretch: Stretch,
    ) -> Iterator[Finding]:
        """Ask the device, and remember the step if it told nothing."""
        part, invoke = self.awake(stretch), parts[1]
        before, marks, relation = self.state, self._marks, self.relation(invoke)
        told, epoch = False, self.tables.epoch
        for finding in judge(part, message, self._reading(number)):
            told = True
            yield finding
        told = told or self._history.told_at(message.index)
        self._intern(part)
        if told or self.state is None or before is None or self.tables.epoch != epoch:
            return
        if not self._indifferent(before, marks, message, number, judge):
            return
        sources = self._sources(marks, message, invoke)
        if sources is not None:
            wrote = self._history.written_at(message.index)
            self.tables.learn(before, event(number, relation), self.state, sources, wrote)

    def _indifferent(
        self, before: State, marks: Sequence[Mark], message: TraceMessage, number: int, judge: Judge[P]
    ) -> bool:
        """Whether the step that was taken is the same whatever the values are that its class leaves out.

        If not, those that were looked at are part of the class from now on.
        """
        part, spans = self._part, dict(self.tables.leaves.get(number, {}))
        assert part is not None
        assert self.state is not None
        if not (before.leafy or self.state.leafy or spans):
            return True
        if before.grown is not self._grown:  # a state of before could not be put back any more
            return False
        touched: dict[Place, int] = {}
        while True:
            try:
                blind = attempt(self.tables, self._own, before, marks, message, spans, judge)
                break
            except TouchedError as error:
                self._looked_at.add((error.message.index, error.span))
                if error.message.index != message.index:
                    self.tables.note(error.message.data, [error.span], ())
                    self._narrow(error.message, [error.span])
                    self._put_in_order(part)
                    return False
                touched[error.span] = 1
                del spans[error.span]
            except Exception:  # a hidden value has no type: what was tried with which, nobody can say
                if not spans:
                    return False
                touched |= dict.fromkeys(spans, 1)
                spans.clear()
        self.tables.note(message.data, touched, spans)
        if touched:
            self._narrow(message, touched)
            self._put_in_order(part)
            return False
        if COMPARES:
            own = {**self._own, History: self._history}
            assert compared(self.tables, blind, own) == compared(self.tables, part, own)
        return True

    def _put_in_order(self, part: P) -> None:
        """Let the part hold values that were looked at as what they are."""
        if len(self._looked_at) > MOST_LOOKED_AT:
            held = {mark.index for mark in self._marks if isinstance(mark, TraceMessage)}
            self._looked_at = {(index, span) for index, span in self._looked_at if index in held}
        self._intern(part)
        self._part = None if self.state is not None else part

    def _narrow(self, message: TraceMessage, touched: Iterable[Place]) -> None:
        """From now on these values are part of the class of their message, be it one of before."""
        split, classes = self._heard.get(message.topic, (whole, Classes()))
        parts = split(message.data)
        number = None if parts is None else classes.find(parts[0])
        if parts is not None and number is not None:
            self.tables.narrow(classes, number, parts[0], message.data, touched)

    def _rests(self, index: int) -> bool:
        """Whether nothing is learned for a while: where little comes again, to learn is a waste."""
        if index < self._rests_until:
            return True
        self._missed += 1
        if self._missed % _TRIAL == 0:
            of = index - self._began_trial  # so many messages, of this part or of others
            self._began_trial = index
            if self._missed > 2 * _TRIAL and of < 2 * _TRIAL:
                self._rests_until = self._began_trial = index + _REST
        return False

    def _intern(self, part: P) -> None:
        """Find out in which state the part is."""
        part.settle()
        taken = self.tables.snapshots.take(part, self._own, self._looked_at)
        self._grown = self.tables.grown(part.grown, self._grown)
        self._marks = list(taken.marks)
        self.state = self.tables.state(taken, self._grown)
        self.invokes = tuple(int(mark) for mark in self._marks if isinstance(mark, InvokeId))
        if self._watch is not None and self.state is not None and self.state.shows is None:
            self.state.shows = part.shows()

    def _sources(
        self, marks: Sequence[Mark], message: TraceMessage, invoke: int | None
    ) -> tuple[int, ...] | None:
        """Where the marks of the present state come from; ``None`` where one comes from nowhere."""
        before = {_name(mark): place for place, mark in reversed(list(enumerate(marks)))}
        found: list[int] = []
        for mark in self._marks:
            place = before.get(_name(mark), PRESENT)
            if place == PRESENT and _name(mark)[1] != (invoke if type(mark) is InvokeId else message.index):
                return None
            found.append(place)
        return tuple(found)

    # What the tables alone have done.

    def catch_up(self, stretch: Stretch) -> None:
        """Write down what the steps of the trail have done, before their stretch is gone."""
        if not self.trail:
            return
        if self._watch is not None:
            self._tell_trail(self._watch, stretch)
        for step, passed in self.trail.last_written(stretch):
            self._written[step] = stretch.index + passed
        assert self.state is not None
        invokes = iter(self.invokes)
        self._marks = [
            InvokeId(next(invokes)) if kind is InvokeId else self._traced(place, kind, stretch)
            for place, kind in enumerate(self.state.kinds)
        ]
        self._part = None
        self.trail.clear()

    def _tell_trail(self, watch: Watch, stretch: Stretch) -> None:
        """Tell where on the trail something else was known than before."""
        assert isinstance(self.trail, ListedTrail), "who is watched goes without the kernel"
        before = None
        for step, at in zip(self.trail.steps, self.trail.places, strict=True):
            shows = step.target.shows
            if shows is not None and shows is not before:
                watch(stretch.index + stretch.passed(at), stretch.time(at), shows)
            before = shows

    def _traced(self, place: int, kind: type, stretch: Stretch) -> Mark:
        """A mark of the present state, from the message that it comes from."""
        passed, place = self.trail.origin(place, stretch)
        if passed is None:
            return self._marks[place]
        index = stretch.index + passed
        return Index(index) if kind is Index else _marked(stretch.message(stretch.places[passed]))


@dataclass(slots=True, eq=False)
class Listener:
    """One channel: whose it is, and the classes of its messages."""

    learned: Learned[Any]
    classes: Classes
    split: Split
    whole: bool

    def hear(self, message: TraceMessage, stretch: Stretch) -> Iterator[Finding]:
        """The findings of a message."""
        return self.learned.hear(message, stretch, self.split(message.data), self.classes)


def _marked(message: TraceMessage) -> TraceMessage:
    return TraceMessage(Index(message.index), message.time, message.channel, message.data)


def _name(mark: Mark) -> tuple[str, int]:
    if isinstance(mark, TraceMessage):
        return "message", mark.index
    return type(mark).__name__, int(mark)
