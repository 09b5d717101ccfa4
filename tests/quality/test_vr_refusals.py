"""A controller that breaks a rule is blamed once, at the sample that shows it, with the right clause."""

from __future__ import annotations

import pytest
from vr_random import framework
from vr_runs import KINDS, Sampling
from vr_story import READY, RUNNING, findings, marked

HOMED = "0 1 1! 2 3"
"""From power-on to HomeRdy."""

# A rule of a command, the clause, and a story in which the command is obeyed all the same.
OBEYED = f"""
home.while-running        V-CHK-3   {RUNNING} 1! 2* 3 2! 4 5
home.while-running        V-DO-01   {RUNNING} 401! 16 1! 2* 3
home.not-waiting          V-CHK-2   0 1 1! 2 4! 7 1! 2* 3
home.not-waiting          V-CHK-2   {RUNNING} 9! 9 1! 2* 3
home.not-waiting          V-CHK-2   0 1 8! 8 1! 2* 3
org.unhomed               V-SM-5    0 1 2! 4* 5 3! 6 4! 7 1
org.unhomed               V-FUN-2   0 1 8! 8 2! 4* 5
org.unhomed               V-SM-5    {RUNNING} 8! 8 10! 1 2! 4* 5
org.not-ready             V-CHK-2   {RUNNING} 4! 7 2! 4* 5
org.not-ready             V-CHK-2   {HOMED} 201! 14 2! 4* 5
run.not-ready             V-FUN-2   0 1 3! 6* 4 5
run.not-ready             V-FUN-2   {HOMED} 3! 6* 4 5
run.not-ready             V-DO-03   {HOMED} 2! 4 3! 6:4* 4 5
stop.nothing-runs         V-CHK-2   0 1 4! 7* 1
stop.nothing-runs         V-CHK-2   0 1 4! 10* 7 1
stop.nothing-runs         V-DO-04   {RUNNING} 9! 9 4! 7* 3
pause.not-running         V-PRE-05  {READY} 5! 5:10* 5
step.not-running          V-PRE-02  0 1 1! 2 6! 2:10* 3
reset.no-error            V-CHK-2   0 1 1! 2 10! 1* 1
reset.no-error            V-CHK-2   {RUNNING} 10! 3* 3
debug-action.not-waiting  V-SUBD-2  0 1 1! 2 101! 13* 1
debug-action.not-waiting  V-CMD-101 {RUNNING} 199! 13* 1
debug-action.not-waiting  V-DO-101  0 1 8! 8 150! 13* 1
home-action.not-homed     V-SUBH-2  0 1 201! 14* 3
home-action.not-homed     V-DO-201  0 1 8! 8 299! 14* 3
home-action.not-homed     V-CMD-201 {RUNNING} 201! 14* 3
origin-action.not-ready   V-SUBO-2  {HOMED} 301! 15* 5
origin-action.not-ready   V-DO-301  0 1 399! 15* 5
run-action.not-running    V-CMD-401 {READY} 401! 16* 6
run-action.not-running    V-DO-401  0 1 499! 16* 6
"""
# The status shows it, whatever the command: 10 is of mode 6 only.
BY_STATUS = {"pause.not-running", "step.not-running"}
NOT_SEEN = {"resume.not-paused": "a flow that is not paused and is resumed goes on as it did"}

# The same where samples are polled: the status of the mode before, or CF_Home, tells the step that was made.
POLLED = f"""
home.not-waiting          V-CHK-3   {RUNNING} 2:6* 3
home.not-waiting          V-CHK-2   {HOMED} 2! 4 2:4* 3
org.unhomed               V-SM-5    0 1 4* 5
org.unhomed               V-SM-5    0 1 4:1* 5
org.not-ready             V-CHK-2   {RUNNING} 4! 7 4:7* 5
run.not-ready             V-FUN-2   {HOMED} 6:3* 4
stop.nothing-runs         V-DO-04   {READY} 7:5* 3
pause.not-running         V-PRE-05  {READY} 5:10* 5
step.not-running          V-PRE-02  0 1 1! 2 2:10* 3
debug-action.not-waiting  V-SUBD-2  {RUNNING} 13:6* 1
home-action.not-homed     V-SUBH-2  {RUNNING} 14:6* 3
origin-action.not-ready   V-SUBO-2  {HOMED} 15:3* 5
run-action.not-running    V-CMD-401 {READY} 16:5* 6
"""
UNSEEN_POLLED = {
    **NOT_SEEN,
    "home.while-running": "with a Stop between two samples Home may be given; at worst it cuts the Stop off",
    "reset.no-error": "where ResetErr leads, an error and its reset between two samples lead too",
}
BY_FLAG = "mode.unhomed"

