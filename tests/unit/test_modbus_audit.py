"""The audit of Modbus/TCP recordings: every rule broken once, and what conforming servers and clients do."""

from __future__ import annotations

import json
import re
import struct
from pathlib import Path

import pytest
from modbus_line import COILS, DEDICATED, INPUTS, REFUSED, UNSOUND, WORDS, Line, accepted, adu, opened

from mmsverify.audit.modbus import MODBUS_RULES
from mmsverify.auditing import audit_traces
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.trace import Channel
from mmsverify.model import MINUS, load
from mmsverify.resources import models_dir

# Each rule; modbus.read-back has a file of its own.


def test_octets_that_are_no_adu_are_told_once() -> None:
    line = opened().octets("client", b"\x00\x01\x00\x01\x00\x06\x01\x01\x00\x01\x00\x08").asks(2).answers(2)
    assert line.told() == [(1, "modbus.undecodable")]


def test_an_answer_to_nothing_is_an_error() -> None:
    assert opened().asks(1).answers(1).answers(2).told() == [(3, "modbus.unasked")]


def test_a_second_answer_is_an_error() -> None:
    assert opened().asks(1).answers(1).answers(1).told() == [(3, "modbus.unasked")]


def test_a_request_that_is_passed_over_is_never_answered() -> None:
    assert opened().asks(1).asks(2).answers(2).link("close").told() == [(1, "modbus.unanswered")]


def test_a_transaction_that_is_used_again_gives_up_a_request_that_was_passed_over() -> None:
    line = opened().asks(1).asks(2).answers(2).asks(1).answers(1)
    assert line.told() == [(1, "modbus.unanswered")]


def test_an_answer_with_another_unit_is_an_error() -> None:
    assert opened().asks(1, unit=1).answers(1, unit=2).told() == [(2, "modbus.unit")]


@pytest.mark.parametrize("function", [0x02, 0x82])
def test_an_answer_with_another_function_code_is_an_error(function: int) -> None:
    assert opened().asks(1, 0x01).answers(1, function, b"\x02").told() == [(2, "modbus.function")]


@pytest.mark.parametrize(
    ("function", "address", "data"),
    [
        (0x01, 1, b"\x02\x05\x00"),
        (0x02, 1001, b"\x01"),
        (0x03, 0, b"\x02\x00\x01"),
        (0x04, 0, b"\x04\x00\x01\x00"),
        (0x05, 1, b"\x00\x01\x00\x00"),
        (0x06, 0, b"\x00\x01\x00\x03"),
        (0x0F, 1, b"\x00\x01\x00\x07"),
        (0x10, 0, b"\x00\x00\x00\x02\x00"),
    ],
)
def test_an_answer_that_does_not_belong_to_its_request_is_an_error(
    function: int, address: int, data: bytes
) -> None:
    line = opened().asks(1, function, address).answers(1, function, data)
    assert line.told() == [(2, "modbus.response")]


@pytest.mark.parametrize("data", [b"", b"\x00", b"\x02\x00"])
def test_an_exception_has_one_code_that_is_not_nought(data: bytes) -> None:
    line = opened().asks(1, 0x01, 961).answers(1, 0x81, data)
    assert line.told() == [(2, "modbus.exception")]


def test_an_exception_that_nothing_explains_is_noted() -> None:
    line = opened().asks(1).refuses(1)
    assert line.told() == [(2, "modbus.refused")]
    assert [each.severity for each in line.found] == ["note"]


@pytest.mark.parametrize(("event", "word"), [("close", "closed"), ("reset", "reset")])
def test_a_message_after_the_end_of_its_connection_is_told_once(event: str, word: str) -> None:
    line = opened().link(event).asks(1).answers(1)
    assert line.told() == [(2, "modbus.closed")]
    assert line.found[0].message.endswith(word)


def test_more_connections_than_may_be_served_are_an_error() -> None:
    line = opened(max_clients=2).link("open", "panel").link("open", "third").asks(1, name="third")
    line.answers(1, name="third").asks(1).answers(1).asks(1, name="panel").answers(1, name="panel")
    assert line.asks(2, name="third").answers(2, name="third").told() == [(2, "modbus.too-many")]


def test_every_rule_has_been_broken_here() -> None:
    said = set(re.findall(r"modbus\.[a-z-]+", Path(__file__).read_text(encoding="utf-8")))
    assert set(MODBUS_RULES) - said == set()


# Each refusing step of the model.


