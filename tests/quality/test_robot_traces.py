"""Runs of the robot model become recordings; the audit flags what repaired forbids, and no witness of it."""

from __future__ import annotations

from pathlib import Path

import pytest
from robot import VARIANTS, robot
from robot_broken import BROKEN

from mmsverify.auditing import audit_traces
from mmsverify.checking.request import Request
from mmsverify.checking.robot_trace import INDICATIONS, SERVICES
from mmsverify.checking.runs import Explorer, Run
from mmsverify.checking.traces import write_run
from mmsverify.checking.worlds import small_worlds
from mmsverify.faults.partings import partings
from mmsverify.model import Claim

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


def runs(variant: str, claims: list[Claim], states: int) -> dict[str, Run]:
    """A run for each of these claims that one is found for, by the claim's title."""
    model = robot(variant)
    explorer = Explorer(model, Request())
    explorer.explore(claims, small_worlds(model, None), states=states)
    return {claim.title: explorer.runs[claim.name] for claim in claims if claim.name in explorer.runs}


def found_in(shown: dict[str, Run], folder: Path) -> dict[str, int]:
    """How many findings the audit has in the recording of each run."""
    paths = {title: write_run(run.steps, folder / f"{title}.mcap") for title, run in shown.items()}
    findings = audit_traces([*paths.values()], profile=None, model=None).findings
    return {title: sum(f.path == str(path) for f in findings) for title, path in paths.items()}


@pytest.mark.slow
def test_the_audit_finds_nothing_in_a_witness_of_repaired(tmp_path: Path) -> None:
    wanted = [claim for claim in robot("repaired").claims if claim.kind == "sometimes"]
    shown = runs("repaired", wanted, 100_000)
    assert sorted(shown) == sorted(claim.title for claim in wanted)
    assert {title: count for title, count in found_in(shown, tmp_path).items() if count} == {}


@pytest.mark.slow
def test_the_audit_flags_every_counterexample_that_messages_can_show(tmp_path: Path) -> None:
    broken = {title for title, length in BROKEN.items() if length >= 0}
    shown = runs("as-written", [c for c in robot("as-written").claims if c.title in broken], 100_000)
    assert shown.keys() == broken
    found = found_in(shown, tmp_path)
    assert {title for title, count in found.items() if not count} == SILENT.keys()


def test_what_the_audit_does_not_flag_the_repaired_robot_does_as_well_and_shows_the_same() -> None:
    written, mended = robot("as-written"), robot("repaired")
    silent = runs("as-written", [claim for claim in written.claims if claim.title in SILENT], 60_000)
    assert silent.keys() == SILENT.keys()
    shown = written.signatures.keys() - HIDDEN
    told = {title: list(partings(mended, run.world, run.path, shown)) for title, run in silent.items()}
    assert {title: found for title, found in told.items() if found} == {}


@pytest.mark.parametrize("variant", VARIANTS)
def test_every_row_that_a_message_shows_becomes_a_message(variant: str) -> None:
    rows = robot(variant).actions
    answering = {row.name for row in rows if row.on.phase == "response" and row.answer}
    assert answering <= SERVICES.keys() | {"initiate"}
    assert {row.name for row in rows if row.on.phase == "indication"} == INDICATIONS.keys()
