"""The part of a model that can matter to some claims: fewer variables, fewer rows, fewer values to try.

A variable matters if a claim reads it, or if a row that writes one that matters reads it. Rows that write
none that matters are dropped, so are updates and parameters that nothing reads, and values of a parameter
that no test tells from another one. Every run of the part is a run of the whole and the other way round, of
the same length once steps that change nothing that matters are left out: verdicts are the same, and a
shortest path stays a shortest one.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from mmsverify.concrete.evaluate import row_facts, step
from mmsverify.concrete.names import free_names
from mmsverify.concrete.scope import Binding, Scope
from mmsverify.concrete.trace_path import Path, Taken
from mmsverify.model import expr as ex
from mmsverify.model.declare import Assign
from mmsverify.model.expr import Expr, Ref
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim, Row
from mmsverify.model.sorts import Enumeration, EnumSort
from mmsverify.model.terms import SetOf


def cone(model: ModelData, claim: Claim) -> frozenset[str]:
    """Names of the variables that can matter to a claim."""
    known: set[str] = set()
    new = set(ex.variables_of(claim.formula))
    while new:
        known |= new
        new = {name for variable in new for name in model.depends.get(variable, ())} - known
    return frozenset(known)


def sliced(model: ModelData, claims: Sequence[Claim]) -> ModelData:
    """The part of the model that can matter to any of the claims, with these claims only."""
    known = frozenset[str]().union(*(cone(model, claim) for claim in claims))
    told = {fact for claim in claims for fact in _row_facts(claim.formula)}
    named = frozenset[str]().union(*(free_names(claim.formula) for claim in claims))
    rows = (_sliced_row(row, known, named) for row in model.actions)
    every_step = any(free_names(c.formula) and not _row_facts(c.formula) for c in claims)
    kept = tuple(row for row in rows if row.assigns or every_step or _told_of(row, told))
    return replace(model, rows=kept, claims=tuple(claims))


def _row_facts(expr: Expr) -> set[ex.RowFact]:
    return {node for node in ex.walk(expr) if isinstance(node, ex.RowFact)}


def _told_of(row: Row, told: Iterable[ex.RowFact]) -> bool:
    facts = row_facts(row)
    return any(facts[fact.fact] in fact.values for fact in told)


def _sliced_row(row: Row, known: frozenset[str], named: frozenset[str]) -> Row:
    """The row without updates of what does not matter, and without parameters that nothing reads then."""
    assigns = tuple(a for a in row.assigns if a.variable in known)
    names = named.union(*(free_names(c.condition) for c in row.guard), *map(_names, assigns))
    parameters = tuple(p for p in row.on.parameters if p.name in names)
    choices = tuple(p for p in row.choices if p.name in names)
    return replace(row, on=replace(row.on, parameters=parameters), assigns=assigns, choices=choices)


def _names(assign: Assign) -> frozenset[str]:
    return (
        free_names(assign.value) | free_names(assign.where) | frozenset().union(*map(free_names, assign.args))
    )


def restored(model: ModelData, scope: Scope, path: Path) -> Path:
    """A path of a part of ``model`` as one of the whole: the same rows, all parameters, whole states."""
    rows = {(row.id, row.answer, row.guard): row for row in model.actions}
    taken = [path[0]]
    for short in path[1:]:
        assert short.row is not None
        row = rows[short.row.id, short.row.answer, short.row.guard]
        bindings = {p.name: _binding(scope, row, p, short) for p in row.parameters}
        after = step(row, bindings, taken[-1].state, scope)
        assert after is not None, f"{row.id} is not enabled where its part is"
        taken.append(Taken(row, bindings, after))
    return tuple(taken)


def _binding(scope: Scope, row: Row, parameter: Ref | SetOf, short: Taken) -> Binding:
    if parameter.name in short.bindings:
        return short.bindings[parameter.name]
    return scope.parameter_values(row, parameter)[0]


def narrowed(model: ModelData, scope: Scope) -> Scope:
    """The scope with parameters that try only members which some test of the model tells apart."""
    sorts = {p.of for row in model.actions for p in row.parameters if isinstance(p.of, EnumSort)}
    return replace(scope, tried={sort.name: told_apart(model, sort) for sort in sorts})


def told_apart(model: ModelData, sort: EnumSort) -> tuple[Enumeration, ...]:
    """The members of an enumeration that a test names, and one to stand for all others.

    All members, if two values are compared neither of which is a literal.
    """
    tested: set[Enumeration] = set()
    for node in (node for expr in _tested_exprs(model) for node in ex.walk(expr)):
        if isinstance(node, ex.Eq) and node.left.sort == sort:
            if not isinstance(node.right, ex.Const):
                return sort.members
            assert isinstance(node.right.value, Enumeration)
            tested.add(node.right.value)
    others = [m for m in sort.members if m not in tested]
    return tuple(m for m in sort.members if m in tested or m is others[0])


def _tested_exprs(model: ModelData) -> Iterable[Expr]:
    for claim in model.claims:
        yield claim.formula
    for row in model.actions:
        yield from (c.condition for c in row.guard)
        for assign in row.assigns:
            yield assign.value
            yield assign.where
