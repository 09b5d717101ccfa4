"""One association: requests and answers find each other, and what Initiate agreed is kept."""

from __future__ import annotations

from string import Formatter

import pytest
from associations import OFFERED, association, reject, rules

from mmsverify.audit.exchange import Association
from mmsverify.audit.rules import RULES, Breach
from mmsverify.formats.mms import Pdu
from mmsverify.samples.pdus import failure, initiation, request, response


def test_an_answer_finds_its_request() -> None:
    made = association()
    asked, breaches = made.request(4, "client", request(1, "status", False))
    assert breaches == []
    assert made.answer("server", response(1, "status")) == (asked, [])


def test_both_sides_may_use_the_same_invoke_id() -> None:
    made = association()
    made.request(0, "client", request(1, "status", False))
    _, breaches = made.request(1, "server", request(1, "downloadSegment", "D"))
    assert breaches == []
    found, _ = made.answer("client", response(1, "downloadSegment"))
    assert found is not None
    assert found.index == 1


def test_an_invoke_id_is_free_again_once_it_is_answered() -> None:
    made = association()
    made.request(0, "client", request(1, "status", False))
    made.answer("server", failure(1, ("service", "object-state-conflict")))
    assert made.request(2, "client", request(1, "status", False))[1] == []


def test_an_invoke_id_in_use_is_a_breach_that_points_to_the_first_request() -> None:
    made = association()
    made.request(3, "client", request(1, "status", False))
    _, (breach,) = made.request(5, "client", request(1, "read", {}))
    assert (breach.rule, breach.related) == ("protocol.invoke-id-reused", (3,))


def test_one_request_too_many_is_told_once() -> None:
    made = association(outstanding=1)
    told = [rules(made.request(n, "client", request(n, "status", False))[1]) for n in range(3)]
    assert told == [[], ["protocol.too-many-outstanding"], []]


def test_a_lost_answer_is_told_once_as_a_request_too_many() -> None:
    made = association(outstanding=1)
    made.request(0, "client", request(1, "status", False))
    told = []
    for n in range(1, 5):
        told += rules(made.request(n, "client", request(n + 1, "status", False))[1])
        made.answer("server", response(n + 1, "status"))
    assert told == ["protocol.too-many-outstanding"]


def test_slots_are_free_again() -> None:
    made = association()
    first, _ = made.request(0, "client", request(1, "status", False))
    second, _ = made.request(1, "client", request(2, "status", False))
    made.answer("server", response(1, "status"))
    third, _ = made.request(3, "client", request(3, "status", False))
    assert first.slot == third.slot != second.slot


def test_an_answer_to_another_service_is_a_breach() -> None:
    made = association()
    made.request(0, "client", request(1, "status", False))
    assert rules(made.answer("server", response(1, "start"))[1]) == ["protocol.other-service"]


def test_an_answer_that_nobody_asked_is_a_breach() -> None:
    assert rules(association().answer("server", response(7, "status"))[1]) == ["protocol.unasked"]


def test_a_recording_that_begins_in_mid_operation_may_show_answers_without_requests() -> None:
    assert Association("a1").answer("server", response(7, "status")) == (None, [])


def test_after_a_gap_an_answer_may_be_to_a_request_that_was_lost() -> None:
    made = association()
    asked, _ = made.request(0, "client", request(1, "status", False))
    assert made.gap() == [asked]
    assert made.answer("server", response(1, "status")) == (None, [])


def test_a_reset_ends_everything_that_was_agreed() -> None:
    made = association("status", outstanding=1)
    asked, _ = made.request(0, "client", request(1, "status", False))
    assert made.end() == [asked]
    assert all(made.request(n, "client", request(n, "start", {}))[1] == [] for n in range(3))


def test_a_positive_answer_to_a_service_that_was_not_listed_is_a_breach() -> None:
    made = association("status")
    made.request(0, "client", request(1, "kill", {}))
    assert rules(made.answer("server", response(1, "kill"))[1]) == ["negotiation.service"]


@pytest.mark.exercises("R-7.5.1.4-5", "R-7.5.2.4-2")
def test_a_service_that_was_not_listed_is_rejected_as_unrecognized() -> None:
    made = association("status")
    made.request(2, "client", request(2, "kill", {}))
    assert made.answer("server", reject(2))[1] == []


