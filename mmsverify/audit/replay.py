"""The replay of one recording: which channel belongs to which device, which model judges it, what is skipped.

What a message means to its device is told in ``device``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Protocol

from mmsverify.audit.device import Device
from mmsverify.audit.learning import part
from mmsverify.audit.learning.classes import split, whole
from mmsverify.audit.learning.lasting import Lasting
from mmsverify.audit.learning.learned import Learned, Listener, Span
from mmsverify.audit.learning.walk import Walk
from mmsverify.audit.lookahead import INITIATES, Lookahead, association, link, offers_additional
from mmsverify.audit.modbus import Server
from mmsverify.audit.parts import FRAMEWORK, ROBOT, SIGNALS, Parts, Tables
from mmsverify.audit.telling import History, Place
from mmsverify.audit.vr import Controller
from mmsverify.audit.whose import SAMPLES
from mmsverify.concrete.belief.coverage import Coverage
from mmsverify.errors import InputError, UsageError
from mmsverify.formats.mcap import McapTrace
from mmsverify.formats.passing import AUDITING, LOOKING, Stages, Tick, stage
from mmsverify.formats.stretch import DisorderError, Stretch
from mmsverify.formats.trace import Channel, TraceMessage
from mmsverify.results import Finding

if TYPE_CHECKING:
    from mmsverify.audit.learning.kernel import Kernel

LONG = 16 << 20
"""From so many octets on, a recording is worth the time that it takes to make the compiled loops ready."""
Judge = Listener | Callable[[TraceMessage, Stretch], Iterator[Finding]]
"""Takes the messages of a channel, and gives their findings."""


class Watch(Protocol):
    """Is told what is known of the devices of a recording while it is replayed."""

    def begin(self) -> None:
        """The run begins, or begins again: forget what was told."""

    def of(self, device: str, model: str) -> part.Watch:
        """Who is to be told of one device, which that model judges."""


class _AgainError(Exception):
    """What has been judged was judged without knowing what the recording shows later."""


class Replay:
    """One recording under a profile.

    ``exact``: every message is judged by itself, and nothing is learned from those before; the findings are
    the same. ``lasting``: what has been loaded and learned for other recordings. ``kernel``: whether compiled
    loops follow what was learned; where nothing is said, if they are installed and the recording is long.
    ``passed`` is told how far it is. ``watch`` is told what is known of each device, from message to message,
    and that a run begins again, after which what it has told counts no more. ``messages``, ``events`` and
    ``skipped`` are counts, true once the run is over; ``coverage`` is what the events of each device have
    exercised, as far as they were not known.
    """

    def __init__(
        self,
        trace: McapTrace,
        tables: Tables,
        model: str | None,
        variant: str,
        *,
        exact: bool = False,
        lasting: Lasting | None = None,
        kernel: bool | None = None,
        passed: Stages | None = None,
        watch: Watch | None = None,
    ) -> None:
        self.trace = trace
        self._watch = watch
        # Who is watched learns by itself: what others have learned does not say what is known in it.
        self._lasting = lasting or Lasting() if watch is None else Lasting()
        self.parts = Parts(tables, variant, self._lasting, trace.path)
        self._exact, self._asked = exact, _known(model)
        self._ahead: Lookahead | None = None
        self._merged = False
        self._passed, self._tick = passed, Tick(stage(AUDITING, passed))
        self._walk = self._quick_way(kernel if watch is None else False)
        self._begin()

    def _quick_way(self, kernel: bool | None) -> Walk | Kernel:
        """By compiled loops where they are installed and worth it, or wanted."""
        if kernel is False or self._exact or (kernel is None and self.trace.octets < LONG):
            return Walk()
        try:
            from mmsverify.audit.learning.kernel import Kernel
            from mmsverify.audit.learning.mirror import Mirror
        except ImportError:
            if kernel:
                raise UsageError(
                    "the compiled loops are not installed",
                    place="--kernel",
                    cure="pip install 'mmsverify[fast]'",
                ) from None
            return Walk()
        return Kernel(self._lasting.get("mirror", Mirror))

    def _begin(self) -> None:
        self.messages = self.events = self.skipped = 0
        self.coverage: list[Coverage] = []
        self._devices: dict[str, Learned[Device]] = {}
        self._controllers: dict[str, Controller] = {}
        self._learners: dict[str, Learned[Controller]] = {}
        self._servers: dict[str, Server] = {}
        self._sure: set[tuple[str, str]] = set()
        self._judges: dict[int, tuple[Channel, Judge]] = {}
        if self._watch is not None:
            self._watch.begin()

    def run(self) -> Iterator[Finding]:
        """The findings, in event order; none before all are known, for it may be that all begins again."""
        found: list[Finding] = []
        try:
            while not self._through(found):
                self._begin()
                found.clear()
        except InputError:
            yield from found
            raise
        self._tick.end()
        yield from found

    def _through(self, found: list[Finding]) -> bool:
        """Judge all messages; false where that must begin again with what is known now."""
        try:
            for stretch in self.trace.stretches(merged=self._merged):
                try:
                    found += self._stretch(stretch)
                    self._tick(stretch.octets(stretch.size), stretch.index + len(stretch.places))
                finally:
                    self.messages = stretch.index + len(stretch.places)
                    self.events = self.messages - self.skipped
        except DisorderError:
            assert not self._merged, "what has been brought into order is in order"
            self._merged = True
            return False
        except _AgainError:
            return False
        for server in self._servers.values():
            found += server.end()
        return True

    def _stretch(self, stretch: Stretch) -> Iterator[Finding]:
        at = 0
        self._walk.start(stretch)
        while at < stretch.size:
            at = self._walk.follow(stretch, at)
            if at == stretch.size:
                break
            if stretch.defines(at):
                self._catch_up(stretch)  # while the messages passed still have their channels
            number = stretch.number(at)
            at, message = stretch.next(at)
            self._tick(stretch.octets(at), stretch.index + len(stretch.places))
            if message is None:
                self._walk.begin()  # it may have defined a channel anew
                continue
            judge = self._judge(message, stretch)
            if isinstance(judge, Listener):
                self._walk.route(number, judge)
                yield from judge.hear(message, stretch)
            else:
                yield from judge(message, stretch)
        self._catch_up(stretch)

    def _catch_up(self, stretch: Stretch) -> None:
        for device in self._devices.values():
            device.catch_up(stretch)
        for controller in self._learners.values():
            controller.catch_up(stretch)

    def _judge(self, message: TraceMessage, stretch: Stretch) -> Judge:
        """Who judges the messages of the message's channel."""
        channel = message.channel
        known = self._judges.get(id(channel))
        if known is None:
            known = self._judges[id(channel)] = channel, self._judge_of(message, stretch)
        return known[1]

    def _judge_of(self, message: TraceMessage, stretch: Stretch) -> Judge:
        names = message.metadata
        if message.message_encoding == "mms-ber" and self._asked in (None, ROBOT):
            self._meet(message, stretch)
            role = names.get("association", ""), names.get("sender", "client")
            return self._device(names.get("vmd", "")).listener(role, split, message.topic)
        if message.schema_name == SAMPLES and self._asked in (None, FRAMEWORK):
            return self._learned(message.channel).listener(names.get("sampling", ""), whole)
        if message.message_encoding == "modbus-tcp" and self._asked in (None, SIGNALS):
            server = self._server(names.get("controller", ""))
            return lambda said, _: server.message(said)
        return self._beside

    def _meet(self, message: TraceMessage, stretch: Stretch) -> None:
        """See an association for the first time: most begin with an Initiate that shows a robot (RP-31).

        Of any other it takes what the recording shows later to know what it is, and what it lacks.
        """
        key = association(message.channel)
        if key is None or key in self._sure or self._ahead is not None:
            return
        if message.data[:1] in INITIATES and offers_additional(message.data):
            self._sure.add(key)
        else:
            self._look_ahead(message.index, stretch)

    def _look_ahead(self, index: int, stretch: Stretch) -> None:
        tick = Tick(stage(LOOKING, self._passed))
        self._ahead = Lookahead(self.trace, merged=self._merged, tick=tick)
        for vmd, learned in self._devices.items():
            spans = self._ahead.blind(vmd)
            if any(first < index for first, _ in spans):
                raise _AgainError
            device = learned.awake(stretch)
            device.base_only, device.blind = self._base_only(vmd), tuple(spans)
            learned.blinded(spans)

    def _base_only(self, vmd: str) -> frozenset[str]:
        keys = self._ahead.base_only if self._ahead is not None else ()
        return frozenset(name for device, name in keys if device == vmd)

    def _beside(self, message: TraceMessage, stretch: Stretch) -> Iterator[Finding]:
        """A link event, or what nobody knows."""
        if (happened := link(message)) is not None:
            if happened[1] == "gap" and self._ahead is None:
                self._look_ahead(message.index, stretch)
            device = self._device(message.metadata.get("name", ""))
            classes = self.parts.robot_tables.classes("link")
            yield from device.hear(message, stretch, whole(message.data), classes, _link)
        elif (happened := link(message, "modbus")) is not None:
            self._server(message.metadata.get("name", "")).link(*happened, message)
        else:
            self.skipped += 1

    def controller(self, channel: Channel) -> Controller:
        """The controller whose samples stand on a channel."""
        name = channel.metadata.get("controller", "")
        if name not in self._controllers:
            self._controllers[name] = self.parts.controller(Place(self.trace.path, name))
        return self._controllers[name]

    def _learned(self, channel: Channel) -> Learned[Controller]:
        name = channel.metadata.get("controller", "")
        if name not in self._learners:
            tables, place = self.parts.framework_tables, Place(self.trace.path, name)
            self._learners[name] = Learned(
                partial(self.parts.controller, place),
                tables,
                _sample,
                whole=True,
                exact=self._exact,
                watch=None if self._watch is None else self._watch.of(name, FRAMEWORK),
            )
        return self._learners[name]

    def _server(self, name: str) -> Server:
        if name not in self._servers:
            self._servers[name] = self.parts.server(Place(self.trace.path, name))
        return self._servers[name]

    def _device(self, vmd: str) -> Learned[Device]:
        if vmd not in self._devices:
            blind = self._ahead.blind(vmd) if self._ahead is not None else []
            base_only = self._base_only(vmd)
            self._devices[vmd] = Learned(
                partial(self._new, Place(self.trace.path, vmd), base_only, blind),
                self.parts.robot_tables,
                Device.message,
                kind=(base_only, tuple(blind)),
                exact=self._exact,
                blind=blind,
                watch=None if self._watch is None else self._watch.of(vmd, ROBOT),
            )
        return self._devices[vmd]

    def _new(
        self, place: Place, base_only: frozenset[str], blind: Sequence[Span], history: History
    ) -> Device:
        device = self.parts.device(place, base_only, blind, history)
        self.coverage.append(device.belief.coverage)
        return device


def _sample(controller: Controller, message: TraceMessage, _: object) -> Iterator[Finding]:
    return controller.sample(message)


def _link(device: Device, message: TraceMessage, _: object) -> Iterator[Finding]:
    connection, event = link(message) or ("", "")
    return device.link(connection, event, message)


def _known(model: str | None) -> str | None:
    if model not in (None, ROBOT, FRAMEWORK, SIGNALS):
        cure = f"use {ROBOT}, {FRAMEWORK} or {SIGNALS}"
        raise UsageError(f"no model {model!r} replays recordings", place="--model", cure=cure)
    return model
