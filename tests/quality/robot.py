"""The robot model in both variants, and a small world for it, for the tests of its quality."""

from __future__ import annotations

from functools import cache

from mmsverify.checking.worlds import World, small_worlds
from mmsverify.concrete import Machine, Scope, SearchResult, search
from mmsverify.concrete.slicing import narrowed, sliced
from mmsverify.model import Claim, ModelData, load
from mmsverify.resources import models_dir

VARIANTS = ("as-written", "repaired")


@cache
def robot(variant: str) -> ModelData:
    return load("mms-robot", models_dir(), variant)


def first_world() -> World:
    """A robot with its arm program and room for one more."""
    return small_worlds(robot("repaired"), None)[0]


def look(model: ModelData, claims: list[Claim], scope: Scope, *, states: int) -> SearchResult:
    """Search the part of the model that matters to the claims."""
    part = sliced(model, claims)
    tight = narrowed(part, scope)
    machine = Machine(part, tight)
    return search(part, tight, claims=claims, machine=machine, symmetry=True, max_states=states)
