"""A check of a profile: what it asks of the table, and the statements that ask for it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

Table = Mapping[str, Any]
Find = Callable[[Table], Iterator[str]]
Level = Literal["refused", "error", "warning", "note"]


@dataclass(frozen=True, slots=True)
class Check:
    """One check: its rule, the statements, how bad a breach is, its meaning, and how breaches are found.

    ``refused``: with a breach the profile describes no robot, and nothing can be judged by it.
    """

    rule: str
    clauses: tuple[str, ...]
    level: Level
    says: str
    find: Find


def check(rule: str, *clauses: str, level: Level = "error") -> Callable[[Find], Check]:
    """Make a check of a function that yields a sentence for each breach; its docstring is the meaning."""

    def made(find: Find) -> Check:
        return Check(f"profile.{rule}", clauses, level, " ".join((find.__doc__ or "").split()), find)

    return made


def program(table: Table, name: str) -> Table | None:
    """A predefined program invocation by name."""
    return next((entry for entry in table["predefined"] if entry["name"] == name), None)


def of_control(table: Table, control: str) -> list[Table]:
    """The predefined program invocations with a control attribute."""
    return [entry for entry in table["predefined"] if entry["control"] == control]


def devices(table: Table, *kinds: str) -> list[Table]:
    """The devices of some kinds."""
    return [device for device in table["devices"] if device["kind"] in kinds]


def arm_domains(table: Table) -> frozenset[str]:
    """The domains that represent an arm."""
    return frozenset({device["domain"] for device in devices(table, "arm")} - {""})


def several(names: list[str]) -> list[str]:
    """The names that stand more than once."""
    return sorted({name for name in names if names.count(name) > 1})
