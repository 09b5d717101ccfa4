"""Whether a profile maps its devices and programs as the standard does: domains, arms, interlocks (6.1, 6.2, 8.2, 8.3)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from mmsverify.profiles.checks import (
    Check,
    Table,
    arm_domains,
    check,
    devices,
    of_control,
    program,
    several,
)
from mmsverify.profiles.robot import STANDARDIZED

ARM_NAME = re.compile(r"R_ARM(-.+)?$")


def _bound(name: str, *clauses: str) -> Check:
    def find(table: Table) -> Iterator[str]:
        entry = program(table, name)
        if entry is not None and entry["domains"] != [name]:
            yield f'predefined {name} must have domains = ["{name}"]'

    find.__doc__ = f"{name} is bound to the domain {name} and to no other."
    return check("bound", *clauses)(find)


@check("device-domain", "R-6.1.1-3", "R-6.2.1-1")
def device_domain(table: Table) -> Iterator[str]:
    """Every device has a predefined domain that represents it."""
    for device in table["devices"]:
        if not device["domain"]:
            yield f"the device {device['name']!r} has no domain"


@check("own-domain", "R-6.2.1-3", "R-6.2.1-4")
def own_domain(table: Table) -> Iterator[str]:
    """Each arm, each auxiliary device and the interlocks have domains of their own."""
    for domain in several([device["domain"] for device in table["devices"] if device["domain"]]):
        sharing = [device for device in table["devices"] if device["domain"] == domain]
        if {device["kind"] for device in sharing} != {"safety"}:
            yield f"the devices {', '.join(repr(d['name']) for d in sharing)} share the domain {domain}"


@check("interlocks", "R-6.3.4.1-1", "R-T15-2", "R-6.2.1-4")
def interlocks(table: Table) -> Iterator[str]:
    """The devices that the state of the VMD reflects include the safety interlocks of the arm."""
    if devices(table, "arm") and not devices(table, "safety"):
        yield 'devices has none of kind "safety": the interlocks of the arm belong to the state of the VMD'


@check("interlock-name", "R-8.2.3-1", level="note")
def interlock_name(table: Table) -> Iterator[str]:
    """The domain of the safety interlocks has the standardized name R_SAFE."""
    for device in devices(table, "safety"):
        if device["domain"] not in ("", "R_SAFE"):
            yield f"the domain {device['domain']} of {device['name']!r} is not called R_SAFE"


@check("arm-name", "R-8.2.1-1", "R-8.2.1-2", level="note")
def arm_name(table: Table) -> Iterator[str]:
    """The domain of an only arm is called R_ARM; of several, each has its own (R_ARM-1, R_ARM-2)."""
    arms = devices(table, "arm")
    for device in arms:
        fit = device["domain"] == "R_ARM" if len(arms) == 1 else ARM_NAME.match(device["domain"])
        if device["domain"] and not fit:
            wanted = "R_ARM" if len(arms) == 1 else "R_ARM-1, R_ARM-2 or the like"
            yield f"the domain {device['domain']} of the arm {device['name']!r} is not called {wanted}"


@check("arm-program", "R-6.1.2.1-1", "R-6.3.2.2-N")
def arm_program(table: Table) -> Iterator[str]:
    """What arms names is bound to the domain of an arm, and CONTROLLED or (where that is dispensed with) NORMAL."""
    for name in table["arms"]:
        entry = program(table, name)
        if entry is None:
            continue
        if not arm_domains(table) & set(entry["domains"]):
            yield f"arms names {name}, which is bound to no domain of an arm"
        elif entry["control"] == "CONTROLLING":
            yield f"arms names {name}, which is CONTROLLING: the program of an arm is CONTROLLED"


@check("arm-programs-named", "R-6.1.2.1-1")
def arm_programs_named(table: Table) -> Iterator[str]:
    """Every predefined CONTROLLED program invocation that is bound to the domain of an arm is named by arms."""
    for entry in of_control(table, "CONTROLLED"):
        if arm_domains(table) & set(entry["domains"]) and entry["name"] not in table["arms"]:
            yield f"{entry['name']} is bound to the domain of an arm, and arms does not name it"


@check("without-arm-program", "R-6.3.2.2-N", level="note")
def without_arm_program(table: Table) -> Iterator[str]:
    """Without a CONTROLLED program for each arm, stopping the program and stopping the arm are the same."""
    served = {d for entry in of_control(table, "CONTROLLED") for d in entry["domains"]}
    for device in devices(table, "arm"):
        if device["domain"] and device["domain"] not in served:
            yield (
                f"no predefined CONTROLLED program invocation operates the arm {device['name']!r}: stopping the "
                "program and stopping the arm cannot be told apart, and motion has no robot state"
            )


@check("one-intelligence", "R-6.1.2.2-1", "R-6.1.2.3-1")
def one_intelligence(table: Table) -> Iterator[str]:
    """One controlling program invocation leads all arms of a VMD; arms of their own are VMDs of their own."""
    arms = {entry["name"] for entry in of_control(table, "CONTROLLED") if entry["name"] in table["arms"]}
    for entry in of_control(table, "CONTROLLING"):
        led = arms & set(entry["controlled"])
        if led and led != arms:
            yield f"{entry['name']} leads {', '.join(sorted(led))} and not {', '.join(sorted(arms - led))}"


@check("device-program", "R-6.1.2.4-1", "R-6.3.7-1")
def device_program(table: Table) -> Iterator[str]:
    """The program of a device is a predefined CONTROLLED program invocation that is bound to its domain."""
    for device in table["devices"]:
        entry = program(table, device["program"])
        if not device["program"]:
            continue
        if entry is None or entry["control"] != "CONTROLLED":
            yield f"the program {device['program']} of {device['name']!r} is no predefined CONTROLLED program invocation"
        elif device["domain"] not in entry["domains"]:
            yield f"the program {device['program']} of {device['name']!r} is not bound to its domain {device['domain']}"


@check("device-attributes", "R-6.2.1-2", "R-6.3.7-2", level="warning")
def device_attributes(table: Table) -> Iterator[str]:
    """The domain of a device should have attributes for power and for control."""
    for device in devices(table, "arm", "auxiliary"):
        lacking = [key for key in ("power", "local_control") if not device[key]]
        if lacking:
            yield f"the device {device['name']!r} has no attribute for {' and '.join(lacking)}"


@check("calibration-program", "R-6.3.6-2", "R-8.2.2-1", level="warning")
def calibration_program(table: Table) -> Iterator[str]:
    """Where a device can be calibrated, a domain and a program invocation for it are predefined."""
    able = [device["name"] for device in table["devices"] if device["calibration"]]
    if able and program(table, "R_CAL") is None:
        yield f"{', '.join(map(repr, able))} can be calibrated, and no R_CAL is predefined"


@check("standard-name", "R-8.1-2", "R-8.1-3", level="note")
def standard_name(table: Table) -> Iterator[str]:
    """Names that begin with R_ are those of the standard."""
    known = re.compile("|".join([*STANDARDIZED, ARM_NAME.pattern, "R_SAFE$"]))
    domains = [d for entry in table["predefined"] for d in entry["domains"]]
    for name in dict.fromkeys(
        [
            *(e["name"] for e in table["predefined"]),
            *domains,
            *(d["domain"] for d in table["devices"]),
        ]
    ):
        if name.startswith("R_") and not known.fullmatch(name):
            yield f"{name} begins with R_ and is no name of the standard"


@check("list-unselected", "R-7.4.4.2-i", "R-7.4.4.2-f2")
def list_unselected(table: Table) -> Iterator[str]:
    """Only what is selected at power-on has a list: of another one, Select would be refused for ever."""
    for entry in of_control(table, "CONTROLLING"):
        if entry["controlled"] and entry["name"] != table["selected_at_power_on"]:
            yield f"{entry['name']} has a list and is not selected at power-on: Select refuses it, and nothing empties its list"


@check("ready-without-arm", "R-6.3.4.4-1", level="warning")
def ready_without_arm(table: Table) -> Iterator[str]:
    """In ROBOT-READY the selected program invocation controls R_ARM."""
    selected = program(table, table["selected_at_power_on"])
    if selected is not None and program(table, "R_ARM") and "R_ARM" not in selected["controlled"]:
        yield f"{selected['name']} is selected at power-on and does not control R_ARM"


HARDWARE = (
    _bound("R_ARM", "R-8.3.1-1", "R-8.3.1-2"),
    _bound("R_CAL", "R-8.3.2-1", "R-8.3.2-2"),
    device_domain, own_domain, interlocks, interlock_name, arm_name, arm_program, arm_programs_named,
    without_arm_program, one_intelligence, device_program, device_attributes, calibration_program, standard_name,
    list_unselected, ready_without_arm,
)  # fmt: skip
