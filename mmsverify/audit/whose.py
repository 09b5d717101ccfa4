"""Whose message it is: the device, and the model that judges such devices."""

from __future__ import annotations

from mmsverify.audit.lookahead import link
from mmsverify.audit.parts import FRAMEWORK, ROBOT, SIGNALS
from mmsverify.formats.trace import TraceMessage

SAMPLES = "vr.Sample"
_ROLES = (("mms", ROBOT), ("modbus", SIGNALS))
Place = tuple[str, str]
"""A device's name, and a model's: a robot and a controller may have one name."""


def whose(message: TraceMessage) -> Place | None:
    """The device of a message, of a link event by its role; ``None`` where no model knows its kind."""
    names = message.metadata
    if message.message_encoding == "mms-ber":
        return names.get("vmd", ""), ROBOT
    if message.message_encoding == "modbus-tcp":
        return names.get("controller", ""), SIGNALS
    if message.schema_name == SAMPLES:
        return names.get("controller", ""), FRAMEWORK
    return next(((names.get("name", ""), model) for role, model in _ROLES if link(message, role)), None)
