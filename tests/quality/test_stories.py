"""Conversations written by hand from the text of the clauses are judged as their author says."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from story import Judged, Story, stories

from mmsverify.auditing import audit_traces
from mmsverify.results import Finding

FOLDER = Path(__file__).parent / "by_hand"
STORIES = {path.stem: path for path in stories(FOLDER)}


def told(name: str) -> Story:
    return Story(STORIES[name].read_text(encoding="utf-8"))


TOLD = {name: told(name) for name in STORIES}
FAULTY = [name for name, story in TOLD.items() if story.judged]
CONFORMING = [name for name, story in TOLD.items() if not story.judged]


EXERCISED = (
    "R-3.2.1-1", "R-5.1.3-2", "R-5.3.1.3.3.13-2", "R-5.3.1.3.3.7-2", "R-6.3.2.3-2", "R-6.3.2.6-1",
    "R-6.3.4.7-2", "R-6.3.5.9-1", "R-7.3.2.1.1.1-1", "R-7.3.2.1.1.4-1", "R-7.3.3.3.1.4-2", "R-7.3.3.3.3-c1",
    "R-7.3.3.3.3-d0", "R-7.3.3.4.1-b", "R-7.3.3.4.1-c", "R-7.3.3.5.3-e1", "R-7.3.3.8.1-e", "R-7.3.3.9-1",
    "R-7.3.3.9.2.4-1", "R-7.3.3.9.2.6-1", "R-7.4.4.2-d", "R-7.4.4.2-e", "R-7.5.1.4-4", "R-7.5.2.1-1",
    "R-7.5.2.4-1", "R-7.5.2.4-2", "R-8.2.2-2", "R-8.3.1-6", "R-8.5.3.1-1", "R-8.5.5.1-1", "R-8.5.5.2-1",
    "R-8.6.1-2", "R-8.7.1-1", "R-8.7.2-2", "R-8.7.4-1", "R-8.8.2-1", "R-9.2.2.2.1-3", "R-A5.1-3", "R-T1-1",
)  # fmt: skip
"""What the faults of the stories are against, as an audit cites it too."""


def waiting(names: list[str]) -> list[Any]:
    """The names as parameters: a story that waits for something is expected to fail until then."""
    marks = {name: pytest.mark.xfail(reason=TOLD[name].waits, strict=False) for name in names}
    return [pytest.param(name, marks=marks[name]) if TOLD[name].waits else name for name in names]


def found(name: str, folder: Path) -> list[Finding]:
    """What an audit finds, notes apart."""
    path = told(name).write(folder / f"{name}.mcap")
    findings = audit_traces([path], profile=None, model=None).findings
    return [finding for finding in findings if finding.severity != "note"]


def agrees(finding: Finding, judged: Judged) -> bool:
    """Whether it is the same message, as bad, against one of the same statements."""
    cited = {*finding.clauses, *finding.readings} & set(judged.clauses)
    return (finding.index, finding.severity) == (judged.index, judged.severity) and bool(cited)


def said(finding: Finding) -> str:
    return (
        f"#{finding.index} {finding.severity} {finding.rule} {' '.join(finding.clauses)}: {finding.message}"
    )


@pytest.mark.parametrize("name", waiting(CONFORMING))
def test_a_robot_that_keeps_the_text_is_not_blamed(name: str, tmp_path: Path) -> None:
    assert list(map(said, found(name, tmp_path))) == []


@pytest.mark.parametrize("name", waiting(FAULTY))
def test_a_robot_that_breaks_the_text_is_blamed_for_what_its_author_says_and_nothing_else(
    name: str, tmp_path: Path
) -> None:
    findings, judged = found(name, tmp_path), TOLD[name].judged
    unsaid = [one for one in judged if not any(agrees(finding, one) for finding in findings)]
    more = [said(finding) for finding in findings if not any(agrees(finding, one) for one in judged)]
    assert (unsaid, more) == ([], [])


def test_there_are_ten_stories_without_a_fault_and_twelve_with_one() -> None:
    judged = [name for name, story in TOLD.items() if not story.waits]
    assert len(set(CONFORMING) & set(judged)) >= 10
    assert len(set(FAULTY) & set(judged)) >= 12


def test_the_stories_exercise_what_is_said_of_them() -> None:
    assert set(EXERCISED) <= {
        clause for story in TOLD.values() for one in story.judged for clause in one.clauses
    }
