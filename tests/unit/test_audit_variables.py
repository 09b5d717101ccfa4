"""Standardized types and variables: values and descriptions that fit, and those that do not."""

from __future__ import annotations

import struct
from typing import Any

import pytest

from mmsverify.audit import variables
from mmsverify.audit.rules import RULES, Breach
from mmsverify.audit.shapes import Array, Misfit, Named, Scalar, Shape, Structure, Value
from mmsverify.audit.variables import TYPES, VARIABLES, Variables
from mmsverify.samples.pdus import of_domain, vmd

ARM = "R_ARM/"


def single(number: float) -> Value:
    return "floating-point", b"\x08" + struct.pack(">f", number)


def double(number: float) -> Value:
    return "floating-point", b"\x0b" + struct.pack(">d", number)


def singles(*numbers: float) -> Value:
    return "array", [single(number) for number in numbers]


def integers(*numbers: int) -> Value:
    return "array", [("integer", number) for number in numbers]


def booleans(*values: bool) -> Value:
    return "array", [("boolean", value) for value in values]


def bounds(*pairs: tuple[float, float]) -> Value:
    return "array", [("structure", [single(upper), single(lower)]) for upper, lower in pairs]


POSE: Value = ("structure", [singles(0, 1, 2), singles(0, 0, 0, 1)])
TOOL: Value = (
    "structure",
    [("objId", "1.0.9506.3"), ("visible-string", "gun"), POSE, ("visible-string", "")],
)

FITTING: dict[str, Value] = {
    "R_VPWR": ("boolean", True),
    "R_VCAL": ("boolean", True),
    "R_VLOCAL": ("boolean", False),
    "R_VSAFEV": ("boolean", False),
    ARM + "R_DPWR": ("boolean", True),
    ARM + "R_DCAL": ("integer", 2),
    ARM + "R_DLOCAL": ("boolean", True),
    ARM + "R_NJ": ("integer", 2),
    ARM + "R_JT": integers(0, 1),
    ARM + "R_JCAL": booleans(True, False),
    ARM + "R_JBK": integers(0, 2),
    ARM + "R_JBD": bounds((180, -180), (90, 0)),
    ARM + "R_AJV": singles(-12.5, 45),
    "R_TUB": POSE,
    "R_TTM": POSE,
    "R_TBW": POSE,
    "R_ATUP": POSE,
    ARM + "R_CTUP": POSE,
    "R_AMBP": POSE,
    "R_SF": single(1),
    "R_PSTU": double(250),
    "R_EEFU": TOOL,
}
MISFITTING: dict[str, list[tuple[Value, str]]] = {
    "R_VPWR": [(("integer", 1), "R-8.5.3.1-1")],
    "R_VCAL": [(("integer", 1), "R-8.5.3.2-1")],
    "R_VLOCAL": [(("visible-string", "no"), "R-8.5.3.3-1")],
    "R_VSAFEV": [(booleans(True), "R-8.5.3.4-1")],
    ARM + "R_DPWR": [(single(1), "R-8.5.4.1-1"), (("integer", 1), "R-6.2.1-7")],
    ARM + "R_DCAL": [(("boolean", True), "R-8.5.4.2-1"), (("integer", 3), "R-8.5.4.2-1")],
    ARM + "R_DLOCAL": [(("integer", 0), "R-8.5.4.3-1")],
    ARM + "R_NJ": [(single(6), "R-8.5.5.1-1"), (("integer", 128), "R-6.2.2.6-1")],
    ARM + "R_JT": [(integers(0, 2), "R-8.5.5.2-1"), (("integer", 0), "R-6.2.2.8.2.1-1")],
    ARM + "R_JCAL": [(integers(0, 1), "R-8.5.5.3-1")],
    ARM + "R_JBK": [(integers(0, 3), "R-8.5.5.4-1"), (booleans(True), "R-6.2.2.8.2.3-1")],
    ARM + "R_JBD": [(singles(180, -180), "R-8.5.5.5-1"), (("array", [singles(1, 0)]), "R-6.2.2.8.2.4-1")],
    ARM + "R_AJV": [(integers(0, 1), "R-8.5.5.6-1"), (single(0), "R-6.2.2.8.2.6-1")],
    "R_TUB": [
        (("structure", [singles(0, 0), singles(0, 0, 0, 1)]), "R-8.5.5.7-1"),
        (single(0), "R-6.2.2.9.1-1"),
    ],
    "R_TTM": [(singles(0, 0, 0), "R-8.5.5.8-1")],
    "R_TBW": [(("structure", [singles(0, 0, 0)]), "R-8.5.5.9-1"), (single(0), "R-6.2.2.7-1")],
    "R_ATUP": [(("structure", [singles(0, 0, 0), singles(0, 0, 0)]), "R-8.4.2-1")],
    ARM + "R_CTUP": [
        (("structure", [integers(0, 0, 0), POSE[1][1]]), "R-8.4.1-1"),
        (single(0), "R-6.2.2.9.2-1"),
    ],
    "R_AMBP": [(("structure", [("array", [double(0)] * 3), POSE[1][1]]), "R-8.5.5.12-1")],
    "R_SF": [(("integer", 1), "R-8.5.5.13-1"), (("boolean", True), "R-6.2.2.9.3-1")],
    "R_PSTU": [(("integer", 250), "R-8.5.5.14-1")],
    "R_EEFU": [
        (("structure", [TOOL[1][0], ("visible-string", "x" * 81), *TOOL[1][2:]]), "R-8.4.4-1"),
        (("structure", [("visible-string", "1.2"), *TOOL[1][1:]]), "R-6.2.2.10-1"),
        (POSE, "R-8.5.5.15-1"),
    ],
}  # fmt: skip


