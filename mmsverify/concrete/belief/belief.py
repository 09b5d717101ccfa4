"""The belief about one device: the states that some run of the model may have reached by the events so far.

After each event the belief is the set of partial states that agree with it; it is empty only if no run of the
model shows these events, and only then a violation is told. Then it starts again from every state that agrees
with what was observed: with the effects of the observed answer, or without them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import reduce
from operator import or_
from typing import Any, Literal

from mmsverify.concrete.belief.act import Refusal, settle, take
from mmsverify.concrete.belief.blame import Blame, Outcome, before, blame
from mmsverify.concrete.belief.constraints import Conflict, Constraints
from mmsverify.concrete.belief.coverage import Coverage
from mmsverify.concrete.belief.given import Asked, Watch, as_known
from mmsverify.concrete.belief.goal import Goal
from mmsverify.concrete.belief.ground import Ground, negated
from mmsverify.concrete.belief.internal import Outstanding, Unseen, decided, not_accepted, undecided
from mmsverify.concrete.belief.nodes import Formula
from mmsverify.concrete.belief.partial import Key, Partial, World
from mmsverify.concrete.belief.ready import Rows
from mmsverify.concrete.belief.resync import as_if_refused, forced, learned_anew, sight_lost
from mmsverify.concrete.belief.several import distinct, widened, written
from mmsverify.concrete.belief.values import YES, Env, exactly
from mmsverify.model.expr import Expr
from mmsverify.model.model import ModelData
from mmsverify.model.rows import MINUS, PLUS, Claim, Clause, Row
from mmsverify.model.sorts import ElementSort

LARGEST_BELIEF = 300


class Belief:
    """What is known about one device under one model.

    ``facts`` are what a profile fixes, by variable and names; ``invariants`` are claims that have been proved
    of the model: they tell what else follows from what is seen. A claim that does not hold would make
    conforming recordings impossible.
    """

    def __init__(
        self, model: ModelData, facts: Mapping[Key, Any] | None = None, invariants: Sequence[Claim] = ()
    ) -> None:
        self.model = model
        self.world = World(model)
        claims = [(c.formula, c.clause) for c in invariants]
        claims += [(a.condition, a.clause) for a in model.assumptions]
        self.ground = Ground(self.world)
        self.made = Rows(self.ground)
        self.constraints = Constraints(self.ground, claims)
        self.unseen = Unseen(model, self.constraints, self.made)
        self.states: list[Partial] = [self.world.blank()]
        self.widened = False
        self.coverage = Coverage()
        self._rows: dict[tuple[str, str], tuple[Row, ...]] = {}
        for row in model.rows:
            event = row.on.phase, row.on.service
            self._rows[event] = (*self._rows.get(event, ()), row)
        self._outstanding: dict[str, Outstanding] = {}
        self._unsure: set[str] = set()
        self._watches: dict[str, Watch] = {}
        self._asked: dict[str, Asked] = {}
        self._accepted = Asked()
        self._shown: Goal | None = None
        self._performed_in: tuple[Goal, str, Sequence[Partial]] | None = None
        self._know(facts or {})

    def _know(self, facts: Mapping[Key, Any]) -> None:
        for (variable, args), given in sorted(facts.items(), key=lambda item: item[0]):
            for sort, name in zip(self.model.signatures[variable].sorts, args, strict=True):
                assert isinstance(sort, ElementSort)
                self.see(sort, name)
            self.states = [state.put((variable, args), exactly(given)) for state in self.states]
        self.states = self.constraints.consistent(self.states)

    def see(self, sort: ElementSort, name: str) -> None:
        """A name has been seen in the recording."""
        if self.world.known(sort, name):
            return
        cells = self.world.add(sort, name)
        self.unseen.forget()
        self.states = [after for state in self.states for after in state.meets(name, sort, cells)]
        for watch in (*self._watches.values(), *self._asked.values(), self._accepted):
            watch.earlier = [
                [after for state in states for after in state.meets(name, sort, cells)]
                for states in watch.earlier
            ]

    def environment(self, phase: str, service: str, bindings: Mapping[str, Any]) -> dict[str, Any]:
        """The values of an event's parameters as the readers take them; its names are seen.

        Members of enumerations may be given as the words that they print. Parameters that no row knows are
        left out.
        """
        env: dict[str, Any] = {}
        for row in self._rows.get((phase, service), ()):
            for parameter in row.on.parameters:
                if parameter.name in bindings and parameter.name not in env:
                    given = bindings[parameter.name]
                    self._see_all(parameter.of, given)
                    env[parameter.name] = as_known(given, parameter.of)
        return env

    def says(self, condition: Expr) -> int:
        """What the belief says of a condition without parameters: ``NO``, ``YES`` or ``EITHER``."""
        formula = self.ground.formula(condition, {})
        return reduce(or_, (formula.holds(state) for state in self.states), 0)

    def attains(self, row: Row) -> bool:
        """Whether what a row shows may hold by now, with all that may have happened unseen."""
        if self.unseen.hopeless(self.states, self._outstanding, Goal([row], {}, self.made)):
            return False
        return bool(self._reached(row, self.states, "observation"))

    def preceded(self, row: Row) -> bool:
        """Whether it may have held already when the service was performed that has just been answered."""
        if self._performed_in is None:
            return True
        goal, slot, ready = self._performed_in
        if any(decided(state, slot) is not None for state in ready):
            return True
        guards = [self.ground.formula(each.guard_formula, goal.env) for each in goal.rows]
        held = self._reached(row, ready, "answer")
        return any(self._assumed(guard, state) for guard in guards for state in held)

    def _reached(
        self, row: Row, states: Sequence[Partial], evidence: Literal["answer", "observation"]
    ) -> list[Partial]:
        goal = Goal([row], {}, self.made)
        return self._agreeing(goal, self.unseen.before(states, evidence, self._outstanding, goal))[0]

    @property
    def shown(self) -> bool:
        """Whether the last event showed state, rather than changed it."""
        return self._shown is not None

    def shown_alone(self, condition: Expr) -> bool:
        """Whether the last event showed the condition, whatever had been before."""
        if self._shown is None:
            return False
        told, _ = self._agreeing(self._shown, [self.world.blank()])
        formula = self.ground.formula(condition, {})
        return bool(told) and all(formula.holds(state) == YES for state in told)

    def _see_all(self, sort: object, given: Any) -> None:
        if isinstance(sort, ElementSort) and given is not None:
            for name in [given] if isinstance(given, str) else sorted(given):
                self.see(sort, name)

    # Events.

    def listen(self) -> None:
        """A message comes: nothing has been shown by it yet."""
        self._shown = self._performed_in = None

    def indicate(self, slot: str, service: str, bindings: Mapping[str, Any]) -> None:
        """A request arrives; it is outstanding from now on.

        Where the model has a transient state of the service, it is entered.
        """
        self._remember(slot)
        self._unsure.discard(slot)
        env = self.environment("indication", service, bindings)
        env |= self.environment("response", service, bindings)
        rows = self._rows.get(("indication", service), ())
        goal = Goal(rows, env, self.made)
        arrived = [after for state in self.states for after in self._indicated(goal, state)]
        request = Outstanding(slot, self._rows.get(("response", service), ()), env)
        self._asked[slot] = Asked([arrived], request)
        if rows:
            ready = self.unseen.before(self.states, "answer", self._others(slot), goal)
            self._become([after for state in ready for after in self._indicated(goal, state)])
        if request.rows:
            self._outstanding[slot] = request

    def _indicated(self, goal: Goal, state: Partial) -> list[Partial]:
        """The state after the row that applies, or unchanged where none does."""
        taken = [
            (row, after)
            for row, ways in zip(goal.rows, goal.ways, strict=True)
            for after in take(ways, state, self.constraints)[0]
        ]
        self.coverage.taken([row for row, _ in taken])
        rest = [state]
        for row in goal.rows:
            refuses = negated(self.ground.formula(row.guard_formula, goal.env))
            rest = [left for before in rest for left in self._assumed(refuses, before)]
        return [after for _, after in taken] + rest

    def _assumed(self, formula: Formula, state: Partial) -> list[Partial]:
        settled = (settle(state, left, self.constraints) for left in formula.assume(state, True, True))
        return [found for found in settled if not isinstance(found, Conflict)]

    def respond(
        self,
        slot: str,
        service: str,
        bindings: Mapping[str, Any],
        answer: str,
        *,
        local: bool = False,
        beside: tuple[str, Mapping[str, Any]] | None = None,
    ) -> Outcome:
        """The responder answers.

        ``local``: a result(-) names a local reason, which needs no explanation by the state, nor tells of it.
        ``beside``: what the message of a result(-) shows of the state, too. No reason for the result(-)
        counts that it excludes, if it is what a responder would show that has no reason.
        """
        env = self.environment("response", service, bindings)
        self._outstanding.pop(slot, None)
        self._remember(slot)
        every = self._rows.get(("response", service), ())
        rows = [row for row in every if row.answer == answer]
        goal = Goal(rows, env, self.made)
        ready = self.unseen.before(self.states, "answer", self._others(slot), goal)
        earlier = self.states
        self._performed_in = goal, slot, ready
        if (asked := self._asked.pop(slot, None)) is not None and answer == PLUS:
            self._accepted = asked
        after, refusals = self._answered(goal, ready, slot, answer)
        if slot in self._unsure:
            self._unsure.discard(slot)
            after += [state for state in earlier if decided(state, slot) is None]
        if after and not local and beside is not None and not self._shows(after, *beside):
            groundless = forced(goal, not_accepted(earlier, slot), self.constraints)
            if shown := self._shows(groundless, *beside):
                return self._refused(service, ready, env, shown)
        if local and answer == MINUS:
            after += forced(goal, not_accepted(ready, slot), self.constraints)
        if after:
            made = {assign.variable: assign.clauses for row in rows for assign in row.assigns}
            return replace(self._become(after, earlier), clauses=made)
        self.states = [undecided(state, slot) for state in earlier]
        effects = forced(goal, self.states, self.constraints)
        if local and answer == MINUS:
            return self._become(effects or self.states, earlier)
        if answer == MINUS:
            return self._refused(service, ready, env, [*effects, *self.states])
        refused = not_accepted(self._performed(Outstanding(slot, every, env), MINUS, earlier), slot)
        then = [*effects, *(refused or self.states)]
        return self._violated(goal, ready, refusals, expected=(MINUS,), then=then)

    def _shows(self, states: Sequence[Partial], service: str, bindings: Mapping[str, Any]) -> list[Partial]:
        """The states among these, with all that may happen unseen, that show this."""
        env = self.environment("shown", service, bindings)
        goal = Goal(self._rows["shown", service], env, self.made)
        return self._agreeing(goal, self.unseen.before(states, "observation", self._outstanding, goal))[0]

    def _refused(self, service: str, ready: Sequence[Partial], env: Env, then: list[Partial]) -> Outcome:
        """A result(-) for which nothing stands: a warning, for the text does not list every reason."""
        accepting = [row for row in self._rows["response", service] if row.answer == PLUS]
        clause = (
            Clause(accepting[-1].clause.ids[-1:], accepting[-1].clause.readings[-1:])
            if accepting
            else Clause(())
        )
        shown = before(self.ground, ready or self.states, env)
        found = Blame(
            f"{service}.refused", "warning", clause, "nothing stands against it", (PLUS,), shown, frozenset()
        )
        return replace(self._become(then, self.states), blame=found)

    def _answered(
        self, goal: Goal, ready: Sequence[Partial], slot: str, answer: str
    ) -> tuple[list[Partial], list[Refusal]]:
        after: list[Partial] = []
        refusals: list[Refusal] = []
        taken: list[Row] = []
        for state in ready:
            early = decided(state, slot)
            if early is not None:
                after += [undecided(state, slot)] if early == answer else []
                continue
            for row, ways in zip(goal.rows, goal.ways, strict=True):
                done, refused = take(ways, state, self.constraints)
                taken += [row] if done else []
                after += done
                refusals += refused
        self.coverage.taken(taken)
        return after, refusals

    def watch(self, slot: str) -> None:
        """State is asked for: the answer may show it at any instant from now on."""
        self._watches[slot] = Watch()

    def watched(self, slot: str) -> int | None:
        """How many instants an answer may show besides the present; ``None`` where nobody watches."""
        watch = self._watches.get(slot)
        return None if watch is None else len(watch.earlier)

    def unwatch(self, slot: str) -> None:
        """Nobody asks for what ``slot`` may show any more."""
        self._watches.pop(slot, None)

    def undisturbed(self, slot: str) -> bool:
        """Whether nothing else has been told since ``slot`` was watched; it is watched no more."""
        watch = self._watches.pop(slot, None)
        return watch is None or not watch.earlier

    def show(self, service: str, bindings: Mapping[str, Any], slot: str | None = None) -> Outcome:
        """A message shows state, at some instant since it was asked for."""
        env = self.environment("shown", service, bindings)
        watch = self._watches.get(slot) if slot is not None else None
        self._remember(slot)
        earlier = self.states
        for row in self._rows.get(("shown", service), ()):
            goal = Goal([row], env, self.made)
            ready = self.unseen.before(self.states, "observation", self._outstanding, goal)
            agreeing, refusals = self._agreeing(goal, ready)
            if watch is not None and any(self._agreed(goal, states) for states in watch.earlier):
                continue  # it may show an earlier instant, and then says nothing about this one
            if not agreeing:
                # Either it lies, and the belief stands; or it is true, and what it shows is learned anew,
                # or follows from what was before the last result(+), which should have been a result(-).
                then = [*self.states, *learned_anew(goal, self.states, self.constraints)]
                undone = as_if_refused(self._accepted, self.made, self.constraints)
                undone = self.unseen.before(undone, "observation", self._outstanding, goal)
                then += self._agreeing(goal, undone)[0]
                return self._violated(goal, ready, refusals, then=then)
            self.coverage.shown(goal, self.world.blank())
            self._become(agreeing)
            self._shown = goal
        return Outcome(written=written(earlier, self.states))

    def _agreed(self, goal: Goal, states: list[Partial]) -> bool:
        return bool(self._agreeing(goal, self.unseen.before(states, "observation", {}, goal))[0])

    def _agreeing(self, goal: Goal, ready: Sequence[Partial]) -> tuple[list[Partial], list[Refusal]]:
        after: list[Partial] = []
        refusals: list[Refusal] = []
        for state in ready:
            for ways in goal.ways:
                done, refused = take(ways, state, self.constraints)
                after += done
                refusals += refused
        return after, refusals

    def lose_sight(self) -> None:
        """Messages may be missing: nothing that can change is known any more.

        What is asked for may have been performed already, whatever has happened since.
        """
        self._unsure, self._accepted = self._unsure | self._outstanding.keys(), Asked()
        self.states = sight_lost(self.states, self.constraints)

    def drop(self, slot: str) -> None:
        """A request will not be answered any more; whether it was performed is not known."""
        outstanding = self._outstanding.pop(slot, None)
        self._asked.pop(slot, None)
        self._watches.pop(slot, None)
        self._unsure.discard(slot)
        if outstanding is not None:
            performed = (self._performed(outstanding, answer, self.states) for answer in (PLUS, MINUS))
            self._become([undecided(s, slot) for states in (self.states, *performed) for s in states])

    def _performed(self, request: Outstanding, answer: str, states: Sequence[Partial]) -> list[Partial]:
        """The states after a request has been performed, from these, whatever was answered."""
        goal = Goal([row for row in request.rows if row.answer == answer], request.env, self.made)
        ready = self.unseen.before(states, "answer", self._others(request.slot), goal)
        return self._agreeing(goal, ready)[0]

    # The set of states.

    def _others(self, slot: str) -> dict[str, Outstanding]:
        return {other: request for other, request in self._outstanding.items() if other != slot}

    def _remember(self, slot: str | None) -> None:
        """Something is told that is not the event of ``slot``: who watches may have seen before it."""
        for watched, watch in self._watches.items():
            if watched == slot:
                continue
            if not watch.earlier or watch.earlier[-1] is not self.states:
                watch.earlier.append(self.states)

    def _become(self, states: Iterable[Partial], earlier: Sequence[Partial] | None = None) -> Outcome:
        kept = distinct(states)
        if len(kept) > LARGEST_BELIEF:
            self.widened = True
            kept = widened(kept, LARGEST_BELIEF // 2)
        self.states = kept
        return Outcome(written=written(earlier, kept) if earlier is not None else frozenset())

    def _violated(
        self,
        goal: Goal,
        ready: Sequence[Partial],
        refusals: Sequence[Refusal],
        *,
        expected: tuple[str, ...] = (),
        then: list[Partial],
    ) -> Outcome:
        earlier = self.states
        found = blame(self.ground, ready or earlier, goal, refusals, expected=expected) if goal.rows else None
        return replace(self._become(then or earlier, earlier), blame=found)
