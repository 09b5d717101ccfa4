"""The standardized types and named variables (8.4, 8.5): their shapes, and what they show of the state.

They are data, with one walk over it; `Variables` keeps what the values of one device must agree with.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

from mmsverify.audit import words
from mmsverify.audit.robot import Call, plain_name
from mmsverify.audit.rules import Breach
from mmsverify.audit.shapes import (
    BOOLEAN,
    FLOAT,
    SINGLE_FLOAT,
    Array,
    Misfit,
    Named,
    Scalar,
    Shape,
    Structure,
    Value,
    integer8,
    misdescribed,
    misfits,
)
from mmsverify.model.rows import Clause

Scope = Literal["vmd", "domain", "either"]


@dataclass(frozen=True, slots=True)
class Type:
    """A standardized named type; all belong to the VMD."""

    clause: Clause
    shape: Named


@dataclass(frozen=True, slots=True)
class Variable:
    """A standardized variable: what it rests on, its shape, and whether it belongs to the VMD or to a domain.

    Where the standard does not say to what a variable belongs, either is taken for it.
    """

    clause: Clause
    shape: Shape
    scope: Scope


POSITION = Named("R_PIS", Array(SINGLE_FLOAT, 3))
ORIENTATION = Named("R_OIS", Array(SINGLE_FLOAT, 4))
POSE = Named("R_PSE", Structure((("R_PIS", POSITION), ("R_OIS", ORIENTATION))))
END_EFFECTOR = Named(
    "R_EEF",
    Structure(
        (
            ("identifier", Scalar("objId")),
            ("tool descriptor", Scalar("visible-string", size=80)),
            ("TOOL-MICS", POSE),
            ("user detail", Scalar("visible-string", size=512)),
        )
    ),
)
BOUNDS = Structure((("upper bound", FLOAT), ("lower bound", FLOAT)))

TYPES: Mapping[str, Type] = {
    "R_PIS": Type(Clause.of("R-8.4.1-1"), POSITION),
    "R_OIS": Type(Clause.of("R-8.4.2-1"), ORIENTATION),
    "R_PSE": Type(Clause.of("R-8.4.3-1"), POSE),
    "R_EEF": Type(Clause.of("R-8.4.4-1", "R-6.2.2.10-1"), END_EFFECTOR),
}


def _variable(shape: Shape, scope: Scope, *cites: str) -> Variable:
    return Variable(Clause.of(*cites, "R-6.3.8.2-1"), shape, scope)


VARIABLES: Mapping[str, Variable] = {
    "R_VPWR": _variable(BOOLEAN, "vmd", "R-8.5.3.1-1"),
    "R_VCAL": _variable(BOOLEAN, "vmd", "R-8.5.3.2-1"),
    "R_VLOCAL": _variable(BOOLEAN, "vmd", "R-8.5.3.3-1"),
    "R_VSAFEV": _variable(BOOLEAN, "vmd", "R-8.5.3.4-1"),
    "R_DPWR": _variable(BOOLEAN, "domain", "R-8.5.4.1-1", "R-6.2.1-7", "R-6.2.1-2"),
    "R_DCAL": _variable(integer8(0, 1, 2), "domain", "R-8.5.4.2-1", "R-6.2.1-7", "R-6.2.1-2"),
    "R_DLOCAL": _variable(BOOLEAN, "domain", "R-8.5.4.3-1", "R-6.2.1-7", "R-6.2.1-2"),
    "R_NJ": _variable(integer8(), "domain", "R-8.5.5.1-1", "R-6.2.2.6-1", "R-6.2.2.1-1"),
    "R_JT": _variable(Array(integer8(0, 1)), "domain", "R-8.5.5.2-1", "R-6.2.2.8.2.1-1", "R-6.2.2.1-2"),
    "R_JCAL": _variable(Array(BOOLEAN), "domain", "R-8.5.5.3-1", "R-6.2.2.1-2"),
    "R_JBK": _variable(Array(integer8(0, 1, 2)), "domain", "R-8.5.5.4-1", "R-6.2.2.8.2.3-1", "R-6.2.2.1-2"),
    "R_JBD": _variable(Array(BOUNDS), "domain", "R-8.5.5.5-1", "R-6.2.2.8.2.4-1", "R-6.2.2.1-2"),
    "R_AJV": _variable(Array(FLOAT), "domain", "R-8.5.5.6-1", "R-6.2.2.8.2.6-1", "R-6.2.2.1-2", "R-8.5.1-1"),
    "R_TUB": _variable(POSE, "either", "R-8.5.5.7-1", "R-6.2.2.9.1-1", "R-8.5.1-2"),
    "R_TTM": _variable(POSE, "either", "R-8.5.5.8-1", "R-8.5.1-2"),
    "R_TBW": _variable(POSE, "either", "R-8.5.5.9-1", "R-6.2.2.7-1", "R-8.5.1-2"),
    "R_ATUP": _variable(POSE, "either", "R-8.5.5.10-1", "R-8.5.1-1"),
    "R_CTUP": _variable(POSE, "either", "R-8.5.5.11-1", "R-6.2.2.9.2-1", "R-8.5.1-1"),
    "R_AMBP": _variable(POSE, "either", "R-8.5.5.12-1", "R-8.5.1-1"),
    "R_SF": _variable(FLOAT, "either", "R-8.5.5.13-1", "R-6.2.2.9.3-1"),
    "R_PSTU": _variable(FLOAT, "either", "R-8.5.5.14-1", "R-8.5.1-1"),
    "R_EEFU": _variable(END_EFFECTOR, "either", "R-8.5.5.15-1"),
}
BY_JOINT = frozenset({"R_JT", "R_JCAL", "R_JBK", "R_JBD", "R_AJV"})
"""The arrays that have an element for each of the arm's R_NJ joints."""
CALIBRATED = 0


