"""The words of stories: what is answered and told, one line each, as what stands in a PDU.

Only words and their places stand here: nothing knows a rule, so that a robot of a story can say anything.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from story_words import Words, limit, named

from mmsverify.formats.mms import Pdu, number
from mmsverify.samples import pdus
from mmsverify.samples.pdus import variables, vmd

Answered = tuple[Any, Any]
"""Body and the robot's part."""

STATES = {
    "IDLE": "robot-idle", "LOADED": "robot-loaded", "READY": "robot-ready", "EXECUTING": "robot-executing",
    "PAUSED": "robot-motion-paused", "INTERVENTION": "manualInterventionRequired",
}  # fmt: skip
ERRORS = {
    "vmd-state": "VmdStateError", "definition": "DefinitionError", "resource": "ResourceError",
    "service": "ServiceProblem", "service-preempt": "ServicePreempt", "access": "AccessError",
    "conclude": "ConcludeProblem", "cancel": "CancelProblem",
}  # fmt: skip


def status(words: Words) -> tuple[Any, Any]:
    """``EXECUTING selected Weld``, then what is not as usual: no power, local control ..."""
    state, chosen = STATES[words.next()], ("noneSelected", None)
    if words.take("selected"):
        chosen = ("programInvocation", words.next())  # type: ignore[assignment]
    logical = number("VmdLogicalStatus", words.next()) if words.take("logical") else 0
    physical = number("VmdPhysicalStatus", words.next()) if words.take("physical") else 0
    flags = [
        *(["safetyInterlocksViolated"] if words.take("violated") else []),
        *([] if words.take("unpowered") else ["anyPhysicalResourcePowerOn"]),
        *([] if words.take("uncalibrated") else ["allPhysicalResourcesCalibrated"]),
        *(["localControl"] if words.take("local") else []),
    ]
    detail = pdus.robot_status(state, flags, chosen)
    if words.take("mask"):
        detail["robotSpecificStatusMask"] = words.next()
    return pdus.status(logical, physical), detail


def attributes(words: Words, name: str) -> Answered:
    """``RUNNING controlling [R_ARM] cycles 3``: state, control, then what is not as usual."""
    state, detail = words.next().lower(), _control(words)
    detail["errorCode"] = int(words.next()) if words.take("error") else 0
    domains = words.listed() if words.take("of") else [name]
    usual = not name.startswith("R_")  # 8.1: so are called the objects that nobody can delete
    deletable = words.take("deletable") or (usual and not words.take("fixed"))
    reusable, monitor = not words.take("once"), words.take("monitored")
    return pdus.attributes(state, domains, deletable=deletable, reusable=reusable, monitor=monitor), detail


def _control(words: Words) -> dict[str, Any]:
    kind = words.next()
    if kind == "normal":
        return dict(pdus.NORMAL)
    if kind == "controlled":
        words.take("by")
        leader = words.next()
        return pdus.controlled(None if leader == "none" else leader)
    listed = words.listed()
    kinds = {"noLimit": "freeRunning", "cycleCount": "cycleLimited", "stepCount": "stepLimited"}
    mode, left = limit(words) or ("noLimit", None)
    detail = pdus.controlling(listed, (kinds[mode], left))
    if words.take("at"):
        detail["control"][1]["programLocation"] = words.next()
    return detail


def domain(words: Words) -> dict[str, Any]:
    """``ready``, ``in-use [Weld]``: state, the program invocations that use it, then what is not as usual."""
    return {
        "state": number("DomainState", words.next()), "listOfProgramInvocations": words.listed(),
        "listOfCapabilities": [], "sharable": words.take("sharable"), "mmsDeletable": not words.take("fixed"),
        "uploadInProgress": 0,
    }  # fmt: skip


def segment(words: Words) -> dict[str, Any]:
    """``"BEGIN" more`` or ``"END" last``."""
    return {"loadData": ("non-coded", words.next().encode()), "moreFollows": not words.take("last")}


