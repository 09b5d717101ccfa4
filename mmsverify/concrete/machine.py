"""A model in a scope, ready to run: initial states, successors, claims as predicates over packed states.

This is what search and graph work with. It only brings grounding and compilation together.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

from mmsverify.concrete.compile import (
    Predicate,
    Successors,
    TwoStatePredicate,
    compile_predicate,
    compile_step,
    compile_successors,
)
from mmsverify.concrete.formulas import FALSE, Formulas, Node
from mmsverify.concrete.ground import Env, Grounding, Instance, settled_facts
from mmsverify.concrete.initial import Start, initial_states, settled_rigid_cells
from mmsverify.concrete.layout import Layout
from mmsverify.concrete.names import free_names
from mmsverify.concrete.scope import CellKey, Scope
from mmsverify.model.expr import Cell, Expr, Ref, RowFact, negation, walk
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim
from mmsverify.model.sorts import Sort


def speaks_of_steps(claim: Claim) -> bool:
    """Whether a claim is settled by a step rather than by a state: one that names a parameter is, too."""
    of_step = (isinstance(n, RowFact) or (isinstance(n, Cell) and n.next) for n in walk(claim.formula))
    return any(of_step) or bool(free_names(claim.formula))


def event(claim: Claim) -> Expr:
    """What settles a claim: its breach, or for a ``Sometimes`` its coming true."""
    return claim.formula if claim.kind == "sometimes" else negation(claim.formula)


class Machine:
    """The rows of a model with the names of a scope put in. Built once, then only read."""

    def __init__(self, model: ModelData, scope: Scope) -> None:
        self.model = model
        self.scope = scope
        self.layout = Layout(model, scope, settled_rigid_cells(model, scope))
        self.formulas = Formulas()
        self.grounding = Grounding(self.layout, self.formulas)
        self.instances: tuple[Instance, ...] = tuple(
            instance for row in model.actions for instance in self.grounding.instances(row)
        )
        self._events: dict[str, Expr] = {}
        self._checks: dict[tuple[str, int], int] = {}
        self._memos: dict[object, dict[int, int]] = {}

    @cached_property
    def start(self) -> Start:
        """The initial states."""
        return initial_states(self.grounding)

    @cached_property
    def successors(self) -> Successors:
        """From a state to every step from it: pairs of an instance's number and the next state."""
        return compile_successors(self.layout, self.formulas, self.instances, range(len(self.instances)))

    def moves(self, steps: Sequence[Claim]) -> Successors:
        """Like ``successors``, without steps that neither change the state nor settle one of these claims.

        Of instances with one effect that settle the same, those stand for all whose guards are weakest.
        """
        alike: dict[object, list[int]] = {}
        for number, instance in enumerate(self.instances):
            checks = tuple(self.check(claim, number) for claim in steps)
            if instance.writes or any(check != FALSE for check in checks):
                alike.setdefault((instance.writes, checks), []).append(number)
        wanted = (number for numbers in alike.values() for number in self._weakest(numbers))
        return compile_successors(self.layout, self.formulas, self.instances, wanted)

    def _weakest(self, numbers: Sequence[int]) -> list[int]:
        """The instances whose guard no other one's guard is a part of."""
        kept: list[tuple[frozenset[int], int]] = []
        for guard, number in sorted(
            ((frozenset(self.instances[n].guard), n) for n in numbers),
            key=lambda item: (len(item[0]), item[1]),
        ):
            if not any(weaker <= guard for weaker, _ in kept):
                kept.append((guard, number))
        return [number for _, number in kept]

    def check(self, claim: Claim, number: int) -> int:
        """The formula that tells whether a step of one instance settles a claim about steps."""
        found = self._checks.get((claim.name, number))
        if found is None:
            instance = self.instances[number]
            row, written = instance.row, frozenset(position for position, _ in instance.writes)
            whole = self.grounding.formula(*self._event(claim, instance))
            atom = settled_facts(self.grounding.facts, row)
            settled = self.formulas.rebuilt(whole, atom, self._memo((row.answer, row.on.service, row.name)))
            found = self.formulas.rebuilt(settled, _Kept(self.formulas, written), self._memo(written))
            self._checks[claim.name, number] = found
        return found

    def _event(self, claim: Claim, instance: Instance) -> tuple[Expr, Env]:
        """What settles the claim, and the row's parameters that it names; one the row has not is absent."""
        expr = self._events.setdefault(claim.name, event(claim))
        given = dict(zip((p.name for p in instance.row.parameters), instance.codes, strict=True))
        return expr, {name: given.get(name) for name in self.grounding.free(expr)}

    def _memo(self, key: object) -> dict[int, int]:
        return self._memos.setdefault(key, {})

    def out_of_reach(self, claim: Claim) -> bool:
        """Whether what is fixed in this scope already tells that no state, or no step, settles a claim."""
        if speaks_of_steps(claim):
            return all(self.check(claim, number) == FALSE for number in range(len(self.instances)))
        return self.grounding.formula(event(claim), {}) == FALSE

    def predicate(self, formula: Expr) -> Predicate:
        """A closed one-state formula as a function of a packed state."""
        return compile_predicate(self.formulas, self.grounding.formula(formula, {}))

    def readings(self, name: str) -> list[tuple[CellKey, Predicate]]:
        """A variable or definition at all its arguments: each with the function from a state to its code."""
        parameters = self._parameters(name)
        refs = tuple(Ref(f"at{i}", sort) for i, sort in enumerate(parameters))
        expr = self.model.define(name, *refs)
        found = []
        for env in self.grounding.extensions(refs, {}):
            args = tuple(str(self.layout.value(ref.of, int(env[ref.name]))) for ref in refs)  # type: ignore[arg-type]
            found.append(((name, args), compile_predicate(self.formulas, self.grounding.formula(expr, env))))
        return found

    def sort_of(self, name: str) -> Sort:
        """The sort of the values of a variable or definition."""
        if name in self.model.definitions:
            return self.model.definitions[name][1].sort
        return self.model.signatures[name].of

    def _parameters(self, name: str) -> tuple[Sort, ...]:
        if name in self.model.definitions:
            return tuple(ref.of for ref in self.model.definitions[name][0])
        return self.model.signatures[name].sorts

    def step_predicate(self, formula: int) -> TwoStatePredicate:
        """A ground two-state formula as a function of a state and the next one."""
        return compile_step(self.formulas, formula)


class _Kept:
    """The change of a two-state formula that reads a cell that no instance writes from the state before."""

    def __init__(self, formulas: Formulas, written: frozenset[int]) -> None:
        self.formulas, self.written = formulas, written

    def __call__(self, node: Node) -> int | None:
        if not node.next or node.cell in self.written:
            return None
        if node.op == "cell":
            return self.formulas.cell(node.cell)
        return self.formulas.same(self.formulas.cell(node.cell), self.formulas.const(node.code))
