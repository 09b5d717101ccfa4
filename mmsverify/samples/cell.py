"""A welding cell as its controller talks to it: the sentences of which the sample conversations are made.

Who writes a conversation says what the robot answers, true or false; nothing here knows the rules.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mmsverify.formats.mms import number
from mmsverify.formats.trace import Sender
from mmsverify.samples import pdus
from mmsverify.samples.pdus import vmd
from mmsverify.samples.recording import Association, Recording

ARM, CALIBRATION, SAFETY = "R_ARM", "R_CAL", "R_SAFE"

CLIENT_SERVICES = (
    "identify", "downloadSegment", "terminateDownloadSequence", "unsolicitedStatus", "informationReport",
    "eventNotification",
)  # fmt: skip
ROBOT_SERVICES = (
    "status", "getNameList", "identify", "read", "write", "takeControl", "relinquishControl",
    "reportSemaphoreStatus", "initiateDownloadSequence", "initiateUploadSequence", "uploadSegment",
    "terminateUploadSequence", "deleteDomain", "getDomainAttributes", "createProgramInvocation",
    "deleteProgramInvocation", "start", "stop", "resume", "reset", "kill", "getProgramInvocationAttributes",
    "defineEventEnrollment", "deleteEventEnrollment", "getCapabilityList", "unsolicitedStatus",
    "informationReport", "eventNotification", "conclude", "cancel",
)  # fmt: skip
ROBOT_ADDITIONAL = ("vMDStop", "vMDReset", "select", "alterProgramInvocationAttributes")
OFFERED: dict[Sender, tuple[str, ...]] = {"client": CLIENT_SERVICES, "server": ROBOT_SERVICES}

CONFLICT = ("service", "object-state-conflict")
NOT_ADMITTED = ("vmd-state", "vmd-state-conflict")


class Cell(Association):
    """The association of a cell controller with its welding robot."""

    def __init__(self, recording: Recording, name: str = "cell-controller") -> None:
        super().__init__(recording, name)

    def begin(self, outstanding: int = 5) -> None:
        """The association is set up."""
        self.open(OFFERED, ROBOT_ADDITIONAL, outstanding)

    # The robot as a whole.

    def status(self, state: str, selected: str | None = None, **more: Any) -> None:
        """Status is asked for and given."""
        body, detail = _status(state, selected, **more)
        self.call("status", False, gives=body, extra=detail)

    def tell_status(self, state: str, selected: str | None = None, **more: Any) -> None:
        """The robot tells its status unasked."""
        body, detail = _status(state, selected, **more)
        self.tell("unsolicitedStatus", body, detail)

    def read(self, *values: tuple[Any, tuple[str, Any]]) -> None:
        """Named variables are read: pairs of a name and its value."""
        found = [("success", value) for _, value in values]
        names = [vmd(name) if isinstance(name, str) else name for name, _ in values]
        self.call("read", pdus.reading(*names), gives={"listOfAccessResult": found})

    def report(self, name: str, value: tuple[str, Any]) -> None:
        """The robot reports a variable unasked."""
        body = {
            "variableAccessSpecification": pdus.variables(vmd(name)),
            "listOfAccessResult": [("success", value)],
        }
        self.tell("informationReport", body)

    # Domains.

    def download(self, domain: str, segments: Sequence[bytes]) -> None:
        """A program is loaded: the robot asks for it piece by piece."""
        begin = {"domainName": domain, "listOfCapabilities": [], "sharable": False}
        self.call("initiateDownloadSequence", begin)
        for sent, segment in enumerate(segments, 1):
            gives = {"loadData": ("non-coded", segment), "moreFollows": sent < len(segments)}
            self.serve("downloadSegment", domain, gives=gives)
        self.serve("terminateDownloadSequence", {"domainName": domain})

    def domain(self, name: str, state: str, used_by: list[str]) -> None:
        """A domain's attributes are asked for and given."""
        gives = {
            "listOfCapabilities": [],
            "state": number("DomainState", state),
            "mmsDeletable": name not in (ARM, CALIBRATION, SAFETY),
            "sharable": name == ARM,
            "listOfProgramInvocations": used_by,
            "uploadInProgress": 0,
        }
        self.call("getDomainAttributes", name, gives=gives)

    # Program invocations.

    def create(self, name: str, kind: int = 1, *, reusable: bool = True) -> None:
        """A program invocation is made of the domain of its name: 0 normal, 1 controlling, 2 controlled."""
        body = {"programInvocationName": name, "listOfDomainNames": [name], "reusable": reusable}
        self.call("createProgramInvocation", body, kind or None)

    def select(self, name: str | None, *controlled: str) -> None:
        """A program invocation is selected with those that it controls; without a name, none is."""
        self.call("select", selection(name, *controlled))

    def start(self, name: str, **how: Any) -> None:
        """A program invocation is started; ``cycles``, ``steps``, ``free`` and ``at`` say how."""
        self.call("start", {"programInvocationName": name}, start_detail(**how))

    def run(self, service: str, name: str, detail: Any = None) -> None:
        """Stop, Resume, Reset or Kill of a program invocation."""
        self.call(service, {"programInvocationName": name}, detail)

    def is_refused(self, service: str, name: str, cause: tuple[str, str], state: str | None = None) -> None:
        """Start, Stop, Resume, Reset or Kill is refused, and what it was meant for stays in ``state``."""
        asked = self.ask(service, {"programInvocationName": name})
        self.refuse(asked, cause, (service, state) if state else None)

    def attributes(self, name: str, state: str, detail: dict[str, Any], **more: Any) -> None:
        """A program invocation's attributes are asked for and given."""
        self.call(
            "getProgramInvocationAttributes", name, gives=pdus.attributes(state, [name], **more), extra=detail
        )

    def arm(self, state: str, by: str | None = None) -> None:
        """The same of the arm's own program invocation."""
        self.attributes(ARM, state, pdus.controlled(by), deletable=False)

    def calibration(self, state: str) -> None:
        """The same of the calibration program."""
        self.attributes(CALIBRATION, state, pdus.NORMAL, deletable=False)

    def arm_left_running(self, enrollment: str, state: str, by: str | None = None) -> None:
        """The robot notifies that R_ARM has left RUNNING, with its attributes."""
        found = pdus.attributes(state, [ARM], deletable=False)
        answer = ("getProgramInvocationAttributes", found)
        self.tell("eventNotification", pdus.notification(enrollment, ARM, ARM, answer, pdus.controlled(by)))


