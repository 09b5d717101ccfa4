"""Why a finding stands: what excludes the event, and the nearest legal conversations; both are tried."""

from __future__ import annotations

import json
import random
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

from mmsverify.audit.causes.conversation import Conversation, conversation, recorded, spread_out
from mmsverify.audit.causes.doubting import Doubtful
from mmsverify.audit.causes.evidence import GivenUpError, smallest
from mmsverify.audit.learning.lasting import of_thread
from mmsverify.audit.parts import Parts
from mmsverify.audit.telling import History, Place
from mmsverify.auditing import audit_traces
from mmsverify.cli import main
from mmsverify.explaining import explain_finding, explain_findings
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.trace import Channel
from mmsverify.profiles import for_recording, within_framework
from mmsverify.resources import traces_dir
from mmsverify.results import Account, Edit, Finding

ROBOTS = [
    pytest.param("annex-a.mcap", marks=pytest.mark.slow),
    "faulty-select.mcap",
    "faulty-vmd-stop.mcap",
    "two-clients.mcap",
]
FAULTY = [*ROBOTS, "faulty-press.mcap", "faulty-signals.mcap"]


@cache
def accounts(name: str) -> list[Account]:
    path = traces_dir() / name
    return explain_findings(path, audit_traces([path], profile=None, model=None).findings)


def account(name: str, index: int) -> Account:
    return next(told for told in accounts(name) if told.finding.index == index)


def grounds(name: str, index: int) -> list[list[int]]:
    return [[each.index for each in ground.messages] for ground in account(name, index).grounds]


def edits(name: str, index: int) -> list[tuple[str, int, str]]:
    return [(edit.kind, edit.index, edit.words) for edit in account(name, index).edits]


# The stories of the samples.


def test_select_was_accepted_though_the_program_had_been_shown_stopped() -> None:
    assert grounds("faulty-select.mcap", 41)[0] == [39]
    said = account("faulty-select.mcap", 41).grounds[0].messages[0]
    assert said.words.startswith("GetProgramInvocationAttributes Weld_Door: result(+), state STOPPED")
    assert said.asked == 38


def test_that_it_was_stopped_also_follows_from_stop_and_the_status_after_it() -> None:
    assert [36, 37] in grounds("faulty-select.mcap", 41)


def test_a_reset_before_the_select_would_have_made_it_legal() -> None:
    assert edits("faulty-select.mcap", 41) == [("insert", 40, "Reset Weld_Door, answered result(+)")]


def test_a_refusal_would_have_been_right_but_the_robot_did_what_it_answered() -> None:
    told = account("faulty-select.mcap", 41)
    assert told.right is not None
    assert (told.right.words, told.later) == ("answers result(-)", (43,))


def test_a_select_before_the_start_would_have_made_it_legal() -> None:
    assert grounds("faulty-select.mcap", 57)[0] == [55]
    assert ("insert", 56, "Select Weld_Door, answered result(+)") in edits("faulty-select.mcap", 57)


def test_vmd_stop_alone_excludes_a_running_program() -> None:
    assert grounds("faulty-vmd-stop.mcap", 42) == [[36]]
    assert edits("faulty-vmd-stop.mcap", 42)[0] == ("change", 42, "shows state IDLE")


def test_manual_intervention_was_shown_and_only_something_unseen_could_have_ended_it() -> None:
    assert grounds("faulty-vmd-stop.mcap", 44) == [[38], [36]]
    assert edits("faulty-vmd-stop.mcap", 44) == [("insert", 43, "UnsolicitedStatus, which shows ROBOT-READY")]


def test_the_other_client_had_control_as_its_start_its_select_and_its_take_control_show() -> None:
    single = [found for found in grounds("two-clients.mcap", 29) if len(found) == 1]
    assert single == [[25], [23], [4]]
    assert edits("two-clients.mcap", 29)[0] == ("change", 29, "answers result(-)")


