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
from mmsverify.concrete.scope import Scope
from mmsverify.model.expr import Cell, Expr, RowFact, negation, walk
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim


def speaks_of_steps(claim: Claim) -> bool:
    """Whether a claim is settled by a step rather than by a state."""
    return any(
        isinstance(node, RowFact) or (isinstance(node, Cell) and node.next) for node in walk(claim.formula)
    )


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
        """Like ``successors``, without steps that can neither change the state nor settle one of these claims.

        Of instances that differ only in parameters on which neither guard nor effect depends, one stands for all.
        """
        wanted: dict[object, int] = {}
        for number, instance in enumerate(self.instances):
            checks = tuple(self.check(claim, number) for claim in steps)
            if instance.writes or any(check != FALSE for check in checks):
                wanted.setdefault((instance.guard, instance.writes, checks), number)
        return compile_successors(self.layout, self.formulas, self.instances, wanted.values())

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
        """What settles the claim, and the row's parameters that it names; one that the row has not is absent."""
        expr = self._events.setdefault(claim.name, event(claim))
        given = dict(zip((p.name for p in instance.row.parameters), instance.codes, strict=True))
        return expr, {name: given.get(name) for name in self.grounding.free(expr)}

    def _memo(self, key: object) -> dict[int, int]:
        return self._memos.setdefault(key, {})

    def predicate(self, formula: Expr) -> Predicate:
        """A closed one-state formula as a function of a packed state."""
        return compile_predicate(self.formulas, self.grounding.formula(formula, {}))

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
