"""What may have happened unseen before an event: internal rows, requests performed early, acts at the panel.

Each internal row fires at most once for the same names between two events; those that explain an observed
state only are left out where an answer is to be explained. While somebody at the panel holds control, what
the panel can change is not known.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import Any, Literal

from mmsverify.concrete.belief.act import changed, possible, take
from mmsverify.concrete.belief.compiled import compiled
from mmsverify.concrete.belief.constraints import Conflict, Constraints
from mmsverify.concrete.belief.horizon import Reach, drifted, reach
from mmsverify.concrete.belief.partial import DECIDED, OTHER, Partial, distinct
from mmsverify.concrete.belief.patterns import Pattern, at, overlap, touches
from mmsverify.concrete.belief.truth import Env
from mmsverify.concrete.belief.values import NO, YES, join
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Row
from mmsverify.model.sorts import BOOL, ElementSort
from mmsverify.model.terms import SetOf

Evidence = Literal["answer", "observation"]

Tag = tuple[str, tuple[str, ...]]
History = frozenset[Tag]
Reached = tuple[Partial, History]

PANEL = "panel"
CONTROL: Pattern = ("local_control", ())
LARGEST = 4000
LARGEST_MEMO = 20000


@dataclass(frozen=True, slots=True)
class Firing:
    """An internal row with names and truth values for its parameters; it fires once for the names in ``tag``.

    ``needs`` are the cells that its guard reads, ``cells`` all that it reads or writes.
    """

    row: Row
    tag: Tag
    env: Env
    needs: frozenset[Pattern]
    cells: frozenset[Pattern]


class Goal:
    """An event that is about to be judged: the rows that may explain it, in its environment."""

    def __init__(self, rows: Sequence[Row], env: Env) -> None:
        self.env = env
        self.rows = [compiled(row) for row in rows]
        self.key = (rows[0].id if rows else "", rows[0].answer if rows else "", frozenset(env.items()))
        self.reads = at({cell for row in self.rows for cell in row.reads}, env)
        self.writes = at({cell for row in self.rows for cell in row.writes}, env)

    def beside(self, outstanding: Mapping[str, Outstanding]) -> Goal:
        """The same event beside requests that may be performed before it: what they touch matters, too."""
        wider = Goal([], self.env)
        wider.rows, wider.reads, wider.writes = self.rows, self.reads, self.writes
        for request in outstanding.values():
            wider.reads |= request.reads
            wider.writes |= request.writes
        return wider

    def impossible(self, state: Partial) -> bool:
        """Whether the state certainly contradicts it."""
        return all(row.impossible(state, self.env) for row in self.rows)


@dataclass(frozen=True, slots=True)
class Outstanding:
    """A request that has been made and not answered: its responding rows and the environment of its event."""

    slot: str
    rows: tuple[Row, ...]
    env: Env

    @property
    def reads(self) -> frozenset[Pattern]:
        """The cells that performing it may read."""
        return at({cell for row in self.rows for cell in compiled(row).reads}, self.env)

    @property
    def writes(self) -> frozenset[Pattern]:
        """The cells that performing it may write."""
        return at({cell for row in self.rows for cell in compiled(row).writes}, self.env)


def decided(state: Partial, slot: str) -> str | None:
    """The answer that the responder has already decided on for a request, though no message shows it yet."""
    mark = state.cells.get((DECIDED, (slot,)))
    return str(next(iter(mark))) if isinstance(mark, frozenset) else None


def undecided(state: Partial, slot: str) -> Partial:
    """The state without the mark of that decision."""
    return state.without([(DECIDED, (slot,))])


@dataclass
class Unseen:
    """The internal rows of a model, and the states that they lead to."""

    model: ModelData
    constraints: Constraints
    _memo: dict[tuple[Any, ...], list[Partial]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        rows = [row for row in self.model.rows if row.on.phase == "internal"]
        self._rows = {"answer": [r for r in rows if r.explains == "any"], "observation": rows}
        panel = [r for r in self.model.rows if any(p.name == PANEL for p in r.on.parameters)]
        self._bars = {PANEL, *(name for row in rows for name in row.never_after)}
        self._panel = frozenset().union(*(r.writes for r in panel)) if panel else frozenset()

    def forget(self) -> None:
        """Drop what was remembered: a new name has been seen."""
        self._memo.clear()

    def before(
        self,
        states: Sequence[Partial],
        evidence: Evidence,
        outstanding: Mapping[str, Outstanding],
        goal: Goal,
    ) -> list[Partial]:
        """All states that may hold when the event comes, those of ``states`` first.

        What cannot matter to the ``goal`` is left for later, what makes it impossible is left out.
        """
        reached: dict[Partial, None] = {}
        for state in states:
            reached |= dict.fromkeys(self._remembered(state, evidence, outstanding, goal))
        return distinct(reached)

    def _remembered(
        self, state: Partial, evidence: Evidence, outstanding: Mapping[str, Outstanding], goal: Goal
    ) -> list[Partial]:
        if outstanding:
            return self._explore(state, evidence, outstanding, goal)
        key = (state, evidence, goal.key)
        if key not in self._memo:
            if len(self._memo) > LARGEST_MEMO:
                self._memo.clear()
            self._memo[key] = self._explore(state, evidence, {}, goal)
        return self._memo[key]

    def _explore(
        self, start: Partial, evidence: Evidence, outstanding: Mapping[str, Outstanding], goal: Goal
    ) -> list[Partial]:
        firings = self._firings(start, evidence)
        if not overlap(goal.reads, [CONTROL]):
            # RP-18: local control was TRUE only where the recording shows it; it does not come and go unseen.
            firings = [firing for firing in firings if CONTROL[0] not in firing.row.writes]
        if outstanding:
            goal = goal.beside({slot: o for slot, o in outstanding.items() if self._early(o, goal)})
        else:
            firings = self._useful(start, firings, goal)
        horizon = None if outstanding else self._horizon(start, firings)
        level: list[Reached] = [(start, frozenset())]
        seen = list(level)
        while level and len(seen) < LARGEST:
            found: list[Reached] = []
            for state, history in level:
                for tag, after in self._next(state, firings, history, outstanding, goal):
                    if horizon is None or not goal.impossible(drifted(after, horizon)):
                        found.append((after, history | {tag}))
            level = [new for new in self._joined(found) if not any(_covers(old, new) for old in seen)]
            seen += level
        unbounded = self._anything(start, firings) if level else []
        return distinct([*(state for state, _ in seen), *unbounded])

    def _anything(self, state: Partial, firings: Sequence[Firing]) -> list[Partial]:
        """Too much may have happened to follow it step by step: nothing is known of what it could change."""
        changed = frozenset[str]().union(*(firing.row.writes for firing in firings))
        found = self.constraints.everywhere(state.forget(changed | self._panel))
        return [] if isinstance(found, Conflict) else [found]

    def _joined(self, found: Sequence[Reached]) -> Iterator[Reached]:
        """The states reached in as many steps, joined where that loses nothing.

        What has fired in all of them has fired; firings that bar others keep their states apart.
        """
        groups: dict[History, list[tuple[Partial, History]]] = {}
        for state, past in found:
            groups.setdefault(frozenset(tag for tag in past if tag[0] in self._bars), []).append(
                (state, past)
            )
        for group in groups.values():
            for joined in distinct(state for state, _ in group):
                pasts = [past for state, past in group if joined.covers(state)]
                yield joined, frozenset.intersection(*pasts)

    def _horizon(self, state: Partial, firings: Sequence[Firing]) -> Reach | None:
        """What may still change; ``None`` where somebody at the panel may change anything."""
        found = reach(((firing.row, dict(firing.env)) for firing in firings), Partial(state.world, {}))
        control = (
            join(found.get("local_control", NO), state.get(("local_control", ()))) if self._panel else NO
        )
        return None if control != NO else found

    def _firings(self, state: Partial, evidence: Evidence) -> list[Firing]:
        return [
            _firing(row, tag, env) for row in self._rows[evidence] for tag, env in self._bindings(row, state)
        ]

    def _useful(self, state: Partial, firings: Sequence[Firing], goal: Goal) -> list[Firing]:
        """The firings without those after which, whatever else happens, the goal cannot be shown."""
        useful = list(firings)
        for firing in [f for f in firings if not f.tag[1]]:
            others = [f.row for f in useful if f.row is not firing.row]
            blurred = state.forget(self._writable(state, others))
            later = [row for row in others if firing.row.name not in row.never_after]
            ends = take(firing.row, blurred, firing.env, self.constraints)[0]
            if all(goal.impossible(end.forget(self._writable(end, later))) for end in ends):
                useful.remove(firing)
        return useful

    def _writable(self, state: Partial, rows: Sequence[Row]) -> frozenset[str]:
        """The variables that the rows may still change, and somebody at the panel meanwhile."""
        written = frozenset[str]().union(*(row.writes for row in rows))
        if self._panel and ("local_control" in written or state.get(("local_control", ())) == YES):
            written |= self._panel
        return written

    def _next(
        self,
        state: Partial,
        firings: Sequence[Firing],
        history: History,
        outstanding: Mapping[str, Outstanding],
        goal: Goal,
    ) -> Iterator[tuple[Tag, Partial]]:
        fired = {name for name, _ in history}
        for firing in firings:
            if (
                firing.tag in history
                or fired.intersection(firing.row.never_after)
                or not possible(firing.row, state, firing.env)
            ):
                continue
            for after in take(firing.row, state, firing.env, self.constraints)[0]:
                if self._matters(firing, state, after, firings, goal):
                    yield firing.tag, after
        if PANEL not in fired and self._panel and state.get(("local_control", ())) == YES:
            forgotten = self.constraints.everywhere(state.forget(self._panel))
            if not isinstance(forgotten, Conflict):
                yield (PANEL, ()), forgotten
        for request in outstanding.values():
            if self._early(request, goal):
                yield from self._performed(request, state)

    def _matters(
        self, firing: Firing, state: Partial, after: Partial, firings: Sequence[Firing], goal: Goal
    ) -> bool:
        """Whether a firing matters to the goal; one that does not can as well fire after the event.

        It matters if the goal reads what it changed or needs, or may write what it touches, or if it makes
        another firing possible.
        """
        keys = changed(state, after)
        if not keys:
            return False
        if (
            touches(goal.reads, keys)
            or overlap(goal.reads, firing.needs)
            or overlap(goal.writes, firing.cells)
        ):
            return True
        return any(
            touches(other.needs, keys)
            and not possible(other.row, state, other.env)
            and possible(other.row, after, other.env)
            for other in firings
        )

    def _early(self, request: Outstanding, goal: Goal) -> bool:
        """Whether it matters that a request is performed before the event, and not after it."""
        return overlap(request.writes, goal.reads) or overlap(goal.writes, request.reads | request.writes)

    def _performed(self, request: Outstanding, state: Partial) -> Iterator[tuple[Tag, Partial]]:
        """A request may be performed at any instant before its response."""
        if decided(state, request.slot) is not None:
            return
        for row in request.rows:
            for after in take(row, state, request.env, self.constraints)[0]:
                yield (
                    ("performed", (request.slot,)),
                    after.put((DECIDED, (request.slot,)), frozenset([row.answer])),
                )

    def _bindings(self, row: Row, state: Partial) -> Iterator[tuple[Tag, dict[str, Any]]]:
        """Names for parameters that are elements, both values for Booleans; any other choice stays open."""
        ranged: list[tuple[str, tuple[Any, ...]]] = []
        for parameter in row.parameters:
            if isinstance(parameter, SetOf):
                continue
            if isinstance(parameter.of, ElementSort):
                ranged.append(
                    (parameter.name, tuple(n for n in state.world.names[parameter.of.name] if n != OTHER))
                )
            elif parameter.of is BOOL:
                ranged.append((parameter.name, (NO, YES)))
        for values in product(*(values for _, values in ranged)):
            tag = (row.name, tuple(v for v in values if isinstance(v, str)))
            yield tag, dict(zip((name for name, _ in ranged), values, strict=True))


def _covers(old: Reached, new: Reached) -> bool:
    """Whether what may follow from ``new`` may follow from ``old``: it allows as much, and less has fired."""
    return old[1] <= new[1] and old[0].covers(new[0])


def _firing(row: Row, tag: Tag, env: Env) -> Firing:
    ready = compiled(row)
    return Firing(row, tag, env, at(ready.needs, env), at({*ready.reads, *ready.writes}, env))