def standard(name: str) -> Variable | None:
    """The standardized variable of that name, with its domain before it where it belongs to one."""
    domain, _, item = name.rpartition("/")
    variable = VARIABLES.get(item)
    if variable is None or variable.scope == ("vmd" if domain else "domain"):
        return None
    return variable


SHOWN: Mapping[str, str] = {
    "R_VPWR": "shown_power",
    "R_VCAL": "shown_calibrated",
    "R_VLOCAL": "shown_local",
    "R_VSAFEV": "shown_interlocks",
    "R_DPWR": "shown_power",
    "R_DLOCAL": "shown_local",
}
"""The Boolean variables that show the model's state, each with the name of what it shows."""


def shows(name: str, data: Value) -> Call | None:
    """What a standardized variable shows of the model's state."""
    if standard(name) is None:
        return None
    domain, _, item = name.rpartition("/")
    kind, content = data
    of = {"device": domain} if domain else {}
    if item in SHOWN and kind == "boolean":
        return Call(item, {**of, SHOWN[item]: content})
    if item == "R_DCAL" and kind in ("integer", "unsigned"):
        calibration = words.word(words.CALIBRATION, content)
        return Call(item, {**of, "shown_calibration": calibration}) if calibration else None
    return None


def together(calls: Sequence[Call]) -> Call | None:
    """What the values of one Read say of the VMD and of its devices; ``None`` where they say not both."""
    of_vmd = [call.bindings for call in calls if "device" not in call.bindings]
    of_devices = [call for call in calls if "device" in call.bindings]
    bindings: dict[str, Any] = dict.fromkeys(("shown_power", "shown_calibrated", "shown_local"))
    for shown in of_vmd:
        bindings |= shown
    if not of_devices or not of_vmd:
        return None
    return Call("readTogether", {
        **bindings,
        "shown_powered": _devices(of_devices, "R_DPWR", (True,)),
        "shown_uncalibrated": _devices(of_devices, "R_DCAL", words.CALIBRATION[1:]),
        "shown_held": _devices(of_devices, "R_DLOCAL", (True,)),
    })  # fmt: skip


def _devices(calls: Sequence[Call], variable: str, values: Sequence[Any]) -> frozenset[str]:
    """The devices of which that variable shows one of these values."""
    of = (call.bindings for call in calls if call.service == variable)
    return frozenset(given["device"] for given in of if not {*given.values()}.isdisjoint(values))


def _breach(name: str, variable: Variable, misfit: Misfit) -> Breach:
    words = {"variable": f"{name}{misfit.part}", "found": misfit.found, "wanted": misfit.wanted}
    rule = "variable.value" if misfit.value else "variable.type"
    return Breach(rule, words, clause=cited(variable.clause, misfit))


def cited(clause: Clause, misfit: Misfit) -> Clause:
    """What a misfit breaks: the clause of the thing, and those of the standardized types around the part."""
    for name in misfit.types:
        clause = clause + TYPES[name].clause
    return clause


def written(request: Mapping[str, Any], response: Sequence[Value]) -> Iterator[Breach]:
    """Values of a Write that the robot has accepted although they do not fit their variables."""
    kind, content = request["variableAccessSpecification"]
    if kind != "listOfVariable":
        return
    for listed, data, (result, _) in zip(content, request["listOfData"], response, strict=False):
        name = _plain_name(listed)
        variable = standard(name) if name else None
        if variable is not None and result == "success":
            for misfit in misfits(variable.shape, data):
                words = {"variable": f"{name}{misfit.part}", "found": misfit.found, "wanted": misfit.wanted}
                yield Breach("variable.written", words, clause=cited(variable.clause, misfit))