@pytest.mark.slow
def test_in_annex_a_services_are_used_that_initiate_could_have_listed_and_a_domain_is_misspelt() -> None:
    assert grounds("annex-a.mcap", 7) == [[1]]
    listed = ("change", 1, "lists InitiateDownloadSequence in servicesSupported")
    assert listed in edits("annex-a.mcap", 7)
    assert edits("annex-a.mcap", 12) == [("change", 12, "names Assemble_Cluster")]
    assert grounds("annex-a.mcap", 26) == [[]]


def test_what_is_wrong_by_itself_needs_no_earlier_message() -> None:
    assert grounds("faulty-signals.mcap", 13) == [[]]


def test_the_answer_on_the_wrong_connection_belongs_on_the_other() -> None:
    told = ("change", 19, "is said to line, whose request #18 waits for it")
    assert edits("faulty-signals.mcap", 19)[0] == told


@pytest.mark.parametrize(("index", "before"), [(117, 116), (311, 310)])
def test_of_a_machine_the_sample_before_is_enough(index: int, before: int) -> None:
    assert grounds("faulty-press.mcap", index) == [[before]]
    assert account("faulty-press.mcap", index).grounds[0].stretch


def test_an_unlawful_mode_that_stays_is_not_mended_by_one_sample() -> None:
    told = account("faulty-press.mcap", 117)
    assert told.right is not None
    assert (told.right.words, told.later) == ("shows C_RunMD 6 (Run)", (118,))
    assert (told.edits, len(told.remarks)) == ((), 1)


@pytest.mark.parametrize("name", FAULTY)
def test_every_clause_of_an_account_is_told_in_our_words(name: str) -> None:
    for told in accounts(name):
        assert [each.id for each in told.statements] == list(told.finding.clauses)


# That they are so.


class Told:
    """The conversation of one sample, told by a device that remembers nothing."""

    def __init__(self, name: str) -> None:
        self.path = traces_dir() / name
        trace = read_trace(self.path)
        tables = within_framework(for_recording(None, trace.profile, str(self.path)))
        self.parts = Parts(tables, "repaired", of_thread(), str(self.path))
        self.talk: Conversation = conversation(trace)

    def marks(self, begin: int, end: int, doubted: set[int]) -> set[tuple[int | None, str]]:
        """The findings of the messages between two positions, some turns in doubt."""
        device = self.parts.device_of(Doubtful, Place("", ""), frozenset(), (), History())
        found: list[Finding] = []
        for at in range(begin, end):
            in_doubt = self.talk.turn_of[at] in doubted
            found += device.hear(self.talk.messages[at], doubted=in_doubt)
        return {(None if each.index is None else recorded(each.index), each.rule) for each in found}

    def comes(self, finding: Finding, believed: set[int]) -> bool:
        """Whether a finding comes when nothing is believed but these messages, and its own."""
        assert finding.index is not None
        event = self.talk.position(finding.index)
        own = self.talk.turn_of[event]
        turns = {self.talk.turn_of[self.talk.position(index)] for index in believed}
        begin = self.talk.begin(min({own, *turns}))
        doubted = {turn for turn in range(len(self.talk.turns)) if turn not in {own, *turns}}
        return (finding.index, finding.rule) in self.marks(begin, event + 1, doubted)


@cache
def told(name: str) -> Told:
    return Told(name)


@pytest.mark.parametrize("name", ROBOTS)
def test_each_set_excludes_the_event_whatever_the_other_messages_say(name: str) -> None:
    for each in accounts(name):
        for ground in each.grounds:
            assert told(name).comes(each.finding, {said.index for said in ground.messages})


@pytest.mark.parametrize("name", ROBOTS)
def test_from_none_of_the_sets_can_a_message_be_left_out(name: str) -> None:
    for each in accounts(name):
        for ground in each.grounds:
            members = {said.index for said in ground.messages}
            assert ground.irreducible
            assert [m for m in members if told(name).comes(each.finding, members - {m})] == []


