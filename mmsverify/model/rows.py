"""What a model is made of once it is assembled: rows, claims, clauses. Plain data, the same for every reader.

A row is one way to answer one event: guard conjuncts, updates, answer. Guards stay lists of conjuncts, so
that replay can name the one that refused, with its clause.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

from mmsverify.model import expr as ex
from mmsverify.model.declare import Assign, On
from mmsverify.model.expr import Cell, Expr, Ref
from mmsverify.model.rewrite import map_cells, rebuilt, substitute, unused
from mmsverify.model.sorts import Sort
from mmsverify.model.terms import SetOf

Level = Literal["error", "warning"]
READINGS = ("RP-", "VR-", "MR-")
"""How the ids of readings begin: one letter pair for each text that is read."""
PLUS, MINUS, SHOWN = "result(+)", "result(-)", "shown"


@dataclass(frozen=True, slots=True)
class Clause:
    """A citation: ids of the clause register, base assumptions (``B-``), readings (``READINGS``)."""

    ids: tuple[str, ...]
    readings: tuple[str, ...] = ()

    @staticmethod
    def of(*cited: str) -> Clause:
        """Sort ids into clauses and readings by their prefix."""
        readings = tuple(c for c in cited if c.startswith(("B-", *READINGS)))
        return Clause(tuple(c for c in cited if c not in readings), readings)

    def __add__(self, other: Clause) -> Clause:
        return Clause(_merged(self.ids, other.ids), _merged(self.readings, other.readings))


def _merged(left: Iterable[str], right: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys((*left, *right)))


@dataclass(frozen=True, slots=True)
class Repair:
    """Why a row of a variant differs from the text: the clauses that it mends, the reading, why."""

    mends: Clause
    because: str


@dataclass(frozen=True, slots=True)
class Conjunct:
    """One condition of a guard and what it rests on; ``says`` tells a breach, with ``{parameter}`` slots."""

    condition: Expr
    clause: Clause
    rule: str = ""
    says: str = ""
    level: Level = "error"


@dataclass(frozen=True)
class Row:
    """One way to answer an event: if all conjuncts hold, the assignments are made and ``answer`` is given.

    ``choices`` are parameters that no event shows (free choices of the responder). ``explains`` restricts an
    internal row to the kind of evidence that it may explain: any, or an observed state only. ``never_after``
    names internal rows after which it does not fire before the next event.
    """

    name: str
    on: On
    guard: tuple[Conjunct, ...]
    assigns: tuple[Assign, ...]
    answer: str
    clause: Clause
    choices: tuple[Ref | SetOf, ...] = ()
    step: str = ""
    explains: Literal["any", "observation"] = "any"
    never_after: tuple[str, ...] = ()
    place: str = field(default="", compare=False)

    @property
    def id(self) -> str:
        """The row's name with its deciding step, unique in a model."""
        return f"{self.name}/{self.step}" if self.step else self.name

    @property
    def parameters(self) -> tuple[Ref | SetOf, ...]:
        """All parameters: those of the event, then the free choices."""
        return self.on.parameters + self.choices

    @cached_property
    def writes(self) -> frozenset[str]:
        """Names of the variables that the row may change."""
        return frozenset(assign.variable for assign in self.assigns)

    @cached_property
    def reads(self) -> frozenset[str]:
        """Names of the variables that guard and updates read."""
        read: set[str] = set()
        for conjunct in self.guard:
            read |= ex.variables_of(conjunct.condition)
        for assign in self.assigns:
            read |= ex.variables_of(assign.value) | ex.variables_of(assign.where)
        return frozenset(read)

    @property
    def guard_formula(self) -> Expr:
        """The conjunction of the guard."""
        return ex.conjunction(*(c.condition for c in self.guard))


