"""A model's rows and claims with all names put in: ground formulas over the positions of a packed state.

A row becomes its instances, one per way to give values to its parameters; an instance whose guard is false
on its face is dropped as early as a parameter decides it. Nothing here runs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

from mmsverify.concrete.evaluate import absent_value, row_facts
from mmsverify.concrete.formulas import FALSE, TRUE, Formulas, Node
from mmsverify.concrete.layout import Layout
from mmsverify.concrete.names import check_names, conjuncts, free_names
from mmsverify.concrete.scope import Binding, is_boolean
from mmsverify.model import expr as ex
from mmsverify.model.declare import Assign
from mmsverify.model.expr import Expr, Ref
from mmsverify.model.rows import Row
from mmsverify.model.sorts import BOOL, EnumSort, IntSort, Sort
from mmsverify.model.terms import SetOf

Code = int | frozenset[int] | None
"""A value of a parameter as a code: of a set, the codes of its members; ``None`` where it is absent."""

Env = Mapping[str, Code]


@dataclass(frozen=True, slots=True)
class Instance:
    """One row with one value for each parameter: its guard, the new value of each written position."""

    row: Row
    codes: tuple[Code, ...]
    guard: tuple[int, ...]
    writes: tuple[tuple[int, int], ...]


class Grounding:
    """Expressions to ground formulas, for one layout; equal requests are answered from memory."""

    def __init__(self, layout: Layout, formulas: Formulas) -> None:
        self.layout = layout
        self.formulas = formulas
        self.facts: list[ex.RowFact] = []
        self._memo: dict[tuple[int, tuple[Code, ...]], int] = {}
        self._free: dict[int, tuple[tuple[str, ...], Expr]] = {}
        self._cells: dict[tuple[str, tuple[int, ...], bool], int] = {}

    def formula(self, expr: Expr, env: Env) -> int:
        """The ground formula of an expression whose free names ``env`` gives values to."""
        if isinstance(expr, ex.Const):
            return self.formulas.const(self._code_of(expr.sort, expr.value))
        if isinstance(expr, ex.Ref):
            return self._ref(expr, env)
        key = (id(expr), tuple(env[name] for name in self.free(expr)))
        found = self._memo.get(key)
        if found is None:
            found = self._memo[key] = self._ground(expr, env)
        return found

    def free(self, expr: Expr) -> tuple[str, ...]:
        """The free names of an expression, sorted; it is kept, so that its identity stays its own."""
        found = self._free.get(id(expr))
        if found is None:
            found = self._free[id(expr)] = (tuple(sorted(free_names(expr))), expr)
        return found[0]

    def codes(self, sort: Sort) -> range:
        """The codes of all values of a sort."""
        if isinstance(sort, IntSort):
            low, high = self.layout.scope.bounds(sort)
            return range(low, high + 1)
        return range(len(self.layout.scope.values(sort)))

    def _code_of(self, sort: Sort, value: object) -> int:
        if isinstance(sort, EnumSort):
            return sort.members.index(value)
        return int(value)  # type: ignore[call-overload,no-any-return]

    def _ref(self, ref: Ref, env: Env) -> int:
        code = env[ref.name]
        assert not isinstance(code, frozenset)
        if code is None:
            return FALSE if is_boolean(ref.sort) else self.formulas.absent
        return self.formulas.const(code)

    def _ground(self, expr: Expr, env: Env) -> int:
        f = self.formulas
        match expr:
            case ex.Cell(variable, args, of, after):
                return self._at(args, env, of, lambda codes: self._cell(variable, codes, after))
            case ex.Member(name, element):
                held = env[name] or frozenset()
                assert isinstance(held, frozenset)
                return self._at((element,), env, BOOL, lambda codes: int(codes[0] in held))
            case ex.Present(name):
                return FALSE if env[name] is None else TRUE
            case ex.RowFact():
                return self._fact(expr)
            case ex.Not(body):
                return f.negation(self.formula(body, env))
            case ex.And(parts):
                return f.conjunction(self.formula(part, env) for part in parts)
            case ex.Or(parts):
                return f.disjunction(self.formula(part, env) for part in parts)
            case ex.Quantified():
                return self._quantified(expr, env)
        return self._ground_values(expr, env)

    def _ground_values(self, expr: Expr, env: Env) -> int:
        f = self.formulas
        match expr:
            case ex.Eq(left, right):
                return f.same(self.formula(left, env), self.formula(right, env), is_boolean(left.sort))
            case ex.Less(left, right):
                return f.less(self.formula(left, env), self.formula(right, env))
            case ex.Plus(left, right, factor):
                return f.plus(self.formula(left, env), self.formula(right, env), factor)
            case ex.Ite(condition, then, otherwise):
                values = self.formula(then, env), self.formula(otherwise, env)
                return f.ite(self.formula(condition, env), *values, is_boolean(expr.sort))
        raise TypeError(f"no grounding for {expr!r}")

    def _fact(self, fact: ex.RowFact) -> int:
        if fact not in self.facts:
            self.facts.append(fact)
        return self.formulas.fact(self.facts.index(fact))

    def _quantified(self, expr: ex.Quantified, env: Env) -> int:
        join = self.formulas.conjunction if expr.universal else self.formulas.disjunction
        return join(self.formula(expr.body, each) for each in self.extensions(expr.bound, env))

    def extensions(self, bound: Sequence[Ref], env: Env) -> Iterator[Env]:
        """The environment with the bound variables set to every combination of values."""
        for codes in product(*(self.codes(ref.of) for ref in bound)):
            yield {**env, **dict(zip((ref.name for ref in bound), codes, strict=True))}

    def _at(self, args: Sequence[Expr], env: Env, of: Sort, at: Callable[[tuple[int, ...]], int]) -> int:
        """What ``at`` gives at the values of the arguments: a choice where those depend on the state."""
        f = self.formulas
        boolean = is_boolean(of)
        found = FALSE if boolean else f.absent
        for conditions, codes in self.places(args, env):
            found = f.ite(f.conjunction(conditions), at(codes), found, boolean)
        return found

    def places(self, args: Sequence[Expr], env: Env) -> Iterator[tuple[tuple[int, ...], tuple[int, ...]]]:
        """The tuples of codes that arguments can be, with their conditions; none where one is absent."""
        cases = [self.formulas.cases(self.formula(arg, env), self.codes(arg.sort)) for arg in args]
        for combined in product(*cases):
            yield tuple(c for c, _ in combined), tuple(code for _, code in combined)

    def _cell(self, variable: str, codes: tuple[int, ...], after: bool) -> int:
        key = (variable, codes, after)
        found = self._cells.get(key)
        if found is None:
            found = self._cells[key] = self._placed(variable, codes, after)
        return found

    def _placed(self, variable: str, codes: tuple[int, ...], after: bool) -> int:
        names = tuple(
            str(self.layout.value(sort, code))
            for sort, code in zip(self.layout.model.signatures[variable].sorts, codes, strict=True)
        )
        constant = self.layout.fixed.get((variable, names))
        if constant is not None:
            return self.formulas.const(constant)
        return self.formulas.cell(self.layout.position[variable, names], after)

    def instances(self, row: Row) -> Iterator[Instance]:
        """The instances of a row whose guard is not false on its face, in the order of the values."""
        check_names(row)
        pending = [part for conjunct in row.guard for part in conjuncts(conjunct.condition)]
        yield from self._instances(row, 0, {}, pending, ())

    def _instances(
        self, row: Row, depth: int, env: Env, pending: list[Expr], guard: tuple[int, ...]
    ) -> Iterator[Instance]:
        known = [part for part in pending if env.keys() >= set(self.free(part))]
        whole = self.formulas.conjunction((*guard, *(self.formula(part, env) for part in known)))
        if whole == FALSE:
            return
        guard = self.formulas.parts(whole)
        if depth == len(row.parameters):
            yield Instance(row, tuple(env.values()), guard, self._writes(row, env))
            return
        later = [part for part in pending if not any(part is other for other in known)]
        parameter = row.parameters[depth]
        for code in self._parameter_codes(row, parameter):
            yield from self._instances(row, depth + 1, {**env, parameter.name: code}, later, guard)

    def _parameter_codes(self, row: Row, parameter: Ref | SetOf) -> Iterator[Code]:
        if isinstance(parameter, SetOf):
            yield from self.layout.scope.subsets(parameter.of)
            return
        if parameter.name in row.on.optional:
            yield None
        tried = self.layout.scope.tried.get(parameter.of.name)
        yield from (
            self.codes(parameter.of) if tried is None else (self._code_of(parameter.of, v) for v in tried)
        )

    def _writes(self, row: Row, env: Env) -> tuple[tuple[int, int], ...]:
        new: dict[int, int] = {}
        for assign in row.assigns:
            boolean = is_boolean(self.layout.model.signatures[assign.variable].of)
            for position, condition, value in self._hits(row, assign, env):
                before = new.get(position, self.formulas.cell(position))
                new[position] = self.formulas.ite(condition, value, before, boolean)
        return tuple((i, value) for i, value in new.items() if value != self.formulas.cell(i))

    def _hits(self, row: Row, assign: Assign, env: Env) -> Iterator[tuple[int, int, int]]:
        """The positions that an assignment may touch, when, and the value that it gives."""
        for each in self.extensions(assign.bound, env):
            where = self.formula(assign.where, each)
            for conditions, codes in self.places(assign.args, each) if where != FALSE else ():
                condition = self.formulas.conjunction((where, *conditions))
                if condition != FALSE:
                    cell = self.formulas.nodes[self._cell(assign.variable, codes, False)]
                    yield cell.cell, condition, self._assigned(row, assign, each)

    def _assigned(self, row: Row, assign: Assign, env: Env) -> int:
        value = self.formula(assign.value, env)
        if value == self.formulas.absent:
            raise absent_value(row, assign)
        return value

    def bindings(self, instance: Instance) -> dict[str, Binding]:
        """The values of an instance's parameters by name."""
        return {
            parameter.name: self._binding(parameter, code)
            for parameter, code in zip(instance.row.parameters, instance.codes, strict=True)
        }

    def _binding(self, parameter: Ref | SetOf, code: Code) -> Binding:
        if isinstance(code, frozenset):
            return frozenset(str(self.layout.value(parameter.of, member)) for member in code)
        return None if code is None else self.layout.value(parameter.of, code)


def settled_facts(facts: Sequence[ex.RowFact], row: Row) -> Callable[[Node], int | None]:
    """The change of a two-state claim that settles what it says of the row."""
    told = row_facts(row)

    def atom(node: Node) -> int | None:
        if node.op != "fact":
            return None
        fact = facts[node.code]
        return TRUE if told[fact.fact] in fact.values else FALSE

    return atom
