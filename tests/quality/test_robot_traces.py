"""Runs of the robot model become recordings; the audit flags what repaired forbids, and no witness of it."""

from __future__ import annotations

from pathlib import Path

import pytest
from robot import VARIANTS, checked, robot

from mmsverify.auditing import audit_traces
from mmsverify.checking import write_counterexamples
from mmsverify.checking.request import Request
from mmsverify.checking.robot_trace import INDICATIONS, SERVICES
from mmsverify.checking.runs import Explorer
from mmsverify.checking.worlds import small_worlds
from mmsverify.faults.partings import partings

BOOKKEEPING = "what is loaded or read is forgotten when its domain is gone: only the robot's own books tell"
READ_OTHERWISE = "repaired states the property otherwise (RP-12), and this run keeps that"
SILENT = {
    "loading-is-bound": BOOKKEEPING,
    "one-download": BOOKKEEPING,
    "uploads-have-domain": BOOKKEEPING,
    "predicates-exclusive": READ_OTHERWISE,
    "predicates-exhaustive": READ_OTHERWISE,
    "ready-controls-arm": READ_OTHERWISE,
}
"""Counterexamples that no message shows, and why; a test makes sure that a repaired robot does the same."""

HIDDEN = {"loads", "uploads", "upload_state", "source", "entered", "selecting", "limited", "keeps"}
"""What no message shows: for whom a domain is loaded or read, what is being handled, how R_CTRL ends."""


def audited(folder: Path, variant: str) -> dict[str, int]:
    """The recordings of a check by property and kind, each with the number of findings."""
    paths = write_counterexamples([checked(variant)], folder)
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
    assert {name.split(".")[0] for name, count in found.items() if not count} == SILENT.keys()


def test_what_the_audit_does_not_flag_the_repaired_robot_does_as_well_and_shows_the_same() -> None:
    written, mended = robot("as-written"), robot("repaired")
    claims = [claim for claim in written.claims if claim.title in SILENT]
    explorer = Explorer(written, Request())
    explorer.explore(claims, small_worlds(written, None), states=60_000)
    assert sorted(claim.title for claim in claims if claim.name in explorer.runs) == sorted(SILENT)
    for run in explorer.runs.values():
        shown = written.signatures.keys() - HIDDEN
        assert list(partings(mended, run.world, run.path, shown)) == []


@pytest.mark.parametrize("variant", VARIANTS)
def test_every_row_that_a_message_shows_becomes_a_message(variant: str) -> None:
    rows = robot(variant).actions
    answering = {row.name for row in rows if row.on.phase == "response" and row.answer}
    assert answering <= SERVICES.keys() | {"initiate"}
    assert {row.name for row in rows if row.on.phase == "indication"} == INDICATIONS.keys()
