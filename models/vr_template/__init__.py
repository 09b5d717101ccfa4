"""The VR template framework of a motion controller, as an executable model: modes, commands, errors.

Two tasks share VR(0) to VR(15): Cmd02 checks commands and sets the mode, Control02 reports the status, acts, and sets
the next mode. Here each of their functions is one step; how their steps interleave is the model vr-tasks.
"""

from functools import partial

from .actions import Actions, ActionsRepaired
from .commands import Commands, CommandsRepaired
from .control import Control, ControlRepaired
from .numbers import COMMANDS, MODES, SUB_MODES, TABLES, statuses
from .outcomes import Outcomes, OutcomesRepaired
from .own import machine
from .properties import Properties, PropertiesRepaired
from .scenario import scenario, worlds

OPTIONS = {
    "name": "vr-template", "standard": "template framework 1.0", "views": {"mode": "mode", "status": "status"},
    "numbers": {"mode": MODES, "status": statuses, "command": COMMANDS, "sub_mode": SUB_MODES}, "tables": TABLES,
    "scenario": scenario, "worlds": worlds,
}  # fmt: skip
AS_WRITTEN = {**OPTIONS, "variant": "as-written"}
REPAIRED = {**OPTIONS, "variant": "repaired"}
TEXT = Control, Commands, Properties, Outcomes
READING = ControlRepaired, CommandsRepaired, PropertiesRepaired, OutcomesRepaired
"""What the framework itself does, and what must hold; what the user's own actions do comes to it."""


class AsWritten(Control, Commands, Actions, Properties, Outcomes, **AS_WRITTEN,
                made_for=partial(machine, TEXT, AS_WRITTEN)):  # fmt: skip
    """The text as it stands."""


class Repaired(ControlRepaired, CommandsRepaired, ActionsRepaired, PropertiesRepaired, OutcomesRepaired, **REPAIRED,
               made_for=partial(machine, READING, REPAIRED)):  # fmt: skip
    """The reading that keeps its own rules."""
