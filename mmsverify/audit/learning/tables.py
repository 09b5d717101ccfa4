"""What was learned of devices of one model under one profile: states, classes of events, and steps between.

Nothing here belongs to one recording: no place of a message, no name that is not in the state itself. So
what one recording has taught serves the next one of such a device.
"""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from mmsverify.audit.learning.classes import Classes
from mmsverify.audit.learning.leaves import Path, Span, fields, leaves
from mmsverify.audit.learning.marks import InvokeId
from mmsverify.audit.learning.snapshots import Snapshot, Snapshots
from mmsverify.concrete.belief.partial import Key
from mmsverify.model import ModelData

LARGEST = 32 << 20
"""Octets of states that are kept."""
MOST_CLASSES = 1 << 14
MOST_STEPS = 1 << 17
MOST_INVOKES = 14
"""Requests that may wait at once in a state that is kept."""
MOST_MARKS = 64
"""Of a state that is kept."""
MOST_GROWN = 1 << 14

DIVERSE = 3
"""So many messages that differ in values only are one class; of less, each may come again and again."""
PRESENT = -1
"""The source of a mark that comes from the message itself."""
NEW = -1
"""The relation of an invokeID that is none of the state's."""


@dataclass(slots=True, eq=False)
class Grown:
    """What was met up to here, as a way through a tree: the same things in the same order are one object."""

    path: tuple[Any, ...] = ()
    then: dict[Any, Grown] = field(default_factory=dict)


@dataclass(slots=True, eq=False)
class State:
    """A state of a device: how to put it back, which of its marks are invokeIDs, and the steps from it.

    ``leafy`` as in `Snapshot`. ``shows`` is what is known in it, in words, where somebody watches.

    Steps are by ``event``.
    """

    octets: bytes
    kinds: tuple[type, ...]
    grown: Grown
    leafy: bool
    invokes: tuple[int, ...]
    steps: dict[int, Step] = field(default_factory=dict)
    shows: Mapping[str, str] | None = None


@dataclass(slots=True, eq=False)
class Step:
    """What a class of events does in a state: where each mark of the next state comes from.

    ``sources``: by number, those of the state before, or ``PRESENT``; ``None`` where all stay in place.
    ``moves``: the same for those that are invokeIDs, counted among themselves.
    ``wrote``: the cells of the belief that it wrote, with what made them so.
    """

    target: State
    sources: tuple[int, ...] | None
    moves: tuple[int, ...] | None
    wrote: dict[Key, tuple[str, ...]]


def event(number: int, relation: int) -> int:
    """A class of events, and which of the state's invokeIDs the event bears, as one number."""
    return number << 4 | relation + 1


