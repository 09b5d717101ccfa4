"""A client at work, one request after the other: the sentences that written conversations are made of."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from independent import views
from independent.controller import Controller
from independent.objects import ARM
from independent.server import ADDITIONAL, OF_CLIENT, SEMAPHORES, SERVICES, Outcome, perform, positive
from independent.tape import Tape
from mmsverify.formats.mms import Pdu, bit_string
from mmsverify.samples import pdus

Change = Callable[[Pdu], Pdu]


def initiation(sort: str, services: tuple[str, ...], additional: tuple[str, ...], outstanding: int) -> Pdu:
    """An Initiate with the parameters of the base class (9.2.2.3)."""
    pdu = pdus.initiation(sort, services, additional, outstanding)
    word = {"Request": "proposed", "Response": "negotiated"}[sort]
    inner = {
        **pdu.body[f"init{sort}Detail"],
        f"{word}ParameterCBB": bit_string("ParameterSupportOptions", ["str1", "str2", "vnam"], 11),
    }
    body = {**pdu.body, f"{word}DataStructureNestingLevel": 2, f"init{sort}Detail": inner}
    return Pdu(pdu.kind, body=body)


@dataclass
class Desk:
    """One association with one robot."""

    tape: Tape
    robot: Controller
    name: str = "a1"
    outstanding: int = 3
    services: tuple[str, ...] = ()
    additional: tuple[str, ...] = ADDITIONAL
    invoke: int = 0
    of_robot: int = 0
    asked: list[Pdu] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.services = self.services or SERVICES + (SEMAPHORES if self.robot.several else ())

    # The association.

    def open(self, *, link: bool = True) -> Desk:
        if link:
            self.tape.link(self.name, "open")
        self.invoke = 0
        self.say("client", initiation("Request", OF_CLIENT, (), self.outstanding))
        self.say("server", initiation("Response", self.services, self.additional, self.outstanding))
        return self

    def close(self) -> None:
        self.say("client", Pdu("conclude-RequestPDU"))
        self.say("server", Pdu("conclude-ResponsePDU"))
        self.tape.link(self.name, "close")
        self.gone()

    def abort(self) -> None:
        self.tape.link(self.name, "reset")
        self.gone()

    def gone(self) -> None:
        """The association has ended: R_CTRL is free (RP-16), what it loaded is lost."""
        if self.robot.owner == self.name:
            self.robot.owner = None
        for domain in list(self.robot.domains.values()):
            if domain.link == self.name and domain.state != "ready":
                del self.robot.domains[domain.name]

    # What is said.

    def say(self, sender: Any, pdu: Pdu, octets: bytes | None = None) -> int:
        return self.tape.say(self.name, sender, pdu, octets)

    def request(self, service: str, body: Any = None, detail: Any = None) -> Pdu:
        """Send a request and do not wait."""
        self.invoke += 1
        pdu = Pdu("confirmed-RequestPDU", self.invoke, service, body, detail)
        self.say("client", pdu)
        return pdu

    def perform(self, asked: Pdu) -> Outcome:
        named = "alterProgramInvocationAttributes" if asked.service == "alterPI" else asked.service
        return perform(self.robot, self.name, asked, supported=named in self.services + self.additional)

    def ask(self, service: str, body: Any = None, detail: Any = None) -> Outcome:
        """A request and the robot's right answer."""
        outcome = self.perform(self.request(service, body, detail))
        self.say("server", outcome.pdu)
        return outcome

    def does(self, service: str, body: Any = None, detail: Any = None) -> None:
        """The same, and it must be a positive answer."""
        outcome = self.ask(service, body, detail)
        assert outcome.pdu.kind == "confirmed-ResponsePDU", (service, body, outcome.why)

    def refused(self, service: str, body: Any = None, detail: Any = None) -> str:
        """The same, and it must be a negative answer; why is told."""
        outcome = self.ask(service, body, detail)
        assert outcome.pdu.kind != "confirmed-ResponsePDU", (service, body)
        return outcome.why

    def tell(self, service: str, body: Any, detail: Any = None) -> int:
        """The robot says something unasked."""
        return self.say("server", Pdu("unconfirmed-PDU", None, service, body, detail))

    def serve(self, service: str, body: Any, gives: Any) -> None:
        """A request of the robot and its answer."""
        self.of_robot += 1
        asked = Pdu("confirmed-RequestPDU", self.of_robot, service, body)
        self.say("server", asked)
        self.say("client", positive(asked, gives))

    # Faults.

    def accepts(
        self, service: str, body: Any = None, detail: Any = None, *, why: str = "", gives: Any = None
    ) -> None:
        """The robot answers positively what it must refuse, and does nothing."""
        asked = self.request(service, body, detail)
        outcome = self.perform(asked)
        assert outcome.why, (service, body, "is rightly accepted")
        assert not why or outcome.why == why, (outcome.why, why)
        self.say("server", positive(asked, gives))
        self.tape.wrong()

    def refuses(self, service: str, body: Any = None, detail: Any = None, *, cause: tuple[str, str]) -> None:
        """The robot refuses what nothing stands against, and does nothing."""
        asked = self.request(service, body, detail)
        assert asked.invoke_id is not None
        info = (service, self.state_of(body)) if service in ("start", "stop", "resume", "reset") else None
        self.say("server", pdus.failure(asked.invoke_id, cause, info))
        self.tape.wrong()

    def lies(self, change: Change, service: str, body: Any = None, detail: Any = None) -> None:
        """The robot answers, but not what is so."""
        outcome = self.perform(self.request(service, body, detail))
        assert outcome.pdu.kind == "confirmed-ResponsePDU", outcome
        self.say("server", change(outcome.pdu))
        self.tape.wrong()

    def state_of(self, body: Any) -> str:
        return self.robot.programs[body["programInvocationName"]].state

    def absent(self, *names: str) -> None:
        """It is shown that no program invocation and no domain has these names."""
        for name in names:
            self.refused("getProgramInvocationAttributes", name)
            self.refused("getDomainAttributes", name)
        self.status()

    # Sentences.

    def status(self) -> None:
        self.does("status", False)

    def unasked(self) -> None:
        """The robot tells its status."""
        body, detail = views.status(self.robot)
        self.tell("unsolicitedStatus", body, detail)

    def attributes(self, *names: str) -> None:
        for name in names or sorted(self.robot.programs):
            self.does("getProgramInvocationAttributes", name)

    def look(self) -> None:
        """Everything that the robot shows of itself and its programs."""
        if self.robot.logical == 2:
            self.status()
            return
        if self.robot.several:
            self.does("reportSemaphoreStatus", pdus.vmd("R_CTRL"))
        self.attributes()
        self.status()

    def read(self, *items: str) -> None:
        self.does("read", pdus.reading(*map(name_of, items)))

    def download(self, domain: str, *, sharable: bool = False) -> None:
        self.does("initiateDownloadSequence", download(domain, sharable))
        self.segments(domain)

    def segments(self, domain: str) -> None:
        """The robot asks for what is left and ends the download."""
        loading = self.robot.domains[domain]
        while loading.left:
            loading.left -= 1
            gives = {"loadData": ("non-coded", b"MOVE"), "moreFollows": loading.left > 0}
            self.serve("downloadSegment", domain, gives)
        loading.state = "complete"
        self.serve("terminateDownloadSequence", {"domainName": domain}, None)
        loading.state, loading.link = "ready", ""

    def create(self, name: str, kind: int = 1) -> None:
        if name not in self.robot.domains:
            self.download(name)
        self.does("createProgramInvocation", creation(name), kind or None)

    def select(self, name: str | None, *members: str) -> None:
        self.does("select", selection(name, *members))

    def run(self, service: str, name: str, detail: Any = None) -> None:
        self.does(service, named(name), detail)

    def start(self, name: str, kind: str = "noLimit", value: int | None = None) -> None:
        self.run("start", name, starting(kind, value))

    # Situations.

    def loaded(self, *names: str) -> None:
        """Programs are there, none is selected."""
        for name in names or ("PAINT",):
            self.create(name)
        self.look()

    def ready(self, name: str = "PAINT", *members: str) -> None:
        """A program is selected with the arm."""
        self.loaded(name)
        self.select(name, ARM, *members)
        self.look()

    def executing(self, name: str = "PAINT", kind: str = "noLimit", value: int | None = None) -> None:
        self.ready(name)
        self.start(name, kind, value)
        self.look()

    def paused(self, name: str = "PAINT") -> None:
        """The arm was stopped, the program runs."""
        self.executing(name)
        self.run("stop", ARM)
        self.look()

    def standing(self, name: str = "PAINT") -> None:
        """Arm and program were stopped."""
        self.paused(name)
        self.run("stop", name)
        self.look()

    def panel(self, *, local: bool) -> None:
        """The operator takes or gives back local control, and the robot tells."""
        self.robot.local = local
        self.robot.logical = 1 if local or self.robot.intervention else 0
        self.unasked()

    def emergency(self, logical: int = 1) -> None:
        self.robot.emergency(logical)
        self.unasked()

    def recover(self, *, keep: bool = True) -> None:
        self.robot.recover(keep=keep)
        self.unasked()


