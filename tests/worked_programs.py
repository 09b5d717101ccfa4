"""Worked PDUs: status and program invocations (7.3)"""

from __future__ import annotations

from typing import Any

from worked_pdus import (
    ATTRIBUTES,
    EXECUTING,
    MASKED,
    NAMED,
    NONE,
    ONE_CYCLE,
    PI1,
    PLAIN,
    SELECTED,
    STATUS,
    STATUS_IDS,
    UNSOLICITED,
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

STATUSES: list[Worked | Refused] = [
    Worked(("R-7.3.2.1-2", "R-7.3.2.1.2-1"), ask("8001FF"), asked("status", True)),
    Refused(
        ("R-7.3.2.1-2", "R-7.3.2.1.2-1"),
        ask("800100", under79(e("A0", "0500"))),
        "confirmed-RequestPDU.detail",
        "found A0",
    ),
    Refused(
        ("R-7.3.2.1-2", "R-7.3.2.1.2-1"),
        ask("800100", under79("9F260101")),
        "confirmed-RequestPDU.detail",
        "a detail of createProgramInvocation in a PDU of status",
    ),
    Worked(
        (*STATUS_IDS, "R-T2-1", "R-T2-2", "R-T2-4", "R-7.3.2.1.1.1-1", "R-7.3.2.1.1.2-1", "R-7.3.2.1.1.4-1"),
        tell(WELL, under79(e("A0", e("30", EXECUTING)))),
        told("status", STATUS, robot(3, "0110", SELECTED)),
    ),
    Worked(
        (*STATUS_IDS, "R-T2-3", "R-7.3.2.1.1.3-1", "R-7.3.2.1.1.4-1"),
        tell(WELL, under79(e("A0", e("30", MASKED)))),
        told("status", STATUS, robot(4, "0001", NONE, "1101")),
    ),
    Worked(
        ("R-T2-3", "R-7.3.2.1.1.3-1"),
        tell(WELL, under79(e("A0", e("30", "800100 81020400 820204F0 8400")))),
        told("status", STATUS, robot(0, "0000", NONE)),
        written=False,
    ),
    Worked(
        STATUS_IDS,
        tell(WELL, under79(e("A0", MASKED))),
        told("status", STATUS, robot(4, "0001", NONE, "1101")),
        written=False,
    ),
    Worked(("R-7.3.2.1-3",), tell(WELL), told("status", STATUS)),
    Worked(("R-7.3.2.1-3",), tell(WELL, under79("A0020500")), told("status", STATUS), written=False),
    Worked(
        STATUS_IDS,
        e("A3", UNSOLICITED, under79(e("A1", e("30", EXECUTING)))),
        unconfirmed("unsolicitedStatus", STATUS, robot(3, "0110", SELECTED)),
    ),
    Worked(
        STATUS_IDS,
        e("A3", UNSOLICITED, under79(e("A1", MASKED))),
        unconfirmed("unsolicitedStatus", STATUS, robot(4, "0001", NONE, "1101")),
        written=False,
    ),
    Refused(
        ("R-T2-1", "R-7.3.2.1.2-2"),
        tell(WELL, under79(e("A0", e("30", "81020460 8400")))),
        "confirmed-ResponsePDU.detail.status.fullResponse",
        "robotVMDState",
    ),
    Refused(
        ("R-T2-2", "R-7.3.2.1.2-2"),
        tell(WELL, under79(e("A0", e("30", "800103 8400")))),
        "confirmed-ResponsePDU.detail.status.fullResponse",
        "robotSpecificStatus",
    ),
    Refused(
        ("R-T2-4", "R-7.3.2.1.1.4-1"),
        tell(WELL, under79(e("A0", e("30", "800103 81020460")))),
        "confirmed-ResponsePDU.detail.status.fullResponse",
        "selectedProgramInvocation",
    ),
]

CREATE = e("BF26", PI1, e("A1", e("1A", "44")))
CREATED = {**NAMED, "listOfDomainNames": ["D"], "reusable": True}
CREATE_IDS = ("R-7.3.3.2.4-1", "R-T3-1", "R-7.3.3.2.1.1-1")
PROGRAMS: list[Worked | Refused] = [
    *(
        Worked(
            CREATE_IDS,
            ask(CREATE, under79(f"9F2601{kind:02X}")),
            asked("createProgramInvocation", CREATED, kind),
        )
        for kind in range(3)
    ),
    Worked(("R-7.3.3.2.2-1", "R-7.3.3.2.4-1"), tell("9F2600"), told("createProgramInvocation")),
    Refused(
        ("R-7.3.3.2.2-1", "R-7.3.3.2.4-1"),
        tell("9F2600", under79("9F260101")),
        "confirmed-ResponsePDU.detail",
        "found 9F26",
    ),
]


def nothing_added() -> list[Worked | Refused]:
    """The services of program invocations whose details are NULL: what they are, and what they may not be."""
    found: list[Worked | Refused] = []
    for tag, service, ids in (
        (0x27, "deleteProgramInvocation", ("R-7.3.3.8-1",)),
        (0x29, "stop", ("R-7.3.3.4-1", "R-7.3.3.4.2-1")),
        (0x2B, "reset", ("R-7.3.3.6-1",)),
        (0x2C, "kill", ("R-7.3.3.7-1",)),
    ):
        plain = service == "deleteProgramInvocation"
        head = e("9F27", "504931") if plain else e(f"BF{tag:02X}", PI1)
        found += [
            Worked(ids, ask(head), asked(service, "PI1" if plain else NAMED)),
            Worked(ids, tell(f"9F{tag:02X}00"), told(service)),
            Refused(
                ids, ask(head, under79(e(f"BF{tag:02X}", "0500"))), "confirmed-RequestPDU.detail", "found BF"
            ),
            Refused(ids, ask(head, under79("0500")), "confirmed-RequestPDU.detail", "found 05"),
            Refused(
                ids,
                tell(f"9F{tag:02X}00", under79(f"9F{tag:02X}00")),
                "confirmed-ResponsePDU.detail",
                "found 9F",
            ),
        ]
    for tag, service, ids in (
        (0x28, "start", ("R-7.3.3.3.2-1", "R-7.3.3.3.4-3")),
        (0x2A, "resume", ("R-7.3.3.5.2-1", "R-7.3.3.5.4-1")),
    ):
        found += [
            Worked(ids, tell(f"9F{tag:02X}00"), told(service)),
            Refused(
                ids,
                tell(f"9F{tag:02X}00", under79(e(f"BF{tag:02X}", "0500"))),
                "confirmed-ResponsePDU.detail",
                "found BF",
            ),
        ]
    return [
        *found,
        Worked(("R-7.3.3.9.1-1",), ask(e("9F2D", "504931")), asked("getProgramInvocationAttributes", "PI1")),
        Refused(
            ("R-7.3.3.9.1-1",),
            ask(e("9F2D", "504931"), under79(e("BF2D", "0500"))),
            "confirmed-RequestPDU.detail",
            "found BF2D",
        ),
    ]


START_IDS = ("R-7.3.3.3.4-1", "R-T4-2", "R-7.3.3.3.1-1", "R-7.3.3.3.4.1-1")


def start(ids: tuple[str, ...], inside: str, detail: Any, *, written: bool = True) -> Worked:
    """A Start of PI1 with what stands in its detail for a controlling one."""
    octets = ask(e("BF28", PI1), under79(e("BF28", e("30", inside))))
    return Worked((*START_IDS, *ids), octets, asked("start", NAMED, ("controlling", detail)), written)


STARTS: list[Worked | Refused] = [
    Worked(("R-7.3.3.3.4-N", "R-7.3.3.3.1-1"), ask(e("BF28", PI1)), asked("start", NAMED)),
    Worked(
        ("R-7.3.3.3.4-1", "R-7.3.3.3.4-N"),
        ask(e("BF28", PI1), under79(e("BF28", "0500"))),
        asked("start", NAMED, ("normal", None)),
        written=False,
    ),
    start(
        ("R-T4-1", "R-7.3.3.3.1.1-1", "R-7.3.3.3.1.2-1"),
        "800135" + e("A1", "810103"),
        {"startLocation": "5", "startCount": counted("cycleCount", 3)},
    ),
    start(("R-7.3.3.3.4-1",), "", {"startCount": ONE_CYCLE}),
    start(("R-T4-1",), "800135", {"startLocation": "5", "startCount": ONE_CYCLE}),
    start(("R-7.3.3.3.4-1",), e("A1", "810101"), {"startCount": ONE_CYCLE}, written=False),
    start(
        ("R-T4-3", "R-7.3.3.3.1.3-1", "R-7.3.3.3.4-2", "R-7.3.3.3.4.2-1"),
        e("A1", "8000"),
        {"startCount": counted("noLimit")},
    ),
    start(
        ("R-T4-3", "R-7.3.3.3.1.4-1", "R-7.3.3.3.4-2", "R-7.3.3.3.4.2-1"),
        e("A1", "81020190"),
        {"startCount": counted("cycleCount", 400)},
    ),
    start(
        ("R-T4-3", "R-7.3.3.3.1.5-1", "R-7.3.3.3.4-2", "R-7.3.3.3.4.2-1"),
        e("A1", "820107"),
        {"startCount": counted("stepCount", 7)},
    ),
    start(("R-7.3.3.3.4-2",), e("A1", "8101FF"), {"startCount": counted("cycleCount", -1)}),
    Refused(
        ("R-7.3.3.3.1.2-1", "R-7.3.3.3.4-2"),
        ask(e("BF28", PI1), under79(e("BF28", e("30", e("A1", "830101"))))),
        "confirmed-RequestPDU.detail.start.controlling.startCount",
        "found 83",
    ),
    Refused(
        ("R-T4-3", "R-7.3.3.3.1.2-1"),
        ask(e("BF28", PI1), under79(e("BF28", e("30", e("A1", "810101", "820101"))))),
        "confirmed-RequestPDU.detail.start.controlling.startCount",
        "too many",
    ),
    Refused(
        ("R-7.3.3.3.1.1-1",),
        ask(e("BF28", PI1), under79(e("BF28", e("30", "800107")))),
        "confirmed-RequestPDU.detail.start.controlling.startLocation",
        "VisibleString",
    ),
    Refused(
        ("R-7.3.3.3.4.1-1", "R-7.3.3.3.4-1"),
        ask(e("BF28", PI1), under79(e("BF28", "0500", "3000"))),
        "confirmed-RequestPDU.detail.start",
        "too many",
    ),
]

RESUME_IDS = ("R-7.3.3.5.4-1", "R-T5-1", "R-7.3.3.5.1.1-1", "R-7.3.3.5.4.1-1")


def resume(ids: tuple[str, ...], inside: str, mode: tuple[str, Any]) -> Worked:
    octets = ask(e("BF2A", PI1), under79(e("BF2A", e("30", inside))))
    return Worked((*RESUME_IDS, *ids), octets, asked("resume", NAMED, ("controlling", {"modeType": mode})))


CHANGED = ("R-T5-2", "R-T5-3", "R-7.3.3.5.4.2-1", "R-7.3.3.5.4.3-1", "R-7.3.3.5.1.3-1")
RESUMES: list[Worked | Refused] = [
    Worked(("R-7.3.3.5.4-N",), ask(e("BF2A", PI1)), asked("resume", NAMED)),
    Worked(
        ("R-7.3.3.5.4-1", "R-7.3.3.5.4-N"),
        ask(e("BF2A", PI1), under79(e("BF2A", "0500"))),
        asked("resume", NAMED, ("normal", None)),
        written=False,
    ),
    resume(("R-T5-2", "R-7.3.3.5.4.2-1", "R-7.3.3.5.1.2-1"), "8000", ("continueMode", None)),
    resume((*CHANGED, "R-7.3.3.5.1.4-1"), e("A1", "8000"), ("changeMode", counted("noLimit"))),
    resume((*CHANGED, "R-7.3.3.5.1.5-1"), e("A1", "810104"), ("changeMode", counted("cycleCount", 4))),
    resume((*CHANGED, "R-7.3.3.5.1.6-1"), e("A1", "820105"), ("changeMode", counted("stepCount", 5))),
    Refused(
        ("R-7.3.3.5.1.3-1", "R-T5-3"),
        ask(e("BF2A", PI1), under79(e("BF2A", e("30", "A100")))),
        "confirmed-RequestPDU.detail.resume.controlling.modeType.changeMode",
        "nothing stands",
    ),
    Refused(
        ("R-T5-2", "R-7.3.3.5.1.1-1"),
        ask(e("BF2A", PI1), under79(e("BF2A", "3000"))),
        "confirmed-RequestPDU.detail.resume.controlling",
        "modeType",
    ),
]

ATTRIBUTE_IDS = ("R-7.3.3.9.4-1", "R-T6-1", "R-T6-2", "R-7.3.3.9.2.1-1", "R-7.3.3.9.2.2-1", "R-7.3.3.9.4.1-1")
LISTED = e("A0", e("1A", "41"), e("1A", "42"))


def attributes(ids: tuple[str, ...], inside: str, error: int, control: tuple[str, Any]) -> Worked:
    return Worked(
        (*ATTRIBUTE_IDS, *ids),
        tell(PLAIN, under79(e("BF2D", inside))),
        told("getProgramInvocationAttributes", ATTRIBUTES, {"errorCode": error, "control": control}),
    )


def controls(names: list[str], mode: tuple[str, int | None], **where: str) -> tuple[str, Any]:
    return "controlling", {"controlledPI": names, **where, "runningMode": mode}


CONTROLS = ("R-T6-3", "R-7.3.3.9.4-2", "R-7.3.3.9.2.4-1", "R-7.3.3.9.2.6-1")
SHOWN: list[Worked | Refused] = [
    attributes(
        (*CONTROLS, "R-7.3.3.9.2.5-1"),
        "800100" + e("A1", e("A0", LISTED, "8102 3132", e("A2", "8000"))),
        0,
        controls(["A", "B"], ("freeRunning", None), programLocation="12"),
    ),
    attributes(
        CONTROLS,
        "80020101" + e("A1", e("A0", "A000", e("A2", "810104"))),
        257,
        controls([], ("cycleLimited", 4)),
    ),
    attributes(
        CONTROLS,
        "8001FF" + e("A1", e("A0", LISTED, e("A2", "820100"))),
        -1,
        controls(["A", "B"], ("stepLimited", 0)),
    ),
    attributes(
        ("R-T6-4", "R-7.3.3.9.2.11-1"),
        "800100" + e("A1", e("A1", PI1)),
        0,
        ("controlled", ("controllingPI", "PI1")),
    ),
    attributes(
        ("R-T6-4", "R-7.3.3.9.2.11-1"),
        "800100" + e("A1", e("A1", "8100")),
        0,
        ("controlled", ("none", None)),
    ),
    attributes((), "800107" + e("A1", "8200"), 7, ("normal", None)),
    Refused(
        ("R-T6-1", "R-7.3.3.9.2.1-1"),
        tell(PLAIN, under79(e("BF2D", e("A1", "8200")))),
        "confirmed-ResponsePDU.detail.getProgramInvocationAttributes",
        "errorCode",
    ),
    Refused(
        ("R-T6-2",),
        tell(PLAIN, under79(e("BF2D", "800100"))),
        "confirmed-ResponsePDU.detail.getProgramInvocationAttributes",
        "control",
    ),
    Refused(
        ("R-T6-3", "R-7.3.3.9.2.6-1"),
        tell(PLAIN, under79(e("BF2D", "800100", e("A1", e("A0", "A000"))))),
        "confirmed-ResponsePDU.detail.getProgramInvocationAttributes.control.controlling",
        "runningMode",
    ),
    Refused(
        ("R-T6-3", "R-7.3.3.9.2.4-1"),
        tell(PLAIN, under79(e("BF2D", "800100", e("A1", e("A0", e("A2", "8000")))))),
        "confirmed-ResponsePDU.detail.getProgramInvocationAttributes.control.controlling",
        "controlledPI",
    ),
]

PROGRAM_PDUS: list[Worked | Refused] = [
    *STATUSES,
    *PROGRAMS,
    *nothing_added(),
    *STARTS,
    *RESUMES,
    *SHOWN,
]
