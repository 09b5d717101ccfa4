"""The standardized named variables of clause 8.5: types, ranges, and what they show of the state.

They are data, with one walk over it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from mmsverify.audit.robot import Call
from mmsverify.audit.rules import Breach
from mmsverify.model.rows import Clause


@dataclass(frozen=True, slots=True)
class Variable:
    """A standardized variable: the kind of its Data, its range, whether it is an array by joints."""

    clause: str
    kind: str
    among: tuple[int, ...] = ()
    array: bool = False


_INTEGERS = ("integer", "unsigned")

VARIABLES = {
    "R_VPWR": Variable("R-8.5.3.1-1", "boolean"),
    "R_VCAL": Variable("R-8.5.3.2-1", "boolean"),
    "R_VLOCAL": Variable("R-8.5.3.3-1", "boolean"),
    "R_VSAFEV": Variable("R-8.5.3.4-1", "boolean"),
    "R_DPWR": Variable("R-8.5.4.1-1", "boolean"),
    "R_DCAL": Variable("R-8.5.4.2-1", "integer", (0, 1, 2)),
    "R_DLOCAL": Variable("R-8.5.4.3-1", "boolean"),
    "R_NJ": Variable("R-8.5.5.1-1", "integer"),
    "R_JT": Variable("R-8.5.5.2-1", "integer", (0, 1), array=True),
    "R_JCAL": Variable("R-8.5.5.3-1", "boolean", array=True),
    "R_JBK": Variable("R-8.5.5.4-1", "integer", (0, 1, 2), array=True),
    "R_JBD": Variable("R-8.5.5.5-1", "structure", array=True),
    "R_AJV": Variable("R-8.5.5.6-1", "floating-point", array=True),
    "R_SF": Variable("R-8.5.5.13-1", "floating-point"),
    "R_PSTU": Variable("R-8.5.5.14-1", "floating-point"),
}
DOMAIN_SPECIFIC = frozenset(
    {"R_DPWR", "R_DCAL", "R_DLOCAL", "R_NJ", "R_JT", "R_JCAL", "R_JBK", "R_JBD", "R_AJV"}
)


def judge(name: str, data: tuple[str, Any]) -> Iterator[Breach]:
    """The breaches of one value that was read or reported.

    ``name`` has its domain before it where it belongs to one.
    """
    variable = _standard(name)
    if variable is None:
        return
    clause = Clause.of(variable.clause, "R-6.3.8.2-1")
    kind, content = data
    if variable.array and kind != "array":
        yield Breach("variable.type", {"variable": name, "kind": kind, "wanted": "array"}, clause=clause)
        return
    for item in content if variable.array else [data]:
        yield from (replace(breach, clause=clause) for breach in _item(name, variable, item))


def _standard(name: str) -> Variable | None:
    domain, _, item = name.rpartition("/")
    return VARIABLES.get(item) if (item in DOMAIN_SPECIFIC) == bool(domain) else None


def _item(name: str, variable: Variable, item: tuple[str, Any]) -> Iterator[Breach]:
    kind, content = item
    if kind != variable.kind and not (kind in _INTEGERS and variable.kind in _INTEGERS):
        yield Breach("variable.type", {"variable": name, "kind": kind, "wanted": variable.kind})
    elif variable.among and content not in variable.among:
        yield Breach(
            "variable.value",
            {"variable": name, "value": content, "wanted": ", ".join(map(str, variable.among))},
        )


def shows(name: str, data: tuple[str, Any]) -> Call | None:
    """What a standardized variable shows of the model's state."""
    if name == "R_VLOCAL" and data[0] == "boolean":
        return Call("R_VLOCAL", {"shown_local": data[1]})
    return None
