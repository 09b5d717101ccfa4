"""What Initiate agrees: versions, parameters, services, the robot standard; and why services are rejected."""

from __future__ import annotations

import pytest
from associations import OFFERED, association, reject, rules

from mmsverify.audit.exchange import Association
from mmsverify.formats.mms import Pdu
from mmsverify.samples.pdus import initiation, request, response


@pytest.mark.exercises("R-7.5.2.1-1")
def test_a_version_below_one_is_none_even_where_the_request_was_not_recorded() -> None:
    made = Association("a1")
    answer = initiation("Response", OFFERED, ())
    answer.body["initResponseDetail"]["negotiatedVersionNumber"] = 0
    assert rules(made.agree(answer)) == ["negotiation.version"]


@pytest.mark.exercises("R-7.5.1.1-1", "R-7.5.1.1-2")
@pytest.mark.parametrize(("version", "said"), [(0, 1), (1, 0), (3, 0)])
def test_a_proposed_version_leaves_one_to_agree_upon(version: int, said: int) -> None:
    proposal = initiation("Request", OFFERED, ())
    proposal.body["initRequestDetail"]["proposedVersionNumber"] = version
    assert rules(Association("a1").propose(proposal)) == ["negotiation.proposed-version"] * said


@pytest.mark.exercises("R-7.5.2.2-1", "R-7.5.1.2-1")
@pytest.mark.parametrize(("given", "said"), [("101", 0), ("001", 0), ("111", 1)])
def test_only_proposed_parameters_are_negotiated(given: str, said: int) -> None:
    made = Association("a1")
    made.propose(initiation("Request", OFFERED, ()))
    answer = initiation("Response", OFFERED, ())
    answer.body["initResponseDetail"]["negotiatedParameterCBB"] = given
    assert rules(made.agree(answer)) == ["negotiation.parameters"] * said


@pytest.mark.parametrize(("wanted", "given", "said"), [(3, 2, 0), (2, 3, 1), (None, 3, 0), (3, None, 0)])
def test_the_nesting_level_is_only_reduced(wanted: int | None, given: int | None, said: int) -> None:
    made = Association("a1")
    proposal, answer = initiation("Request", OFFERED, ()), initiation("Response", OFFERED, ())
    if wanted is not None:
        proposal.body["proposedDataStructureNestingLevel"] = wanted
    if given is not None:
        answer.body["negotiatedDataStructureNestingLevel"] = given
    made.propose(proposal)
    assert rules(made.agree(answer)) == ["negotiation.nesting"] * said


@pytest.mark.exercises("R-7.5.1.4-1")
def test_bits_beyond_those_of_the_robot_standard_mean_nothing() -> None:
    made = Association("a1")
    made.propose(initiation("Request", OFFERED, ()))
    answer = initiation("Response", OFFERED, ())
    answer.body["initResponseDetail"]["additionalSupportedCalled"] = "0010" + "1" * 40
    assert made.agree(answer) == []
    made.request(0, "client", request(1, "select", {}))
    assert made.answer("server", response(1, "select"))[1] == []
    made.request(2, "client", request(2, "alterPI", {}))
    assert rules(made.answer("server", response(2, "alterPI"))[1]) == ["negotiation.additional"]


# The robot standard is agreed on or not.


def initiated(*, proposed: bool, agreed: bool, octets: int = 11) -> tuple[Association, list[str]]:
    """An association of which the two messages of Initiate carry the robot's part, or not."""
    made = Association("a1")
    proposal, answer = initiation("Request", OFFERED, ()), initiation("Response", OFFERED, ())
    for word, sort, kept in (("Calling", "Request", proposed), ("Called", "Response", agreed)):
        pdu = proposal if word == "Calling" else answer
        if not kept:
            del pdu.body[f"init{sort}Detail"][f"additionalSupported{word}"]
    answer.body["initResponseDetail"]["negotiatedParameterCBB"] = "1".ljust(octets, "0")
    made.propose(proposal)
    return made, rules(made.agree(answer))


