"""A robot written from the text alone is not blamed; its faults are, each once, with a clause."""

from __future__ import annotations

from collections.abc import Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from random import Random

import pytest
from independent.catalogue import CATALOGUE, OPEN, Fault
from independent.chance import Talk
from independent.tape import Said, Tape, write

from mmsverify.auditing import audit_traces
from mmsverify.formats.trace import Channel
from mmsverify.results import Finding

FEW, MANY = 4, 40
QUICK = (
    "start_stopped", "start_not_selected", "select_normal", "without_control_select_taken", "local_select",
    "intervention_vmd_reset", "refused_vmd_stop", "refused_select", "status_executing_but_ready",
    "unasked_local_all_allowed", "attributes_list_more", "attributes_cycles_more", "domain_arm_deletable",
    "variable_jt_length", "semaphore_two_tokens", "reused_invoke", "reused_and_answered_late",
    "before_initiate", "octets_inner_length_server", "initiate_version_raised",
)  # fmt: skip


def blamed(messages: Sequence[Said], profile: dict[str, str], path: Path) -> list[Finding]:
    """What an audit finds, notes apart."""
    found = audit_traces([write(path, messages, profile)], profile=None, model=None).findings
    return [finding for finding in found if finding.severity != "note"]


def shown(found: Sequence[Finding]) -> list[str]:
    return [f"{f.index} {f.severity} {f.rule} {f.clauses} {f.readings} {f.message}" for f in found]


def spoken(seed: int, least: int, most: int) -> tuple[Talk, Tape]:
    talk = Talk(seed)
    return talk, talk.hold(Random(seed).randint(least, most))


def amiss(fault: Fault, found: Sequence[Finding], places: Sequence[int]) -> str:
    """What is wrong with the findings about a faulty conversation; nothing if they are right."""
    here = [f for f in found if f.index in places and (f.severity == "error" or fault.level == "any")]
    cited = {name for finding in here for name in (*finding.clauses, *finding.readings)}
    more = [f for f in found if f.severity == "error" and f.index not in places]
    if not here:
        return "missed"
    if not any(fnmatchcase(name, allowed) for name in cited for allowed in fault.clauses):
        return f"cited {sorted(cited)}"
    return "told more than once" if more else ""


def judged(fault: Fault, messages: Sequence[Said], places: Sequence[int], path: Path) -> str:
    found = blamed(messages, fault.profile, path)
    wrong = amiss(fault, found, places)
    return "\n".join([wrong, *shown(found)]) if wrong else ""


@pytest.mark.parametrize("seed", range(FEW))
def test_a_short_conversation_of_the_independent_robot_is_not_blamed(seed: int, tmp_path: Path) -> None:
    talk, tape = spoken(seed, 25, 45)
    assert shown(blamed(tape.messages, talk.profile, tmp_path / "made.mcap")) == []


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(500, 500 + MANY))
def test_a_conversation_of_the_independent_robot_is_not_blamed(seed: int, tmp_path: Path) -> None:
    talk, tape = spoken(seed, 30, 90)
    assert shown(blamed(tape.messages, talk.profile, tmp_path / "made.mcap")) == []


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(700, 710))
def test_a_recording_that_begins_in_the_middle_is_not_blamed(seed: int, tmp_path: Path) -> None:
    talk, tape = spoken(seed, 40, 70)
    begin = Random(seed).randrange(5, 30)
    assert shown(blamed(tape.messages[begin:], talk.profile, tmp_path / "made.mcap")) == []


@pytest.mark.parametrize("name", QUICK)
def test_a_fault_of_the_independent_robot_is_found_once(name: str, tmp_path: Path) -> None:
    fault = CATALOGUE[name]
    tape = fault.tape()
    assert judged(fault, tape.messages, fault.places(tape), tmp_path / "made.mcap") == ""


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.xfail(name in OPEN, reason=OPEN.get(name, ""), strict=True))
        for name in CATALOGUE
        if name not in QUICK
    ],
)
def test_every_fault_of_the_catalogue_is_found_once(name: str, tmp_path: Path) -> None:
    fault = CATALOGUE[name]
    tape = fault.tape()
    assert judged(fault, tape.messages, fault.places(tape), tmp_path / "made.mcap") == ""


def beside(tape: Tape, other: Tape, chance: Random) -> tuple[list[Said], dict[int, int]]:
    """Two recordings in one, each in its own order; where the messages of the first have come to stand."""
    left, right = list(tape.messages), list(other.messages)
    mixed: list[Said] = []
    places: dict[int, int] = {}
    while left or right:
        if left and (not right or chance.random() < 0.5):
            places[len(tape.messages) - len(left)] = len(mixed)
            mixed.append(left.pop(0))
        else:
            mixed.append(right.pop(0))
    return mixed, places


@pytest.mark.parametrize("name", ["start_not_selected", "status_none_selected"])
def test_a_fault_of_the_second_robot_is_found_among_the_messages_of_both(name: str, tmp_path: Path) -> None:
    fault = CATALOGUE[name]
    tape, other = fault.tape("second"), CATALOGUE["select_normal"].tape("first")
    harmless = Tape("first", other.messages[: other.faults[0] - 1])
    mixed, places = beside(tape, harmless, Random(7))
    where = [places[place] for place in fault.places(tape)]
    assert judged(fault, mixed, where, tmp_path / "made.mcap") == ""


@pytest.mark.parametrize("name", ["select_normal", "attributes_arm_deletable"])
def test_a_fault_is_found_at_its_index_among_channels_that_nobody_knows(name: str, tmp_path: Path) -> None:
    fault = CATALOGUE[name]
    tape = fault.tape()
    strange = Tape("x", [Said(Channel("/camera", "jpeg"), b"\xff\xd8")] * 40)
    mixed, places = beside(tape, strange, Random(3))
    where = [places[place] for place in fault.places(tape)]
    assert judged(fault, mixed, where, tmp_path / "made.mcap") == ""
