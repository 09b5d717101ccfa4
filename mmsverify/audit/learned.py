"""A device or controller whose automaton builds itself: what it has seen once it need not think about again.

A step that told nothing is remembered: from which state, by which class of events, to which state. Where the
conversation repeats itself, a look into a table is all; where it does not, the device itself is asked. Tables
are bounded: what is forgotten costs time, never a finding.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, Generic, Protocol, TypeVar

from mmsverify.audit.classes import Split
from mmsverify.audit.marks import Index, InvokeId
from mmsverify.audit.snapshots import Mark, Snapshot, Snapshots
from mmsverify.audit.telling import History
from mmsverify.concrete.belief.partial import Key
from mmsverify.formats.trace import Channel, TraceMessage
from mmsverify.model import ModelData
from mmsverify.results import Finding

LARGEST = 32 << 20
"""Octets of states that are kept of one part."""
MOST_CLASSES = 1 << 14
LONGEST = 2048
"""Octets of a message that may have a class: of longer ones few are said twice, and all would be kept."""
_MOST_STEPS = 1 << 17
_TRIAL = 256  # so many messages are not known, and then it is seen how many were
_REST = 8192  # messages
_PRESENT = -1  # a mark that comes from the message itself
_NEW = -1  # an invokeID that is none of the state's

Listener = Callable[[int, int, Channel, bytes], Iterator[Finding] | tuple[()]]


@dataclass(slots=True, eq=False)
class _State:
    """A state of the device: how to put it back, which of its marks are invokeIDs, and the steps from it.

    Steps are by class of events, and by the mark that is the event's invokeID.
    """

    octets: bytes
    kinds: tuple[type, ...]
    invokes: tuple[int, ...]
    steps: dict[tuple[int, int], _Step] = field(default_factory=dict)


@dataclass(slots=True, eq=False)
class _Step:
    """What a class of events does in a state: where each mark of the next state comes from.

    ``sources``: by number, those of the state before, or the message (or its invokeID, where true stands
    beside); ``None`` where nothing changes.
    ``wrote``: the cells of the belief that it wrote, with what made them so.
    """

    target: _State
    sources: tuple[tuple[int, bool], ...] | None
    wrote: dict[Key, tuple[str, ...]]


class Part(Protocol):
    """What is audited: its messages go in, findings come out. ``SHARED`` are the types of what is no state.

    ``version``: states are comparable only as long as it is the same.
    """

    SHARED: ClassVar[tuple[type, ...]]

    @property
    def history(self) -> History: ...
    @property
    def version(self) -> int: ...
    def settle(self) -> None: ...


P = TypeVar("P", bound=Part)


class Learned(Generic[P]):
    """A part, its model and what was learned of it; ``judge`` gives the findings of a message.

    ``exact``: nothing is learned, and every message is judged by itself; so it is up to the index ``blind``.
    """

    def __init__(
        self,
        part: P,
        model: ModelData,
        judge: Callable[[P, TraceMessage], Iterator[Finding]],
        *,
        exact: bool = False,
        blind: int = -1,
    ) -> None:
        self._exact, self._blind, self._judge = exact, blind, judge
        self._part: P | None = part
        self._history = part.history
        self._snapshots = Snapshots(model, part.SHARED)
        self._states: dict[tuple[bytes, tuple[int, ...], int], _State] = {}
        self._size = self._steps = self._numbers = 0
        self._classes: list[dict[bytes, int]] = []
        self._state: _State | None = None
        self._marks: list[Any] = []
        self._pending: dict[_Step, int] = {}  # steps whose writing the history does not know yet
        self._seen: set[int] = set()
        self._missed = self._began_trial = self._rests_until = 0

    def beside(
        self, act: Callable[[P, TraceMessage], Iterator[Finding]], message: TraceMessage
    ) -> Iterator[Finding]:
        """The findings of something else that happens, of which nothing is learned."""
        part = self._awake()
        self._state = None
        yield from act(part, _marked(message))

    def listener(self, usual: Mapping[int, bytes], split: Split) -> Listener:
        """Who takes in the messages of one channel, and gives their findings: mostly none.

        ``split`` takes the invokeID out of a message; ``usual`` as in ``classes``.
        """
        classes: dict[bytes, int] = {}
        self._classes.append(classes)
        # Nearly all that is done in a long audit is done here: whatever is looked up often is at hand.
        exact, blind, pending = self._exact, self._blind, self._pending

        def heard(index: int, time: int, channel: Channel, data: bytes) -> Iterator[Finding] | tuple[()]:
            if exact or index <= blind or len(data) > LONGEST:
                return self._alone(TraceMessage(Index(index), time, channel, data))
            parts: tuple[bytes, int | None] | None
            # The first way is what `split` of MMS does, in short.
            if len(data) > 4 and data[1] < 0x80 and data[2:4] == usual.get(data[0]) and data[4] < 0x80:
                parts = data[:4] + data[5:], data[4]
            else:
                parts = split(data)
                if parts is None:
                    return self._alone(TraceMessage(Index(index), time, channel, data))
            rest, invoke = parts
            number = classes.get(rest) or self._class(classes, rest)
            state = self._state
            if state is None:
                return self._learn(number, invoke, TraceMessage(Index(index), time, channel, data))
            relation = _NEW
            if invoke is not None:
                for place in state.invokes:
                    if self._marks[place] == invoke:
                        relation = place
            step = state.steps.get((number, relation))
            if step is None:
                return self._learn(number, invoke, TraceMessage(Index(index), time, channel, data))
            if step.sources is not None:
                marks, present = self._marks, (index, time, channel, data)
                self._marks = [
                    marks[source] if source >= 0 else (invoke if fresh else present)
                    for source, fresh in step.sources
                ]
            if step.wrote:
                pending[step] = index
            self._state = step.target
            self._part = None
            return ()

        return heard

    # The exact way.

    def _alone(self, message: TraceMessage) -> Iterator[Finding]:
        part = self._awake()
        self._state = None
        yield from self._judge(part, message)

    def _learn(self, number: int, invoke: int | None, message: TraceMessage) -> Iterator[Finding]:
        """Ask the device, and remember the step if it told nothing; the first of a class is only noted."""
        part = self._awake()
        if self._rests(message.index) or number not in self._seen:
            self._seen.add(number)
            self._state = None
            yield from self._judge(part, message)
            return
        if self._state is None:
            self._intern(part)
        before, marks = self._state, self._marks
        assert before is not None
        relation = next((n for n in before.invokes if marks[n] == invoke), _NEW)
        told = False
        for finding in self._judge(part, message):
            told = True
            yield finding
        told = told or self._history.told_at(message.index)
        self._intern(part)
        if told or self._state is None:
            return
        sources = self._sources(marks, message, invoke)
        if sources is not None and self._steps < _MOST_STEPS:
            same = before is self._state and sources == tuple(range(len(marks)))
            fresh = tuple(zip(sources, (kind is InvokeId for kind in self._state.kinds), strict=True))
            step = _Step(self._state, None if same else fresh, self._history.written_at(message.index))
            before.steps[number, relation] = step
            self._steps += 1

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

    def _awake(self) -> P:
        """The part itself, in the state that the tables have led to."""
        if self._pending:
            self._history.write_down((step.wrote, index) for step, index in self._pending.items())
            self._pending.clear()
        if self._part is None:
            assert self._state is not None
            kinds = self._state.kinds
            marks = [_mark(kind, mark) for kind, mark in zip(kinds, self._marks, strict=True)]
            self._marks = marks
            self._part = self._snapshots.put_back(self._state.octets, marks)
        return self._part

    def _intern(self, part: P) -> None:
        """Find out in which state the part is."""
        part.settle()
        taken = self._snapshots.take(part)
        self._marks = list(taken.marks)
        self._state = self._known(taken, part.version)

    def _known(self, taken: Snapshot, version: int) -> _State:
        key = taken.octets, taken.order, version
        if key not in self._states:
            if self._size + len(taken.octets) > LARGEST:
                self._forget()
            kinds = tuple(type(mark) for mark in taken.marks)
            invokes = tuple(n for n, kind in enumerate(kinds) if kind is InvokeId)
            self._states[key] = _State(taken.octets, kinds, invokes)
            self._size += len(taken.octets)
        return self._states[key]

    def _sources(self, marks: list[Any], message: TraceMessage, invoke: int | None) -> tuple[int, ...] | None:
        """Where the marks of the present state come from; ``None`` where one comes from nowhere."""
        before = {_name(mark): place for place, mark in reversed(list(enumerate(marks)))}
        found: list[int] = []
        for mark in self._marks:
            place = before.get(_name(mark), _PRESENT)
            if place == _PRESENT and _name(mark)[1] != (invoke if type(mark) is InvokeId else message.index):
                return None
            found.append(place)
        return tuple(found)

    def _class(self, classes: dict[bytes, int], rest: bytes) -> int:
        """The number of a class that has none yet, from 1; none is used twice."""
        if self._numbers % MOST_CLASSES == MOST_CLASSES - 1:
            for each in self._classes:
                each.clear()
            self._seen.clear()
            self._forget()
        self._numbers += 1
        classes[rest] = self._numbers
        return self._numbers

    def _forget(self) -> None:
        """Make room: what was learned is learned anew."""
        self._states.clear()
        self._size = self._steps = 0


def _marked(message: TraceMessage) -> TraceMessage:
    return TraceMessage(Index(message.index), message.time, message.channel, message.data)


def _name(mark: Mark) -> tuple[str, int]:
    if isinstance(mark, TraceMessage):
        return "message", mark.index
    return type(mark).__name__, int(mark)


def _mark(kind: type, mark: Any) -> Any:
    """A mark as the device holds it: of a message that only passed by, the table kept what it was."""
    if not isinstance(mark, tuple):
        return InvokeId(mark) if kind is InvokeId else mark
    index, time, channel, data = mark
    return Index(index) if kind is Index else TraceMessage(Index(index), time, channel, data)
