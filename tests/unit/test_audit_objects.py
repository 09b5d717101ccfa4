"""The standardized objects: answers that show them as the standard fixes them, and answers that do not."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from mmsverify.audit.objects import OBJECTS, Fixed, Objects
from mmsverify.audit.rules import RULES, Breach
from mmsverify.audit.variables import VARIABLES
from mmsverify.formats.mms import Pdu, decode, encode
from mmsverify.samples import pdus
from mmsverify.samples.pdus import of_domain, request, response, vmd

DOMAIN = {"listOfCapabilities": [], "state": 2, "mmsDeletable": False, "uploadInProgress": 0}
CONDITION = {"mmsDeletable": False, "class": 1, "priority": 64, "severity": 64, "alarmSummaryReports": False}
ACTION = {"mmsDeletable": False, "listOfModifier": []}
SEMAPHORE = {
    "mmsDeletable": False, "class": 0, "numberOfTokens": 1, "numberOfOwnedTokens": 1, "numberOfHungTokens": 0,
}  # fmt: skip
SINGLE = ("floating-point", {"format-width": 32, "exponent-width": 8})
POSITION = ("array", {"packed": False, "numberOfElements": 3, "elementType": SINGLE})
R_STC, R_ARM = ("status", False), ("getProgramInvocationAttributes", "R_ARM")


def conforming(fixed: Fixed) -> tuple[Any, Any]:
    """Request and response of the service that shows the attribute, as the standard wants them."""
    match fixed.service:
        case "getDomainAttributes":
            shares = {"sharable": fixed.name == "R_ARM", "listOfProgramInvocations": [fixed.name]}
            return fixed.name, DOMAIN | shares
        case "getProgramInvocationAttributes":
            return fixed.name, pdus.attributes("idle", [fixed.name], deletable=False)
        case "reportSemaphoreStatus":
            return vmd(fixed.name), SEMAPHORE
        case "getEventConditionAttributes":
            return vmd(fixed.name), CONDITION
        case "reportEventConditionStatus":
            return vmd(fixed.name), {"currentState": 2, "numberOfEventEnrollments": 1, "enabled": True}
        case "getEventActionAttributes":
            return vmd(fixed.name), ACTION | {
                "confirmedServiceRequest": R_STC if "S" in fixed.name else R_ARM
            }
        case "getNamedTypeAttributes":
            return vmd(fixed.name), {"mmsDeletable": False, "typeSpecification": ("typeName", vmd("T"))}
    scope = of_domain("R_ARM", fixed.name) if fixed.name in IN_DOMAINS else vmd(fixed.name)
    return ("name", scope), {"mmsDeletable": False, "typeSpecification": ("typeName", vmd("T"))}


IN_DOMAINS = {"R_DPWR", "R_DCAL", "R_DLOCAL", "R_NJ", "R_JT", "R_JCAL", "R_JBK", "R_JBD", "R_AJV"}
OTHER: dict[str, Any] = {
    "mmsDeletable": True, "listOfProgramInvocations": ["OTHER"], "listOfDomainNames": ["OTHER"], "class": 3,
    "numberOfTokens": 2, "severity": 1, "priority": 1, "alarmSummaryReports": True, "enabled": False,
    "listOfModifier": [("attach-To-Semaphore", {"semaphoreName": vmd("S")})],
    "confirmedServiceRequest": ("identify", None),
}  # fmt: skip
SHOWN = {key: fixed for key, fixed in OBJECTS.items() if fixed.service != "eventNotification"}


def judged(service: str, asked: Any, given: Any, objects: Objects | None = None) -> list[Breach]:
    """The breaches of one question and its answer, as they come from the wire."""
    question, answer = (
        decode(encode(pdu)) for pdu in (request(1, service, asked), response(1, service, given))
    )
    return list((objects or Objects()).answered(question, answer))


def rules(breaches: list[Breach]) -> list[str]:
    return [breach.rule for breach in breaches]


@pytest.mark.parametrize("key", SHOWN)
def test_an_object_as_the_standard_fixes_it_is_no_breach(key: str) -> None:
    assert judged(SHOWN[key].service, *conforming(SHOWN[key])) == []


@pytest.mark.exercises(every="standard object")
@pytest.mark.parametrize("key", SHOWN)
def test_another_value_of_a_fixed_attribute_breaks_its_clause(key: str) -> None:
    fixed = SHOWN[key]
    asked, given = conforming(fixed)
    other = not fixed.value if isinstance(fixed.value, bool) else OTHER[fixed.field]
    (breach,) = judged(fixed.service, asked, given | {fixed.field: other})
    assert breach.clause == fixed.clause
    assert breach.rule == (
        "object.initial" if fixed.initial else "object.member" if fixed.member else "object.attribute"
    )
    assert RULES[breach.rule].severity == ("note" if fixed.initial else "error")
    assert RULES[breach.rule].says.format(**breach.words)


def test_an_object_of_another_name_is_anybodys() -> None:
    body = DOMAIN | {"mmsDeletable": True, "sharable": False, "listOfProgramInvocations": []}
    assert judged("getDomainAttributes", "WELD", body) == []
    assert judged("reportSemaphoreStatus", vmd("DOOR"), SEMAPHORE | {"numberOfTokens": 3}) == []
    assert judged("getEventConditionAttributes", of_domain("D", "R_RVS"), CONDITION | {"severity": 1}) == []
    given = {"mmsDeletable": True, "typeSpecification": ("boolean", None)}
    assert judged("getVariableAccessAttributes", ("name", vmd("R_DCAL")), given) == []
    assert judged("getVariableAccessAttributes", ("address", ("numericAddress", 4)), given) == []


@pytest.mark.exercises("R-8.2.1-4")
def test_the_arms_domain_may_serve_other_programs_beside_its_own() -> None:
    body = DOMAIN | {"sharable": True, "listOfProgramInvocations": ["WELD", "R_ARM"]}
    assert judged("getDomainAttributes", "R_ARM", body) == []


@pytest.mark.exercises("R-8.7.1-2")
def test_what_a_client_has_altered_is_not_held_against_the_robot() -> None:
    objects = Objects()
    altered = {"eventConditionName": vmd("R_RVS"), "priority": 1}
    assert judged("alterEventConditionMonitoring", altered, None, objects) == []
    assert judged("getEventConditionAttributes", vmd("R_RVS"), CONDITION | {"priority": 1}, objects) == []
    told = judged("getEventConditionAttributes", vmd("R_SIV"), CONDITION | {"priority": 1}, objects)
    assert rules(told) == ["object.initial"]


# Types.


@pytest.mark.exercises("R-8.4.1-1")
def test_a_standardized_type_is_described_as_the_standard_has_it() -> None:
    good, bad = ({"mmsDeletable": False, "typeSpecification": it} for it in (POSITION, SINGLE))
    assert judged("getNamedTypeAttributes", vmd("R_PIS"), good) == []
    (breach,) = judged("getNamedTypeAttributes", vmd("R_PIS"), bad)
    assert (breach.rule, breach.clause and breach.clause.ids[0]) == ("object.type", "R-8.4.1-1")


@pytest.mark.exercises("R-8.5.4.2-1")
def test_a_standardized_variable_is_described_as_the_standard_has_it() -> None:
    good, bad = (
        {"mmsDeletable": False, "typeSpecification": it} for it in (("integer", 8), ("boolean", None))
    )
    asked = ("name", of_domain("R_ARM", "R_DCAL"))
    assert judged("getVariableAccessAttributes", asked, good) == []
    assert rules(judged("getVariableAccessAttributes", asked, bad)) == ["object.type"]


# The semaphore.


@pytest.mark.exercises("R-8.6.1-2", "R-8.6.1-3")
@pytest.mark.parametrize(("owned", "hung", "said"), [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 1), (2, 0, 1)])
def test_one_token_has_one_owner(owned: int, hung: int, said: int) -> None:
    body = SEMAPHORE | {"numberOfOwnedTokens": owned, "numberOfHungTokens": hung}
    assert rules(judged("reportSemaphoreStatus", vmd("R_CTRL"), body)) == ["semaphore.tokens"] * said


@pytest.mark.exercises("R-8.6.1-2", "R-8.6.1-3")
@pytest.mark.parametrize(("state", "entries", "said"), [(1, 1, 0), (1, 2, 1), (0, 2, 0)])
def test_one_entry_owns_while_others_wait(state: int, entries: int, said: int) -> None:
    entry = {"entryClass": 0, "applicationReference": {}, "priority": 64, "relinquishIfConnectionLost": True}
    listed = [{"entryId": bytes([number]), **entry} for number in range(entries)]
    asked = {"semaphoreName": vmd("R_CTRL"), "state": state}
    given = {"listOfSemaphoreEntry": listed, "moreFollows": False}
    assert rules(judged("reportSemaphoreEntryStatus", asked, given)) == ["semaphore.tokens"] * said


# Deleting.

DELETIONS: list[tuple[str, Any, Any, str | None]] = [
    ("deleteDomain", "R_SAFE", None, "R-8.2.3-2"),
    ("deleteDomain", "WELD", None, None),
    ("deleteSemaphore", vmd("R_CTRL"), None, "R-8.6.1-1"),
    ("deleteSemaphore", vmd("DOOR"), None, None),
    ("deleteEventCondition", ("specific", [vmd("R_RVS"), vmd("OWN")]), 0, "R-8.7.1-2"),
    ("deleteEventCondition", ("specific", [vmd("R_RVS"), vmd("OWN")]), 1, None),
    ("deleteEventCondition", ("vmd", None), 4, None),
    ("deleteEventAction", ("specific", [vmd("R_STC")]), 0, "R-8.8.1-1"),
    ("deleteEventAction", ("specific", [vmd("R_STC")]), 1, None),
]


def deletion(service: str, field: str, names: list[Any], deleted: int) -> tuple[str, Any, Any]:
    counts = {"numberMatched": len(names), "numberDeleted": deleted}
    return service, {"scopeOfDelete": 0, field: names}, counts


@pytest.mark.exercises("R-8.2.3-2", "R-8.6.1-1", "R-8.7.1-2", "R-8.8.1-1")
@pytest.mark.parametrize(("service", "asked", "given", "clause"), DELETIONS)
def test_an_object_that_is_not_deletable_is_not_deleted(
    service: str, asked: Any, given: Any, clause: str | None
) -> None:
    told = judged(service, asked, given)
    assert [breach.clause and breach.clause.ids[0] for breach in told] == ([clause] if clause else [])
    assert set(rules(told)) <= {"object.deleted"}


@pytest.mark.exercises("R-8.4.3-1", "R-8.5.3.1-1")
@pytest.mark.parametrize("service", ["deleteNamedType", "deleteVariableAccess"])
@pytest.mark.parametrize(("deleted", "said"), [(0, 0), (1, 0), (2, 1)])
def test_of_several_only_the_deletable_ones_go(service: str, deleted: int, said: int) -> None:
    field, standard = {
        "deleteNamedType": ("listOfTypeName", "R_PSE"),
        "deleteVariableAccess": ("listOfName", "R_VPWR"),
    }[service]
    told = judged(*deletion(service, field, [vmd(standard), vmd("OWN")], deleted))
    assert rules(told) == ["object.deleted"] * said


def test_a_whole_scope_names_no_object() -> None:
    body = {"scopeOfDelete": 3}
    assert judged("deleteNamedType", body, {"numberMatched": 9, "numberDeleted": 9}) == []


# Notifications.


def notified(action: str, answer: tuple[str, Any], **more: Any) -> list[Breach]:
    detail = pdus.controlled(None) if answer[0].startswith("getProgram") else None
    body = pdus.notification("E", "R_RVS", action, answer, detail) | more
    pdu = decode(encode(Pdu("unconfirmed-PDU", None, "eventNotification", body)))
    return list(Objects().notified(pdu))


ATTRIBUTES = ("getProgramInvocationAttributes", pdus.attributes("idle", ["R_ARM"], deletable=False))
STATUS = ("status", pdus.status(0, 0))


@pytest.mark.exercises("R-8.8.1-1", "R-8.8.2-1")
def test_a_standardized_action_gives_the_result_of_its_service() -> None:
    assert notified("R_STC", STATUS) == notified("R_ARM", ATTRIBUTES) == notified("OWN", ATTRIBUTES) == []
    (status,), (arm,) = notified("R_STC", ATTRIBUTES), notified("R_ARM", STATUS)
    assert (status.rule, status.clause and status.clause.ids) == ("event.action-result", ("R-8.8.1-1",))
    assert (arm.rule, arm.clause and arm.clause.ids) == ("event.action-result", ("R-8.8.2-1",))


def test_an_action_may_fail() -> None:
    failed = {
        "eventActionName": vmd("R_STC"),
        "eventActionResult": ("failure", {"errorClass": ("access", 0)}),
    }
    assert notified("R_STC", STATUS, actionResult=failed) == []


@pytest.mark.exercises("R-8.3.1-2")
def test_the_action_r_arm_shows_the_arms_own_domain() -> None:
    wrong = ("getProgramInvocationAttributes", pdus.attributes("idle", ["WELD"], deletable=False))
    assert rules(notified("R_ARM", wrong)) == ["object.attribute"]


@pytest.mark.exercises("R-8.7.1-2")
def test_a_standardized_event_has_the_normal_severity() -> None:
    assert rules(notified("R_STC", STATUS, severity=1)) == ["object.attribute"]
    assert notified("R_STC", STATUS, severity=1, eventConditionName=vmd("OWN")) == []


def test_every_entry_says_what_it_rests_on() -> None:
    assert [key for key, fixed in OBJECTS.items() if not fixed.clause.ids] == []
    assert replace(OBJECTS["domain R_ARM getDomainAttributes sharable"], name="X").object == "domain X"


# The table itself: written down by hand, so that nothing falls out of it unseen.

DOMAIN_FIELDS = {"mmsDeletable", "sharable"}
CONDITION_FIELDS = {"mmsDeletable", "class", "severity", "priority", "alarmSummaryReports", "enabled"}
ACTION_FIELDS = {"mmsDeletable", "listOfModifier", "confirmedServiceRequest"}
FIELDS = {
    "domain R_ARM": DOMAIN_FIELDS | {"listOfProgramInvocations"},
    "domain R_CAL": DOMAIN_FIELDS | {"listOfProgramInvocations"},
    "domain R_SAFE": DOMAIN_FIELDS,
    "program invocation R_ARM": {"listOfDomainNames"},
    "program invocation R_CAL": {"listOfDomainNames"},
    "semaphore R_CTRL": {"mmsDeletable", "class", "numberOfTokens"},
    **{f"event condition {name}": CONDITION_FIELDS for name in ("R_RVS", "R_SIV", "R_RLC", "R_ARM")},
    **{f"event action {name}": ACTION_FIELDS for name in ("R_STC", "R_ARM")},
    **{f"type {name}": {"mmsDeletable"} for name in ("R_PIS", "R_OIS", "R_PSE", "R_EEF")},
}


def test_no_fixed_attribute_is_forgotten() -> None:
    listed: dict[str, set[str]] = {}
    for fixed in OBJECTS.values():
        if fixed.kind != "variable":
            listed.setdefault(fixed.object, set()).add(fixed.field)
    assert listed == FIELDS
    assert {fixed.name for fixed in OBJECTS.values() if fixed.kind == "variable"} == set(VARIABLES)
    assert {fixed.name for fixed in OBJECTS.values() if fixed.service == "eventNotification"} == {
        "R_RVS", "R_SIV", "R_RLC", "R_ARM",
    }  # fmt: skip


@pytest.mark.exercises("R-8.4.1-1", "R-8.4.2-1", "R-8.4.3-1", "R-8.4.4-1")
@pytest.mark.parametrize(
    ("name", "parts"),
    [
        ("R_PIS", (3, SINGLE)),
        ("R_OIS", (4, SINGLE)),
        ("R_PSE", [(3, SINGLE), (4, SINGLE)]),
        (
            "R_EEF",
            [("objId", None), ("visible-string", 80), [(3, SINGLE), (4, SINGLE)], ("visible-string", 512)],
        ),
    ],
)
def test_each_standardized_type_is_that_of_the_text(name: str, parts: Any) -> None:
    good, bad = (
        {"mmsDeletable": False, "typeSpecification": it} for it in (described(parts), ("bit-string", 8))
    )
    assert judged("getNamedTypeAttributes", vmd(name), good) == []
    assert rules(judged("getNamedTypeAttributes", vmd(name), bad)) == ["object.type"]


def described(parts: Any) -> tuple[str, Any]:
    """A type as a text tells it: a list of components, a number of elements, or a type specification."""
    if isinstance(parts, list):
        inner = [{"componentType": described(part)} for part in parts]
        return "structure", {"packed": False, "components": inner}
    first, second = parts
    if isinstance(first, int):
        return "array", {"packed": False, "numberOfElements": first, "elementType": second}
    return parts[0], parts[1]
