"""Worked PDUs: the additional services (7.4), Initiate (7.5), what events carry (8.8, 7.3.4)"""

from __future__ import annotations

from typing import Any

from worked_pdus import (
    ATTRIBUTES,
    EXECUTING,
    ONE_CYCLE,
    PI1,
    PLAIN,
    SELECTED,
    STATUS,
    WELL,
    Refused,
    Worked,
    ask,
    asked,
    counted,
    e,
    robot,
    tell,
    told,
    unconfirmed,
    under79,
)

from mmsverify.formats.mms import Pdu

ADDED = ("R-7.4.1.1-1", "R-7.4.1.2-1", "R-7.4.1.2-2")
ANSWERED = ("R-7.4.1.3-1",)


def add(inside: str) -> str:
    return ask(e("BF4E", inside))


def added(inside: str) -> str:
    return tell(e("BF4E", inside))


SELECT = (*ADDED, "R-7.4.4.3-1", "R-T10-1")
ALTER = (*ADDED, "R-7.4.5.3-1", "R-T11-1", "R-7.4.5.1.1.2-1", "R-7.4.5.3.1-1", "R-7.3.3.3.4-2")


def alter(
    ids: tuple[str, ...], inside: str, count: tuple[str, int | None], *, written: bool = True
) -> Worked:
    body = {"programInvocation": "PI1", "startCount": count}
    return Worked((*ALTER, *ids), add(e("A3", PI1, inside)), asked("alterPI", body), written)


ERROR = e("A0", "840102")
FAILED = {"errorClass": ("service", 2)}
ADDITIONAL: list[Worked | Refused] = [
    Worked((*ADDED, "R-7.4.2.3-1", "R-T7-1"), add("8000"), asked("vMDStop")),
    Worked((*ANSWERED, "R-7.4.2.3-1", "R-T7-1"), added("8000"), told("vMDStop")),
    Worked((*ADDED, "R-7.4.3.3-1", "R-T9-1", "R-7.4.3.1.1.1-1"), add("8101FF"), asked("vMDReset", True)),
    Worked((*ADDED, "R-7.4.3.3-1", "R-T9-1", "R-7.4.3.1.1.1-1"), add("810100"), asked("vMDReset", False)),
    Worked(
        (*ANSWERED, "R-7.4.3.3-1", "R-T9-1", "R-7.4.3.1.2-1"),
        tell(e("BF4E", e("A1", "800101 810103")), under79(e("A0", e("30", EXECUTING)))),
        told("vMDReset", {"vmdLogicalStatus": 1, "vmdPhysicalStatus": 3}, robot(3, "0110", SELECTED)),
    ),
    Worked(
        (*SELECT, "R-7.4.4.1.1.1-1", "R-7.4.4.1.1.2-1"),
        add(e("A2", PI1, e("A1", e("1A", "41"), e("1A", "42")))),
        asked("select", {"controlling": "PI1", "controlled": ["A", "B"]}),
    ),
    Worked((*SELECT, "R-7.4.4.1.1.1-1"), add("A200"), asked("select", {})),
    Worked(
        (*SELECT, "R-7.4.4.1.1.2-1"),
        add(e("A2", e("A1", e("1A", "41")))),
        asked("select", {"controlled": ["A"]}),
    ),
    Worked((*SELECT, "R-7.4.4.1.1.2-1"), add(e("A2", PI1)), asked("select", {"controlling": "PI1"})),
    Worked((*ANSWERED, "R-7.4.4.3-1", "R-T10-1"), added("8200"), told("select")),
    alter((), e("A1", "810106"), counted("cycleCount", 6)),
    alter(("R-7.4.5.1.1.3-1",), e("A1", "8000"), counted("noLimit")),
    alter(("R-7.4.5.1.1.3-1",), "", ONE_CYCLE),
    alter(("R-7.4.5.1.1.3-1",), e("A1", "810101"), ONE_CYCLE, written=False),
    alter(("R-7.4.5.1.1.5-1",), e("A1", "820106"), counted("stepCount", 6)),
    Worked((*ANSWERED, "R-7.4.5.3-1", "R-T11-1"), added("8300"), told("alterPI")),
    Refused(
        ("R-T11-1",),
        add(e("A3", e("A1", "810106"))),
        "confirmed-RequestPDU.service.additionalService.alterPI",
        "programInvocation",
    ),
    Refused(
        ("R-7.4.1.1-1", "R-7.4.1.2-1"),
        add("8400"),
        "confirmed-RequestPDU.service.additionalService",
        "found 84",
    ),
    Refused(("R-7.4.1.3-1",), added("8400"), "confirmed-ResponsePDU.service.additionalService", "found 84"),
    Refused(
        ("R-7.4.1.2-2", "R-7.4.1.5-1"),
        e("A3", e("BF4E", "8000")),
        "unconfirmed-PDU",
        "found BF4E where service",
    ),
    Refused(
        ("R-7.4.2.3-1", "R-T7-1"),
        add("800100"),
        "confirmed-RequestPDU.service.additionalService.vMDStop",
        "NULL of 1",
    ),
    Refused(
        ("R-7.4.3.3-1", "R-T9-1"),
        add("8100"),
        "confirmed-RequestPDU.service.additionalService.vMDReset",
        "BOOLEAN of 0",
    ),
    Worked(
        ("R-7.4.1.4-1", "R-T7-1", "R-T9-1", "R-T10-1", "R-T11-1"),
        e("A2", "800105", e("A2", ERROR)),
        Pdu("confirmed-ErrorPDU", 5, body={"serviceError": FAILED}),
    ),
    Worked(
        ("R-7.4.1.4-1",),
        e("A2", "800105", e("A2", ERROR, e("A3", "AA020500"))),
        Pdu(
            "confirmed-ErrorPDU",
            5,
            body={"serviceError": {**FAILED, "serviceSpecificInformation": ("additionalService", None)}},
        ),
    ),
    Worked(
        ("R-7.4.1.4-1",),
        e("A2", "800105", e("A2", ERROR, e("A3", "AA03830105"))),
        Pdu(
            "confirmed-ErrorPDU",
            5,
            body={
                "serviceError": {
                    **FAILED,
                    "serviceSpecificInformation": ("additionalService", b"\x83\x01\x05"),
                }
            },
        ),
    ),
    Worked(
        ("R-7.4.1.5-1",),
        "A304A3020500",
        Pdu("unconfirmed-PDU", None, "additionalUnconfirmedService"),
    ),
    Refused(
        ("R-7.4.1.5-1",),
        "A305A303830105",
        "unconfirmed-PDU.service.additionalUnconfirmedService",
        "found 83",
    ),
]

