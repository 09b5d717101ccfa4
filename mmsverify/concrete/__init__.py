"""Concrete readers of a model: the tree-walking judge, grounding and compilation, search. Imports no solver.

from mmsverify.concrete import Scope, search
"""

from mmsverify.concrete.judge import NotAPathError, replay
from mmsverify.concrete.machine import Machine
from mmsverify.concrete.reach import reach
from mmsverify.concrete.scope import Scope, generic_scope, scope_for
from mmsverify.concrete.search import SearchResult, search
from mmsverify.concrete.trace_path import Path, Taken, path_steps

__all__ = [
    "Machine", "NotAPathError", "Path", "Scope", "SearchResult", "Taken",
    "generic_scope", "path_steps", "reach", "replay", "scope_for", "search",
]  # fmt: skip