@pytest.mark.parametrize(("function", "address", "rule", "clause"), REFUSED)
def test_what_must_be_refused_may_not_be_accepted(
    function: int, address: int, rule: str, clause: str
) -> None:
    line = accepted(function, address, dedicated=DEDICATED)
    assert line.told() == [(2, rule)]
    assert clause in line.found[0].clauses
    assert (line.found[0].severity, line.found[0].related) == ("error", (1,))


@pytest.mark.parametrize(("function", "address"), [case[:2] for case in REFUSED])
def test_what_must_be_refused_may_be_refused(function: int, address: int) -> None:
    assert opened(dedicated=DEDICATED).asks(1, function, address).refuses(1, function).told() == []


@pytest.mark.parametrize(("function", "address", "word", "rest", "data"), UNSOUND)
def test_a_request_with_data_that_it_cannot_have_may_not_be_accepted(
    function: int, address: int, word: int, rest: bytes, data: bytes
) -> None:
    line = opened().asks(1, function, address, word, rest).answers(1, function, data)
    assert line.told() == [(2, "request.unsound")]
    assert "M-2.2-7" in line.found[0].clauses
    assert "MR-02" in line.found[0].readings
    assert opened().asks(1, function, address, word, rest).refuses(1, function, 3).told() == []


def test_every_refusing_step_of_the_model_has_been_broken_here() -> None:
    model = load("modbus-signals", models_dir(), "repaired")
    steps = {row.guard[-1].rule for row in model.actions if row.answer == MINUS}
    broken = {rule for _, _, rule, _ in REFUSED} | {"request.unsound"}
    # A plan sorts the numbers of 0x03, 0x04, 0x06 and 0x10 as registers or as beyond them: never as signals.
    assert steps - broken == {"access.not-registers"}


# What conforms.


@pytest.mark.parametrize(("function", "address"), COILS)
@pytest.mark.exercises("M-2.3.1-4", "M-2.2-8")
def test_coils_are_the_outputs_and_the_internal_signals(function: int, address: int) -> None:
    assert accepted(function, address).told() == []


@pytest.mark.parametrize(("function", "address"), INPUTS)
@pytest.mark.exercises("M-2.3.1-1")
def test_discrete_inputs_are_the_external_inputs(function: int, address: int) -> None:
    assert accepted(function, address).told() == []


@pytest.mark.parametrize(("function", "address"), WORDS)
@pytest.mark.exercises("M-2.3-7")
def test_words_are_the_registers_of_the_plan(function: int, address: int) -> None:
    assert accepted(function, address).told() == []


@pytest.mark.exercises("M-2.3.2-2")
def test_a_dedicated_signal_may_be_read() -> None:
    assert accepted(0x01, 5, dedicated=[10]).told() == []


@pytest.mark.exercises("M-2.3-7", "M-2.3.2-1")
def test_an_address_is_counted_from_the_offset_of_the_plan() -> None:
    assert accepted(0x01, 0, address_offset=1).told() == []
    assert accepted(0x01, 953, address_offset=1).told() == [(2, "access.beyond")]
    assert accepted(0x02, 0, address_offset=1001).told() == []


@pytest.mark.exercises("M-2.2-1", "M-2.2-8")
def test_requests_may_be_answered_in_another_order() -> None:
    line = opened().asks(1).asks(2, 0x02, 1001).asks(3)
    assert line.answers(3).answers(1).answers(2, 0x02).told() == []


def test_a_recording_may_begin_with_an_answer() -> None:
    assert Line().answers(1).asks(2).answers(2).told() == []


def test_after_a_gap_an_answer_may_be_to_what_was_lost() -> None:
    assert opened().asks(1).link("gap").answers(2).asks(3).answers(3).told() == []


def test_before_a_gap_nothing_is_told_as_never_answered() -> None:
    assert opened().asks(1).asks(2).answers(2).link("gap").link("close").told() == []


@pytest.mark.exercises("M-2.1-13")
def test_a_client_may_come_again_and_begin_anew() -> None:
    assert opened().asks(1).answers(1).link("close").link("open").asks(1).answers(1).told() == []


@pytest.mark.exercises("M-2-S4b")
def test_a_client_may_leave_before_the_answer() -> None:
    assert opened().asks(1).answers(1).asks(2).asks(3).link("reset").told() == []


def test_a_recording_may_end_before_the_answer() -> None:
    assert opened().asks(1).told() == []


def test_of_a_server_whose_answers_overtake_each_other_nothing_is_told_as_never_answered() -> None:
    line = opened().asks(1).asks(2).answers(2).answers(1)
    assert line.asks(3).asks(4).answers(4).link("close").told() == []


def test_an_answer_to_a_request_before_a_gap_is_judged() -> None:
    assert opened().asks(1).link("gap").answers(1, unit=2).told() == [(3, "modbus.unit")]


