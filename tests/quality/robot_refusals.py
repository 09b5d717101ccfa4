"""For every step of a procedure that refuses: a conversation that leads to a state in which it alone does.

Z3 finds the state: it keeps the proved invariants, nothing is outstanding in it, one condition of the
accepting row fails or none does, and for the rest it is as quiet as can be. A recording may begin at any
time, so the conversation begins there; only what no message shows (associations, R_CTRL, transfers) is
brought about before the eyes of the audit.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import z3
from robot_acts import Act
from robot_sayable import sayable
from robot_talk import Talk, row_name

from mmsverify.concrete import Scope, scope_for
from mmsverify.concrete.evaluate import Moment, Valuation, updated
from mmsverify.concrete.scope import known_facts
from mmsverify.concrete.trace_path import readable
from mmsverify.model import ModelData, Row
from mmsverify.model import expr as ex
from mmsverify.model.expr import Cell, Expr, Ref
from mmsverify.model.rows import MINUS, PLUS, after
from mmsverify.model.sorts import BOOL, Sort
from mmsverify.model.terms import SetOf
from mmsverify.symbolic.states import ClosedWorld, Enumerator

COUNTS = (0, 3)
ME, OTHER, SLOT = "client1", "client2", "request1"
Bindings = Mapping[str, Any]
Key = tuple[str, tuple[str, ...]]


def refusing(model: ModelData) -> list[Row]:
    """The rows of refusing steps: what a printed step answers, not a failure that may come at any time."""
    return [row for row in model.actions if row.on.phase == "response" and row.answer == MINUS and row.step]


def accepting(model: ModelData, row: Row) -> list[Row]:
    """The rows by which the same procedure accepts after the refusing row's step."""
    passed = row.guard[:-1]
    same = [other for other in model.actions if other.name == row.name and other.answer == PLUS]
    return [o for o in same if len(o.guard) > len(passed) and o.guard[: len(passed)] == passed]


def parts(condition: Expr) -> tuple[Expr, ...]:
    """The parts of a condition that are joined by "and"."""
    return condition.parts if isinstance(condition, ex.And) else (condition,)


class Liar(Talk):
    """A robot that may break the rules."""

    def break_rule(self, row: Row, hidden: Bindings) -> None:
        """It acts by a row without asking its guard, and answers so."""
        request = self.pending[SLOT]
        bindings = {**hidden, **self.bindings(row, request.asked)}
        self.state = updated(row, Moment(self.scope, self.state, bindings))
        self._decide(request, row)
        self._answer(Act("answer", SLOT))


@dataclass(frozen=True, slots=True)
class Situation:
    """A state without associations, what is done before a request, the request, the row that would accept."""

    model: ModelData
    scope: Scope
    start: Valuation
    acts: tuple[Act, ...]
    row: Row
    given: Bindings

    def told(self) -> Liar:
        """The conversation up to the request, with a look at everything before it."""
        talk = Liar(self.model, self.scope, self.start)
        for act in self.acts:
            assert talk.do(act), f"{act} cannot happen"
        # What is seen before local control is seen to be FALSE may have been changed at the panel meanwhile.
        talk.look_round(ME)
        talk.look_round(ME)
        assert talk.do(Act("ask", SLOT, self.row.on.service, self.given))
        heard = talk.pending[SLOT].asked
        said = {name: readable(held) for name, held in self.given.items() if name in heard}
        assert said == {name: readable(heard[name]) for name in said}, f"{said} is heard as {heard}"
        return talk


