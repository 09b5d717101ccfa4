"""The VR template framework of a motion controller, as an executable model: modes, commands, errors.

Two tasks share VR(0) to VR(15): Cmd02 checks commands and sets the mode, Control02 reports the status, acts, and sets
the next mode. Here each of their functions is one step; how their steps interleave is the model vr-tasks.
"""

from .commands import Commands, CommandsRepaired
from .control import Control, ControlRepaired
from .numbers import COMMANDS, MODES, TABLES, statuses
from .properties import Properties, PropertiesRepaired
from .scenario import scenario, worlds

STANDARD = "template framework 1.0"
VIEWS = {"mode": "mode", "status": "status"}
NUMBERS = {"mode": MODES, "status": statuses, "command": COMMANDS}


class AsWritten(Control, Commands, Properties, name="vr-template", variant="as-written", standard=STANDARD, views=VIEWS,
                numbers=NUMBERS, tables=TABLES, scenario=scenario, worlds=worlds):  # fmt: skip
    """The text as it stands."""


class Repaired(ControlRepaired, CommandsRepaired, PropertiesRepaired, name="vr-template", variant="repaired", standard=STANDARD,
               views=VIEWS, numbers=NUMBERS, tables=TABLES, scenario=scenario, worlds=worlds):  # fmt: skip
    """The reading that keeps its own rules."""