SERVICES = "82 03 00 80 40"
PROPOSED = {
    "proposedMaxServOutstandingCalling": 1,
    "proposedMaxServOutstandingCalled": 2,
    "initRequestDetail": {
        "proposedVersionNumber": 1,
        "proposedParameterCBB": "101",
        "servicesSupportedCalling": "1000000001000000",
        "additionalSupportedCalling": "1110",
    },
}
AGREED = {
    "negotiatedMaxServOutstandingCalling": 1,
    "negotiatedMaxServOutstandingCalled": 2,
    "initResponseDetail": {
        "negotiatedVersionNumber": 1,
        "negotiatedParameterCBB": "101",
        "servicesSupportedCalled": "1000000001000000",
        "additionalSupportedCalled": "1110",
    },
}
OFFER = "800101 810205A0" + SERVICES
PROPOSAL_IDS = ("R-7.5.3-1", "R-T12-1", "R-7.5.1.1-1", "R-7.5.1.2-1", "R-7.5.1-1", "R-7.5.1.4-1")
AGREEMENT_IDS = ("R-7.5.3-2", "R-T13-1", "R-7.5.2.2-1", "R-7.5.2-1", "R-7.5.2.4-1")


def without(initiation: dict[str, Any], detail: str, field: str) -> dict[str, Any]:
    return {**initiation, detail: {k: v for k, v in initiation[detail].items() if k != field}}


def initiate(head: str, *inside: str) -> str:
    return e(head, "810101", "820102", e("A4", *inside))


