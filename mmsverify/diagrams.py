"""Diagrams of a model by name: load it, explore a small scope, draw the views that it declares.

Ties loading, exploration and drawing together; the drawing itself is ``graph``'s.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from mmsverify.concrete import Machine, Scope, scope_for
from mmsverify.concrete.slicing import narrowed, sliced
from mmsverify.errors import UsageError
from mmsverify.graph import View, dot, mermaid, svg, view_names, views
from mmsverify.model import Claim, Clause, ModelData, load
from mmsverify.model import expr as ex
from mmsverify.model.rewrite import primed
from mmsverify.resources import models_dir

DRAWINGS: Mapping[str, Callable[[Sequence[View]], str]] = {"mermaid": mermaid, "dot": dot, "svg": svg}

MAX_STATES = 5000
"""How many states are expanded: enough for every small model, a fair sample of a large one."""

DIAGRAM_BOUNDS = (0, 1)
"""The bounds of integers without bounds: a diagram shows that a counter changes, not how far it counts."""


def draw(model: str, *, variant: str | None = None, format: str) -> str:
    """The views of a model as ``mermaid``, ``dot`` or ``svg``.

    ``model`` is a name or a path; without ``variant``, ``repaired`` is drawn where the model has it. The
    scope is the model's option ``diagram`` (``{"sizes": ..., "profile": ...}``), else two of each sort.
    """
    if format not in DRAWINGS:
        raise UsageError(f"no diagrams in the format {format!r}", cure=f"use one of {', '.join(DRAWINGS)}")
    return DRAWINGS[format](diagram_views(load(model, models_dir(), variant)))


def diagram_views(model: ModelData) -> list[View]:
    """The declared views of a model, from an exploration of the part of it that matters to them."""
    names = view_names(model)
    part = sliced(model, [_told_by(model, name) for name in names.values()])
    machine = Machine(part, narrowed(part, diagram_scope(model)))
    return views(machine, names, max_states=MAX_STATES)


def _told_by(model: ModelData, name: str) -> Claim:
    """A claim that reads what a view shows: what matters to it matters to the view."""
    parameters, body = model.definitions.get(name, ((), ex.TRUE))
    if name in model.signatures:
        parameters = tuple(ex.Ref(f"at{i}", sort) for i, sort in enumerate(model.signatures[name].sorts))
        body = model.define(name, *parameters)
    same = ex.quantified(True, parameters, ex.equal(primed(body), body))
    return Claim(name, "step", Clause(()), same)


def diagram_scope(model: ModelData) -> Scope:
    """The small scope in which a model is drawn."""
    asked: Mapping[str, Any] = model.options.get("diagram", {})
    sizes = asked.get("sizes", {sort.short: 2 for sort in model.sorts.values()})
    return replace(scope_for(model, sizes, asked.get("profile", {})), int_bounds=DIAGRAM_BOUNDS)
