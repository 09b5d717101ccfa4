"""Random runs as recordings of either kind, and what an audit makes of these."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from vr_random import Cells, profile, run, sparse, thinned, write

from mmsverify.auditing import audit_traces
from mmsverify.results import Finding

Sampling = Literal["scan", "polled"]
KINDS: tuple[Sampling, ...] = ("scan", "polled")


def recording(seed: int, count: int, kind: Sampling, path: Path, machine: str = "") -> list[Cells]:
    """The random run of a seed, recorded: its samples, all of them or those that were polled."""
    samples = run(seed, count, machine)
    if kind == "polled":
        samples = thinned(samples, seed)
    told = [*sparse(samples, seed)]
    write(path, kind, told, profile(seed))
    return told


def blamed(path: Path, machine: str = "") -> list[Finding]:
    """What an audit finds, notes apart."""
    findings = audit_traces([path], profile=Path(machine) if machine else None, model=None).findings
    return [finding for finding in findings if finding.severity != "note"]
