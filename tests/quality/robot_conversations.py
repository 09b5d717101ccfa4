"""Robots of several kinds, random conversations with them, and what an audit makes of these."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robot import robot
from robot_random import Chance, beginning
from robot_talk import Talk

from mmsverify.auditing import audit_traces
from mmsverify.results import Finding

ARM = {"name": "R_ARM", "control": "CONTROLLED", "domains": ["R_ARM"], "deletable": False}
CALIBRATION = {"name": "R_CAL", "control": "NORMAL", "domains": ["R_CAL"], "deletable": False}
TASK = {"name": "TASK", "control": "CONTROLLING", "domains": ["TASK"], "deletable": False, "reusable": False}
ROBOTS: tuple[tuple[dict[str, Any], dict[str, int]], ...] = (
    ({"predefined": [ARM, CALIBRATION]}, {"PI": 4, "Client": 1, "Request": 2, "Domain": 4, "Upload": 1}),
    (
        {"predefined": [ARM, CALIBRATION], "associations": "multiple"},
        {"PI": 4, "Client": 2, "Request": 2, "Domain": 3, "Upload": 2},
    ),
    ({"predefined": [ARM, TASK], "selected_at_power_on": "TASK"}, {"PI": 3, "Client": 1, "Request": 2}),
    (
        {"predefined": [], "step_limited": False, "associations": "multiple"},
        {"PI": 3, "Client": 3, "Request": 3},
    ),
)  # fmt: skip


def conversation(seed: int, count: int) -> Talk:
    """A conversation of ``count`` messages.

    Of every third, the recording begins in mid-operation; every other one has gaps.
    """
    profile, sizes = ROBOTS[seed % len(ROBOTS)]
    chance = Chance(beginning(robot("repaired"), profile, sizes), seed, gaps=0.003 * (seed // 4 % 2))
    if seed % 3 == 2:
        chance.join_late(seed % 100)
    return chance.hold(count)


def blamed(talk: Talk, path: Path) -> list[Finding]:
    """What an audit finds, notes apart."""
    findings = audit_traces([talk.write(path)], profile=None, model=None).findings
    return [finding for finding in findings if finding.severity != "note"]
