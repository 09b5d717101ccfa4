"""The replay of one recording: which channel belongs to which device, which model judges it, what is skipped.

What a message means to its device is told in ``device``.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from mmsverify.audit.device import Device
from mmsverify.audit.telling import Place
from mmsverify.concrete.belief import Belief
from mmsverify.concrete.belief.coverage import Coverage
from mmsverify.concrete.belief.partial import OTHER
from mmsverify.errors import DecodeError, ProfileError, UsageError
from mmsverify.formats import mms
from mmsverify.formats.mcap import McapTrace
from mmsverify.formats.trace import TraceMessage
from mmsverify.model import Claim, ModelData, load
from mmsverify.resources import models_dir
from mmsverify.results import Finding

ROBOT = "mms-robot"
PROVED = "repaired"
Tables = Mapping[str, Mapping[str, Any]]


class Replay:
    """One recording under a profile.

    ``messages``, ``events`` and ``skipped`` are counts, true once the run is over; ``coverage`` is what the
    events of each device have exercised.
    """

    def __init__(self, trace: McapTrace, tables: Tables, model: str | None, variant: str) -> None:
        self.trace = trace
        self.profile = tables.get(ROBOT, {})
        self.model: ModelData = load(_robot_model(model), models_dir(), variant)
        self.messages = self.events = self.skipped = 0
        self.coverage: list[Coverage] = []
        self._devices: dict[str, Device] = {}
        self._base_only = _base_only(trace)

    def run(self) -> Iterator[Finding]:
        """The findings, in event order."""
        for message in self.trace:
            self.messages += 1
            if message.message_encoding == "mms-ber":
                self.events += 1
                yield from self._device(message.metadata.get("vmd", "")).message(message)
            elif (link := _link(message)) is not None:
                self.events += 1
                yield from self._device(message.metadata.get("name", "")).link(*link, message)
            else:
                self.skipped += 1

    def _device(self, vmd: str) -> Device:
        if vmd not in self._devices:
            scenario = self.model.options["scenario"]
            predefined = self.profile.get("predefined", ())
            domains = {domain for entry in predefined for domain in entry.get("domains", ())}
            sizes = {"PI": len(predefined), "Client": 0, "Request": 0, "Domain": len(domains)}
            _, facts = scenario(sizes, self.profile)
            # R_CAL is a predefined name (8.3.2): of what the profile does not predefine nothing calibrates.
            facts = {**facts, ("calibrates", (OTHER,)): False}
            # Lists at power-on tell nothing of a recording that may begin at any time.
            facts = {key: held for key, held in facts.items() if key[0] != "predefined_controls"}
            base = frozenset(name for owner, name in self._base_only if owner == vmd)
            belief = Belief(self.model, facts, self._proved())
            if not belief.states:
                raise ProfileError(
                    "no robot can have what the profile says: it contradicts what the standard fixes",
                    place=self.trace.path,
                    cure="run mmsverify check mms-robot with this profile: it names the clause",
                )
            self.coverage.append(belief.coverage)
            self._devices[vmd] = Device(Place(self.trace.path, vmd), belief, self._arms(), base)
        return self._devices[vmd]

    def _proved(self) -> tuple[Claim, ...]:
        """The invariants to rely upon: those of the repaired reading are proved, the text's own are not."""
        return self.model.always if self.model.variant == PROVED else ()

    def _arms(self) -> frozenset[str]:
        """The domains that represent an arm: those of the arms among the devices of the profile."""
        devices = self.profile.get("devices", ())
        return frozenset(device["domain"] for device in devices if device["kind"] == "arm")


def _link(message: TraceMessage) -> tuple[str, str] | None:
    """The connection of an MMS link and what happens to it; ``None`` where the message tells of none."""
    if message.schema_name != "link.Event":
        return None
    try:
        event = json.loads(message.data)
        connection, what, role = event["connection"], event["event"], event["role"]
    except (ValueError, KeyError, TypeError):
        return None
    return (str(connection), str(what)) if role == "mms" else None


def _robot_model(model: str | None) -> str:
    if model not in (None, ROBOT):
        raise UsageError(f"no model {model!r} replays recordings", place="--model", cure=f"use {ROBOT}")
    return ROBOT


def _base_only(trace: McapTrace) -> frozenset[tuple[str, str]]:
    """The associations of devices that are no robots, each with its device.

    Their Initiate shows no additional services, and no robot detail follows.
    """
    begun: dict[tuple[str, str], bool] = {}
    for message in trace:
        if message.message_encoding != "mms-ber":
            continue
        key = (message.metadata.get("vmd", ""), message.metadata.get("association", ""))
        if message.data[:1] in (b"\xa8", b"\xa9"):
            begun[key] = begun.get(key, False) or _offers_additional(message.data)
        elif key in begun and not begun[key] and (b"\xbf\x4f" in message.data or b"\xbf\x4e" in message.data):
            begun[key] = _has_detail(message.data)
    return frozenset(key for key, robot in begun.items() if not robot)


def _offers_additional(octets: bytes) -> bool:
    try:
        body = mms.decode(octets).body
    except DecodeError:
        return True
    details: Iterable[Any] = (body.get("initRequestDetail"), body.get("initResponseDetail"))
    return any(detail and any(key.startswith("additionalSupported") for key in detail) for detail in details)


def _has_detail(octets: bytes) -> bool:
    try:
        pdu = mms.decode(octets)
    except DecodeError:
        return False
    return pdu.detail is not None or pdu.service in ("select", "vMDStop", "vMDReset", "alterPI")