def selection(name: str | None, *controlled: str) -> dict[str, Any]:
    """The body of Select."""
    return {"controlling": name, "controlled": list(controlled)} if name else {}


def start_detail(
    cycles: int = 0, steps: int = 0, *, free: bool = False, at: str = ""
) -> tuple[str, Any] | None:
    """The robot's part of Start; none for a program invocation that takes none."""
    if not (cycles or steps or free or at):
        return None
    count = ("noLimit", None) if free else ("stepCount", steps) if steps else ("cycleCount", cycles or 1)
    return "controlling", {**({"startLocation": at} if at else {}), "startCount": count}


def resumption(**how: Any) -> tuple[str, Any]:
    """The robot's part of Resume: as before, or with a new count."""
    started = start_detail(**how)
    mode = ("continueMode", None) if started is None else ("changeMode", started[1]["startCount"])
    return "controlling", {"modeType": mode}


def _status(
    state: str,
    selected: str | None,
    *,
    logical: int = 0,
    physical: int = 0,
    local: bool = False,
    flags: Sequence[str] = pdus.ALL_WELL,
) -> tuple[dict[str, int], dict[str, Any]]:
    chosen = ("programInvocation", selected) if selected else ("noneSelected", None)
    shown = [*flags, "localControl"] if local else flags
    return pdus.status(logical, physical), pdus.robot_status(state, shown, chosen)
