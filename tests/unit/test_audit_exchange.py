"""One association: requests and answers find each other, and what Initiate agreed is kept."""

from __future__ import annotations

from mmsverify.audit.exchange import Association
from mmsverify.audit.rules import Breach
from mmsverify.formats.mms import Pdu
from mmsverify.samples.pdus import failure, initiation, request, response

OFFERED = ("status", "start", "read", "downloadSegment")


def association(
    *services: str, outstanding: int = 2, additional: tuple[str, ...] = ("select",)
) -> Association:
    """An association that has been set up, both sides offering these services."""
    made = Association("a1")
    made.propose(initiation("Request", services or OFFERED, additional, outstanding))
    assert made.agree(initiation("Response", services or OFFERED, additional, outstanding)) == []
    return made


def rules(breaches: list[Breach]) -> list[str]:
    return [breach.rule for breach in breaches]


def reject(invoke_id: int) -> Pdu:
    return Pdu("rejectPDU", invoke_id, body={"rejectReason": ("confirmed-request", 1)})


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


def test_a_refusal_of_a_service_that_was_not_listed_is_none() -> None:
    made = association("status")
    made.request(0, "client", request(1, "kill", {}))
    assert made.answer("server", failure(1, ("access", "object-non-existent")))[1] == []
    made.request(2, "client", request(2, "kill", {}))
    assert made.answer("server", reject(2))[1] == []


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