# The clause of a row of SetNextMode, or of what ResetErr leads to, and a story in which another mode comes.
NEXT = f"""
V-NEXT-00   0 3* 3
V-NEXT-01   0 1 1 3* 3
V-NEXT-01   0 1 1 5* 5
V-NEXT-02   0 1 1! 2 1* 1
V-NEXT-02   0 1 1! 2 5* 5
V-NEXT-03a  {HOMED} 1* 1
V-NEXT-03b  {HOMED} 5* 5
V-NEXT-04   {HOMED} 2! 4 3* 3
V-NEXT-05   {READY} 3* 3
V-NEXT-06   {RUNNING} 3* 3
V-NEXT-06   {RUNNING} 5* 5
V-NEXT-07a  {RUNNING} 4! 7 1* 1
V-SM-3      {RUNNING} 4! 7 1* 1
V-NEXT-07b  0 1 1! 2 4! 7 3* 3
V-NEXT-10   {RUNNING} 4! 10 3* 3
V-NEXT-11   {RUNNING} 8! 11 1* 1
V-NEXT-12   {RUNNING} 9! 12 3* 3
V-DO-10a    {RUNNING} 8! 8 10! 3* 3
V-SM-4      {RUNNING} 8! 8 10! 3* 3
V-DO-10b    {RUNNING} 9! 9 10! 1* 1
V-DO-10c    0 1 9! 9 10! 3* 3
V-NEXT-13   {HOMED} 101! 13 3* 3
V-SUBD-3    {READY} 101! 13 5* 5
V-NEXT-14   {READY} 201! 14 5* 5
V-SUBH-3    {READY} 201! 14 1* 1
V-NEXT-15   {READY} 301! 15 3* 3
V-SUBO-3    {READY} 301! 15 1* 1
V-NEXT-16   {RUNNING} 401! 16 5* 5
V-CTL02-N   {READY} 0* 1
"""
# Rows that the reading of the framework gives up: what they print is a breach.
LEFT = f"""
V-DEV-3  0 1 8! 8 8 1* 1
V-DEV-3  {RUNNING} 8! 8 1* 1
V-DEV-4  {RUNNING} 9! 9 3* 3
V-DEV-4  0 1 9! 9 9 1* 1
"""

# For each row of SetPreMode, a mode with a status that is not its own, nor that of the mode before.
STATUS = f"""
V-PRE-00  0 0:1* 0:1 0
V-PRE-01  0 1 1:2* 1
V-PRE-02  0 1 1! 2 2:4* 2:4 2:4 3
V-PRE-03  {HOMED} 3:5* 3
V-PRE-04  {HOMED} 2! 4 4:2* 4
V-PRE-05  {READY} 5:6* 5
V-PRE-06  {RUNNING} 6:5* 6:5 6
V-PRE-07  {RUNNING} 4! 7 7:8* 7
V-PRE-08  {RUNNING} 8! 8 8:9* 8
V-PRE-09  {RUNNING} 9! 9 9:8* 9
V-PRE-13  0 1 101! 13 13:14* 13
V-PRE-14  {HOMED} 201! 14 14:13* 14
V-PRE-15  {READY} 301! 15 15:14* 15
V-PRE-16  {RUNNING} 401! 16 16:10* 16
"""
# Between two polled samples the machine may have been in the mode of this status, and has come from there.
AGAIN = {"V-PRE-06", "V-PRE-08", "V-PRE-09", "V-PRE-16"}


def told(table: str, words: int) -> list[list[str]]:
    """The lines of a table: so many words, and the story."""
    return [line.split(None, words) for line in table.splitlines() if line]


def rules() -> set[str]:
    """The rules of the commands that the model refuses."""
    return {c.rule for row in framework().actions for c in row.guard if c.rule}


def warned() -> set[str]:
    """Those that rest on a reading."""
    return {c.rule for row in framework().actions for c in row.guard if c.rule and c.level == "warning"}


def test_every_rule_has_a_story_or_a_reason_why_there_is_none() -> None:
    assert {rule for rule, _, _ in told(OBEYED, 2)} | set(NOT_SEEN) == rules()
    assert {rule for rule, _, _ in told(POLLED, 2)} | set(UNSEEN_POLLED) == rules()


@pytest.mark.parametrize(("rule", "clause", "story"), told(OBEYED, 2))
def test_a_command_that_is_obeyed_unlawfully_is_blamed(rule: str, clause: str, story: str) -> None:
    (found,) = findings(story, "scan")
    assert [found.index] == marked(story)
    assert found.rule == ("status.mode" if rule in BY_STATUS else rule)
    assert found.severity == ("warning" if rule in warned() - BY_STATUS else "error")
    assert clause in found.clauses


@pytest.mark.parametrize(("rule", "clause", "story"), told(POLLED, 2))
def test_a_polled_sample_that_no_lawful_steps_explain_is_blamed(rule: str, clause: str, story: str) -> None:
    (found,) = findings(story, "polled")
    assert [found.index] == marked(story)
    assert found.rule in {"status.mode" if rule in BY_STATUS else rule, BY_FLAG}
    assert clause in found.clauses


@pytest.mark.parametrize(("rule", "clause", "story"), [r for r in told(OBEYED, 2) if r[0] in UNSEEN_POLLED])
def test_what_polled_samples_cannot_tell_is_not_blamed(rule: str, clause: str, story: str) -> None:
    assert findings(story, "polled") == [], (rule, clause)


@pytest.mark.parametrize(("clause", "story"), told(NEXT, 1))
def test_another_mode_than_the_next_is_blamed(clause: str, story: str) -> None:
    (found,) = findings(story, "scan")
    assert [found.index] == marked(story)
    assert (found.rule, found.severity) == ("mode.next", "error")
    assert clause in found.clauses


@pytest.mark.parametrize(("clause", "story"), told(LEFT, 1))
def test_an_error_that_is_left_without_a_reset_is_blamed(clause: str, story: str) -> None:
    (found,) = findings(story, "scan")
    assert [found.index] == marked(story)
    assert (found.rule, found.severity) == ("error.left", "error")
    assert clause in found.clauses


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("clause", "story"), told(STATUS, 1))
def test_a_status_that_is_not_of_the_mode_is_blamed_once(clause: str, story: str, kind: Sampling) -> None:
    found = findings(story, kind)
    if kind == "polled" and clause in AGAIN:
        assert found == []
        return
    assert [each.index for each in found] == marked(story)
    assert (found[0].rule, found[0].severity) == ("status.mode", "error")
    assert clause in found[0].clauses
