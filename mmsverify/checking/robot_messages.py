"""Messages of the robot standard for steps of its model: requests, answers, and what shows the state.

A step is what results print of it (``PathStep``); no model is looked up here, and nothing is judged.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any

from mmsverify.audit import words
from mmsverify.checking import domain_messages
from mmsverify.formats.mms import Pdu, bit_string, number
from mmsverify.model.rows import PLUS

Arguments = Mapping[str, Any]
State = Mapping[str, Any]

FLAGS = {
    "interlocks_violated": "safetyInterlocksViolated",
    "any_power": "anyPhysicalResourcePowerOn",
    "all_calibrated": "allPhysicalResourcesCalibrated",
    "local_control": "localControl",
}
TELLS_STATE = frozenset({"start", "stop", "resume", "reset"})
OUTSTANDING = 5
WRITTEN = "AUXILIARY"
"""A variable of the robot's own: the standard's need not be there."""
SEMAPHORE = ("vmd-specific", words.SEMAPHORE)


def request(invoke_id: int, service: str, given: Arguments) -> Pdu:
    """The request for a service with the arguments of its row."""
    body, detail = _asked(service, given)
    return Pdu("confirmed-RequestPDU", invoke_id, service, body, detail)


def _asked(service: str, given: Arguments) -> tuple[Any, Any]:
    match service:
        case "createProgramInvocation":
            domains = domain_messages.names(given)
            named = {"programInvocationName": given["pi"], "listOfDomainNames": domains}
            return {**named, "reusable": given["reuse"]}, words.CONTROL.index(given["kind"]) or None
        case "deleteProgramInvocation" | "getProgramInvocationAttributes":
            return given["pi"], None
        case "start":
            return {"programInvocationName": given["pi"]}, _start(given)
        case "resume":
            return {"programInvocationName": given["pi"]}, _resume(given)
        case "stop" | "reset" | "kill":
            return {"programInvocationName": given["pi"]}, None
        case "select":
            return _selection(given), None
        case "alterPI":
            return {"programInvocation": given["pi"], "startCount": _count(given)}, None
        case "vMDReset" | "status":
            return False, None
        case "takeControl" | "relinquishControl" | "reportSemaphoreStatus":
            return _of_semaphore(service, given), None
        case "read":
            return {"specificationWithResult": False, **_variables(*given["variables"])}, None
        case "write":
            return {**_variables(WRITTEN), "listOfData": [("boolean", True)]}, None
    return domain_messages.asked(service, given), None


def _of_semaphore(service: str, given: Arguments) -> Any:
    if service == "reportSemaphoreStatus":
        return SEMAPHORE
    if service == "relinquishControl":
        return {"semaphoreName": SEMAPHORE}
    limited = {"controlTimeOut": 60_000, "abortOnTimeOut": False} if given.get("times_out") else {}
    taken_over: dict[str, Any] = {"applicationToPreempt": {}} if given.get("preempts") else {}
    stays = bool(given.get("stays"))
    return {"semaphoreName": SEMAPHORE, **limited, "relinquishIfConnectionLost": not stays, **taken_over}


def _variables(*names: str) -> dict[str, Any]:
    listed = [{"variableSpecification": ("name", _named(name))} for name in names]
    return {"variableAccessSpecification": ("listOfVariable", listed)}


def _named(name: str) -> tuple[str, Any]:
    """The name of a standardized variable; one of a domain has the domain before it."""
    domain, _, item = name.rpartition("/")
    return ("domain-specific", {"domainId": domain, "itemId": item}) if domain else ("vmd-specific", item)


def _start(given: Arguments) -> tuple[str, Any] | None:
    if not given.get("location_given") and given.get("limit") is None:
        return None
    location = {"startLocation": "1"} if given.get("location_given") else {}
    return "controlling", {**location, "startCount": _count(given)}


def _resume(given: Arguments) -> tuple[str, Any] | None:
    if not given.get("type_given") and given.get("limit") is None:
        return None
    changed = given.get("limit") is not None
    return "controlling", {"modeType": ("changeMode", _count(given)) if changed else ("continueMode", None)}


def _count(given: Arguments) -> tuple[str, Any]:
    match given.get("limit"):
        case "FREE-RUN":
            return "noLimit", None
        case "STEP-LIMITED":
            return "stepCount", given.get("count", 1)
    return "cycleCount", given.get("count", 1)


def _selection(given: Arguments) -> dict[str, Any]:
    if given.get("controlling") is None:
        return {}
    listed = list(given.get("controlled", ()))
    twice = listed[:1] if given.get("named_twice") else []
    return {"controlling": given["controlling"], "controlled": listed + twice}


def answer(invoke_id: int, service: str, given: Arguments, result: str, after: State) -> Pdu:
    """The response of a row with its result; a refusal tells the state where the protocol does."""
    if result == PLUS:
        body, detail = _answered(service, given, after)
        return Pdu("confirmed-ResponsePDU", invoke_id, service, body, detail)
    error: dict[str, Any] = {"errorClass": ("service", number("ServiceProblem", "object-state-conflict"))}
    if service in TELLS_STATE:
        error["serviceSpecificInformation"] = (service, words.STATE.index(after[f"state[{given['pi']}]"]))
    return Pdu("confirmed-ErrorPDU", invoke_id, body={"serviceError": error})


def _answered(service: str, given: Arguments, after: State) -> tuple[Any, Any]:
    match service:
        case "vMDReset" | "status":
            return _status(after), robot_status(after)
        case "takeControl":
            return ("noResult", None), None
        case "write":
            return [("success", None)], None
        case "reportSemaphoreStatus":
            owned = sum(bool(held) for cell, held in after.items() if cell.startswith("holder["))
            tokens = {"numberOfOwnedTokens": owned, "numberOfHungTokens": int(after["hung"])}
            return {"mmsDeletable": False, "class": 0, "numberOfTokens": 1, **tokens}, None
    return domain_messages.answered(service, given), None


def _status(state: State) -> dict[str, int]:
    return {
        "vmdLogicalStatus": words.LOGICAL.index(state["logical"]),
        "vmdPhysicalStatus": words.PHYSICAL.index(state["physical"]),
    }


def robot_status(state: State) -> dict[str, Any]:
    """The robot detail of Status (7.3.2.1.2)."""
    flags = [flag for cell, flag in FLAGS.items() if state[cell]]
    chosen = [name for name in programs(state) if state[f"selected[{name}]"]]
    return {
        "robotVMDState": words.ROBOT_STATE.index(state["robot_state"]),
        "robotSpecificStatus": bit_string("RobotSpecificStatus", flags, 4),
        "robotSpecificStatusMask": "1111",
        "selectedProgramInvocation": ("programInvocation", chosen[0]) if chosen else ("noneSelected", None),
    }


def unsolicited_status(state: State) -> Pdu:
    """The robot tells a change of its status by itself (7.3.2.2)."""
    return Pdu("unconfirmed-PDU", None, "unsolicitedStatus", _status(state), robot_status(state))


def variables(state: State, calibrated: Collection[str]) -> dict[str, tuple[str, Any]]:
    """The standardized variables that show something of the model's state (8.5), with their Data.

    ``calibrated`` are the physical resources that have a calibration attribute.
    """
    found: dict[str, tuple[str, Any]] = {name: ("boolean", state[cell]) for name, cell in OF_VMD.items()}
    for device in devices(state):
        found |= {
            f"{device}/{name}": ("boolean", state[f"{cell}[{device}]"]) for name, cell in OF_DEVICE.items()
        }
        if device in calibrated:
            calibration = words.CALIBRATION.index(state[f"calibration[{device}]"])
            found[f"{device}/R_DCAL"] = ("integer", calibration)
    return found


OF_VMD = {
    "R_VPWR": "any_power",
    "R_VCAL": "all_calibrated",
    "R_VLOCAL": "local_control",
    "R_VSAFEV": "interlocks_violated",
}
OF_DEVICE = {"R_DPWR": "power", "R_DLOCAL": "device_local"}


def values(invoke_id: int, shown: Sequence[tuple[str, Any]]) -> Pdu:
    """What Read answers for variables that have these Data."""
    found = [("success", data) for data in shown]
    return Pdu("confirmed-ResponsePDU", invoke_id, "read", {"listOfAccessResult": found})


def devices(state: State) -> list[str]:
    """Names of the physical resources that a state speaks of."""
    return [cell[len("power[") : -1] for cell in state if cell.startswith("power[")]


def programs(state: State) -> list[str]:
    """Names of the program invocations that a state speaks of."""
    return [cell[len("state[") : -1] for cell in state if cell.startswith("state[")]


def attributes(invoke_id: int, name: str, state: State) -> Pdu:
    """What GetProgramInvocationAttributes answers for a program invocation in this state."""
    if state[f"state[{name}]"] == "NON-EXISTENT":
        error = {"errorClass": ("access", number("AccessError", "object-non-existent"))}
        return Pdu("confirmed-ErrorPDU", invoke_id, body={"serviceError": error})
    body = {
        "state": words.STATE.index(state[f"state[{name}]"]),
        "listOfDomainNames": domain_messages.bound(name, state),
        "mmsDeletable": state[f"deletable[{name}]"],
        "reusable": state[f"reusable[{name}]"],
        "monitor": False,
        "executionArgument": ("simpleString", ""),
    }
    detail = {"errorCode": state[f"error_code[{name}]"], "control": _control(name, state)}
    return Pdu("confirmed-ResponsePDU", invoke_id, "getProgramInvocationAttributes", body, detail)


def _control(name: str, state: State) -> tuple[str, Any]:
    names = programs(state)
    match state[f"control[{name}]"]:
        case "CONTROLLING":
            listed = [c for c in names if state[f"controls[{name}, {c}]"]]
            location = "1" if state[f"located[{name}]"] else ""
            return "controlling", {
                "controlledPI": listed,
                "programLocation": location,
                "runningMode": _mode(name, state),
            }
        case "CONTROLLED":
            leaders = [a for a in names if state[f"controller[{name}, {a}]"]]
            return "controlled", ("controllingPI", leaders[0]) if leaders else ("none", None)
    return "normal", None


def _mode(name: str, state: State) -> tuple[str, Any]:
    match state[f"mode[{name}]"]:
        case "CYCLE-LIMITED":
            return "cycleLimited", state[f"cycles[{name}]"]
        case "STEP-LIMITED":
            return "stepLimited", state[f"steps[{name}]"]
    return "freeRunning", None


def initiation(sort: str) -> Pdu:
    """An Initiate of a robot that supports all of its services; ``sort`` is Request or Response."""
    past = {"Request": "proposed", "Response": "negotiated"}[sort]
    side = {"Request": "Calling", "Response": "Called"}[sort]
    offered: Sequence[str] = (
        "status", "getNameList", "identify", "read", "takeControl", "relinquishControl", "start", "stop",
        "resume", "reset", "kill", "createProgramInvocation", "deleteProgramInvocation",
        "getProgramInvocationAttributes", "write", "unsolicitedStatus", "conclude", "cancel",
        *DOMAIN_SERVICES,
    )  # fmt: skip
    body = {
        f"{past}MaxServOutstandingCalling": OUTSTANDING,
        f"{past}MaxServOutstandingCalled": OUTSTANDING,
        f"init{sort}Detail": {
            f"{past}VersionNumber": 1,
            f"{past}ParameterCBB": bit_string("ParameterSupportOptions", ["str1", "vnam"], 11),
            f"servicesSupported{side}": bit_string("ServiceSupportOptions", offered, 85),
            f"additionalSupported{side}": bit_string("AdditionalSupportOptions", ADDITIONAL, 4),
        },
    }
    return Pdu(f"initiate-{sort}PDU", body=body)


DOMAIN_SERVICES = (
    "initiateDownloadSequence", "downloadSegment", "terminateDownloadSequence", "initiateUploadSequence",
    "uploadSegment", "terminateUploadSequence", "loadDomainContent", "storeDomainContent", "deleteDomain",
    "getDomainAttributes",
)  # fmt: skip
ADDITIONAL = ("vMDStop", "vMDReset", "select", "alterProgramInvocationAttributes")
