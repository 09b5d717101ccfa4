"""The words of the model for the numbers of the protocol: enumerations by index, names, services."""

from __future__ import annotations

ROBOT_STATE = (
    "ROBOT-IDLE",
    "ROBOT-LOADED",
    "ROBOT-READY",
    "ROBOT-EXECUTING",
    "ROBOT-MOTION-PAUSED",
    "MANUAL-INTERVENTION-REQUIRED",
)
STATE = (
    "NON-EXISTENT",
    "UNRUNNABLE",
    "IDLE",
    "RUNNING",
    "STOPPED",
    "STARTING",
    "STOPPING",
    "RESUMING",
    "RESETTING",
)
LOGICAL = (
    "STATE-CHANGES-ALLOWED",
    "NO-STATE-CHANGES-ALLOWED",
    "LIMITED-SERVICES-PERMITTED",
    "SUPPORT-SERVICES-ALLOWED",
)
DOMAIN_STATE = ("NON-EXISTENT", "LOADING", "READY", "READY", "COMPLETE", "INCOMPLETE")
PHYSICAL = ("OPERATIONAL", "PARTIALLY-OPERATIONAL", "INOPERABLE", "NEEDS-COMMISSIONING")
CALIBRATION = ("CALIBRATED", "NOT-CALIBRATED", "CALIBRATING")
CONTROL = ("NORMAL", "CONTROLLING", "CONTROLLED")
LIMIT = {"noLimit": "FREE-RUN", "cycleCount": "CYCLE-LIMITED", "stepCount": "STEP-LIMITED"}
MODE = {"freeRunning": "FREE-RUN", "cycleLimited": "CYCLE-LIMITED", "stepLimited": "STEP-LIMITED"}

SEMAPHORE = "R_CTRL"
ARM = "R_ARM"

# Services as a reader of the standard calls them.
TITLES = {
    "createProgramInvocation": "CreateProgramInvocation",
    "deleteProgramInvocation": "DeleteProgramInvocation",
    "start": "Start",
    "stop": "Stop",
    "resume": "Resume",
    "reset": "Reset",
    "kill": "Kill",
    "select": "Select",
    "vMDStop": "VMD Stop",
    "vMDReset": "VMD Reset",
    "alterPI": "AlterProgramInvocationAttributes",
    "takeControl": "TakeControl",
    "relinquishControl": "RelinquishControl",
    "status": "Status",
    "unsolicitedStatus": "UnsolicitedStatus",
    "getProgramInvocationAttributes": "GetProgramInvocationAttributes",
    "read": "Read",
    "initiate": "Initiate",
}


def title(service: str) -> str:
    """The service's name in a sentence."""
    return TITLES.get(service, service[:1].upper() + service[1:])


def word(table: tuple[str, ...], number: int) -> str | None:
    """The word for a number; ``None`` for one that the table does not have."""
    return table[number] if 0 <= number < len(table) else None