class Tables:
    """The states, classes and steps of devices that share a model and a profile.

    ``epoch`` grows when all is forgotten, for want of room; what a device holds stays good for it.
    """

    def __init__(self, model: ModelData, shared: Iterable[type]) -> None:
        self.snapshots = Snapshots(model, shared)
        self.epoch = 0
        self._roles: dict[Hashable, Classes] = {}
        self._root, self._grown = Grown(), 0
        self._states: dict[tuple[bytes, tuple[int, ...], Grown], State] = {}
        self._size = self._steps = self._numbers = 0
        self.initial: dict[Hashable, State | None] = {}
        """By kind of device: the state of one that has not seen anything."""
        self._looked: dict[Path, int] = {}
        self._passed_by: set[Path] = set()
        self.leaves: dict[int, Mapping[Span, str]] = {}
        """By class: the values that it leaves out, by their places in a message."""
        self.seen: set[int] = set()
        """The classes of which an event has been met: only the second one is worth a state."""

    def classes(self, role: Hashable) -> Classes:
        """The classes of the messages of one role in the conversation."""
        return self._roles.setdefault(role, Classes())

    def number(self, classes: Classes, rest: bytes, data: bytes, *, whole: bool) -> int:
        """The number of the class of a message, from 1; none is used twice.

        ``rest`` is the message ``data`` without its invokeID. ``whole``: it has no values to be left out.
        """
        found = classes.find(rest)
        if found is not None:
            return found
        spans = {} if whole else self._left_out(data)
        return self._named(classes, rest, spans, len(data) - len(rest), DIVERSE)

    def narrow(
        self, classes: Classes, number: int, rest: bytes, data: bytes, touched: Iterable[Span]
    ) -> None:
        """Make a class anew that does not leave out the values at ``touched``: they are looked at."""
        spans, shift, gone = self.leaves.get(number, {}), len(data) - len(rest), set(touched)
        less = {span: kind for span, kind in spans.items() if span not in gone}
        template = classes.template(rest, _shifted(spans, shift))
        if len(less) == len(spans) or template is None:
            return
        template.numbers[template.rest(rest)] = 0
        template.less[template.rest(rest)] = less
        classes.forget(number)
        self.seen.add(self._named(classes, rest, less, shift, 1))

    def note(self, data: bytes, touched: Collection[Span], untouched: Collection[Span]) -> None:
        """What was found out of a message's values: fields always looked at are not left out any more."""
        for path, span in fields(data).items():
            if span in touched:
                self._looked[path] = self._looked.get(path, 0) + 1
            elif span in untouched:
                self._passed_by.add(path)

    def _left_out(self, data: bytes) -> dict[Span, str]:
        """The values of a message that may be left out."""
        found = leaves(data)
        if found:
            always = {path for path, times in self._looked.items() if times > 1} - self._passed_by
            for path, span in fields(data).items() if always else ():
                if path in always:
                    found.pop(span, None)
        return found

    def _named(
        self, classes: Classes, rest: bytes, spans: Mapping[Span, str], shift: int, diverse: int
    ) -> int:
        """The number of a new class: one that leaves values out, if so many others have been met."""
        if self._numbers % MOST_CLASSES == MOST_CLASSES - 1:
            self.forget()
        self._numbers += 1
        number = self._numbers
        while spans:
            template = classes.template(rest, _shifted(spans, shift))
            if template is None:
                break
            left = template.rest(rest)
            if left not in template.less:
                template.met[left] = template.met.get(left, 0) + 1
                if template.met[left] < diverse:
                    break
                template.numbers[left] = number
                self.leaves[number] = spans
                return number
            spans = template.less[left]
        classes[rest] = number
        return number

    def grown(self, path: Sequence[Any], known: Grown) -> Grown:
        """The object of what was met; ``known`` is that of the first part of it."""
        for each in path[len(known.path) :]:
            if each not in known.then:
                self._grown += 1
                known.then[each] = Grown((*known.path, each))
            known = known.then[each]
        return known

    @property
    def root(self) -> Grown:
        """Where nothing has been met."""
        return self._root

    def state(self, taken: Snapshot, grown: Grown) -> State | None:
        """The state of a snapshot; ``None`` where too much of it changes with every message."""
        key = taken.octets, taken.order, grown
        found = self._states.get(key)
        if found is None:
            kinds = tuple(type(mark) for mark in taken.marks)
            invokes = tuple(n for n, kind in enumerate(kinds) if kind is InvokeId)
            if len(invokes) > MOST_INVOKES or len(kinds) > MOST_MARKS:
                return None
            if self._size + len(taken.octets) > LARGEST or self._grown > MOST_GROWN:
                self.forget()
            found = self._states[key] = State(taken.octets, kinds, grown, taken.leafy, invokes)
            self._size += len(taken.octets)
        return found

    def learn(
        self,
        before: State,
        event: int,
        target: State,
        sources: tuple[int, ...],
        wrote: dict[Key, tuple[str, ...]],
    ) -> None:
        """Keep a step, where there is room."""
        if self._steps >= MOST_STEPS:
            return
        places = {place: n for n, place in enumerate(before.invokes)}
        moves = tuple(places.get(sources[n], PRESENT) for n in target.invokes)
        still = before.invokes == target.invokes and sources == tuple(range(len(before.kinds)))
        same = moves == tuple(range(len(before.invokes)))
        before.steps[event] = Step(target, None if still else sources, None if same else moves, wrote)
        self._steps += 1

    def forget(self) -> None:
        """Make room: what was learned is learned anew."""
        for classes in self._roles.values():
            classes.clear()
        self._roles.clear()
        self.seen.clear()
        self.leaves.clear()
        self.initial.clear()
        self._states.clear()
        self._root, self._grown = Grown(), 0
        self._size = self._steps = 0
        self.epoch += 1


def _shifted(spans: Mapping[Span, str], shift: int) -> dict[Span, str]:
    """The spans in a message without its invokeID, which stands before all of them."""
    return {(begin - shift, end - shift): kind for (begin, end), kind in spans.items()}
