"""Why an event cannot be: the conjunct that refused, in the state that comes closest, and what was known.

Nothing is decided here; the belief calls for an explanation once it is sure that there is no way.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce
from typing import Any

from mmsverify.concrete.belief.act import Refusal
from mmsverify.concrete.belief.goal import Goal
from mmsverify.concrete.belief.ground import Ground
from mmsverify.concrete.belief.partial import OTHER, Key, Partial
from mmsverify.concrete.belief.ready import Ready
from mmsverify.concrete.belief.values import ABSENT, NO, Env, Known, everything, join, plain, single
from mmsverify.model import expr as ex
from mmsverify.model.expr import Cell, Eq, Expr, Ref
from mmsverify.model.rows import Clause, Conjunct, Row
from mmsverify.model.sorts import BOOL, Sort
from mmsverify.model.terms import SetOf


@dataclass(frozen=True, slots=True)
class Blame:
    """One violation as data: the rule, what it rests on, a sentence about it, and the state before.

    ``reads`` are the cells that the refusing condition reads; the events that last wrote them are the related
    ones. ``observed``: what was shown, as ``attribute=value``, if it was one value.
    """

    rule: str
    level: str
    clause: Clause
    says: str
    expected: tuple[str, ...]
    before: Mapping[str, Any]
    reads: frozenset[Key]
    observed: str = ""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of an event: a violation or none.

    ``written`` are the cells that it changed, ``clauses`` those that made it change them, by variable.
    """

    blame: Blame | None = None
    written: frozenset[Key] = frozenset()
    clauses: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


def blame(
    ground: Ground,
    states: Sequence[Partial],
    goal: Goal,
    refusals: Sequence[Refusal],
    *,
    expected: tuple[str, ...],
) -> Blame:
    """The mildest and most plausible explanation: the state and row with the fewest conditions broken."""
    best = min(
        (_breach(way, state, refusals) for ways in goal.ways for way in ways for state in states), key=_weight
    )
    conjunct, invariant, state, env = best.conjunct, best.invariant, best.state, goal.env
    shown = _expected(conjunct, states, env, ground) or expected
    return Blame(
        rule=conjunct.rule,
        level=best.level,
        clause=conjunct.clause + invariant,
        says=_sentence(conjunct.says, states, goal),
        expected=shown,
        before=before(ground, states, env),
        reads=_cells(conjunct, state, env),
        observed=_observed(conjunct, env),
    )


@dataclass(frozen=True, slots=True)
class _Breach:
    conjunct: Conjunct
    invariant: Clause
    state: Partial
    broken: int
    level: str
    passed: int


def _weight(breach: _Breach) -> tuple[bool, int, int]:
    return (breach.level == "error", breach.broken, -breach.passed)


def _breach(way: Ready, state: Partial, refusals: Sequence[Refusal]) -> _Breach:
    """The conditions of the row that are certainly broken in the state, or the one where it got stuck."""
    row = way.row
    broken = [(i, row.guard[i]) for i, formula in enumerate(way.guard) if formula.holds(state) == NO]
    stuck = [r for r in refusals if r.row is row]
    invariant = next((r.invariant for r in stuck if r.invariant.ids and not broken), Clause(()))
    if not broken:
        where = max(stuck, key=lambda r: r.passed, default=None)
        broken = [(where.passed, where.conjunct)] if where else [(len(row.guard), _whole(row))]
    errors = [pair for pair in broken if pair[1].level == "error"]
    passed, conjunct = (errors or broken)[0]
    return _Breach(conjunct, invariant, state, len(broken), "error" if errors else "warning", passed)


def _whole(row: Row) -> Conjunct:
    """The row as one condition: where its guard may hold, but nothing that it leads to can be."""
    return Conjunct(row.guard_formula, row.clause, row.name, "what it leads to cannot be")


def _sentence(says: str, states: Sequence[Partial], goal: Goal) -> str:
    """``says`` with its slots filled: parameters of the event and, by variable name, what the states hold."""
    sorts = {p.name: p.of for row in goal.rows for p in row.on.parameters if not isinstance(p, SetOf)}
    words = {name: _word(given, sorts.get(name, BOOL)) for name, given in goal.env.items()}
    for signature in states[0].world.model.signatures.values():
        if not signature.sorts and signature.name not in words:
            words[signature.name] = _word(_joined(states, (signature.name, ())), signature.of)
    return says.format_map(_Words(words))