@pytest.mark.exercises("M-2.3-7")
def test_registers_are_counted_without_the_offset() -> None:
    assert accepted(0x03, 0, address_offset=1).told() == []
    assert accepted(0x03, 1022, address_offset=1).told() == []


@pytest.mark.parametrize("code", [4, 5, 6, 8, 10, 11])
def test_an_exception_may_have_a_reason_that_no_message_shows(code: int) -> None:
    assert opened().asks(1).refuses(1, code=code).told() == []


@pytest.mark.parametrize("function", [0x07, 0x11, 0x2B])
def test_a_function_code_that_the_text_does_not_open_is_not_judged(function: int) -> None:
    assert opened().asks(1, function).answers(1, function, b"\x00").told() == []
    assert opened().asks(1, function).refuses(1, function, 1).told() == []


@pytest.mark.exercises("M-2.1-10")
def test_two_clients_may_use_the_same_transactions() -> None:
    line = opened().link("open", "panel").asks(1).asks(1, 0x02, 1001, name="panel")
    assert line.answers(1, 0x02, name="panel").answers(1).told() == []


def test_an_answer_on_another_connection_is_told_once() -> None:
    line = opened().link("open", "panel").asks(1).answers(1, name="panel").asks(2).answers(2)
    assert line.link("close").told() == [(3, "modbus.unasked")]


# How many are served.


@pytest.mark.exercises("M-2.1-11")
def test_as_many_connections_as_may_be_served_are_none_too_many() -> None:
    line = opened(max_clients=2).link("open", "panel").asks(1, name="panel").answers(1, name="panel")
    assert line.asks(1).answers(1).told() == []


@pytest.mark.exercises("M-2.1-11")
def test_a_client_that_is_connected_and_not_served_is_none_too_many() -> None:
    assert opened(max_clients=1).link("open", "panel").asks(1, name="panel").asks(1).answers(1).told() == []


@pytest.mark.exercises("M-2.1-13")
def test_a_client_may_wait_until_another_one_has_left() -> None:
    line = opened(max_clients=1).link("open", "panel").asks(1, name="panel").asks(1).answers(1)
    assert line.link("close").answers(1, name="panel").told() == []


@pytest.mark.exercises("M-2.1-13")
def test_two_clients_may_wait_until_another_one_has_left() -> None:
    line = opened(max_clients=1).link("open", "panel").link("open", "third").asks(1, name="panel")
    line.link("close").answers(1, name="panel")
    assert line.told() == []
    line.asks(1, name="third").answers(1, name="third").asks(2, name="panel").answers(2, name="panel")
    assert line.told() == [(2, "modbus.too-many")]


@pytest.mark.exercises("M-2.1-13")
def test_a_client_whose_leaving_is_recorded_late_may_have_left_before() -> None:
    line = opened(max_clients=1).asks(1).answers(1).link("open", "panel").asks(1, name="panel")
    assert line.answers(1, name="panel").link("close").asks(2, name="panel").told() == []


# Recordings.


def test_the_text_as_written_refuses_nothing(tmp_path: Path) -> None:
    path = tmp_path / "one.mcap"
    with TraceWriter(path) as writer:
        writer.add(1, Channel.modbus("robot4", "c1", "client"), adu(1, b"\x01\xff\xf0\x00\x08"))
        writer.add(2, Channel.modbus("robot4", "c1", "server"), adu(1, b"\x01\x01\x00"))
    told = {v: audit_traces([path], profile=None, model=None, variant=v) for v in ("as-written", "repaired")}
    assert [[f.rule for f in told[v].findings] for v in told] == [[], ["access.beyond"]]


def test_two_servers_in_one_recording_are_told_apart(tmp_path: Path) -> None:
    path = tmp_path / "two.mcap"
    with TraceWriter(path) as writer:
        for n, name in enumerate(("robot4", "robot5")):
            event = {"connection": "line", "event": "open", "role": "modbus"}
            writer.add(1000 * n, Channel.link(name), json.dumps(event).encode())
        ask = adu(1, struct.pack(">BHH", 0x02, 2001, 8))
        writer.add(3000, Channel.modbus("robot4", "line", "client"), ask)
        writer.add(4000, Channel.modbus("robot5", "line", "server"), adu(1, b"\x02\x01\x05"))
        writer.add(5000, Channel.modbus("robot4", "line", "server"), adu(1, b"\x02\x01\x05"))
    audit = audit_traces([path], profile=None, model=None)
    assert [(f.vmd, f.index, f.rule) for f in audit.findings] == [
        ("robot5", 3, "modbus.unasked"),
        ("robot4", 4, "access.not-inputs"),
    ]