@pytest.mark.exercises("R-7.5.1-1", "R-7.5.2-1")
def test_what_was_not_proposed_is_not_agreed() -> None:
    assert initiated(proposed=False, agreed=True)[1] == ["negotiation.syntax"]
    assert [initiated(proposed=p, agreed=a)[1] for p, a in ((True, True), (True, False))] == [[], []]


@pytest.mark.exercises("R-7.5.2-1", "R-7.3.1-2")
def test_the_robot_syntax_is_used_only_where_it_was_agreed_on() -> None:
    made, _ = initiated(proposed=True, agreed=False)
    asked = [request(1, "status", False), request(2, "select", {}), request(3, "select", {})]
    assert [rules(list(made.robot_syntax(pdu))) for pdu in asked] == [[], ["negotiation.unagreed"], []]
    made, _ = initiated(proposed=True, agreed=True)
    assert [rules(list(made.robot_syntax(pdu))) for pdu in asked] == [[], [], []]
    started = request(1, "start", {"programInvocationName": "A"}, ("controlling", {}))
    made, _ = initiated(proposed=False, agreed=False)
    assert rules(list(made.robot_syntax(started))) == ["negotiation.unagreed"]


@pytest.mark.exercises("R-7.3.2.1-3", "R-7.3.3.9.3-1")
@pytest.mark.parametrize("service", ["status", "getProgramInvocationAttributes"])
def test_an_answer_has_its_robot_part_where_the_robot_standard_was_agreed_on(service: str) -> None:
    bare, whole = response(1, service, {}), response(1, service, {}, {"errorCode": 0})
    for pdu, said in ((bare, ["negotiation.no-detail"]), (whole, [])):
        assert rules(list(initiated(proposed=True, agreed=True)[0].robot_syntax(pdu))) == said
    for made, _ in (initiated(proposed=True, agreed=False), initiated(proposed=True, agreed=True, octets=18)):
        assert list(made.robot_syntax(bare)) == []


# Rejects.


@pytest.mark.exercises("R-7.5.1.4-4", "R-7.5.2.4-2", "R-7.5.1.4-3")
@pytest.mark.parametrize(
    ("reason", "rule"),
    [
        (0, None),
        (1, "negotiation.rejected"),
        (2, "negotiation.reject-unfounded"),
        (3, "negotiation.reject-unfounded"),
        (4, None),
        (5, "negotiation.reject-unfounded"),
        (6, "negotiation.reject-unfounded"),
        (8, None),
        (9, None),
    ],
)
def test_a_listed_service_is_rejected_only_for_protocol_errors(reason: int, rule: str | None) -> None:
    made = association()
    made.request(0, "client", request(1, "status", False))
    assert rules(made.answer("server", reject(1, reason))[1]) == ([rule] if rule else [])


@pytest.mark.exercises("R-7.5.1.4-4")
def test_a_protocol_error_that_there_was_may_be_the_reason() -> None:
    made = association(outstanding=1)
    made.request(0, "client", request(1, "status", False))
    made.request(1, "client", request(2, "status", False))
    assert made.answer("server", reject(2, 6))[1] == []
    made.request(2, "client", request(1, "read", {}))
    assert made.answer("server", reject(1, 3))[1] == []
    attached = Pdu("confirmed-RequestPDU", 4, "status", False, modifiers=(("attach-To-Semaphore", {}),))
    made.request(3, "client", attached)
    assert made.answer("server", reject(4, 2))[1] == []


def test_after_a_gap_nobody_knows_what_was_outstanding() -> None:
    made = association()
    made.gap()
    made.request(0, "client", request(1, "status", False))
    made.request(1, "client", request(2, "status", False))
    assert made.answer("server", reject(1, 6))[1] == []
    assert made.answer("server", reject(2, 3))[1] == []


def test_the_reject_of_an_answer_answers_no_request() -> None:
    made = association()
    asked, _ = made.request(0, "server", request(1, "downloadSegment", "D"))
    assert made.answer("client", reject(1, 3, "confirmed-response")) == (None, [])
    assert made.answer("client", response(1, "downloadSegment"))[0] == asked