def named(name: str) -> dict[str, str]:
    return {"programInvocationName": name}


def creation(name: str, *domains: str, reusable: bool = True) -> dict[str, Any]:
    return {"programInvocationName": name, "listOfDomainNames": list(domains) or [name], "reusable": reusable}


def selection(name: str | None, *members: str) -> dict[str, Any]:
    return {} if name is None else {"controlling": name, "controlled": list(members)}


def starting(kind: str = "noLimit", value: int | None = None) -> tuple[str, Any]:
    return "controlling", {"startCount": (kind, value)}


def resuming(kind: str = "continueMode", value: int | None = None) -> tuple[str, Any]:
    mode = (kind, None) if kind == "continueMode" else ("changeMode", (kind, value))
    return "controlling", {"modeType": mode}


def altering(name: str, kind: str = "noLimit", value: int | None = None) -> dict[str, Any]:
    return {"programInvocation": name, "startCount": (kind, value)}


def download(domain: str, sharable: bool = False) -> dict[str, Any]:
    return {"domainName": domain, "listOfCapabilities": [], "sharable": sharable}


def loading(domain: str) -> dict[str, Any]:
    return {"domainName": domain, "sharable": False, "fileName": ["LIB", domain]}


def name_of(item: str) -> tuple[str, Any]:
    """``R_VPWR`` of the VMD, ``R_ARM.R_NJ`` of a domain."""
    domain, _, inner = item.partition(".")
    return pdus.of_domain(domain, inner) if inner else pdus.vmd(item)


def writing(item: str, value: tuple[str, Any]) -> dict[str, Any]:
    return {"variableAccessSpecification": pdus.variables(pdus.vmd(item)), "listOfData": [value]}


def control() -> dict[str, Any]:
    return {
        "semaphoreName": pdus.vmd("R_CTRL"), "priority": 64, "acceptableDelay": 0,
        "relinquishIfConnectionLost": True,
    }  # fmt: skip