def _plain_name(listed: Mapping[str, Any]) -> str:
    """The name of a variable that is accessed as a whole, with its domain before it; else nothing."""
    kind, named = listed["variableSpecification"]
    return plain_name(named) if kind == "name" and "alternateAccess" not in listed else ""


def described(name: str, specification: Value) -> Iterator[tuple[Clause, Misfit]]:
    """Where a TypeSpecification differs from what the standard says of that variable."""
    variable = standard(name)
    if variable is not None:
        for misfit in misdescribed(variable.shape, specification):
            yield cited(variable.clause, misfit), misfit


def described_type(name: str, specification: Value) -> Iterator[tuple[Clause, Misfit]]:
    """The same of a standardized type."""
    standardized = TYPES.get(name)
    if standardized is not None:
        for misfit in misdescribed(standardized.shape, specification):
            yield cited(standardized.clause, misfit), misfit


@dataclass(frozen=True, slots=True)
class _Joints:
    """How many joints an arm has, and the variable and the message that say so."""

    count: int
    variable: str
    index: int


@dataclass(slots=True)
class Variables:
    """The values of one device: what must agree from one message to the next, and within one."""

    _joints: dict[str, _Joints] = field(default_factory=dict)
    _bounds: dict[str, tuple[int, list[tuple[float, float]]]] = field(default_factory=dict)

    def judge(self, values: Sequence[tuple[str, Value]], index: int) -> Iterator[Breach]:
        """The breaches of the values of one message, by the variables' names."""
        for name, data in values:
            variable = standard(name)
            if variable is not None:
                wrong = [_breach(name, variable, misfit) for misfit in misfits(variable.shape, data)]
                yield from wrong or self._agree(name, variable, data, index)
        yield from _calibrations(dict(values))

    def _agree(self, name: str, variable: Variable, data: Value, index: int) -> Iterator[Breach]:
        """A value of the right shape against what others have said of the same arm."""
        domain, _, item = name.rpartition("/")
        if item == "R_NJ" or item in BY_JOINT:
            told = _Joints(data[1] if item == "R_NJ" else len(data[1]), name, index)
            yield from self._count(domain, variable, told)
        if item == "R_JBD":
            yield from self._bound(domain, name, data, index)
        elif item == "R_AJV":
            yield from self._travelled(domain, name, data)

    def _count(self, domain: str, variable: Variable, told: _Joints) -> Iterator[Breach]:
        known = self._joints.get(domain)
        if known is None or told.variable.endswith("/R_NJ"):
            self._joints[domain] = told
        if known is not None and known.count != told.count:
            other = standard(known.variable)
            assert other is not None
            words = {
                "variable": told.variable,
                "count": told.count,
                "other": known.variable,
                "joints": known.count,
            }
            yield Breach("variable.joints", words, (known.index,), variable.clause + other.clause)

    def _bound(self, domain: str, name: str, data: Value, index: int) -> Iterator[Breach]:
        bounds = [(_number(upper), _number(lower)) for _, (upper, lower) in data[1]]
        self._bounds[domain] = index, bounds
        for joint, (upper, lower) in enumerate(bounds):
            if upper < lower:
                yield Breach(
                    "variable.bounds", {"variable": f"{name}[{joint}]", "upper": upper, "lower": lower}
                )

    def _travelled(self, domain: str, name: str, data: Value) -> Iterator[Breach]:
        index, bounds = self._bounds.get(domain, (0, []))
        for joint, (value, (upper, lower)) in enumerate(zip(map(_number, data[1]), bounds, strict=False)):
            if lower <= upper and not lower <= value <= upper:
                words = {"variable": f"{name}[{joint}]", "value": value, "lower": lower, "upper": upper}
                yield Breach("variable.beyond-bounds", words, (index,))


def _number(data: Value) -> float:
    """A floating-point value of MMS: the width of its exponent, then IEEE 754."""
    octets: bytes = data[1]
    form = {5: ">f", 9: ">d"}.get(len(octets))
    return float(struct.unpack(form, octets[1:])[0]) if form else float("nan")


def _calibrations(values: Mapping[str, Value]) -> Iterator[Breach]:
    """An arm is calibrated if and only if all its joints are (6.2.2.4), where one message shows both."""
    for name, (kind, content) in values.items():
        joints = values.get(name.replace("R_DCAL", "R_JCAL"))
        if (
            not name.endswith("/R_DCAL")
            or joints is None
            or joints[0] != "array"
            or kind not in ("integer", "unsigned")
        ):
            continue
        all_are = bool(joints[1]) and all(joint == ("boolean", True) for joint in joints[1])
        if all_are != (content == CALIBRATED):
            words = {"variable": name, "value": content, "joints": "all" if all_are else "not all"}
            yield Breach("variable.calibration", words)