class _Words(dict[str, str]):
    def __missing__(self, name: str) -> str:
        return name


def _word(given: Any, sort: Sort) -> str:
    if given is ABSENT or given is None:
        return "none"
    if isinstance(given, str):
        return given
    if isinstance(given, frozenset):
        return ", ".join(sorted(given)) or "nothing"
    words = (str(v).upper() if isinstance(v, bool) else str(v) for v in plain(given, sort))
    return " or ".join(words) or "unknown"


def _expected(conjunct: Conjunct, states: Sequence[Partial], env: Env, ground: Ground) -> tuple[str, ...]:
    """For a shown value: the values that it could have had, as ``attribute=value``."""
    for held, shown in _compared(conjunct, env):
        value, sort = ground.value(held, env), held.sort
        if value is None:
            return ()
        listed = plain(reduce(join, (value.known(state) for state in states)), sort)
        return tuple(f"{_attribute(shown)}={v}" for v in listed if v not in plain(env[shown.name], sort))
    return ()


def _observed(conjunct: Conjunct, env: Env) -> str:
    """The shown value itself."""
    for _, shown in _compared(conjunct, env):
        return f"{_attribute(shown)}={_word(env[shown.name], shown.of)}"
    return ""


def _compared(conjunct: Conjunct, env: Env) -> Iterator[tuple[Expr, Ref]]:
    """What the condition compares with a shown value, and the parameter that shows it."""
    for node in ex.walk(conjunct.condition):
        if not isinstance(node, Eq) or not isinstance(node.right, Ref):
            continue
        if node.right.name.startswith("shown_") and env[node.right.name] is not ABSENT:
            yield node.left, node.right


def _attribute(shown: Ref) -> str:
    return shown.name.removeprefix("shown_")


def _joined(states: Sequence[Partial], key: Key) -> Known:
    return reduce(join, (state.get(key) for state in states))


def before(ground: Ground, states: Sequence[Partial], env: Env) -> dict[str, Any]:
    """The state before the event, by attribute: single cells, definitions, cells of the names in the event.

    Relations that do not hold are left out, and what is not known.
    """
    model = ground.world.model
    names = {given for given in env.values() if isinstance(given, str)}
    names |= {n for given in env.values() if isinstance(given, frozenset) for n in given}
    shown: dict[str, Any] = {}
    for key in sorted({key for state in states for key, _ in state.cells()}):
        variable, args = key
        signature = model.signatures[variable]
        if signature.rigid or OTHER in args or (args and not names.intersection(args)):
            continue
        known = _joined(states, key)
        if not (args and signature.of is BOOL and known == NO):
            _put(shown, f"{variable}[{', '.join(args)}]" if args else variable, known, signature.of)
    for name, (parameters, body) in model.definitions.items():
        value = None if parameters or body.sort is BOOL else ground.value(body, {})
        if value is not None:
            _put(shown, name, reduce(join, (value.known(state) for state in states)), body.sort)
    return dict(sorted(shown.items()))


def _put(shown: dict[str, Any], name: str, known: Known, sort: Sort) -> None:
    if known == everything(sort):
        return
    listed = plain(known, sort)
    if len(listed) == 1 and single(known):
        shown[name] = listed[0]
    elif listed and len(listed) < 6:
        shown[name] = {"oneOf": listed}


def _cells(conjunct: Conjunct, state: Partial, env: Env) -> frozenset[Key]:
    """The cells that the condition reads in this environment, bound variables over all known names."""
    keys: set[Key] = set()
    for node in ex.walk(conjunct.condition):
        if isinstance(node, Cell):
            keys |= set(_instances(node, state, env))
    return frozenset(keys)


def _instances(cell: Cell, state: Partial, env: Env) -> Iterable[Key]:
    fixed = [env.get(arg.name) if isinstance(arg, Ref) else None for arg in cell.args]
    for key, _ in state.cells():
        if key[0] == cell.variable and all(
            not isinstance(f, str) or f == name for f, name in zip(fixed, key[1], strict=True)
        ):
            yield key
