"""Why an event cannot be: the conjunct that refused, in the state that comes closest, and what was known.

Nothing is decided here; the belief calls for an explanation once it is sure that there is no way.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Any

from mmsverify.concrete.belief.act import Refusal
from mmsverify.concrete.belief.partial import OTHER, Key, Partial
from mmsverify.concrete.belief.truth import ABSENT, Env, truth, value
from mmsverify.concrete.belief.values import NO, Known, join, plain, single
from mmsverify.model import expr as ex
from mmsverify.model.expr import Cell, Eq, Ref
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Clause, Conjunct, Row


@dataclass(frozen=True, slots=True)
class Blame:
    """One violation as data: the rule, what it rests on, a sentence about it, and the state before.

    ``reads`` are the cells that the refusing condition reads; the events that last wrote them are the related
    ones.
    """

    rule: str
    level: str
    clause: Clause
    says: str
    expected: tuple[str, ...]
    before: Mapping[str, Any]
    reads: frozenset[Key]


def blame(
    model: ModelData,
    states: Sequence[Partial],
    rows: Sequence[Row],
    refusals: Sequence[Refusal],
    env: Env,
    *,
    expected: tuple[str, ...],
) -> Blame:
    """The mildest and most plausible explanation: the state and row with the fewest conditions broken."""
    best = min((_breach(row, state, env, refusals) for row in rows for state in states), key=_weight)
    conjunct, invariant, state = best.conjunct, best.invariant, best.state
    shown = _expected(conjunct, states, env) or expected
    return Blame(
        rule=conjunct.rule,
        level=best.level,
        clause=conjunct.clause + invariant,
        says=_sentence(conjunct.says, states, env),
        expected=shown,
        before=before(model, states, env),
        reads=_cells(conjunct, state, env),
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


def _breach(row: Row, state: Partial, env: Env, refusals: Sequence[Refusal]) -> _Breach:
    """The conditions of the row that are certainly broken in the state, or the one where it got stuck."""
    broken = [(i, c) for i, c in enumerate(row.guard) if truth(c.condition)(state, env) == NO]
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


def _sentence(says: str, states: Sequence[Partial], env: Env) -> str:
    """``says`` with its slots filled: parameters of the event and, by variable name, what the states hold."""
    words = {name: _word(given) for name, given in env.items()}
    for variable in states[0].world.full if states else ():
        words.setdefault(variable, _word(_joined(states, (variable, ()))))
    return says.format_map(_Words(words))


class _Words(dict[str, str]):
    def __missing__(self, name: str) -> str:
        return name


def _word(given: Any) -> str:
    if given is ABSENT or given is None:
        return "none"
    if isinstance(given, str):
        return given
    if isinstance(given, frozenset) and all(isinstance(v, str) for v in given):
        return ", ".join(sorted(given)) or "nothing"
    return " or ".join(str(v).upper() if isinstance(v, bool) else str(v) for v in plain(given)) or "unknown"


def _expected(conjunct: Conjunct, states: Sequence[Partial], env: Env) -> tuple[str, ...]:
    """For a shown value: the values that it could have had, as ``attribute=value``."""
    for node in ex.walk(conjunct.condition):
        if isinstance(node, Eq) and isinstance(node.right, Ref) and node.right.name.startswith("shown_"):
            listed = plain(reduce(join, (value(node.left)(state, env) for state in states)))
            return tuple(
                f"{node.right.name.removeprefix('shown_')}={v}"
                for v in listed
                if v not in plain(env[node.right.name])
            )
    return ()


def _joined(states: Sequence[Partial], key: Key) -> Known:
    return reduce(join, (state.get(key) for state in states))


def before(model: ModelData, states: Sequence[Partial], env: Env) -> dict[str, Any]:
    """The state before the event, by attribute: single cells, definitions, cells of the names in the event.

    Relations that do not hold are left out, and what is not known.
    """
    names = {given for given in env.values() if isinstance(given, str)}
    names |= {
        n for given in env.values() if isinstance(given, frozenset) for n in given if isinstance(n, str)
    }
    shown: dict[str, Any] = {}
    for key in sorted({key for state in states for key in state.cells}):
        variable, args = key
        if variable.startswith("$") or OTHER in args or (args and not names.intersection(args)):
            continue
        known = _joined(states, key)
        if (
            variable in model.signatures
            and not model.signatures[variable].rigid
            and not (args and known == NO)
        ):
            _put(
                shown,
                f"{variable}[{', '.join(args)}]" if args else variable,
                known,
                states[0].world.full[variable],
            )
    for name, (parameters, body) in model.definitions.items():
        if not parameters and body.sort.name != "Boolean":
            _put(shown, name, reduce(join, (value(body)(state, {}) for state in states)), None)
    return dict(sorted(shown.items()))


def _put(shown: dict[str, Any], name: str, known: Known, full: Known | None) -> None:
    if known == full:
        return
    listed = plain(known)
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
    for key in state.cells:
        if key[0] == cell.variable and all(
            not isinstance(f, str) or f == name for f, name in zip(fixed, key[1], strict=True)
        ):
            yield key
