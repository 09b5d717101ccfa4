"""What may have happened unseen before an event: internal rows, requests performed early, acts at the panel.

A row that no message shows may fire any number of times. One that explains an observed state only is left
out where an answer is to be explained; it is assumed once between two events for the same names, and only
where a state does not allow what is shown. Where a state agrees with an observation, nothing more is
explained: what else may have happened may as well happen after it. While somebody at the panel holds control,
what the panel can change is not known.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from typing import Any, Literal

from mmsverify.concrete.belief.act import idle, take
from mmsverify.concrete.belief.constraints import Conflict, Constraints
from mmsverify.concrete.belief.field import Field, History, Move, move
from mmsverify.concrete.belief.goal import Goal
from mmsverify.concrete.belief.horizon import Reach, reach
from mmsverify.concrete.belief.partial import DECIDED, Key, Partial
from mmsverify.concrete.belief.ready import Ready, Rows
from mmsverify.concrete.belief.relaxed import hopeless
from mmsverify.concrete.belief.several import changed, distinct
from mmsverify.concrete.belief.values import ABSENT, NO, YES, Env, within
from mmsverify.model.model import ModelData
from mmsverify.model.rows import PLUS, Row
from mmsverify.model.sorts import BOOL, ElementSort
from mmsverify.model.terms import SetOf

Evidence = Literal["answer", "observation"]
Reached = tuple[Partial, History]

PANEL = "panel"
PERFORMED = "performed"
CONTROL: Key = ("local_control", ())
SHOWS_CONTROL = frozenset({"local_control", "device_local"})
"""The variables of which any tells whether somebody at the panel holds control."""

LARGEST = 300
LARGEST_MEMO = 20000
MOST_ROUNDS = 6


@dataclass(frozen=True, slots=True, eq=False)
class Outstanding:
    """A request that has been made and not answered: its responding rows and the environment of its event."""

    slot: str
    rows: tuple[Row, ...]
    env: Env

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Outstanding) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)

    @property
    def _key(self) -> tuple[Any, ...]:
        return self.slot, self.rows[0].id, frozenset(self.env.items())


def decided(state: Partial, slot: str) -> str | None:
    """The answer that the responder has already decided on for a request, though no message shows it yet."""
    mark: str | None = state.beside.get((DECIDED, (slot,)))
    return mark


def undecided(state: Partial, slot: str) -> Partial:
    """The state without the mark of that decision."""
    return state.without([(DECIDED, (slot,))]) if (DECIDED, (slot,)) in state.beside else state


def not_accepted(states: Iterable[Partial], slot: str) -> list[Partial]:
    """The states in which the responder has not accepted the request already, without marks of a decision."""
    return [undecided(state, slot) for state in states if decided(state, slot) != PLUS]


@dataclass
class Unseen:
    """The internal rows of a model, and the states that they lead to."""

    model: ModelData
    constraints: Constraints
    made: Rows
    _memo: dict[tuple[Any, ...], list[Partial]] = field(default_factory=dict)
    _steps: dict[tuple[Ready, Partial], list[Partial]] = field(default_factory=dict)
    _fields: dict[tuple[Any, ...], Field] = field(default_factory=dict)
    _horizons: dict[tuple[Any, ...], Reach] = field(default_factory=dict)
    _given: dict[Move, Reach] = field(default_factory=dict)

    def __post_init__(self) -> None:
        rows = [row for row in self.model.rows if row.on.phase == "internal"]
        self._rows = {"answer": [r for r in rows if r.explains == "any"], "observation": rows}
        panel = [r for r in self.model.rows if any(p.name == PANEL for p in r.on.parameters)]
        self._bars = {PANEL, *(name for row in rows for name in row.never_after)}
        self._panel = frozenset[str]().union(*(r.writes for r in panel))

    def forget(self) -> None:
        """Drop what was remembered, here and of rows and invariants: a new name has been seen."""
        self.made.forget()
        self.constraints.forget()
        self._memo.clear()
        self._steps.clear()
        self._fields.clear()
        self._horizons.clear()
        self._given.clear()

    def before(
        self,
        states: Sequence[Partial],
        evidence: Evidence,
        outstanding: Mapping[str, Outstanding],
        goal: Goal,
    ) -> list[Partial]:
        """The states that may hold when the event comes, those of ``states`` among them.

        What cannot matter to the ``goal`` is left for later, what makes it impossible is left out.
        """
        asked = tuple(outstanding.values())
        reached: dict[Partial, None] = {}
        for state in states:
            reached |= dict.fromkeys(self._remembered(state, evidence, asked, goal))
        return distinct(reached)

    def hopeless(self, states: Iterable[Partial], outstanding: Mapping[str, Outstanding], goal: Goal) -> bool:
        """Whether what is observed certainly cannot be; quickly told, and not of all that cannot be."""
        moves = self._field("observation", tuple(outstanding.values()), goal)
        return all(hopeless(state, moves, goal, _may, self._gives) for state in states)

    def _gives(self, each: Move) -> Reach:
        """The values that a move may give."""
        found = self._given.get(each)
        if found is None:
            found = self._given[each] = reach(each.ways, self.constraints.world)
            if each.tag[0] == PANEL:
                found.anything(self.constraints.world, self._panel)
        return found

    def _remembered(
        self, state: Partial, evidence: Evidence, asked: tuple[Outstanding, ...], goal: Goal
    ) -> list[Partial]:
        key = (state, evidence, asked, goal.key)
        found = self._memo.get(key)
        if found is None:
            if len(self._memo) > LARGEST_MEMO:
                self._memo.clear()
            found = self._memo[key] = self._explore(state, self._field(evidence, asked, goal), goal)
        return found

    def _explore(self, start: Partial, moves: Field, goal: Goal) -> list[Partial]:
        level: list[Reached] = [(start, frozenset())]
        seen: list[Reached] = []
        while level and len(seen) < LARGEST:
            found: list[Reached] = []
            for state, past in level:
                blurred, tried = self._blurred(state, past, moves, goal)
                seen.append((blurred, past))
                found += self._after(blurred, past, tried, moves, goal)
            level = [new for new in self._joined(found) if not any(_covers(old, new) for old in seen)]
        unbounded = self._anything(start, moves) if level else []
        return distinct([*(state for state, _ in seen), *unbounded])

    def _blurred(self, state: Partial, past: History, moves: Field, goal: Goal) -> tuple[Partial, list[Move]]:
        """The state after any moves that merely disturb, or none, and the moves to try in it.

        What they may change is as it was, or as they make it.
        """
        for _ in range(MOST_ROUNDS):
            tried, beside = moves.next(state, past, goal)
            before = state
            for each in beside:
                for after in self._made(each, state):
                    state = state if state.covers(after) else state.joined(after)
            if state is before:
                return state, tried
        world = state.world
        touched = {place.key[0] for each in moves.moves for place in world.changed(each.writes)}
        state = state.forget(touched)
        return state, moves.next(state, past, goal)[0]

    def _after(
        self, state: Partial, past: History, tried: Sequence[Move], moves: Field, goal: Goal
    ) -> Iterator[Reached]:
        """The states after one move more, without those from which there is no way to the goal."""
        for each in tried:
            history = past | {each.tag} if each.explains or each.tag[0] in self._bars else past
            horizon = self._horizon(moves, history)
            for after in self._made(each, state):
                if each.explains and not _explained(state, after, moves, goal):
                    continue
                if not goal.impossible(horizon.drifted(after)):
                    yield after, history

    def _made(self, each: Move, state: Partial) -> Iterator[Partial]:
        if each.tag[0] == PANEL:
            forgotten = self.constraints.everywhere(state.forget(self._panel))
            if not isinstance(forgotten, Conflict):
                yield forgotten
        elif each.tag[0] == PERFORMED:
            for way in each.ways:
                for after in take([way], state, self.constraints)[0]:
                    yield after.put((DECIDED, each.tag[1]), way.row.answer)
        else:
            for way in each.ways:
                yield from self._taken(way, state)

    def _taken(self, way: Ready, state: Partial) -> list[Partial]:
        """The states that the row leads to beyond ``state``; often asked, for events leave it waiting."""
        key = (way, state)
        found = self._steps.get(key)
        if found is None:
            if len(self._steps) > LARGEST_MEMO:
                self._steps.clear()
            found = self._steps[key] = [] if idle(way, state) else take([way], state, self.constraints)[0]
        return found

    def _anything(self, state: Partial, moves: Field) -> list[Partial]:
        """Too much may have happened to follow it step by step: nothing is known of what it could change."""
        touched = frozenset(key[0] for key in self._cells(each.writes for each in moves.moves))
        found = self.constraints.everywhere(state.forget(touched | self._panel))
        return [] if isinstance(found, Conflict) else [found]

    def _cells(self, sets: Iterable[int]) -> Iterator[Key]:
        for cells in sets:
            for place in self.constraints.world.changed(cells):
                yield place.key

    def _joined(self, found: Sequence[Reached]) -> Iterator[Reached]:
        """The states reached in as many steps, joined where that loses nothing.

        What has fired in all of them has fired; firings that bar others keep their states apart.
        """
        groups: dict[History, list[Reached]] = {}
        for state, past in found:
            bars = frozenset(tag for tag in past if tag[0] in self._bars)
            groups.setdefault(bars, []).append((state, past))
        for group in groups.values():
            for joined in distinct(state for state, _ in group):
                pasts = [past for state, past in group if joined.covers(state)]
                yield joined, frozenset.intersection(*pasts)

    def _horizon(self, moves: Field, history: History) -> Reach:
        """What may still change after these moves."""
        key = (id(moves), history)
        found = self._horizons.get(key)
        if found is None:
            gone = moves.gone(history)
            left = [each for number, each in enumerate(moves.moves) if not gone >> number & 1]
            found = reach((way for each in left for way in each.ways), self.constraints.world)
            if any(each.tag[0] == PANEL for each in left):
                found.anything(self.constraints.world, self._panel)
            self._horizons[key] = found
        return found

    # The moves that there are.

    def _field(self, evidence: Evidence, asked: tuple[Outstanding, ...], goal: Goal) -> Field:
        # RP-18: local control was TRUE only where the recording shows it; it does not come and go unseen.
        world = self.constraints.world
        control = bool(world.mask(SHOWS_CONTROL & world.full.keys()) & goal.reads)
        key = (evidence, asked, control)
        if key not in self._fields:
            if len(self._fields) > LARGEST:
                self._fields.clear()
                self._horizons.clear()
                self._given.clear()
            rows = [r for r in self._rows[evidence] if control or CONTROL[0] not in r.writes]
            self._fields[key] = Field([*self._moves(rows), *map(self._performing, asked), *self._at_panel()])
        return self._fields[key]

    def _moves(self, rows: Sequence[Row]) -> Iterator[Move]:
        for row in rows:
            for names, envs in self._bindings(row).items():
                ways = tuple(way for env in envs for way in self.made.ready(row, env))
                explains = row.explains == "observation"
                yield move((row.name, names), ways, row.never_after, explains=explains)

    def _performing(self, asked: Outstanding) -> Move:
        """A request may be performed at any instant before its response."""
        ways = tuple(way for row in asked.rows for way in self.made.ready(row, asked.env))
        made = move((PERFORMED, (asked.slot,)), ways)

        def stands(state: Partial) -> int | None:
            return 0 if decided(state, asked.slot) is not None else made.obstacle(state)

        return replace(made, stands=stands)

    def _at_panel(self) -> Iterator[Move]:
        if self._panel:
            world = self.constraints.world
            control = world.spots[CONTROL]

            def stands(state: Partial) -> int | None:
                return None if state.get(CONTROL) == YES else control

            yield Move((PANEL, ()), (), control, world.mask(self._panel), stands=stands)

    def _bindings(self, row: Row) -> dict[tuple[str, ...], list[dict[str, Any]]]:
        """Names for parameters that are elements, both values for Booleans; any other choice stays open.

        An optional one may not be given; that is left open with its value.
        """
        ranged: list[tuple[str, tuple[Any, ...]]] = []
        for parameter in row.parameters:
            if isinstance(parameter, SetOf):
                continue
            absent = (ABSENT,) if parameter.name in row.on.optional else ()
            if isinstance(parameter.of, ElementSort):
                ranged.append((parameter.name, (*self.constraints.world.names[parameter.of.name], *absent)))
            elif parameter.of is BOOL:
                ranged.append((parameter.name, (NO, YES, *absent)))
        found: dict[tuple[str, ...], list[dict[str, Any]]] = {}
        for values in product(*(values for _, values in ranged)):
            env = dict(zip((name for name, _ in ranged), values, strict=True))
            found.setdefault(tuple(v for v in values if isinstance(v, str)), []).append(env)
        return found


def _may(each: Move, state: Partial) -> bool:
    """Whether a move may be made in some of the states that this one allows."""
    if each.tag[0] == PANEL:
        known = state.get(CONTROL)
        assert isinstance(known, int)
        return bool(known & YES)
    return each.obstacle(state) is None


def _explained(before: Partial, after: Partial, moves: Field, goal: Goal) -> bool:
    """Whether a move makes something possible that was not: what the event reads, or another move."""
    new = 0
    for key in changed(before, after):
        if not within(after.get(key), before.get(key)):
            new |= before.world.spots[key]
    return bool(new & goal.reads) or any(
        each.obstacle(before) is not None and each.obstacle(after) is None
        for each in moves.moves
        if each.reads & new
    )


def _covers(old: Reached, new: Reached) -> bool:
    """Whether what may follow from ``new`` may follow from ``old``: it allows as much, and less has fired."""
    return old[1] <= new[1] and old[0].covers(new[0])
