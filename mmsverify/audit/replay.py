"""The replay of one recording: which channel belongs to which device, which model judges it, what is skipped.

What a message means to its device is told in ``device``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import Any

from mmsverify.audit.classes import USUAL, split, whole
from mmsverify.audit.device import Device
from mmsverify.audit.learned import Learned
from mmsverify.audit.lookahead import Lookahead, link
from mmsverify.audit.modbus import Access, Plan, Server
from mmsverify.audit.telling import Place
from mmsverify.audit.vr import Controller, Numbering, Scans
from mmsverify.audit.watching import AUDITING, LOOKING, Stages, stage
from mmsverify.concrete.automaton import Automaton, TooManyStatesError
from mmsverify.concrete.belief import Belief
from mmsverify.concrete.belief.coverage import Coverage
from mmsverify.concrete.belief.partial import OTHER
from mmsverify.concrete.machine import Machine
from mmsverify.concrete.scope import scope_for
from mmsverify.errors import ProfileError, UsageError
from mmsverify.formats.mcap import McapTrace
from mmsverify.formats.trace import Channel, TraceMessage
from mmsverify.model import Claim, ModelData, load
from mmsverify.model.load import made_for
from mmsverify.resources import models_dir
from mmsverify.results import Finding

ROBOT, FRAMEWORK, SIGNALS = "mms-robot", "vr-template", "modbus-signals"
SAMPLES = "vr.Sample"
PROVED = "repaired"
Judge = Callable[[int, int, Channel, bytes], Iterator[Finding] | tuple[()]]
"""Takes a message, by index, time, channel and octets, and gives its findings."""
Tables = Mapping[str, Mapping[str, Any]]


class Replay:
    """One recording under a profile.

    ``exact``: every message is judged by itself, and nothing is learned from those before; the findings are
    the same. ``passed`` is told how far it is. ``messages``, ``events`` and ``skipped`` are counts, true once
    the run is over; ``coverage`` is what the events of each device have exercised.
    """

    def __init__(
        self, trace: McapTrace, tables: Tables, model: str | None, variant: str, *, exact: bool = False,
        passed: Stages | None = None,
    ) -> None:  # fmt: skip
        self.trace = trace
        self.profile = tables.get(ROBOT, {})
        self._exact = exact
        self._asked, self._variant, self._tables = _known(model), variant, tables
        self.messages = self.events = self.skipped = 0
        self.coverage: list[Coverage] = []
        self._devices: dict[str, Learned[Device]] = {}
        self._controllers: dict[str, Controller] = {}
        self._learners: dict[Controller, Learned[Controller]] = {}
        self._servers: dict[str, Server] = {}
        self._ahead = Lookahead(trace.watched(stage(LOOKING, passed)))
        self._judged = trace.watched(stage(AUDITING, passed))

    def run(self) -> Iterator[Finding]:
        """The findings, in event order."""
        judges: dict[int, Judge] = {}
        channels = []  # kept, so that no two have the same identity
        index = -1
        try:
            for batch in self._judged.batches():
                for time, _, channel, data in batch:
                    index += 1
                    judge = judges.get(id(channel))
                    if judge is None:
                        channels.append(channel)
                        judge = judges[id(channel)] = self._judge(channel)
                    found = judge(index, time, channel, data)
                    if found:
                        yield from found
        finally:
            self.messages = index + 1
            self.events = self.messages - self.skipped
        for server in self._servers.values():
            yield from server.end()

    def _judge(self, channel: Channel) -> Judge:
        """Who judges the messages of a channel."""
        encoding, names = channel.message_encoding, channel.metadata
        if encoding == "mms-ber" and self._asked in (None, ROBOT):
            return self._device(names.get("vmd", "")).listener(USUAL, split)
        if channel.schema_name == SAMPLES and self._asked in (None, FRAMEWORK):
            return self._learned(channel).listener({}, whole)
        if encoding == "modbus-tcp" and self._asked in (None, SIGNALS):
            return _whole(self._server(names.get("controller", "")).message)
        return _whole(self._beside)

    def _beside(self, message: TraceMessage) -> Iterator[Finding]:
        """A link event, or what nobody knows."""
        if (happened := link(message)) is not None:
            connection, event = happened
            device = self._device(message.metadata.get("name", ""))
            yield from device.beside(lambda part, marked: part.link(connection, event, marked), message)
        elif (happened := link(message, "modbus")) is not None:
            self._server(message.metadata.get("name", "")).link(*happened, message)
        else:
            self.skipped += 1

    def controller(self, channel: Channel) -> Controller:
        """The controller whose samples stand on a channel."""
        name = channel.metadata.get("controller", "")
        if name not in self._controllers:
            scans, numbering = self._framework
            self._controllers[name] = Controller(Place(self.trace.path, name), scans, numbering)
        return self._controllers[name]

    def _learned(self, channel: Channel) -> Learned[Controller]:
        controller = self.controller(channel)
        if controller not in self._learners:
            model = self._framework[0].automaton.machine.model
            self._learners[controller] = Learned(controller, model, Controller.sample, exact=self._exact)
        return self._learners[controller]

    def _server(self, name: str) -> Server:
        if name not in self._servers:
            self._servers[name] = Server(Place(self.trace.path, name), *self._signals)
        return self._servers[name]

    @cached_property
    def _signals(self) -> tuple[Access, Plan]:
        """What the model of the server says of requests, and the plan of signals."""
        model = load(SIGNALS, models_dir(), self._variant)
        return Access(model, scope_for(model, {"Socket": 0, "Client": 0}, {})), Plan(
            self._tables.get(SIGNALS, {})
        )

    @cached_property
    def model(self) -> ModelData:
        """The robot standard; a recording without robots does not load it."""
        return load(ROBOT, models_dir(), self._variant)

    @cached_property
    def _framework(self) -> tuple[Scans, Numbering]:
        """The template framework's automaton, and what its numbers mean."""
        profile = self._tables.get(FRAMEWORK, {})
        model = made_for(load(FRAMEWORK, models_dir(), self._variant), profile)
        numbering = Numbering(model.options["numbers"], profile.get("sub_action_status", "either"))
        # A recording may begin at any time, and of a controller that kept its homing while it was off.
        try:
            automaton = Automaton(Machine(model, scope_for(model, {}, {})))
        except TooManyStatesError:
            cause = "too many commands of the user's that change the homing for an audit"
            cure = "list those that the recording shows"
            raise ProfileError(cause, place=f"{FRAMEWORK}.commands", cure=cure) from None
        return Scans(automaton), numbering

    def _device(self, vmd: str) -> Learned[Device]:
        if vmd not in self._devices:
            scenario = self.model.options["scenario"]
            predefined = self.profile.get("predefined", ())
            domains = {domain for entry in predefined for domain in entry.get("domains", ())}
            sizes = {"PI": len(predefined), "Client": 0, "Request": 0, "Domain": len(domains)}
            _, facts = scenario(sizes, self.profile)
            # R_CAL is a predefined name (8.3.2), and so are the standardized domains (8.2): of what the
            # profile does not predefine nothing calibrates, and nothing is one of them.
            facts = {**facts, ("calibrates", (OTHER,)): False, ("standard_domain", (OTHER,)): False}
            # Lists at power-on tell nothing of a recording that may begin at any time.
            facts = {key: held for key, held in facts.items() if key[0] != "predefined_controls"}
            base = frozenset(name for owner, name in self._ahead.base_only if owner == vmd)
            belief = Belief(self.model, facts, self._proved())
            if not belief.states:
                raise ProfileError(
                    "no robot can have what the profile says: it contradicts what the standard fixes",
                    place=self.trace.path,
                    cure="run mmsverify check mms-robot with this profile: it names the clause",
                )
            self.coverage.append(belief.coverage)
            place = Place(self.trace.path, vmd)
            device = Device(place, belief, self._arms(), base, self._ahead.blind(vmd))
            until = max((last for _, last in device.blind), default=-1)
            self._devices[vmd] = Learned(device, self.model, Device.message, exact=self._exact, blind=until)
        return self._devices[vmd]

    def _proved(self) -> tuple[Claim, ...]:
        """The invariants to rely upon: those of the repaired reading are proved, the text's own are not."""
        return self.model.always if self.model.variant == PROVED else ()

    def _arms(self) -> frozenset[str]:
        """The domains that represent an arm: those of the arms among the devices of the profile."""
        devices = self.profile.get("devices", ())
        return frozenset(device["domain"] for device in devices if device["kind"] == "arm")


def _whole(judge: Callable[[TraceMessage], Iterator[Finding]]) -> Judge:
    """A judge of whole messages."""
    return lambda index, time, channel, data: judge(TraceMessage(index, time, channel, data))


def _known(model: str | None) -> str | None:
    if model not in (None, ROBOT, FRAMEWORK, SIGNALS):
        cure = f"use {ROBOT}, {FRAMEWORK} or {SIGNALS}"
        raise UsageError(f"no model {model!r} replays recordings", place="--model", cure=cure)
    return model