def read(words: Words) -> dict[str, Any]:
    """The values, one after the other; ``lacking`` one that does not exist."""
    found: list[tuple[str, Any]] = []
    while words:
        found.append(("failure", 10) if words.take("lacking") else ("success", words.value()))
    return {"listOfAccessResult": found}


def semaphore(words: Words) -> dict[str, Any]:
    """How many tokens are owned."""
    fixed = {"mmsDeletable": False, "class": 0, "numberOfTokens": 1, "numberOfHungTokens": 0}
    return {**fixed, "numberOfOwnedTokens": int(words.next())}


def condition(words: Words) -> dict[str, Any]:
    """The attributes of an event condition, as the standard sets them; ``severity`` another one."""
    usual = {"mmsDeletable": False, "class": 1, "priority": 64, "alarmSummaryReports": False}
    return {**usual, "severity": int(words.next()) if words.take("severity") else 64}


BODIES: Mapping[str, Callable[[Words], Any]] = {
    "getDomainAttributes": domain,
    "downloadSegment": segment,
    "uploadSegment": segment,
    "initiateUploadSequence": lambda words: {"ulsmID": int(words.next()), "listOfCapabilities": []},
    "read": read,
    "write": lambda _: [("success", None)],
    "takeControl": lambda _: ("noResult", None),
    "reportSemaphoreStatus": semaphore,
    "getEventConditionAttributes": condition,
    "identify": lambda _: {"vendorName": "Maker", "modelName": "Arm", "revision": "1"},
}
"""What a positive answer holds, by service; nothing where no word stands here."""


def answer(service: str, asked: Any, words: Words) -> Answered:
    """A positive answer to a request with the body ``asked``."""
    if service in ("status", "vMDReset"):
        return status(words)
    if service == "getProgramInvocationAttributes":
        return attributes(words, asked)
    return (BODIES[service](words) if service in BODIES else None), None


def failure(words: Words, service: str) -> dict[str, Any]:
    """``service/object-state-conflict in STOPPED``: class and code, the state of the program invocation."""
    kind, code = words.next().split("/")
    error: dict[str, Any] = {"errorClass": (kind, number(ERRORS[kind], code))}
    if words.take("in"):
        error["serviceSpecificInformation"] = (
            service,
            number("ProgramInvocationState", words.next().lower()),
        )
    return {"serviceError": error}


def notification(words: Words) -> dict[str, Any]:
    """``Halt of R_ARM with R_ARM STOPPED controlled by Weld``: enrollment, condition, the action's result."""
    name, _, condition_name = words.next(), words.take("of"), words.next()
    body = {
        "eventEnrollmentName": vmd(name), "eventConditionName": vmd(condition_name), "severity": 64,
        "transitionTime": ("undefined", None), "notificationLost": False,
    }  # fmt: skip
    if not words.take("with"):
        return body
    if words.take("status"):
        action, (shown, detail) = "R_STC", status(words)
        result = {"response": ("status", shown), "detail": detail}
    else:
        action = words.next()
        shown, detail = attributes(words, action)
        result = {"response": ("getProgramInvocationAttributes", shown), "detail": detail}
    return {
        **body,
        "actionResult": {"eventActionName": vmd(action), "eventActionResult": ("success", result)},
    }


def report(words: Words) -> dict[str, Any]:
    """``Part_Count 3``: a variable that is reported unasked."""
    specification = variables(named(words.next()))
    return {"variableAccessSpecification": specification, "listOfAccessResult": [("success", words.value())]}


def unasked(words: Words) -> Pdu | None:
    """``tells``, ``reports``, ``notifies``: what a robot says by itself; ``None`` where it answers."""
    if words.take("tells"):
        body, detail = status(words)
        return Pdu("unconfirmed-PDU", None, "unsolicitedStatus", body, detail)
    if words.take("reports"):
        return Pdu("unconfirmed-PDU", None, "informationReport", report(words))
    if words.take("notifies"):
        return Pdu("unconfirmed-PDU", None, "eventNotification", notification(words))
    return None