def judged(*values: tuple[str, Value]) -> list[Breach]:
    """The breaches of messages that show one value each."""
    device = Variables()
    return [breach for index, value in enumerate(values) for breach in device.judge([value], index)]


def rules(breaches: list[Breach]) -> list[str]:
    return [breach.rule for breach in breaches]


def clauses(breach: Breach) -> tuple[str, ...]:
    return (*(breach.clause.ids if breach.clause else ()), *RULES[breach.rule].clause.ids)


def specification(shape: Shape) -> Value:
    """A TypeSpecification that describes a shape, written out."""
    match shape:
        case Named():
            return specification(shape.of)
        case Scalar("floating-point"):
            width, exponent = shape.size or (64, 11)
            return "floating-point", {"format-width": width, "exponent-width": exponent}
        case Scalar():
            return shape.kind, shape.size
        case Array():
            inner = specification(shape.of)
            return "array", {"packed": False, "numberOfElements": shape.count or 6, "elementType": inner}
        case Structure():
            parts = [{"componentType": specification(part)} for _, part in shape.components]
            return "structure", {"packed": False, "components": parts}


def test_every_standardized_variable_is_tried_both_ways() -> None:
    tried = {name.rpartition("/")[2] for name in FITTING}
    assert tried == set(VARIABLES) == {name.rpartition("/")[2] for name in MISFITTING}


@pytest.mark.exercises("R-8.1-3")
def test_standardized_names_carry_their_prefix() -> None:
    assert [name for name in (*VARIABLES, *TYPES) if not name.startswith("R_")] == []


@pytest.mark.exercises("R-8.5.1-1")
def test_actual_commanded_and_programmed_values_are_told_apart_by_their_names() -> None:
    values = {name for name, variable in VARIABLES.items() if "R-8.5.1-1" in variable.clause.ids}
    assert values == {name for name in VARIABLES if name[:3] in ("R_A", "R_C", "R_P")}