def edited(path: Path, edit: Edit, into: Path) -> None:
    """The recording with an edit."""
    trace = read_trace(path)
    messages = list(trace)
    channels = {message.topic: message.channel for message in messages}
    with TraceWriter(into) as made:
        made.add_profile(trace.profile)
        for message in messages:
            here = message.index == edit.index
            if edit.kind == "drop" and message.index in (edit.index, edit.asked):
                continue
            said = [(message.channel, message.data)]
            if here and edit.kind != "drop":
                put_in = [(channels[topic], octets) for topic, octets in edit.said]
                said = put_in if edit.kind == "change" else [*put_in, *said]
            for number, (channel, octets) in enumerate(said):
                made.add(message.time + number, channel, octets)


@pytest.mark.parametrize("name", FAULTY)
def test_with_an_edit_that_is_proposed_an_audit_finds_less_and_nothing_new(name: str, tmp_path: Path) -> None:
    before = Counter(each.finding.rule for each in accounts(name))
    for number, each in enumerate(accounts(name)):
        for edit in each.edits:
            made = tmp_path / f"{number}-{edit.kind}-{edit.index}.mcap"
            edited(traces_dir() / name, edit, made)
            found = audit_traces([made], profile=None, model=None).findings
            after = Counter(finding.rule for finding in found)
            assert after < before, (each.finding.rule, edit.words, [told.message for told in found])


@pytest.mark.parametrize("seed", [3, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (2, 6, 8, 10))])
def test_doubt_makes_no_finding_of_what_conforms(seed: int) -> None:
    chance = random.Random(seed)
    share, sample = chance.random(), told("production-run.mcap")
    turns = sample.talk.turns
    doubted = {turn for turn in range(len(turns)) if chance.random() < share}
    end = next(at for at, said in enumerate(sample.talk.messages) if said.index == spread_out(232))
    assert sample.marks(0, end, doubted) == set()


# Other recordings: a sample without one of its messages, or begun later.


def without(name: str, index: int, into: Path, *, begin: int = 0) -> Path:
    """The sample from the message ``begin`` on, without one of its messages."""
    trace = read_trace(traces_dir() / name)
    with TraceWriter(into) as made:
        made.add_profile(trace.profile)
        for message in trace:
            if message.index >= begin and message.index != index:
                made.add(message.time, message.channel, message.data)
    return into


def first_account(path: Path, rule: str) -> Account:
    findings = audit_traces([path], profile=None, model=None).findings
    return explain_finding(path, next(each for each in findings if each.rule == rule))


def test_an_answer_to_nothing_lacks_its_request(tmp_path: Path) -> None:
    path = without("two-clients.mcap", 26, tmp_path / "made.mcap")
    told_of = first_account(path, "protocol.unasked")
    assert [each.index for each in told_of.grounds[0].messages] == [17]
    assert [edit.words for edit in told_of.edits if edit.kind == "insert"] == ["the request, such as Status"]


def test_a_request_without_an_answer_lacks_it(tmp_path: Path) -> None:
    path = without("two-clients.mcap", 23, tmp_path / "made.mcap")
    told_of = first_account(path, "protocol.unanswered")
    assert told_of.finding.index == 22
    assert ("insert", 23, "the answer to #22, result(+)") in [
        (edit.kind, edit.index, edit.words) for edit in told_of.edits
    ]


def test_of_a_request_that_stands_there_twice_one_is_left_out(tmp_path: Path) -> None:
    path, trace = tmp_path / "made.mcap", read_trace(traces_dir() / "two-clients.mcap")
    with TraceWriter(path) as made:
        made.add_profile(trace.profile)
        for message in trace:
            for number in range(2 if message.index == 5 else 1):
                made.add(message.time + number, message.channel, message.data)
    told_of = first_account(path, "protocol.invoke-id-reused")
    assert [each.index for each in told_of.grounds[0].messages] == [5]
    assert [(edit.kind, edit.index, edit.asked) for edit in told_of.edits] == [("drop", 6, None)]


def test_a_recording_that_begins_late_is_explained_by_what_it_has(tmp_path: Path) -> None:
    path = without("faulty-select.mcap", -1, tmp_path / "made.mcap", begin=38)
    told_of = first_account(path, "select.selected-active")
    assert [each.index for each in told_of.grounds[0].messages] == [1]


