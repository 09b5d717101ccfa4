"""The keys of ``[vr-template]``: what the template framework leaves to who builds a machine with it.

Where a command of his own is allowed the framework says for each hundred of numbers. A table may say otherwise:
whether that keeps the framework's rules is proved or refuted, not presumed.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mmsverify.errors import ProfileError
from mmsverify.profiles.keys import Key, choice, choices, flag, is_int, name, tables

ALLOWED: Mapping[int, tuple[str, ...]] = {
    1: ("DbgRdy", "HomeRdy", "OrgRdy"),
    2: ("HomeRdy", "OrgRdy"),
    3: ("OrgRdy",),
    4: ("Run",),
}
"""The modes in which the framework allows the commands of each hundred."""
MODES = (*ALLOWED[1], *ALLOWED[4])
FRAMEWORK_TABLE, COMMANDS = "vr-template", "commands"

COMMAND: Mapping[str, Key] = {
    "number": Key(None, "an integer of 101-199, 201-299, 301-399 or 401-499",
                  lambda v: is_int(v) and v // 100 in ALLOWED and v % 100 != 0,
                  "its number in VR(C_Cmd)", ("V-CMD-101", "V-CMD-201", "V-CMD-301", "V-CMD-401", "V-CHK-T")),
    "name": name(says="its name"),
    "sub_mode": Key(None, "an integer from 0", lambda v: is_int(v) and v >= 0,
                    "what DoCmd sets VR(C_SubMD) to", ("V-DO-101", "V-DO-201", "V-DO-301", "V-DO-401")),
    "allowed": choices([], MODES, says="the modes in which it is allowed; where nothing is said, all that the framework has for its number",
                       clauses=("V-SUBD-2", "V-SUBH-2", "V-SUBO-2")),
    "homing": choice("keeps", "loses", "homes", says="what its action does to homing: keeps it as it is, loses it, or homes the machine",
                     clauses=("V-VR-10",)),
}  # fmt: skip

FRAMEWORK: Mapping[str, Key] = {
    "homed_at_power_on": flag(False, says="whether the controller is homed when it is powered"),
    "sub_action_status": choice("either", "11-14", "13-16", says="the numbers of the sub-action statuses"),
    COMMANDS: tables([], COMMAND, says="the machine's own commands; where none is listed, each number of 101 to 499 is one",
                     clauses=("V-CMD-101", "V-CMD-201", "V-CMD-301", "V-CMD-401")),
}  # fmt: skip


def completed(entries: list[dict[str, Any]], where: str) -> list[dict[str, Any]]:
    """The commands with the modes that the framework allows, where an entry names none."""
    _require_once(entries, where)
    _require_one_effect(entries, where)
    return [{**each, "allowed": each["allowed"] or list(ALLOWED[each["number"] // 100])} for each in entries]


def within_framework(tables: Mapping[str, Mapping[str, Any]]) -> dict[str, Mapping[str, Any]]:
    """The tables with commands allowed only where the framework allows them, too: what a machine is held to.

    What a table allows beyond the framework a check refutes; no machine is excused by it.
    """
    table = tables.get(FRAMEWORK_TABLE, {})
    within = [
        {**each, "allowed": [m for m in each["allowed"] if m in ALLOWED[each["number"] // 100]]}
        for each in table.get(COMMANDS, ())
    ]
    return {**tables, FRAMEWORK_TABLE: {**table, COMMANDS: within}}


def _require_once(entries: list[dict[str, Any]], where: str) -> None:
    for key in ("number", "name"):
        met: set[Any] = set()
        for each in entries:
            if each[key] in met:
                raise ProfileError(
                    f"two commands have the {key} {each[key]}",
                    place=where,
                    cure=f"give each a {key} of its own",
                )
            met.add(each[key])


def _require_one_effect(entries: list[dict[str, Any]], where: str) -> None:
    """Commands of a hundred that set the same sub-mode have the same action; it does one thing to homing."""
    actions: dict[tuple[int, int], dict[str, Any]] = {}
    for each in entries:
        first = actions.setdefault((each["number"] // 100, each["sub_mode"]), each)
        if first["homing"] != each["homing"]:
            raise ProfileError(
                f"{first['name']} and {each['name']} are one action, by sub_mode = {each['sub_mode']}, "
                f'and yet homing = "{first["homing"]}" and "{each["homing"]}"',
                place=where,
                cure="give them two sub-modes, or one homing",
            )
