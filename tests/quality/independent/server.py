"""From a request to its answer: the robot performs a service at one instant and says what came of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from independent import domains, programs, views, vmd
from independent.controller import Controller
from independent.objects import UNKNOWN, Answer, Refusal
from mmsverify.formats.mms import Pdu
from mmsverify.samples import pdus

SERVICES = (
    "status", "getNameList", "identify", "read", "write", "initiateDownloadSequence",
    "initiateUploadSequence", "uploadSegment", "terminateUploadSequence",
    "loadDomainContent", "storeDomainContent", "deleteDomain",
    "getDomainAttributes", "createProgramInvocation", "deleteProgramInvocation", "start", "stop", "resume",
    "reset", "kill", "getProgramInvocationAttributes", "defineEventEnrollment", "deleteEventEnrollment",
    "unsolicitedStatus", "informationReport", "eventNotification", "conclude", "cancel",
)  # fmt: skip
SEMAPHORES = ("takeControl", "relinquishControl", "reportSemaphoreStatus")
ADDITIONAL = ("vMDStop", "vMDReset", "select", "alterProgramInvocationAttributes")
OF_CLIENT = (
    "downloadSegment", "terminateDownloadSequence", "unsolicitedStatus", "informationReport",
    "eventNotification",
)  # fmt: skip


@dataclass(frozen=True)
class Outcome:
    """The answer to a request; ``why`` says for a negative one what stood against it."""

    pdu: Pdu
    why: str = ""


def positive(asked: Pdu, body: Any = None, detail: Any = None) -> Pdu:
    return Pdu("confirmed-ResponsePDU", asked.invoke_id, asked.service, body, detail)


def negative(asked: Pdu, cause: tuple[str, str], info: tuple[str, str] | None = None) -> Pdu:
    assert asked.invoke_id is not None
    if cause[0] == "service-preempt":
        code = {"timeout": 1, "cancel": 3}[cause[1]]
        error = {"errorClass": ("service-preempt", code)}
        return Pdu("confirmed-ErrorPDU", asked.invoke_id, body={"serviceError": error})
    return pdus.failure(asked.invoke_id, cause, info)


def rejected(asked: Pdu) -> Pdu:
    """Reject: the service is not supported (7.5.2.4)."""
    return Pdu("rejectPDU", asked.invoke_id, body={"rejectReason": ("confirmed-request", 1)})


def perform(robot: Controller, who: str, asked: Pdu, *, supported: bool = True) -> Outcome:
    """What the robot does with a request that it has an answer to at once."""
    assert asked.service is not None
    if not supported:
        return Outcome(rejected(asked), "unsupported")
    try:
        robot.admit(who, asked.service)
        body, detail = _BY_SERVICE[asked.service](robot, who, asked)
    except Refusal as refusal:
        return Outcome(negative(asked, refusal.cause, refusal.info), refusal.why)
    return Outcome(positive(asked, body, detail))


Perform = Callable[[Controller, str, Pdu], Answer]
_NONE: Answer = (None, None)


def _identify(_robot: Controller, _who: str, _asked: Pdu) -> Answer:
    return {"vendorName": "Maker", "modelName": "Six", "revision": "1"}, None


def _read(robot: Controller, _who: str, asked: Pdu) -> Answer:
    names = [item["variableSpecification"][1] for item in asked.body["variableAccessSpecification"][1]]
    found = [views.variable(robot, name) for name in names]
    results = [("failure", 10) if value is None else ("success", value) for value in found]
    return {"listOfAccessResult": results}, None


def _write(robot: Controller, _who: str, asked: Pdu) -> Answer:
    names = [item["variableSpecification"][1] for item in asked.body["variableAccessSpecification"][1]]
    for (_, name), data in zip(names, asked.body["listOfData"], strict=True):
        if name not in robot.variables:
            raise Refusal("unknown", UNKNOWN)
        robot.variables[name] = data[1]
    return [("success", None) for _ in names], None


def _named(act: Callable[[Controller, str], None]) -> Perform:
    def run(robot: Controller, _who: str, asked: Pdu) -> Answer:
        act(robot, asked.body["programInvocationName"] if isinstance(asked.body, Mapping) else asked.body)
        return _NONE

    return run


def _download(robot: Controller, who: str, asked: Pdu) -> Answer:
    domains.begin_download(robot, who, asked.body["domainName"], asked.body["sharable"], 2)
    return _NONE


def _load(robot: Controller, _who: str, asked: Pdu) -> Answer:
    domains.load(robot, asked.body["domainName"], asked.body["sharable"])
    return _NONE


def _create(robot: Controller, _who: str, asked: Pdu) -> Answer:
    programs.create(robot, asked.body, asked.detail)
    return _NONE


def _start(robot: Controller, _who: str, asked: Pdu) -> Answer:
    programs.start(robot, asked.body["programInvocationName"], asked.detail)
    return _NONE


def _resume(robot: Controller, _who: str, asked: Pdu) -> Answer:
    programs.resume(robot, asked.body["programInvocationName"], asked.detail)
    return _NONE


def _select(robot: Controller, _who: str, asked: Pdu) -> Answer:
    vmd.select(robot, asked.body)
    return _NONE


def _alter(robot: Controller, _who: str, asked: Pdu) -> Answer:
    vmd.alter(robot, asked.body)
    return _NONE


def _vmd_stop(robot: Controller, _who: str, _asked: Pdu) -> Answer:
    vmd.vmd_stop(robot)
    return _NONE


def _vmd_reset(robot: Controller, _who: str, _asked: Pdu) -> Answer:
    vmd.vmd_reset(robot)
    return views.status(robot)


def _take(robot: Controller, who: str, _asked: Pdu) -> Answer:
    if not vmd.take(robot, who):
        raise Refusal("taken", ("service-preempt", "timeout"))
    return ("noResult", None), None


def _relinquish(robot: Controller, who: str, _asked: Pdu) -> Answer:
    vmd.relinquish(robot, who)
    return _NONE


_BY_SERVICE: Mapping[str, Perform] = {
    "status": lambda robot, _w, _a: views.status(robot),
    "identify": _identify,
    "read": _read,
    "write": _write,
    "initiateDownloadSequence": _download,
    "loadDomainContent": _load,
    "deleteDomain": _named(domains.delete),
    "getDomainAttributes": lambda robot, _w, asked: views.domain(robot, asked.body),
    "createProgramInvocation": _create,
    "deleteProgramInvocation": _named(programs.delete),
    "start": _start,
    "stop": _named(programs.stop),
    "resume": _resume,
    "reset": _named(programs.reset),
    "kill": _named(programs.kill),
    "getProgramInvocationAttributes": lambda robot, _w, asked: views.program(robot, asked.body),
    "select": _select,
    "alterPI": _alter,
    "vMDStop": _vmd_stop,
    "vMDReset": _vmd_reset,
    "takeControl": _take,
    "relinquishControl": _relinquish,
    "reportSemaphoreStatus": lambda robot, _w, _a: views.semaphore(robot),
    "defineEventEnrollment": lambda _r, _w, _a: _NONE,
}
