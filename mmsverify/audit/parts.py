"""What is audited, under one profile: robots, controllers, servers, each with the model that judges it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, TypeVar

from mmsverify.audit.device import Device
from mmsverify.audit.learning.lasting import Lasting
from mmsverify.audit.learning.tables import Tables as LearnedTables
from mmsverify.audit.modbus import Access, Plan, Server
from mmsverify.audit.telling import History, Place
from mmsverify.audit.vr import Controller, Numbering, Scans
from mmsverify.concrete.automaton import Automaton, TooManyStatesError
from mmsverify.concrete.belief import Belief
from mmsverify.concrete.belief.partial import OTHER
from mmsverify.concrete.machine import Machine
from mmsverify.concrete.scope import scope_for
from mmsverify.errors import ProfileError
from mmsverify.model import Claim, ModelData, load
from mmsverify.model.load import made_for
from mmsverify.resources import models_dir

ROBOT, FRAMEWORK, SIGNALS = "mms-robot", "vr-template", "modbus-signals"
PROVED = "repaired"
Tables = Mapping[str, Mapping[str, Any]]
D = TypeVar("D", bound=Device)


class Parts:
    """Makes them. ``lasting`` is what was made for other recordings; ``path`` is named in errors."""

    def __init__(self, tables: Tables, variant: str, lasting: Lasting, path: str) -> None:
        self._tables, self._variant, self._lasting, self._path = tables, variant, lasting, path
        self.profile = tables.get(ROBOT, {})

    def _load(self, name: str) -> ModelData:
        return load(name, models_dir(), self._variant)

    # Robots.

    @cached_property
    def model(self) -> ModelData:
        """The robot standard; a recording without robots does not load it."""
        return self._load(ROBOT)

    @cached_property
    def robot_tables(self) -> LearnedTables:
        """What was learned of robots under this profile."""
        # The model is part of what is kept: no other one can have its identity.
        _, tables = self._lasting.get(
            ("learned", id(self.model), repr(self.profile)),
            lambda: (self.model, LearnedTables(self.model, Device.SHARED)),
        )
        return tables

    def device(
        self, place: Place, base_only: frozenset[str], blind: Sequence[tuple[int, int]], history: History
    ) -> Device:
        """A robot of which the recording has not shown anything yet; the rest as in `Device`."""
        return self.device_of(Device, place, base_only, blind, history)

    def device_of(
        self,
        kind: type[D],
        place: Place,
        base_only: frozenset[str],
        blind: Sequence[tuple[int, int]],
        history: History,
    ) -> D:
        """The same, of a class that is more than a `Device`."""
        belief = Belief(self.model, self._facts(), self._proved())
        if not belief.states:
            raise ProfileError(
                "no robot can have what the profile says: it contradicts what the standard fixes",
                place=self._path,
                cure="run mmsverify check mms-robot with this profile: it names the clause",
            )
        return kind(place, belief, self._arms(), base_only=base_only, blind=blind, history=history)

    def _facts(self) -> dict[Any, Any]:
        scenario = self.model.options["scenario"]
        predefined = self.profile.get("predefined", ())
        domains = {domain for entry in predefined for domain in entry.get("domains", ())}
        sizes = {"PI": len(predefined), "Client": 0, "Request": 0, "Domain": len(domains)}
        _, facts = scenario(sizes, self.profile)
        # R_CAL is a predefined name (8.3.2), and so are the standardized domains (8.2): of what the profile
        # does not predefine nothing calibrates, and nothing is one of them.
        facts = {**facts, ("calibrates", (OTHER,)): False, ("standard_domain", (OTHER,)): False}
        # Lists at power-on tell nothing of a recording that may begin at any time.
        return {key: held for key, held in facts.items() if key[0] != "predefined_controls"}

    def _proved(self) -> tuple[Claim, ...]:
        """The invariants to rely upon: those of the repaired reading are proved, the text's own are not."""
        return self.model.always if self.model.variant == PROVED else ()

    def _arms(self) -> frozenset[str]:
        """The domains that represent an arm: those of the arms among the devices of the profile."""
        devices = self.profile.get("devices", ())
        return frozenset(device["domain"] for device in devices if device["kind"] == "arm")

    # Controllers of the template framework.

    def controller(self, place: Place, history: History | None = None) -> Controller:
        """A controller of which the recording has not shown anything yet."""
        scans, numbering, _ = self._framework
        return Controller(place, scans, numbering, history)

    @property
    def numbering(self) -> Numbering:
        """What the numbers in a controller's cells mean under this profile."""
        return self._framework[1]

    @property
    def framework_tables(self) -> LearnedTables:
        """What was learned of controllers under this profile."""
        return self._framework[2]

    @cached_property
    def _framework(self) -> tuple[Scans, Numbering, LearnedTables]:
        profile = self._tables.get(FRAMEWORK, {})
        return self._lasting.get(("framework", self._variant, repr(profile)), lambda: self._made(profile))

    def _made(self, profile: Mapping[str, Any]) -> tuple[Scans, Numbering, LearnedTables]:
        """The template framework's automaton, what its numbers mean, and tables that are empty yet."""
        model = made_for(self._load(FRAMEWORK), profile)
        numbering = Numbering(model.options["numbers"], profile.get("sub_action_status", "either"))
        # A recording may begin at any time, and of a controller that kept its homing while it was off.
        try:
            automaton = Automaton(Machine(model, scope_for(model, {}, {})))
        except TooManyStatesError:
            cause = "too many commands of the user's that change the homing for an audit"
            cure = "list those that the recording shows"
            raise ProfileError(cause, place=f"{FRAMEWORK}.commands", cure=cure) from None
        return Scans(automaton), numbering, LearnedTables(model, Controller.SHARED)

    # Servers of signals.

    def server(self, place: Place) -> Server:
        """A Modbus server of which the recording has not shown anything yet."""
        return Server(place, *self._signals)

    @cached_property
    def _signals(self) -> tuple[Access, Plan]:
        """What the model of the server says of requests, and the plan of signals."""
        model = self._load(SIGNALS)
        access = Access(model, scope_for(model, {"Socket": 0, "Client": 0}, {}))
        return access, Plan(self._tables.get(SIGNALS, {}))
