"""The two tasks of the template framework: the interleavings that break it as written, and the repairs."""

from __future__ import annotations

import pytest

from mmsverify.checking import check_models
from mmsverify.results import Verdict

SHORTEST = {
    "only-checked-is-done": ["operator", "finds_axes_in_order", "lets_through", "operator", "does"],
    "never-forbidden": ["operator", "finds_axes_in_order", "lets_through", "operator", "does"],
    "no-mode-is-lost": [
        "operator",
        "finds_axes_in_order",
        "lets_through",
        "takes",
        "does",
        "acts",
        "goes_on",
    ],
    "no-command-is-lost": ["operator", "operator"],
    "negative-limit-is-named": ["inputs", "finds_emergency"],
    "emergency-is-named": ["inputs", "finds_no_name"],
    "success-means-in-order": ["inputs", "finds_no_name"],
}
"""The shortest bad interleavings, row by row."""
OF_CMD02, OF_CONTROL02 = {"finds_axes_in_order", "lets_through", "does"}, {"takes", "acts", "goes_on"}


def verdicts(variant: str) -> dict[str, Verdict]:
    (check,) = check_models(["vr-tasks"], variant=variant)
    return {verdict.name: verdict for verdict in check.verdicts}


def acting(verdict: Verdict) -> list[str]:
    assert verdict.counterexample is not None
    return [step.action.rpartition(": ")[2] for step in verdict.counterexample][1:]


def test_each_race_and_each_misprint_is_shown_by_its_shortest_interleaving() -> None:
    broken = {name: v for name, v in verdicts("as-written").items() if v.result == "violated"}
    assert {name: acting(verdict) for name, verdict in broken.items()} == SHORTEST


@pytest.mark.exercises(
    "V-CMD-N", "V-CMD02-1", "V-CMD02-2", "V-CMD02-3", "V-CTL02-N", "V-TASK-1", "V-MIO-1", "V-MIO-2",
    "V-MIO-3", "V-MIO-4", "V-MIO-5", "V-MIO-6", "V-DO-R1", "V-DO-R2",
)  # fmt: skip
def test_the_repaired_tasks_lose_nothing_and_do_nothing_unchecked() -> None:
    assert {v.result for v in verdicts("repaired").values()} == {"proved"}


def test_an_interleaving_names_the_task_of_each_step() -> None:
    steps = verdicts("as-written")["no-mode-is-lost"].counterexample
    assert steps is not None
    tasks = {
        step.action.rpartition(": ")[2]: step.action.partition(".")[0] for step in steps if "." in step.action
    }
    assert tasks == {**dict.fromkeys(OF_CMD02, "Cmd02"), **dict.fromkeys(OF_CONTROL02, "Control02")}