@pytest.mark.exercises("R-7.5.1.4-5", "R-7.5.2.4-2")
def test_another_refusal_of_a_service_that_was_not_listed_is_worth_a_note() -> None:
    made = association("status")
    made.request(0, "client", request(1, "kill", {}))
    made.request(1, "client", request(2, "kill", {}))
    told = made.answer("server", failure(1, ("access", "object-non-existent")))[1]
    told += made.answer("server", reject(2, 4))[1]
    assert rules(told) == ["negotiation.refused", "negotiation.reject-reason"]
    assert {RULES[breach.rule].severity for breach in told} == {"note"}


def test_additional_services_have_a_list_of_their_own() -> None:
    made = association()
    made.request(0, "client", request(1, "select", {}))
    assert made.answer("server", response(1, "select"))[1] == []
    made.request(2, "client", request(2, "vMDStop"))
    assert rules(made.answer("server", response(2, "vMDStop"))[1]) == ["negotiation.additional"]


def test_a_listed_service_must_not_be_rejected_as_unknown() -> None:
    made = association()
    made.request(0, "client", request(1, "status", False))
    assert rules(made.answer("server", reject(1))[1]) == ["negotiation.rejected"]


def test_negotiation_only_reduces() -> None:
    made = Association("a1")
    made.propose(initiation("Request", OFFERED, (), 1))
    assert rules(made.agree(initiation("Response", OFFERED, (), 2))) == ["negotiation.outstanding"] * 2


def test_the_version_lies_between_one_and_the_proposed_one() -> None:
    made = Association("a1")
    made.propose(initiation("Request", OFFERED, ()))
    answer = initiation("Response", OFFERED, ())
    answer.body["initResponseDetail"]["negotiatedVersionNumber"] = 2
    assert rules(made.agree(answer)) == ["negotiation.version"]


# Cancel.

CANCEL_UNKNOWN, CANCEL_IMPOSSIBLE = 1, 2


def cancelled(made: Association, *steps: str | tuple[str, int]) -> list[str]:
    """What is said of a conversation about invokeID 1: the client asks and cancels, the robot answers."""
    told: list[Breach] = []
    for index, step in enumerate(steps):
        match step:
            case "ask":
                told += made.request(index, "client", request(1, "status", False))[1]
            case "answer":
                told += made.answer("server", response(1, "status"))[1]
            case "error":
                told += made.answer("server", failure(1, ("service", "object-state-conflict")))[1]
            case "cancel":
                told += made.cancel(index, "client", Pdu("cancel-RequestPDU", 1))
            case "granted":
                told += made.cancel(index, "server", Pdu("cancel-ResponsePDU", 1))
            case (_, code):
                body = {"serviceError": {"errorClass": ("cancel", code)}}
                told += made.cancel(index, "server", Pdu("cancel-ErrorPDU", 1, body=body))
    return rules(told)


REFUSED, UNKNOWN = ("refused", CANCEL_IMPOSSIBLE), ("refused", CANCEL_UNKNOWN)


@pytest.mark.exercises("R-9.2.2.2.1-1")
@pytest.mark.parametrize(
    "steps",
    [
        ("ask", "cancel", "granted", "error"),
        ("ask", "cancel", "error", "granted"),
        ("ask", "cancel", REFUSED, "answer"),
        ("ask", "cancel", "answer", UNKNOWN),
        ("ask", "answer", "cancel", UNKNOWN),
        ("ask", "cancel", "granted", "error", "ask", "answer"),
    ],
)
def test_a_cancel_that_is_answered_truly_is_no_breach(steps: tuple[str, ...]) -> None:
    assert cancelled(association(), *steps) == []