@pytest.mark.exercises("R-8.5.1-2")
def test_a_pose_of_one_system_in_another_is_named_by_their_letters() -> None:
    named = {name for name, variable in VARIABLES.items() if "R-8.5.1-2" in variable.clause.ids}
    assert named == {name for name in VARIABLES if name[:3] == "R_T" and set(name[3:]) <= set("TUBMW")}
    assert {VARIABLES[name].shape for name in named} == {variables.POSE}


@pytest.mark.parametrize("name", FITTING)
def test_a_value_of_its_type_is_no_breach(name: str) -> None:
    assert judged((name, FITTING[name])) == []


@pytest.mark.exercises("R-8.4.1-1", "R-8.4.2-1", "R-8.4.4-1", every="standard variable")
@pytest.mark.parametrize(
    ("name", "value", "clause"),
    [(name, value, clause) for name, tried in MISFITTING.items() for value, clause in tried],
)
def test_a_value_of_another_type_breaks_the_variables_clause(name: str, value: Value, clause: str) -> None:
    breaches = judged((name, value))
    assert set(rules(breaches)) <= {"variable.type", "variable.value"}
    assert all(clause in clauses(breach) and "R-6.3.8.2-1" in clauses(breach) for breach in breaches)
    assert breaches != []


@pytest.mark.exercises("R-8.5.4.2-1", "R-6.2.1-7")
def test_a_variable_of_another_scope_is_not_the_standardized_one() -> None:
    assert judged(("R_DCAL", ("boolean", True)), ("R_CONVEYOR/R_VLOCAL", ("integer", 1))) == []
    assert rules(judged(("R_CONVEYOR/R_DCAL", ("boolean", True)))) == ["variable.type"]


@pytest.mark.exercises("R-8.5.5.1-1", "R-8.5.5.2-1", "R-8.5.5.6-1")
def test_an_array_has_an_element_for_each_joint() -> None:
    wrong = judged((ARM + "R_NJ", ("integer", 6)), (ARM + "R_JT", integers(0, 0, 0)))
    assert [(breach.rule, breach.related) for breach in wrong] == [("variable.joints", (0,))]
    assert clauses(wrong[0])[:1] == ("R-8.5.5.2-1",)
    assert judged((ARM + "R_NJ", ("integer", 2)), (ARM + "R_AJV", singles(0, 0))) == []


def test_two_arrays_of_one_arm_are_equally_long() -> None:
    assert rules(judged((ARM + "R_JT", integers(0, 0)), (ARM + "R_AJV", singles(0)))) == ["variable.joints"]
    assert judged(("R_ARM_1/R_JT", integers(0, 0)), ("R_ARM_2/R_AJV", singles(0))) == []


def test_the_number_of_joints_itself_counts_more_than_an_array() -> None:
    told = judged(
        (ARM + "R_JT", integers(0)),
        (ARM + "R_NJ", ("integer", 2)),
        (ARM + "R_JCAL", booleans(True, True)),
    )
    assert rules(told) == ["variable.joints"]


@pytest.mark.exercises("R-6.2.2.8.2.4-1", "R-8.5.5.5-1")
def test_an_upper_bound_is_not_below_the_lower_one() -> None:
    (breach,) = judged((ARM + "R_JBD", bounds((180, -180), (0, 90))))
    assert breach.rule == "variable.bounds"
    assert breach.words["variable"] == "R_ARM/R_JBD[1]"


@pytest.mark.exercises("R-6.2.2.8.2.4-1", "R-8.5.5.6-2")
def test_a_joint_beyond_its_bounds_is_worth_a_note() -> None:
    (breach,) = judged((ARM + "R_JBD", bounds((180, -180), (90, 0))), (ARM + "R_AJV", singles(0, 91)))
    assert (breach.rule, breach.related) == ("variable.beyond-bounds", (0,))
    assert RULES[breach.rule].severity == "note"
    assert judged((ARM + "R_JBD", bounds((180, -180))), (ARM + "R_AJV", singles(180))) == []


