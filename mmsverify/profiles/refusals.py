"""What no robot can be: a profile with such a breach is refused, with the statement that forbids it."""

from __future__ import annotations

from collections.abc import Iterator

from mmsverify.profiles.checks import Check, Table, check, of_control, program, several
from mmsverify.profiles.robot import STANDARDIZED

NONE = '""'


@check("named-twice", "R-8.1-1", level="refused")
def named_twice(table: Table) -> Iterator[str]:
    """A name stands for one program invocation."""
    for name in several([entry["name"] for entry in table["predefined"]]):
        yield f"{name} is predefined twice; give each name once"


@check("selected-controlling", "R-6.3.5.4-2", "R-6.3.5.4-3", level="refused")
def selected_controlling(table: Table) -> Iterator[str]:
    """What is selected at power-on is predefined and CONTROLLING."""
    fit = [entry["name"] for entry in of_control(table, "CONTROLLING")]
    if table["selected_at_power_on"] not in ("", *fit):
        yield (
            f"selected_at_power_on names {table['selected_at_power_on']!r}, which is not a predefined CONTROLLING "
            f"program invocation; give {' or '.join(fit) or NONE}"
        )


def _fixed(name: str, key: str, *clauses: str) -> Check:
    wanted = STANDARDIZED[name][key]
    shown = str(wanted).lower() if isinstance(wanted, bool) else f'"{wanted}"'

    def find(table: Table) -> Iterator[str]:
        entry = program(table, name)
        if entry is not None and entry[key] != wanted:
            yield f"predefined {name} must have {key} = {shown}"

    find.__doc__ = f"{name} has {key} = {shown}."
    return check(f"{name.lower().replace('_', '-')}-{key}", *clauses, level="refused")(find)


FIXED = (
    _fixed("R_ARM", "control", "R-8.3.1-6"),
    _fixed("R_ARM", "deletable", "R-8.3.1-3"),
    _fixed("R_ARM", "reusable", "R-8.3.1-4"),
    _fixed("R_CAL", "control", "R-8.3.2-3", "R-6.3.6-7"),
    _fixed("R_CAL", "deletable", "R-8.3.2-2"),
    _fixed("R_CAL", "reusable", "R-8.3.2-2"),
)


@check("list-owner", "R-6.3.2.3-1", level="refused")
def list_owner(table: Table) -> Iterator[str]:
    """Only a CONTROLLING program invocation has a list of controlled ones."""
    for entry in table["predefined"]:
        if entry["controlled"] and entry["control"] != "CONTROLLING":
            yield f"predefined {entry['name']} is {entry['control']} and has no list of controlled ones"


@check("listed", "R-6.3.2.3-2", level="refused")
def listed(table: Table) -> Iterator[str]:
    """What a list names is predefined and CONTROLLED."""
    fit = [entry["name"] for entry in of_control(table, "CONTROLLED")]
    for entry in table["predefined"]:
        for name in entry["controlled"]:
            if name not in fit:
                yield f"predefined {entry['name']} controls {name}, which is no predefined CONTROLLED one; name {' or '.join(fit) or 'none'}"


@check("listed-once", "R-6.3.1-3", "R-7.3.3.1-4", level="refused")
def listed_once(table: Table) -> Iterator[str]:
    """A CONTROLLED program invocation is on one list at most, and once."""
    for name in several([name for entry in table["predefined"] for name in entry["controlled"]]):
        yield f"{name} is controlled twice; name it in one list, once"


@check("single-task", "R-5.3.1.3.3.4-2", level="refused")
def one_task(table: Table) -> Iterator[str]:
    """A robot that holds one task program has at most one that is predefined."""
    held = [entry["name"] for entry in of_control(table, "CONTROLLING")]
    if table["single_task"] and len(held) > 1:
        yield f"single_task = true, and {' and '.join(held)} are predefined; a robot that holds one task program has one"


REFUSALS = (named_twice, selected_controlling, *FIXED, list_owner, listed, listed_once, one_task)