def test_a_sample_that_cannot_be_read_is_wrong_by_itself(tmp_path: Path) -> None:
    path, channel = tmp_path / "made.mcap", Channel.vr("press", "scan")
    with TraceWriter(path) as made:
        for number, data in enumerate([b'{"C_RunMD": 1, "CS_RunSTA": 1}', b"no sample"]):
            made.add(number, channel, data)
    told_of = first_account(path, "vr.undecodable")
    assert told_of.grounds[0].messages == ()
    assert [edit.kind for edit in told_of.edits] == ["drop"]


# The search itself.


def test_the_latest_smallest_set_is_found() -> None:
    needed = [{1, 4, 6}, {2, 3, 5, 7}]

    def asks(first: int, kept: frozenset[int]) -> bool:
        return any(one <= {turn for turn in kept if turn >= first} for one in needed)

    found = smallest(9, asks, [])
    assert found is not None
    assert (found.turns, found.irreducible) == ((2, 3, 5, 7), True)


def test_a_single_message_that_is_likely_is_preferred() -> None:
    found = smallest(9, lambda _, kept: kept >= {5, 7} or 2 in kept, [2])
    assert found is not None
    assert found.turns == (2,)


def test_where_all_together_do_not_do_nothing_is_found() -> None:
    assert smallest(3, lambda *_: False, []) is None


def test_a_search_that_is_broken_off_says_so() -> None:
    questions = iter([False, False, True])

    def asks(_: int, __: frozenset[int]) -> bool:
        for answer in questions:
            return answer
        raise GivenUpError

    found = smallest(3, asks, [])
    assert found is not None
    assert not found.irreducible


# The command.


def test_the_account_is_printed_for_somebody_tired(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", str(traces_dir() / "faulty-select.mcap"), "41"]) == 1
    printed = capsys.readouterr().out
    assert "because     this message excludes it, whatever the others say:" in printed
    assert "one edit    put in before #40: Reset Weld_Door, answered result(+)" in printed
    assert "R-7.4.4.2-e: Select e) refuses" in printed


def test_of_a_message_without_a_finding_it_is_said_that_nothing_is_wrong(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["explain", str(traces_dir() / "faulty-vmd-stop.mcap"), "3"]) == 0
    assert capsys.readouterr().out.endswith("message 3: nothing is wrong with it\n")


def test_an_account_as_json_has_all_its_parts(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", str(traces_dir() / "faulty-select.mcap"), "41", "--format", "json"]) == 1
    printed = json.loads(capsys.readouterr().out)
    (one,) = printed["accounts"]
    assert (printed["schema"], printed["index"]) == ("mmsverify.explain/1", 41)
    assert one["violation"]["rule"] == "select.selected-active"
    assert one["grounds"][0]["messages"][0]["index"] == one["earliest"] == 39
    assert one["edits"][0]["said"][0]["topic"] == "/weld3/mms/cell-controller/client"


def test_a_finding_about_the_whole_file_has_no_grounds() -> None:
    whole = Finding("a.mcap", None, None, None, None, "error", "input.unreadable", (), "cut off")
    told_of = explain_finding(traces_dir() / "faulty-select.mcap", whole)
    assert (told_of.grounds, told_of.edits, len(told_of.remarks)) == ((), (), 1)


def test_names_out_of_a_recording_cannot_move_the_cursor(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "made.mcap"
    with TraceWriter(path) as made:
        made.add(1, Channel.modbus("robot\x1b[2J", "panel\x1b[1m", "server"), bytes.fromhex("0001"))
    assert main(["explain", str(path), "0"]) == 1
    assert "\x1b" not in capsys.readouterr().out


def test_the_order_of_the_file_does_not_matter(tmp_path: Path) -> None:
    messages = list(read_trace(traces_dir() / "faulty-vmd-stop.mcap"))
    path = tmp_path / "disorder.mcap"
    with TraceWriter(path) as trace:
        for message in [*messages[10:], *messages[:10]]:
            trace.add(message.time, message.channel, message.data)
    found = audit_traces([path], profile=None, model=None).findings
    assert [account.finding for account in explain_findings(path, found)] == list(found)