INITIATIONS: list[Worked | Refused] = [
    Worked(PROPOSAL_IDS, initiate("A8", OFFER, "830204E0"), Pdu("initiate-RequestPDU", body=PROPOSED)),
    Worked(AGREEMENT_IDS, initiate("A9", OFFER, "830204E0"), Pdu("initiate-ResponsePDU", body=AGREED)),
    Worked(
        ("R-7.5.1-1",),
        initiate("A8", OFFER),
        Pdu("initiate-RequestPDU", body=without(PROPOSED, "initRequestDetail", "additionalSupportedCalling")),
    ),
    Worked(
        ("R-7.5.2-1",),
        initiate("A9", OFFER),
        Pdu("initiate-ResponsePDU", body=without(AGREED, "initResponseDetail", "additionalSupportedCalled")),
    ),
    *(
        Refused(ids, initiate(head, rest), f"initiate-{sort}PDU.init{sort}Detail", field)
        for head, sort, all_ids in (("A8", "Request", PROPOSAL_IDS), ("A9", "Response", AGREEMENT_IDS))
        for ids, rest, field in (
            ((all_ids[0], all_ids[1]), "810205A0" + SERVICES, "VersionNumber"),
            ((all_ids[0], all_ids[1]), "800101" + SERVICES, "ParameterCBB"),
            ((all_ids[0], all_ids[1]), "800101 810205A0 830204E0", "servicesSupported"),
        )
    ),
    *(
        Refused(
            (one,),
            initiate(head, "8003008000 810205A0" + SERVICES + "830204E0"),
            f"initiate-{sort}PDU.init{sort}Detail.{word}VersionNumber",
            "outside the bounds",
        )
        for head, sort, word, one in (
            ("A8", "Request", "proposed", "R-7.5.3-1"),
            ("A9", "Response", "negotiated", "R-7.5.3-2"),
        )
    ),
]

NOTIFIED = e("A0", e("80", "45")) + e("A1", e("80", "43")) + "820140" + e("A4", "8200")


def notified(ids: tuple[str, ...], result: str, outcome: tuple[str, dict[str, Any]]) -> Worked:
    """A notification whose action came to ``result``."""
    action = e("A8", e("80", "41"), e("A0" if outcome[0] == "success" else "A1", result))
    body = {
        "eventEnrollmentName": ("vmd-specific", "E"),
        "eventConditionName": ("vmd-specific", "C"),
        "severity": 64,
        "transitionTime": ("undefined", None),
        "notificationLost": False,
        "actionResult": {
            "eventActionName": ("vmd-specific", "A"),
            "eventActionResult": outcome,
        },
    }
    return Worked(ids, e("A3", e("A2", NOTIFIED, action)), unconfirmed("eventNotification", body))


NORMAL = {"errorCode": 0, "control": ("normal", None)}
SUMMARY = e("A0", e("80", "43")) + "810140 820102 830100"
ALARM = {
    "eventConditionName": ("vmd-specific", "C"),
    "severity": 64,
    "currentState": 2,
    "unacknowledgedState": 0,
}
EVENTS: list[Worked | Refused] = [
    notified(
        ("R-8.8.1-1",),
        WELL + under79(e("A0", e("30", EXECUTING))),
        ("success", {"response": ("status", STATUS), "detail": robot(3, "0110", SELECTED)}),
    ),
    notified(
        ("R-8.8.2-1",),
        PLAIN + under79(e("BF2D", "800100", e("A1", "8200"))),
        ("success", {"response": ("getProgramInvocationAttributes", ATTRIBUTES), "detail": NORMAL}),
    ),
    notified(("R-8.8.1-1",), WELL, ("success", {"response": ("status", STATUS)})),
    notified(("R-8.8.1-1",), e("A1", ERROR), ("failure", {"serviceError": FAILED})),
    Refused(
        ("R-8.8.1-1", "R-8.8.2-1"),
        e("A3", e("A2", NOTIFIED, e("A8", e("80", "41"), "A000"))),
        "unconfirmed-PDU.service.eventNotification.actionResult.eventActionResult.success",
        "response",
    ),
    Worked(
        ("R-7.3.4-2",),
        tell(e("BF3F", e("A0", e("30", SUMMARY, "A4020500")))),
        told(
            "getAlarmSummary",
            {"listOfAlarmSummary": [{**ALARM, "displayEnhancement": None}], "moreFollows": False},
        ),
    ),
    Worked(
        ("R-7.3.4-2",),
        tell(e("BF3F", e("A0", e("30", SUMMARY, "A403810104")))),
        told(
            "getAlarmSummary",
            {"listOfAlarmSummary": [{**ALARM, "displayEnhancement": ("index", 4)}], "moreFollows": False},
        ),
    ),
    Worked(
        ("R-7.3.4-2",),
        ask(e("BF42", e("A0", e("80", "4A")), e("A1", e("30", "800400000001", "A1020500", "830141")))),
        asked(
            "writeJournal",
            {
                "journalName": ("vmd-specific", "J"),
                "listOfJournalEntry": [
                    {
                        "occurrenceTime": b"\0\0\0\1",
                        "additionalDetail": None,
                        "entryForm": ("annotation", "A"),
                    }
                ],
            },
        ),
    ),
]

ADDITION_PDUS: list[Worked | Refused] = [*ADDITIONAL, *INITIATIONS, *EVENTS]
