"""The two tasks of the template framework: the interleavings that break it as written, and the repairs."""

from __future__ import annotations

import pytest

from mmsverify.checking import check_models
from mmsverify.results import Verdict

SHORTEST = {
    "only-checked-is-done": ["operator", "lets_through", "operator", "does"],
    "never-forbidden": ["operator", "lets_through", "operator", "does"],
    "no-mode-is-lost": ["operator", "lets_through", "takes", "does", "acts", "goes_on"],
    "no-command-is-lost": ["operator", "operator"],
}
"""The shortest bad interleavings: who acts, step by step."""


def verdicts(variant: str) -> dict[str, Verdict]:
    (check,) = check_models(["vr-tasks"], variant=variant)
    return {verdict.name: verdict for verdict in check.verdicts}


def acting(verdict: Verdict) -> list[str]:
    assert verdict.counterexample is not None
    return [step.action.partition("(")[0] for step in verdict.counterexample][1:]


def test_each_race_is_shown_by_its_shortest_interleaving() -> None:
    broken = {name: v for name, v in verdicts("as-written").items() if v.result == "violated"}
    assert {name: acting(verdict) for name, verdict in broken.items()} == SHORTEST


@pytest.mark.exercises("V-CMD-N", "V-CMD02-2", "V-CTL02-N", "V-TASK-1")
def test_the_repaired_tasks_lose_nothing_and_do_nothing_unchecked() -> None:
    assert {v.result for v in verdicts("repaired").values()} == {"proved"}
