"""The judgement of a profile: refused where it describes no robot, else what it breaks, by rule and statement."""

from __future__ import annotations

from collections.abc import Iterator, Set

from mmsverify.errors import ProfileError
from mmsverify.profiles.checks import Table
from mmsverify.profiles.conformance import CONFORMANCE
from mmsverify.profiles.hardware import HARDWARE
from mmsverify.profiles.refusals import REFUSALS
from mmsverify.profiles.robot import ROBOT
from mmsverify.results import ProfileFinding

CHECKS = (*REFUSALS, *HARDWARE, *CONFORMANCE)
"""Every check, those that refuse a profile first."""

PICS = ("step_limited", "devices", "first_step", "orientation", "program_location", "additional_services")
"""The keys of parts 5 and 6 of the PICS, which the implementer has to complete (9.4)."""


def require_robot(table: Table, place: str) -> None:
    """Refuse a table that no robot can have; the clause is told."""
    for each in REFUSALS:
        for sentence in each.find(table):
            cause, _, cure = sentence.partition("; ")
            told = "; ".join(filter(None, [cure, " ".join(each.clauses)]))
            raise ProfileError(cause, place=place, cure=told)


def judge(table: Table, stated: Set[str] | None = None) -> list[ProfileFinding]:
    """What a robot's table breaks. ``stated`` are the keys that the profile itself gives, where that is known."""
    found = [
        ProfileFinding(each.rule, each.clauses, each.level, sentence)
        for each in (*HARDWARE, *CONFORMANCE)
        if each.level != "refused"
        for sentence in each.find(table)
    ]
    return found + list(_unstated(table, stated))


def _unstated(table: Table, stated: Set[str] | None) -> Iterator[ProfileFinding]:
    """Which keys of the PICS a profile leaves to their defaults."""
    for key in PICS:
        needless = key == "first_step" and not table["step_limited"]
        if stated is not None and key not in stated and not needless:
            clauses = tuple(dict.fromkeys(("R-9.4.1-1", *ROBOT[key].clauses)))
            says = f"{key} is not stated; it is taken to be the default"
            yield ProfileFinding("profile.not-stated", clauses, "note", says)
