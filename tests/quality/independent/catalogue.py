"""Every kind of fault; and those that the audit does not judge as their author says, and why."""

from __future__ import annotations

from collections.abc import Mapping

from independent import fault_robot, fault_services, fault_shown, fault_wire
from independent.fault import CATALOGUE, Fault

__all__ = ["CATALOGUE", "OPEN", "Fault", "fault_robot", "fault_services", "fault_shown", "fault_wire"]

OPEN: Mapping[str, str] = {
    "limited_attributes": "in local control, the panel may have changed the logical status",
    "status_loaded_but_empty": "a program that was never shown may have come and gone",
    "start_calibrating": "told once, but at what is seen next: the arm may have come to rest",
}
"""What a fault of the catalogue comes to instead of one finding at its place."""
