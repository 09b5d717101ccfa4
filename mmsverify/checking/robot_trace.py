"""A run of the robot model as the conversation that would show it: who sends which MMS PDU, in order.

Steps that are messages become messages; what happens inside the robot shows only where its status changes,
which it tells by UnsolicitedStatus. A Status, the attributes of every program invocation and domain, the
variables of every physical resource and how many own R_CTRL stand at both ends, and once more before the last
step: what that step changes back would be seen by nobody otherwise.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from mmsverify.checking import domain_messages
from mmsverify.checking import robot_messages as messages
from mmsverify.checking.domain_messages import FROM_ROBOT
from mmsverify.formats.mms import Pdu
from mmsverify.formats.trace import Sender
from mmsverify.model.rows import PLUS
from mmsverify.results import PathStep

SERVICES = {
    "create": "createProgramInvocation", "delete": "deleteProgramInvocation", "kill": "kill",
    "start": "start",
    "stop": "stop", "resume": "resume", "reset": "reset", "select": "select", "vmd_stop": "vMDStop",
    "vmd_reset": "vMDReset", "take_control": "takeControl", "relinquish_control": "relinquishControl",
    "alter": "alterPI", "write": "write",
    "start_fails": "start", "stop_fails": "stop", "resume_fails": "resume",
    "reset_fails": "reset",
    "initiate_download": "initiateDownloadSequence", "segment_given": "downloadSegment",
    "segment_failed": "downloadSegment", "download_terminated": "terminateDownloadSequence",
    "initiate_upload": "initiateUploadSequence", "upload_segment": "uploadSegment",
    "terminate_upload": "terminateUploadSequence", "load_domain": "loadDomainContent",
    "store_domain": "storeDomainContent", "delete_domain": "deleteDomain",
}  # fmt: skip
INDICATIONS = {
    "start_indicated": "start", "stop_indicated": "stop", "resume_indicated": "resume",
    "reset_indicated": "reset",
    "t101": "select", "t104": "select",
}  # fmt: skip
OBSERVER = "observer"
"""Who asks for the state at both ends: an association of its own that the recording finds in being."""


class Sent(NamedTuple):
    """One message: on which association, by which side."""

    association: str
    sender: Sender
    pdu: Pdu


def conversation(steps: Sequence[PathStep]) -> list[Sent]:
    """The messages of a run, from its initial state on."""
    return list(_Speaker(steps).speak())


def profile_of(first: PathStep) -> dict[str, str]:
    """What the run assumes of the robot, as the metadata record of a trace states it."""
    state = first.state
    predefined = [
        {
            "name": name,
            "control": state[f"predefined_control[{name}]"],
            "domains": domain_messages.bound(name, state, "predefined_uses", "predefined_arm"),
            "deletable": state[f"predefined_deletable[{name}]"],
            "reusable": state[f"predefined_reusable[{name}]"],
        }
        for name in messages.programs(state)
        if state[f"predefined[{name}]"]
    ]
    chosen = [name for name in messages.programs(state) if state[f"selected_at_power_on[{name}]"]]
    return {
        "model": "mms-robot",
        "associations": "single" if state["single_association"] else "multiple",
        "step_limited": json.dumps(state["step_limited"]),
        "single_task": json.dumps(state["single_task"]),
        "predefined": json.dumps(predefined),
        "selected_at_power_on": chosen[0] if chosen else "",
    }


class _Speaker:
    """Turns steps into messages; remembers which requests wait for an answer, and the last invoke id."""

    def __init__(self, steps: Sequence[PathStep]) -> None:
        self.steps = steps
        self.waiting: dict[tuple[str, str], int] = {}
        self.last_id = 0
        first = steps[0].state
        self.calibrated = [d for d in messages.devices(first) if first[f"needs_calibration[{d}]"]]

    def speak(self) -> Iterator[Sent]:
        last = len(self.steps) - 1
        yield from self._show(self.steps[0])
        for number in range(1, last + 1):
            if number == last > 1:
                yield from self._show(self.steps[number - 1])
            yield from self._step(number)
        if last:
            yield from self._show(self.steps[last])

    def _show(self, step: PathStep) -> Iterator[Sent]:
        """All that the robot tells when it is asked, each answered with what the step leads to."""
        yield Sent(OBSERVER, "client", messages.request(self._id(), "status", {}))
        yield Sent(OBSERVER, "server", messages.answer(self.last_id, "status", {}, PLUS, step.state))
        for name in messages.programs(step.state):
            asked = messages.request(self._id(), "getProgramInvocationAttributes", {"pi": name})
            yield Sent(OBSERVER, "client", asked)
            yield Sent(OBSERVER, "server", messages.attributes(self.last_id, name, step.state))
        programs = messages.programs(step.state)
        for name in domain_messages.domains(step.state):
            asked = messages.request(self._id(), "getDomainAttributes", {"domain": name})
            yield Sent(OBSERVER, "client", asked)
            shown = domain_messages.attributes(self.last_id, name, step.state, programs)
            yield Sent(OBSERVER, "server", shown)
        values = messages.variables(step.state, self.calibrated)
        asked = messages.request(self._id(), "read", {"variables": list(values)})
        yield Sent(OBSERVER, "client", asked)
        yield Sent(OBSERVER, "server", messages.values(self.last_id, list(values.values())))
        yield Sent(OBSERVER, "client", messages.request(self._id(), "reportSemaphoreStatus", {}))
        told = messages.answer(self.last_id, "reportSemaphoreStatus", {}, PLUS, step.state)
        yield Sent(OBSERVER, "server", told)

    def _id(self) -> int:
        self.last_id += 1
        return self.last_id

    def _step(self, number: int) -> Iterator[Sent]:
        step = self.steps[number]
        row, _, result = step.action.partition(" ")
        if row in INDICATIONS:
            yield self._ask(number, INDICATIONS[row])
        elif row in SERVICES and not step.arguments.get("panel"):
            yield from self._perform(step, SERVICES[row], result)
        elif row in ("initiate", "release"):
            yield from self._associate(step, row, result)
        else:
            yield from self._inside(number)

    def _ask(self, number: int, service: str) -> Sent:
        """The request of an indication; what that does not say is taken from the answer that follows."""
        step = self.steps[number]
        request = str(step.arguments["request"])
        later = (s for s in self.steps[number + 1 :] if _answers(s, service, request))
        whole = next(later, step)
        self.waiting[request, service] = self._id()
        user = str(whole.arguments.get("user", OBSERVER))
        return Sent(user, "client", messages.request(self.last_id, service, whole.arguments))

    def _perform(self, step: PathStep, service: str, result: str) -> Iterator[Sent]:
        user = str(step.arguments["user"])
        sides: tuple[Sender, Sender] = ("server", "client")
        asking, answering = sides if service in FROM_ROBOT else reversed(sides)
        asked = self.waiting.pop((str(step.arguments.get("request")), service), None)
        if asked is None:
            asked = self._id()
            yield Sent(user, asking, messages.request(asked, service, step.arguments))
        yield Sent(user, answering, messages.answer(asked, service, step.arguments, result, step.state))

    def _associate(self, step: PathStep, row: str, result: str) -> Iterator[Sent]:
        user = str(step.arguments["user"])
        if row == "release":
            yield Sent(user, "client", Pdu("conclude-RequestPDU"))
            yield Sent(user, "server", Pdu("conclude-ResponsePDU"))
        elif result == PLUS:
            yield Sent(user, "client", messages.initiation("Request"))
            yield Sent(user, "server", messages.initiation("Response"))

    def _inside(self, number: int) -> Iterator[Sent]:
        before, after = self.steps[number - 1].state, self.steps[number].state
        if messages.unsolicited_status(before) != messages.unsolicited_status(after):
            yield Sent(OBSERVER, "server", messages.unsolicited_status(after))


def _answers(step: PathStep, service: str, request: str) -> bool:
    row = step.action.partition(" ")[0]
    return SERVICES.get(row) == service and step.arguments.get("request") == request
