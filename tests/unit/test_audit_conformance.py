"""The base class of robots: what a robot lists and agrees to at Initiate, and what it must not reject."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest

from mmsverify.audit.conformance import BASE_CLASS, REQUIRED, SECONDARY_STORAGE, Conformance
from mmsverify.audit.negotiation import negotiated
from mmsverify.audit.rules import Breach
from mmsverify.formats.mms import Pdu
from mmsverify.samples.pdus import initiation, request

LOADING = ("initiateDownloadSequence", "initiateUploadSequence", "uploadSegment", "terminateUploadSequence")
WHOLE = (*sorted(REQUIRED - {"select"}), *LOADING)
SINGLE = {service: clause for requirement in BASE_CLASS.values() if len(requirement.alternatives) == 1
          for service in requirement.alternatives[0] for clause in requirement.clause.ids}  # fmt: skip


def initiated(services: Sequence[str], additional: Sequence[str] = ("select",)) -> list[Breach]:
    proposal, answer = initiation("Request", (), ()), initiation("Response", services, additional)
    return list(Conformance().initiated(proposal.body, answer.body))


def ids(breach: Breach) -> tuple[str, ...]:
    return breach.clause.ids if breach.clause else ()


def rules(breaches: list[Breach]) -> list[str]:
    return [breach.rule for breach in breaches]


def test_no_service_of_the_base_class_is_forgotten() -> None:
    assert {
        "identify", "conclude", "cancel", "status", "getDomainAttributes", "deleteDomain",
        "createProgramInvocation", "deleteProgramInvocation", "start", "stop", "resume", "reset",
        "getProgramInvocationAttributes", "read", "write", "select",
    } == REQUIRED  # fmt: skip


def test_a_robot_that_lists_the_base_class_lacks_nothing() -> None:
    assert initiated(WHOLE) == []


@pytest.mark.exercises(every="requirement of the base class")
@pytest.mark.parametrize("service", sorted(SINGLE))
def test_each_service_of_the_base_class_is_missed(service: str) -> None:
    left = [name for name in WHOLE if name != service]
    (breach,) = initiated(left, () if service == "select" else ("select",))
    assert (breach.rule, ids(breach)) == ("conformance.services", (SINGLE[service],))


def test_all_that_is_missing_is_told_at_once() -> None:
    (breach,) = initiated(("identify", "conclude"), ())
    assert len(breach.words["missing"].split(", ")) > 8
    assert {"R-9.2.2.2.1-1", "R-9.2.2.2.1-8", "R-9.2.2.2.1-9"} <= set(ids(breach))


@pytest.mark.exercises("R-9.2.2.2.1-9", "R-9.2.2.2.2.1-1", "R-9.2.2.2.2.1-2", "R-9.2.2.2.2.2-1", "R-9.1-1")
def test_a_robot_loads_over_the_network_or_from_secondary_storage() -> None:
    bare = [name for name in WHOLE if name not in LOADING]
    assert initiated([*bare, *SECONDARY_STORAGE]) == []
    (neither,) = initiated([*bare, "loadDomainContent"])
    (down_only,) = initiated([*bare, "initiateDownloadSequence"])
    assert "R-9.2.2.2.2.1-1" in ids(neither)
    assert "R-9.2.2.2.2.1-2" in ids(neither)
    assert "R-9.2.2.2.2.1-1" not in ids(down_only)
    assert "R-9.2.2.2.2.1-2" in ids(down_only)


def test_who_has_not_agreed_on_the_robot_standard_is_no_robot() -> None:
    answer = initiation("Response", (), ())
    del answer.body["initResponseDetail"]["additionalSupportedCalled"]
    assert list(Conformance().initiated(None, answer.body)) == []


def test_a_robot_is_told_once_what_it_lacks() -> None:
    robot = Conformance()
    answer = initiation("Response", WHOLE, ()).body
    assert [rules(list(robot.initiated(None, answer))) for _ in range(2)] == [["conformance.services"], []]


PARAMETERS = [
    ("111", "111", 2, 2, ""),
    ("111", "101", 2, 2, "str2"),
    ("101", "101", 2, 2, ""),
    ("111", "000", 2, 2, "str1, str2, vnam"),
    ("111", "111", 5, 1, "NEST = 2"),
    ("111", "111", 1, 1, ""),
    ("111", "111", 2, None, ""),
    ("111", "111", None, 1, ""),
]


@pytest.mark.exercises("R-9.2.2.3-1")
@pytest.mark.parametrize(("proposed", "agreed", "deep", "level", "missing"), PARAMETERS)
def test_a_robot_agrees_to_the_parameters_of_the_base_class(
    proposed: str, agreed: str, deep: int | None, level: int | None, missing: str
) -> None:
    ask, answer = initiation("Request", (), ()).body, initiation("Response", WHOLE, ("select",)).body
    ask["initRequestDetail"]["proposedParameterCBB"] = proposed
    answer["initResponseDetail"]["negotiatedParameterCBB"] = agreed
    if deep is not None:
        ask["proposedDataStructureNestingLevel"] = deep
    if level is not None:
        answer["negotiatedDataStructureNestingLevel"] = level
    told = [(breach.rule, breach.words["missing"]) for breach in Conformance().initiated(ask, answer)]
    assert told == ([("conformance.parameters", missing)] if missing else [])
    assert list(Conformance().initiated(None, answer)) == []


@pytest.mark.exercises("R-9.2.2.2.2.2-2")
@pytest.mark.parametrize(
    ("loading", "proposed", "agreed", "said"),
    [
        (SECONDARY_STORAGE, 7, 7, 0),
        (SECONDARY_STORAGE, 7, 6, 1),
        (SECONDARY_STORAGE, 6, 6, 0),
        (LOADING, 7, 6, 0),
    ],
)
def test_with_secondary_storage_a_robot_should_agree_to_third_parties(
    loading: Sequence[str], proposed: int, agreed: int, said: int
) -> None:
    services = [name for name in WHOLE if name not in LOADING]
    ask = initiation("Request", (), ()).body
    answer = initiation("Response", [*services, *loading], ("select",)).body
    ask["initRequestDetail"]["proposedParameterCBB"] = "1" * proposed
    answer["initResponseDetail"]["negotiatedParameterCBB"] = "1" * agreed
    assert rules(list(Conformance().initiated(ask, answer))) == ["conformance.third-party"] * said


def rejection(service: str, reason: Any, *, listed: bool = False) -> list[Breach]:
    agreed = negotiated(initiation("Response", WHOLE, ("select",)).body, None) if listed else None
    pdu = Pdu("rejectPDU", 1, body={"rejectReason": reason})
    return list(Conformance().rejected(agreed, request(1, service), pdu))


@pytest.mark.exercises("R-9.2.2.2.1-2", "R-7.5.2.4-2")
def test_no_robot_rejects_a_service_of_the_base_class_as_unknown() -> None:
    (breach,) = rejection("status", ("confirmed-request", 1))
    assert (breach.rule, ids(breach)) == ("conformance.rejected", ("R-9.2.2.2.1-2",))
    assert rejection("status", ("confirmed-request", 4)) == []
    assert rejection("kill", ("confirmed-request", 1)) == []


def test_what_was_listed_is_judged_by_that() -> None:
    assert rejection("status", ("confirmed-request", 1), listed=True) == []