@pytest.mark.exercises("R-9.2.2.2.1-1")
@pytest.mark.parametrize(
    ("steps", "rule"),
    [
        (("ask", "cancel", "granted", "answer"), "cancel.performed"),
        (("ask", "cancel", "answer", "granted"), "cancel.performed"),
        (("cancel", "granted"), "cancel.unknown"),
        (("ask", "answer", "cancel", "granted"), "cancel.unknown"),
        (("ask", "cancel", UNKNOWN, "answer"), "cancel.known"),
        (("ask", "granted", "answer"), "cancel.unasked"),
        (("ask", REFUSED, "answer"), "cancel.unasked"),
    ],
)
def test_a_cancel_that_is_answered_falsely_is_a_breach(steps: tuple[str, ...], rule: str) -> None:
    assert cancelled(association(), *steps) == [rule]


def test_what_a_recording_may_lack_is_not_missed() -> None:
    assert cancelled(Association("a1"), "cancel", "granted") == []
    assert cancelled(Association("a1"), "granted", REFUSED) == []


@pytest.mark.exercises("R-7.5.2.4-2")
@pytest.mark.parametrize(("services", "said"), [(("status", "cancel"), 1), (("status",), 0)])
def test_a_cancel_that_is_listed_is_not_an_unknown_pdu(services: tuple[str, ...], said: int) -> None:
    made = association(*services)
    assert cancelled(made, "ask", "cancel") == []
    unknown = Pdu("rejectPDU", None, body={"rejectReason": ("pdu-error", 0)})
    assert rules(made.answer("server", unknown)[1]) == ["negotiation.rejected"] * said


# Beginning and end.


def admitted(made: Association, side: str, kind: str = "confirmed-RequestPDU") -> list[str]:
    return rules(list(made.admit(side, Pdu(kind, 9, "status"))))


@pytest.mark.exercises("R-9.2.1-1")
def test_nothing_is_asked_before_initiate_is_answered() -> None:
    made = Association("a1")
    assert admitted(made, "client") == []
    made.propose(initiation("Request", OFFERED, ()))
    assert [admitted(made, "client"), admitted(made, "client")] == [["protocol.no-association"], []]
    made.propose(initiation("Request", OFFERED, ()))
    made.refuse()
    assert admitted(made, "client") == ["protocol.no-association"]
    assert admitted(association(), "client") == []


@pytest.mark.exercises("R-9.2.1-1")
def test_who_concludes_asks_for_nothing_more() -> None:
    made = association()
    assert list(made.conclude("client", Pdu("conclude-RequestPDU"))) == []
    assert admitted(made, "server") == []
    assert admitted(made, "client", "confirmed-ResponsePDU") == []
    assert admitted(made, "client") == ["protocol.after-conclude-request"]


def test_a_refused_conclude_changes_nothing() -> None:
    made = association()
    steps = [("client", "conclude-RequestPDU"), ("server", "conclude-ErrorPDU")]
    assert [list(made.conclude(side, Pdu(kind, body={}))) for side, kind in steps] == [[], []]
    assert admitted(made, "client") == []


@pytest.mark.exercises("R-9.2.1-1")
@pytest.mark.parametrize("kind", ["conclude-ResponsePDU", "conclude-ErrorPDU"])
def test_a_conclude_that_nobody_asked_is_not_answered(kind: str) -> None:
    assert rules(list(association().conclude("server", Pdu(kind)))) == ["protocol.conclude-unasked"]
    made = association()
    list(made.conclude("server", Pdu("conclude-RequestPDU")))
    assert rules(list(made.conclude("server", Pdu(kind)))) == ["protocol.conclude-unasked"]
    assert list(Association("a1").conclude("server", Pdu(kind))) == []


def test_a_conclude_leaves_no_request_unanswered() -> None:
    made = association()
    made.request(0, "client", request(1, "status", False))
    list(made.conclude("client", Pdu("conclude-RequestPDU")))
    assert rules(list(made.conclude("server", Pdu("conclude-ResponsePDU")))) == ["protocol.unanswered"]
    assert [asked.index for asked in made.concluded()] == [0]
    assert admitted(made, "client") == ["protocol.after-conclude"]


def test_what_a_rule_expects_is_said_in_the_words_of_its_sentence() -> None:
    """Each rule can be told: its expectations need no word that its sentence does not have."""

    def slots(text: str) -> set[str]:
        return {name for _, name, _, _ in Formatter().parse(text) if name}

    for rule in RULES.values():
        for each in (*rule.expects, rule.observed):
            assert slots(each) <= slots(rule.says), rule.id
