"""Audits of Modbus/TCP recordings: a server on a robot controller that opens its signals."""

from mmsverify.audit.modbus.access import Access, Plan
from mmsverify.audit.modbus.rules import MODBUS_RULES
from mmsverify.audit.modbus.server import Server

__all__ = ["MODBUS_RULES", "Access", "Plan", "Server"]
