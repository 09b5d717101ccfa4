"""The model of the server of signals: what is proved of it, what the text itself breaks, and how soon."""

from __future__ import annotations

from functools import cache

import pytest

from mmsverify.checking import check_models
from mmsverify.formats.modbus import Function
from mmsverify.model import load
from mmsverify.model.rows import MINUS
from mmsverify.model.sorts import EnumSort
from mmsverify.resources import models_dir
from mmsverify.results import Verdict

BROKEN_AS_WRITTEN = {"nothing-is-touched": 1, "never-stopped": 1, "no-call-is-abnormal": 6}
"""By property, the steps of the shortest run that breaks it."""

REFUSING = (
    "request.unsound", "access.beyond", "access.not-inputs", "access.not-coils", "access.not-registers",
    "access.dedicated",
)  # fmt: skip


@cache
def verdicts(variant: str) -> dict[str, Verdict]:
    (check,) = check_models(["modbus-signals"], variant=variant)
    return {verdict.name: verdict for verdict in check.verdicts}


def test_every_property_of_the_repaired_reading_is_proved() -> None:
    assert {v.result for v in verdicts("repaired").values()} == {"proved"}


def test_the_rules_of_the_repaired_reading_hold_for_any_number_of_sockets_and_clients() -> None:
    rules = {name: v for name, v in verdicts("repaired").items() if v.kind != "sometimes"}
    assert {(v.method, v.scope) for v in rules.values()} == {("induction", "any number of Socket, Client")}


@pytest.mark.exercises("M-2.1-10")
def test_two_clients_are_served_at_once_after_five_steps() -> None:
    assert verdicts("repaired")["several"].depth == 5


def test_the_text_as_it_stands_breaks_exactly_these_properties() -> None:
    broken = {name: v.depth for name, v in verdicts("as-written").items() if v.result != "proved"}
    assert broken == BROKEN_AS_WRITTEN


@pytest.mark.exercises("M-2-S4a", "M-2.1-8", "M-2.1-9")
def test_as_written_the_robot_stops_when_a_client_leaves_before_its_answer() -> None:
    run = verdicts("as-written")["no-call-is-abnormal"].counterexample
    assert run is not None
    calls = "listens", "connects", "accepts", "receives", "disconnects", "answers"
    assert [step.action.partition("(")[0] for step in run[1:]] == list(calls)


def test_the_refusing_steps_are_these_in_their_order() -> None:
    model = load("modbus-signals", models_dir(), "repaired")
    steps = [row.guard[-1].rule for row in model.actions if row.answer == MINUS]
    assert tuple(steps) == REFUSING


def test_as_written_no_request_is_refused() -> None:
    model = load("modbus-signals", models_dir(), "as-written")
    assert [row.name for row in model.actions if row.answer == MINUS] == []


def test_the_model_and_the_format_know_the_same_function_codes() -> None:
    model = load("modbus-signals", models_dir(), "repaired")
    row = next(row for row in model.actions if row.answer == MINUS)
    sort = next(p.of for p in row.on.parameters if p.name == "function")
    assert isinstance(sort, EnumSort)
    assert [str(member.value) for member in sort.members] == [f"0x{code:02X}" for code in Function]