class Meeting(Enumerator):
    """Finds situations in one world."""

    def __init__(self, model: ModelData, profile: Mapping[str, Any], sizes: Mapping[str, int]) -> None:
        made = scope_for(model, sizes, profile)
        self.scope = Scope(made.elements, made.facts, COUNTS)
        facts = known_facts(model, self.scope)
        super().__init__(model, ClosedWorld(made.elements, facts, COUNTS))
        given = [*(c.condition for c in model.assumptions), *(c.formula for c in model.always), *self._calm()]
        self.solver = self._solver(*map(self._formula, given), *self._in_range(self._now))
        for key, value in facts.items():
            self.solver.add(
                self.translator.term(self._cell(key)) == self._term(model.signatures[key[0]].of, value)
            )

    # What is looked for.

    def against(self, step: Row) -> Situation | None:
        """A situation in which the step stands against the request, and no later step if that can be."""
        for row in accepting(self.model, step):
            conditions = [c.condition for c in step.guard]
            found = self._meet(row, conditions, [c.condition for c in row.guard[len(conditions) :]])
            if found is not None:
                return found
        return None

    def nothing_against(self, step: Row) -> Situation | None:
        """A situation in which nothing does, though as much as can be of the step's condition holds."""
        for row in accepting(self.model, step):
            near = [p for p in parts(step.guard[-1].condition) if known(p, row)]
            found = self._meet(row, [c.condition for c in row.guard], near)
            if found is not None:
                return found
        return None

    def _meet(self, row: Row, conditions: Sequence[Expr], near: Sequence[Expr]) -> Situation | None:
        self.solver.push()
        try:
            wanted = [*conditions, *sayable(row)]
            self.solver.add(*(self._formula(self._asked(row, each)) for each in wanted))
            self.solver.add(*(part for parameter in row.parameters for part in self._given(row, parameter)))
            self.solver.add(*self._fixed(row))
            if self.solver.check() != z3.sat:
                return None
            wishes = (*self._plain(row), *(self._asked(row, each) for each in near), *self._quiet())
            for wish in map(self._formula, wishes):
                self.solver.push()
                self.solver.add(wish)
                if self.solver.check() != z3.sat:
                    self.solver.pop()
            return self._read_situation(row, self._pinned(row))
        finally:
            while self.solver.num_scopes():
                self.solver.pop()

    def _pinned(self, row: Row) -> z3.ModelRef:
        """The first model that there is, value by value: whatever was asked before, the same is found."""
        assert self.solver.check() == z3.sat
        found = self.solver.model()
        for choice in (*self._choices(row), *map(self._values, self._now, self._sorts)):
            for wish in choice:
                if z3.is_true(found.eval(wish, model_completion=True)):
                    self.solver.add(wish)
                    break
                self.solver.push()
                self.solver.add(wish)
                if self.solver.check() == z3.sat:
                    found = self.solver.model()
                    break
                self.solver.pop()
        return found

    def _values(self, term: z3.ExprRef, of: Sort) -> list[z3.BoolRef]:
        return [term == self._term(of, value) for value in self.world.values(of)]

    def _choices(self, row: Row) -> Iterator[list[z3.BoolRef]]:
        """What each parameter may be, absent or empty first."""
        for parameter in row.parameters:
            if isinstance(parameter, SetOf):
                has = self.translator.parameter(parameter)
                for name in self.scope.names(parameter.of):
                    member = has(self._term(parameter.of, name))
                    yield [z3.Not(member), member]
                continue
            if parameter.name in row.on.optional:
                present = self.translator.formula(ex.Present(parameter.name))
                yield [z3.Not(present), present]
            yield self._values(self.translator.term(parameter), parameter.of)

    def _asked(self, row: Row, condition: Expr) -> Expr:
        """The condition after the request's indication, where the model has one that applies."""
        cases, none = [], []
        for heard in self.model.actions:
            if heard.on.phase == "indication" and heard.on.service == row.on.service:
                cases.append(
                    ex.disjunction(ex.negation(heard.guard_formula), after(condition, heard.assigns))
                )
                none.append(heard.guard_formula)
        return ex.conjunction(*cases, ex.disjunction(*none, condition))

    def _fixed(self, row: Row) -> Iterator[z3.BoolRef]:
        """It is this client's request, and no act at the panel."""
        for parameter in row.parameters:
            if isinstance(parameter, Ref) and parameter.name in ("user", "request"):
                yield self.translator.term(parameter) == self._term(
                    parameter.of, ME if parameter.name == "user" else SLOT
                )
            elif parameter.name == "panel" and isinstance(parameter, Ref):
                yield z3.Not(self.translator.formula(parameter))

    def _is(self, variable: str, *names: str, value: Any = True) -> Expr:
        """That a cell has a value, which may be a word."""
        cell, of = self._cell((variable, names)), self.model.signatures[variable].of
        if of is BOOL:
            return cell if value else ex.negation(cell)
        return ex.equal(cell, self._word(of, value))

    def _calm(self) -> Iterator[Expr]:
        """No request is on its way, no transfer half way, and messages can show who is bound to what."""
        names = self.scope.elements
        for p in names["PI"]:
            # What a profile fixes of R_ARM and R_CAL never changes (8.3).
            fixed = ex.disjunction(self._is("standard_arm", p), self._is("calibrates", p))
            yield ex.disjunction(ex.negation(fixed), self._is("reusable", p))
            for d in names["Domain"]:
                same = ex.equal(self._cell(("uses", (p, d))), self._cell(("predefined_uses", (p, d))))
                yield ex.disjunction(ex.negation(fixed), same)
            for request in names["Request"]:
                yield ex.negation(self._is("entered", request, p))
                yield ex.negation(self._is("selecting", request, p))
            for word in ("STARTING", "STOPPING", "RESUMING", "RESETTING"):
                yield ex.negation(self._is("state", p, value=word))
            bound = [self._is("uses", p, d) for d in names["Domain"]]
            gone = self._is("state", p, value="NON-EXISTENT")
            if bound:
                yield ex.disjunction(gone, *bound)
                arms = [self._is("uses", p, d) for d in names["Domain"] if d == "R_ARM"]
                yield ex.disjunction(gone, ex.equal(self._cell(("arm", (p,))), ex.disjunction(*arms)))
        for d in names["Domain"]:
            loading = [self._is("loads", u, d) for u in names["Client"]]
            yield ex.negation(self._is("domain_state", d, value="COMPLETE"))
            yield ex.negation(self._is("domain_state", d, value="INCOMPLETE"))
            yield ex.disjunction(ex.negation(self._is("domain_state", d, value="LOADING")), *loading)
            for u in names["Client"]:
                yield ex.disjunction(ex.negation(self._is("loads", u, d)), self._open())
        yield from self._calm_uploads()
        yield self._is("associated", ME)
        for u in names["Client"]:
            yield ex.negation(self._is("limited", u))
            yield ex.negation(self._is("keeps", u))
            yield ex.disjunction(ex.negation(self._is("holder", u)), self._is("associated", u))
        # A status that admits nothing but Status would forbid to look round (RP-11).
        yield ex.negation(self._is("logical", value="LIMITED-SERVICES-PERMITTED"))

    def _calm_uploads(self) -> Iterator[Expr]:
        """Each goes on for one client and reads one domain."""
        names = self.scope.elements
        for x in names["Upload"]:
            reading = [self._is("uploads", u, x) for u in names["Client"]]
            yield ex.negation(self._is("upload_state", x, value="UPLOADED"))
            yield ex.equal(ex.disjunction(*reading), self._is("upload_state", x, value="UPLOADING"))
            yield ex.equal(
                ex.disjunction(*(self._is("source", x, d) for d in names["Domain"])),
                self._is("upload_state", x, value="UPLOADING"),
            )
            # A number names an upload on its association only.
            yield from (ex.negation(self._is("uploads", u, x)) for u in names["Client"] if u != ME)
            for one in names["Domain"]:
                yield from (
                    ex.negation(ex.conjunction(self._is("source", x, one), self._is("source", x, two)))
                    for two in names["Domain"]
                    if two > one
                )

    def _open(self) -> Expr:
        return ex.conjunction(
            ex.negation(self._is("local_control")), self._is("logical", value="STATE-CHANGES-ALLOWED")
        )

    def _plain(self, row: Row) -> Iterator[Expr]:
        """What is named is of the kind of which messages tell most."""
        pi = next((p for p in row.parameters if isinstance(p, Ref) and p.name == "pi"), None)
        of = self.model.signatures["control"].of
        if pi is not None and row.on.service in ("start", "resume", "stop", "reset"):
            for kind in ("NORMAL", "CONTROLLING"):
                yield ex.equal(Cell("control", (pi,), of), self._word(of, kind))
        # Of a domain that is not sharable, a recording that begins later leaves open whether it is in use.
        if any(parameter.name == "domains" for parameter in row.parameters):
            for d in self.scope.elements["Domain"]:
                named = ex.Member("domains", Ref(f"the {d}", self.model.sorts["Domain"]))
                yield ex.disjunction(ex.negation(named), self._is("sharable", d))

    def _word(self, of: Sort, word: Any) -> ex.Const:
        meant = self._meant(of, word)
        assert not isinstance(meant, str)
        return ex.Const(meant, of)

    def _quiet(self) -> Iterator[Expr]:
        """What a plain state is like: the less goes on, the less may happen unseen."""
        names = self.scope.elements
        yield self._is("logical", value="STATE-CHANGES-ALLOWED")
        yield ex.negation(self._is("local_control"))
        yield ex.negation(self._is("intervention"))
        yield self._is("holder", ME)
        yield self._is("physical", value="OPERATIONAL")
        yield ex.negation(self._is("hung"))
        yield ex.negation(self._is("motion"))
        for p in names["PI"]:
            for word in ("RUNNING", "UNRUNNABLE", "STOPPED"):
                yield ex.negation(self._is("state", p, value=word))
            yield ex.negation(self._is("selected", p))
            yield self._is("mode", p, value="FREE-RUN")
            yield ex.negation(self._is("arm", p))
        for u in names["Client"]:
            yield from (ex.negation(self._is("loads", u, d)) for d in names["Domain"])
            if u != ME:
                yield ex.negation(self._is("associated", u))
        for x in names["Upload"]:
            yield self._is("upload_state", x, value="NON-EXISTENT")

    # What is found.

    def _read_situation(self, row: Row, found: z3.ModelRef) -> Situation:
        state: dict[Key, Any] = dict(zip(self.keys, self._read(found, self._now), strict=True))
        start, acts = self._before(state)
        given = {parameter.name: self._bound(row, parameter, found) for parameter in row.parameters}
        return Situation(self.model, self.scope, start, tuple(acts), row, given)

    def _bound(self, row: Row, parameter: Ref | SetOf, found: z3.ModelRef) -> Any:
        def true(term: z3.ExprRef) -> bool:
            return bool(z3.is_true(found.eval(term, model_completion=True)))

        if isinstance(parameter, SetOf):
            has = self.translator.parameter(parameter)
            return frozenset(
                n for n in self.scope.names(parameter.of) if true(has(self._term(parameter.of, n)))
            )
        if parameter.name in row.on.optional and not true(
            self.translator.formula(ex.Present(parameter.name))
        ):
            return None
        term = self.translator.term(parameter)
        return next(v for v in self.world.values(parameter.of) if true(term == self._term(parameter.of, v)))

    def _before(self, state: dict[Key, Any]) -> tuple[Valuation, list[Act]]:
        """The state without what clients bring about by messages, and the messages that do."""
        start, acts = dict(state), []
        clients = [u for u in self.scope.elements["Client"] if state["associated", (u,)]]
        single = state["single_association", ()]
        for (variable, names), held in state.items():
            if variable in ("associated", "holder", "hung", "loads", "uploads", "source"):
                start[variable, names] = False
            elif variable == "upload_state":
                start[variable, names] = self._meant(self.model.signatures[variable].of, "NON-EXISTENT")
            elif variable == "domain_state" and held.value == "LOADING":
                start[variable, names] = self._meant(self.model.signatures[variable].of, "NON-EXISTENT")
                start["domain_deletable", names] = False
        if state["hung", ()]:
            other = next(u for u in self.scope.elements["Client"] if u not in clients)
            acts += [
                Act("open", other),
                *exchange(self.model, "takeControl", other, times_out=False, stays=True, preempts=False),
                Act("reset", other),
            ]
        acts += [Act("open", u) for u in clients]
        for u in clients:
            if state["holder", (u,)] and not single:
                acts += exchange(self.model, "takeControl", u, times_out=False, stays=False, preempts=False)
            for d in self.scope.elements["Domain"]:
                if state["loads", (u, d)]:
                    acts += exchange(
                        self.model, "initiateDownloadSequence", u, domain=d, shares=state["sharable", (d,)]
                    )
            for x in self.scope.elements["Upload"]:
                if state["uploads", (u, x)]:
                    d = next(d for d in self.scope.elements["Domain"] if state["source", (x, d)])
                    acts += exchange(self.model, "initiateUploadSequence", u, upload=x, domain=d)
        return start, acts


def exchange(model: ModelData, service: str, user: str, **given: Any) -> list[Act]:
    """A request that is granted at once."""
    (row,) = (r for r in model.actions if r.on.service == service and r.answer == PLUS)
    asked = {"request": SLOT, "user": user, "panel": False, **given}
    return [Act("ask", SLOT, service, asked), Act("perform", SLOT, row_name(row)), Act("answer", SLOT)]


def known(condition: Expr, row: Row) -> bool:
    """Whether the row's parameters tell all that the condition speaks of."""
    return ex.refs_of(condition).keys() <= {parameter.name for parameter in row.parameters}
