"""Runs of the robot model become recordings; the audit flags what repaired forbids, and no witness of it."""

from __future__ import annotations

from pathlib import Path

import pytest
from robot import VARIANTS, robot

from mmsverify.auditing import audit_traces
from mmsverify.checking import check_models, write_counterexamples
from mmsverify.checking.robot_trace import INDICATIONS, SERVICES

# What these runs show breaks no rule of repaired: no message shows R_CTRL, and the predicates of 6.3.4
# and the arm that READY demands are read otherwise there (RP-12).
SILENT = {
    "holder-is-associated",
    "one-holder",
    "predicates-exclusive",
    "predicates-exhaustive",
    "ready-controls-arm",
}


def audited(folder: Path, variant: str) -> dict[str, int]:
    """The recordings of a check by property and kind, each with the number of findings."""
    paths = write_counterexamples(check_models(["mms-robot"], variant=variant), folder)
    findings = audit_traces(paths, profile=None, model=None).findings
    counts = {path: sum(finding.path == str(path) for finding in findings) for path in paths}
    return {path.name.removeprefix(f"mms-robot.{variant}."): count for path, count in counts.items()}


@pytest.mark.slow
def test_the_audit_finds_nothing_in_a_witness_of_repaired(tmp_path: Path) -> None:
    found = audited(tmp_path, "repaired")
    assert len(found) >= 18
    assert {name: count for name, count in found.items() if count} == {}


@pytest.mark.slow
def test_the_audit_flags_every_counterexample_that_messages_can_show(tmp_path: Path) -> None:
    found = {n: c for n, c in audited(tmp_path, "as-written").items() if n.endswith("counterexample.mcap")}
    assert {name.split(".")[0] for name, count in found.items() if not count} == SILENT


@pytest.mark.parametrize("variant", VARIANTS)
def test_every_row_that_a_message_shows_becomes_a_message(variant: str) -> None:
    rows = robot(variant).actions
    answering = {row.name for row in rows if row.on.phase == "response" and row.answer}
    assert answering <= SERVICES.keys() | {"initiate"}
    assert {row.name for row in rows if row.on.phase == "indication"} == INDICATIONS.keys()
