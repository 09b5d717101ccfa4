"""Small scopes of the robot model whose states are counted, and the table of their counts.

``python tests/golden/robot_counts.py`` writes the table anew, after a change of the model that changes it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import Any

from mmsverify.concrete import Machine, Scope, scope_for, search
from mmsverify.concrete.slicing import narrowed, sliced
from mmsverify.model import ModelData, load
from mmsverify.resources import models_dir

TABLE = Path(__file__).with_suffix(".tsv")
VARIANTS = ("as-written", "repaired")
ARM = {"name": "R_ARM", "control": "CONTROLLED", "domains": ["R_ARM"], "deletable": False}
CALIBRATION = {"name": "R_CAL", "control": "NORMAL", "domains": ["R_CAL"], "deletable": False}
TASK = {"name": "TASK", "control": "CONTROLLING", "domains": ["TASK"], "deletable": False}
TOKEN = ("one_holder", "holder_is_associated")
LARGEST = 120_000

Counts = tuple[int, int, int]
"""States, steps that change the state, steps to the farthest state."""


@dataclass(frozen=True, slots=True)
class Small:
    """A part of the model, that which matters to ``claims`` (none: to all invariants), in a small scope.

    ``counted``: it is small enough to be counted to the end.
    """

    sizes: Mapping[str, int]
    profile: Mapping[str, Any] = field(default_factory=dict)
    claims: tuple[str, ...] = ()
    variants: tuple[str, ...] = VARIANTS
    counted: bool = True


SMALL: Mapping[str, Small] = {
    "token": Small({"Client": 2}, {"predefined": []}, TOKEN),
    "tokens": Small({"Client": 2}, {"predefined": [], "associations": "multiple"}, TOKEN),
    "panel": Small({"PI": 1}, {"predefined": []}, ("local_control_logical",), ("repaired",)),
    "arm": Small({"PI": 1}, {"predefined": [ARM]}, ("arm_moves_arm",)),
    "device": Small({"PI": 1, "Device": 1}, {"predefined": [ARM]}),
    "calibration": Small({"PI": 1, "Device": 0}, {"predefined": [CALIBRATION]}),
    "task": Small({"PI": 1, "Device": 0}, {"predefined": [TASK], "selected_at_power_on": "TASK"}),
    "pair": Small({"PI": 2, "Device": 0}, {"predefined": [ARM]}, counted=False),
}
COUNTED = [(variant, name) for name, small in SMALL.items() for variant in small.variants if small.counted]


@cache
def robot(variant: str) -> ModelData:
    return load("mms-robot", models_dir(), variant)


@cache
def part(variant: str, name: str) -> tuple[ModelData, Scope]:
    """The part of the model and its scope."""
    model, small = robot(variant), SMALL[name]
    wanted = [c for c in model.claims if (c.name in small.claims if small.claims else c.kind == "always")]
    made = sliced(model, wanted)
    scope = replace(scope_for(made, {"PI": 1, **small.sizes}, small.profile), int_bounds=(0, 1))
    return made, narrowed(made, scope)


def counted(variant: str, name: str) -> Counts:
    """What a search counts."""
    model, scope = part(variant, name)
    result = search(model, scope, claims=(), machine=Machine(model, scope), max_states=LARGEST)
    assert result.reason in ("", "an integer left its bounds"), f"{variant} {name}: {result.reason}"
    return result.states, result.transitions, result.depth


def table() -> dict[tuple[str, str], Counts]:
    """The counts written down, by variant and name."""
    rows = (line.split("\t") for line in TABLE.read_text(encoding="utf-8").splitlines()[1:])
    return {(variant, name): (int(a), int(b), int(c)) for variant, name, a, b, c in rows}


def written() -> str:
    """The table as it ought to be."""
    found = {key: counted(*key) for key in COUNTED}
    rows = [
        "variant\tscope\tstates\tsteps\tdepth",
        *("\t".join(map(str, (*key, *c))) for key, c in found.items()),
    ]
    return "\n".join(rows) + "\n"


if __name__ == "__main__":
    TABLE.write_text(written(), encoding="utf-8")
