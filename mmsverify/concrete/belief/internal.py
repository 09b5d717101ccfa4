"""What may have happened unseen before an event: internal rows, requests performed early, acts at the panel.

Each internal row fires at most once for the same names between two events; those that explain an observed
state only are left out where an answer is to be explained, and nothing more is explained where a state agrees
with an observation already: what else may have happened may as well happen after it. While somebody at the
panel holds control, what the panel can change is not known.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import Any, Literal

from mmsverify.concrete.belief.act import changed, idle, maybe, take
from mmsverify.concrete.belief.constraints import Conflict, Constraints
from mmsverify.concrete.belief.field import Field, History, Move, move
from mmsverify.concrete.belief.goal import NOTHING, Goal, Patterns, step
from mmsverify.concrete.belief.horizon import Drifting, Reach, reach
from mmsverify.concrete.belief.partial import DECIDED, OTHER, Partial, distinct
from mmsverify.concrete.belief.patterns import Pattern, overlap, touches
from mmsverify.concrete.belief.truth import Env
from mmsverify.concrete.belief.values import NO, YES, within
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Row
from mmsverify.model.sorts import BOOL, ElementSort
from mmsverify.model.terms import SetOf

Evidence = Literal["answer", "observation"]
Reached = tuple[Partial, History]

PANEL = "panel"
PERFORMED = "performed"
CONTROL: Pattern = ("local_control", ())
LARGEST = 4000
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
    mark = state.cells.get((DECIDED, (slot,)))
    return str(next(iter(mark))) if isinstance(mark, frozenset) else None


def undecided(state: Partial, slot: str) -> Partial:
    """The state without the mark of that decision."""
    return state.without([(DECIDED, (slot,))]) if (DECIDED, (slot,)) in state.cells else state


@dataclass
class Unseen:
    """The internal rows of a model, and the states that they lead to."""

    model: ModelData
    constraints: Constraints
    _memo: dict[tuple[Any, ...], list[Partial]] = field(default_factory=dict)
    _fields: dict[tuple[Any, ...], Field] = field(default_factory=dict)
    _horizons: dict[tuple[Any, ...], Reach] = field(default_factory=dict)

    def __post_init__(self) -> None:
        rows = [row for row in self.model.rows if row.on.phase == "internal"]
        self._rows = {"answer": [r for r in rows if r.explains == "any"], "observation": rows}
        panel = [r for r in self.model.rows if any(p.name == PANEL for p in r.on.parameters)]
        self._bars = {PANEL, *(name for row in rows for name in row.never_after)}
        self._panel = frozenset[str]().union(*(r.writes for r in panel))

    def forget(self) -> None:
        """Drop what was remembered: a new name has been seen."""
        self._memo.clear()
        self._fields.clear()
        self._horizons.clear()

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
                tried, beside = moves.next(state, past, goal)
                blurred = _blurred(state, beside, self.constraints)
                seen.append((blurred, past))
                found += self._after(blurred, past, tried, moves, goal)
            level = [new for new in self._joined(found) if not any(_covers(old, new) for old in seen)]
        unbounded = self._anything(start, moves) if level else []
        return distinct([*(state for state, _ in seen), *unbounded])

    def _after(
        self, state: Partial, past: History, tried: Sequence[Move], moves: Field, goal: Goal
    ) -> Iterator[Reached]:
        """The states after one move more, without those from which there is no way to the goal."""
        for each in tried:
            history = past | {each.tag}
            horizon = self._horizon(moves, history)
            for after in self._made(each, state):
                if each.explains and not _explained(state, after, moves, goal):
                    continue
                if not goal.impossible(Drifting(after, horizon)):
                    yield after, history

    def _made(self, each: Move, state: Partial) -> Iterator[Partial]:
        if each.tag[0] == PANEL:
            forgotten = self.constraints.everywhere(state.forget(self._panel))
            if not isinstance(forgotten, Conflict):
                yield forgotten
            return
        for way in each.ways:
            if each.tag[0] != PERFORMED and idle(way.row.row, state, way.env):
                continue
            for after in take(way.row.row, state, way.env, self.constraints)[0]:
                if each.tag[0] == PERFORMED:
                    yield after.put((DECIDED, each.tag[1]), frozenset([way.row.row.answer]))
                else:
                    yield after

    def _anything(self, state: Partial, moves: Field) -> list[Partial]:
        """Too much may have happened to follow it step by step: nothing is known of what it could change."""
        changed = frozenset(variable for each in moves.moves for variable, _ in each.writes)
        found = self.constraints.everywhere(state.forget(changed | self._panel))
        return [] if isinstance(found, Conflict) else [found]

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
        key = (id(moves), frozenset(tag for tag in history if not tag[1] or tag[0] in self._bars))
        found = self._horizons.get(key)
        if found is None:
            gone = moves.gone(key[1])
            left = [each for number, each in enumerate(moves.moves) if not gone >> number & 1]
            blank = Partial(self.constraints.world, {})
            found = reach(((way.row.row, way.env) for each in left for way in each.ways), blank)
            if any(each.tag[0] == PANEL for each in left):
                found |= {variable: blank.world.full[variable] for variable in self._panel}
            self._horizons[key] = found
        return found

    # The moves that there are.

    def _field(self, evidence: Evidence, asked: tuple[Outstanding, ...], goal: Goal) -> Field:
        # RP-18: local control was TRUE only where the recording shows it; it does not come and go unseen.
        control = overlap(goal.reads, [CONTROL])
        key = (evidence, asked, control)
        if key not in self._fields:
            rows = [r for r in self._rows[evidence] if control or CONTROL[0] not in r.writes]
            self._fields[key] = Field([*self._moves(rows), *map(_performing, asked), *self._at_panel()])
        return self._fields[key]

    def _moves(self, rows: Sequence[Row]) -> Iterator[Move]:
        for row in rows:
            for names, envs in self._bindings(row).items():
                steps = [step(row, env) for env in envs]
                yield move((row.name, names), steps, row.never_after, explains=row.explains == "observation")

    def _at_panel(self) -> Iterator[Move]:
        if self._panel:
            arities = self.model.signatures
            writes = frozenset((name, (None,) * len(arities[name].sorts)) for name in self._panel)
            yield Move((PANEL, ()), (), frozenset([CONTROL]), writes, enabled=_panel_acts)

    def _bindings(self, row: Row) -> dict[tuple[str, ...], list[dict[str, Any]]]:
        """Names for parameters that are elements, both values for Booleans; any other choice stays open."""
        ranged: list[tuple[str, tuple[Any, ...]]] = []
        for parameter in row.parameters:
            if isinstance(parameter, SetOf):
                continue
            if isinstance(parameter.of, ElementSort):
                known = self.constraints.world.names[parameter.of.name]
                ranged.append((parameter.name, tuple(n for n in known if n != OTHER)))
            elif parameter.of is BOOL:
                ranged.append((parameter.name, (NO, YES)))
        found: dict[tuple[str, ...], list[dict[str, Any]]] = {}
        for values in product(*(values for _, values in ranged)):
            env = dict(zip((name for name, _ in ranged), values, strict=True))
            found.setdefault(tuple(v for v in values if isinstance(v, str)), []).append(env)
        return found


def _blurred(state: Partial, beside: Sequence[Move], constraints: Constraints) -> Partial:
    """The state after any of these moves, or none: what they may change is as it was, or as they make it."""
    before = None
    rounds = 0
    while state is not before:
        before = state
        rounds += 1
        for each in beside:
            for way in each.ways:
                if way.obstacle(state) is None:
                    state = maybe(way.row.row, state, way.env, constraints)
        if rounds > MOST_ROUNDS:
            return state.forget(frozenset(variable for each in beside for variable, _ in each.writes))
    return state


def _explained(before: Partial, after: Partial, moves: Field, goal: Goal) -> bool:
    """Whether a move makes something possible that was not: what the event reads, or another move."""
    keys = [key for key in changed(before, after) if not within(after.get(key), before.get(key))]
    return touches(goal.reads, keys) or any(
        each.obstacle(before) is not None and each.obstacle(after) is None
        for each in moves.moves
        if touches(each.reads, keys)
    )


def _performing(asked: Outstanding) -> Move:
    """A request may be performed at any instant before its response."""
    steps = tuple(step(row, asked.env) for row in asked.rows)
    made = move((PERFORMED, (asked.slot,)), steps)

    def obstacle(state: Partial) -> Patterns | None:
        return NOTHING if decided(state, asked.slot) is not None else made.obstacle(state)

    return Move(made.tag, made.ways, made.reads, made.writes, enabled=obstacle)


def _panel_acts(state: Partial) -> Patterns | None:
    return None if state.get(CONTROL) == YES else frozenset([CONTROL])  # type: ignore[arg-type]


def _covers(old: Reached, new: Reached) -> bool:
    """Whether what may follow from ``new`` may follow from ``old``: it allows as much, and less has fired."""
    return old[1] <= new[1] and old[0].covers(new[0])
