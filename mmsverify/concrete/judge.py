"""A claimed path is re-checked before it is believed: by the tree-walking interpreter, from the rows.

Nothing compiled or grounded is used here.
"""

from __future__ import annotations

from collections.abc import Mapping

from mmsverify.concrete.evaluate import Moment, Valuation, holds, step, within_bounds
from mmsverify.concrete.machine import speaks_of_steps
from mmsverify.concrete.names import free_names
from mmsverify.concrete.scope import Binding, Scope, cell_name, known_facts
from mmsverify.concrete.trace_path import Path
from mmsverify.errors import MmsverifyError
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim, Row
from mmsverify.model.show import shown


class NotAPathError(MmsverifyError):
    """A path that the rows do not allow, or that does not show what is said: a fault of the checker."""

    code = "path"


def replay(model: ModelData, scope: Scope, path: Path, claim: Claim | None = None) -> None:
    """Take every step of ``path`` again; :class:`NotAPathError` if one is not a step of the rows.

    With ``claim``, also make sure that the path ends in a breach of it (or, for a ``Sometimes``, in a
    witness).
    """
    if not path:
        raise NotAPathError("a path without an initial state")
    _check_start(model, scope, path[0].state)
    for number in range(1, len(path)):
        _check_step(model, scope, path, number)
    if claim is not None and not _shows(scope, path, claim):
        raise NotAPathError(
            f"the path does not show what is claimed of {claim.title}", place=f"step {len(path) - 1}"
        )


def _check_start(model: ModelData, scope: Scope, state: Valuation) -> None:
    at = Moment(scope, state, {})
    for conjunct in (*model.initial, *model.assumptions):
        if not holds(conjunct.condition, at):
            raise NotAPathError(f"no initial state: not {shown(conjunct.condition)}", place="step 0")
    for key, value in known_facts(model, scope).items():
        if state[key] != value:
            raise NotAPathError(f"{cell_name(key)} is not {value!s}", place="step 0")


def _check_step(model: ModelData, scope: Scope, path: Path, number: int) -> None:
    before, taken = path[number - 1], path[number]
    if taken.row is None or not any(taken.row is row or taken.row == row for row in model.actions):
        raise NotAPathError("a step without a row of the model", place=f"step {number}")
    if not _can_have(scope, taken.row, taken.bindings):
        raise NotAPathError(f"{taken.row.id} cannot have these parameters", place=f"step {number}")
    after = step(taken.row, taken.bindings, before.state, scope)
    if after is None:
        raise NotAPathError(f"the guard of {taken.row.id} refuses", place=f"step {number}")
    if after != taken.state or not within_bounds(model, scope, after):
        raise NotAPathError(f"{taken.row.id} leads to another state", place=f"step {number}")


def _can_have(scope: Scope, row: Row, bindings: Mapping[str, Binding]) -> bool:
    """Whether these are values for exactly the row's parameters."""
    values = {p.name: scope.parameter_values(row, p) for p in row.parameters}
    return values.keys() == bindings.keys() and all(bindings[name] in values[name] for name in values)


def _shows(scope: Scope, path: Path, claim: Claim) -> bool:
    if speaks_of_steps(claim):
        if len(path) < 2:
            return False
        named = {**dict.fromkeys(free_names(claim.formula)), **path[-1].bindings}
        at = Moment(scope, path[-2].state, named, path[-1].state, path[-1].row)
    else:
        at = Moment(scope, path[-1].state, {})
    return holds(claim.formula, at) is (claim.kind == "sometimes")