@pytest.mark.exercises("R-6.2.2.4-1", "R-8.5.5.3-1")
@pytest.mark.parametrize(
    ("device", "joints", "said"), [(0, (True, True), 0), (1, (True, False), 0), (2, (False, False), 0),
                                   (0, (True, False), 1), (1, (True, True), 1), (2, (True, True), 1)]
)  # fmt: skip
def test_an_arm_is_calibrated_if_and_only_if_its_joints_are(
    device: int, joints: tuple[bool, ...], said: int
) -> None:
    values = [(ARM + "R_DCAL", ("integer", device)), (ARM + "R_JCAL", booleans(*joints))]
    assert rules(list(Variables().judge(values, 0))) == ["variable.calibration"] * said


def test_calibration_shown_in_two_messages_may_have_changed_in_between() -> None:
    assert judged((ARM + "R_DCAL", ("integer", 0)), (ARM + "R_JCAL", booleans(False))) == []


# Writing.


def write(name: tuple[str, Any], data: Value, result: str = "success", **more: Any) -> list[Breach]:
    listed = {"variableSpecification": ("name", name), **more}
    request = {"variableAccessSpecification": ("listOfVariable", [listed]), "listOfData": [data]}
    return list(variables.written(request, [(result, None if result == "success" else 7)]))


@pytest.mark.exercises("R-8.5.5.13-1", "R-8.1-1")
def test_a_value_of_another_type_is_not_accepted_from_a_client() -> None:
    (breach,) = write(vmd("R_SF"), ("integer", 1))
    assert breach.rule == "variable.written"
    assert clauses(breach)[0] == "R-8.5.5.13-1"
    assert rules(write(of_domain("R_ARM", "R_DCAL"), ("integer", 9))) == ["variable.written"]


def test_a_write_that_fails_or_fits_is_no_breach() -> None:
    assert write(vmd("R_SF"), ("integer", 1), "failure") == []
    assert write(vmd("R_SF"), single(0.5)) == []
    assert write(vmd("Part_Count"), ("integer", 1)) == []
    assert write(of_domain("R_ARM", "R_JT"), ("integer", 1), alternateAccess=[("unnamed", None)]) == []


# Descriptions of types.


@pytest.mark.parametrize("name", VARIABLES)
def test_a_description_of_the_right_type_is_no_breach(name: str) -> None:
    variable = VARIABLES[name]
    full = f"R_ARM/{name}" if variable.scope == "domain" else name
    assert list(variables.described(full, specification(variable.shape))) == []


@pytest.mark.parametrize("name", VARIABLES)
def test_a_description_of_another_type_is_a_breach(name: str) -> None:
    variable = VARIABLES[name]
    full = f"R_ARM/{name}" if variable.scope == "domain" else name
    ((clause, misfit),) = variables.described(full, ("bcd", 4))
    assert clause.ids[0] == variable.clause.ids[0]
    assert misfit.found == "bcd"


def test_the_name_of_another_standardized_type_is_a_breach() -> None:
    ((_, misfit),) = variables.described("R_TUB", ("typeName", vmd("R_EEF")))
    assert misfit == Misfit("", "R_EEF", "R_PSE")
    assert list(variables.described("R_TUB", ("typeName", vmd("R_PSE")))) == []
    assert list(variables.described("R_TUB", ("typeName", vmd("POSE")))) == []


@pytest.mark.parametrize(
    ("name", "described", "part"),
    [
        ("R_TUB", ("structure", {"components": []}), ""),
        ("R_SF", ("array", {"numberOfElements": 1, "elementType": ("boolean", None)}), ""),
        ("R_ARM/R_DCAL", ("integer", 16), ""),
        ("R_ARM/R_JT", ("array", {"numberOfElements": 6, "elementType": ("integer", 32)}), "[]"),
        ("R_ARM/R_JBD", ("boolean", None), ""),
    ],
)
def test_the_part_that_differs_is_named(name: str, described: Value, part: str) -> None:
    assert [misfit.part for _, misfit in variables.described(name, described)] == [part]