@dataclass(frozen=True, slots=True)
class Claim:
    """A property of the model: of every state, of some reachable state, or of every step.

    ``provided`` speaks of rigid variables: under a profile in which it fails, a ``sometimes`` is not asked.
    """

    name: str
    kind: Literal["always", "sometimes", "step"]
    clause: Clause
    formula: Expr
    says: str = ""
    assists: bool = False
    provided: Expr = ex.TRUE
    place: str = field(default="", compare=False)

    @property
    def title(self) -> str:
        """The name as results print it: the Python name with hyphens."""
        return self.name.replace("_", "-")


@dataclass(frozen=True, slots=True)
class Gap:
    """Events and states for which the text gives no rule, declared so that the gap is known to be one."""

    name: str
    clause: Clause
    says: str


@dataclass(frozen=True, slots=True)
class Signature:
    """A state variable's shape: the sorts of its arguments and of its value, and whether it ever changes."""

    name: str
    sorts: tuple[Sort, ...]
    of: Sort
    rigid: bool
    doc: str = ""


def after(expr: Expr, assigns: Sequence[Assign]) -> Expr:
    """The expression, read in the state after the assignments, as one over the state before them.

    This is the only definition of what an update means; the weakest precondition of a formula is ``after`` of
    it.
    """
    by_variable: dict[str, list[Assign]] = {}
    for assign in assigns:
        by_variable.setdefault(assign.variable, []).append(assign)
    if not by_variable:
        return expr
    return map_cells(
        expr, lambda cell: _updated(cell, by_variable.get(cell.variable, ())), frozenset(by_variable)
    )


def _updated(cell: Cell, assigns: Sequence[Assign]) -> Expr:
    value: Expr = cell
    for assign in assigns:
        hit, new = matched(assign, cell.args)
        value = ex.choice(hit, new, value)
    return value


def matched(assign: Assign, args: tuple[Expr, ...]) -> tuple[Expr, Expr]:
    """When the assignment touches the cell at ``args``, and the value that it gives there."""
    bound = {ref.name: ref for ref in assign.bound}
    solved: dict[str, Expr] = {}
    left: list[tuple[Expr, Expr]] = []
    for target, actual in zip(assign.args, args, strict=True):
        if isinstance(target, Ref) and target.name in bound and target.name not in solved:
            solved[target.name] = actual
        else:
            left.append((actual, target))
    # The names in ``args`` are not this assignment's: no substitution or quantifier of it may touch them.
    free = tuple(ref for name, ref in bound.items() if name not in solved)
    taken = {name for arg in args for name in ex.refs_of(arg)}
    fresh = {ref.name: Ref(unused(ref.name, taken), ref.of) for ref in free}
    known: dict[str, Expr] = {**solved, **fresh}
    tests = (ex.equal(actual, substitute(target, known)) for actual, target in left)
    condition = ex.conjunction(*tests, substitute(assign.where, known))
    return ex.quantified(False, tuple(fresh.values()), condition), substitute(assign.value, known)


def step_formula(claim: Expr, row: Row) -> Expr:
    """A two-state claim, for the steps of one row, as a formula over the state before it.

    Facts about the row are decided; a parameter that the row does not have is FALSE.
    """

    def change(cell: Cell) -> Expr:
        plain = Cell(cell.variable, cell.args, cell.of)
        return after(plain, row.assigns) if cell.next else plain

    facts = {"answer": row.answer, "service": row.on.service, "phase": row.on.phase, "name": row.name}
    known = {parameter.name for parameter in row.parameters}
    absent = {
        name: ex.FALSE
        for name, ref in ex.refs_of(claim).items()
        if name not in known and not name.endswith(ex.BOUND)
    }
    return map_cells(substitute(_resolved(claim, facts), absent), change)


def _resolved(expr: Expr, facts: Mapping[str, str]) -> Expr:
    if isinstance(expr, ex.RowFact):
        return ex.Const(facts[expr.fact] in expr.values)
    return rebuilt(expr, lambda part: _resolved(part, facts))
