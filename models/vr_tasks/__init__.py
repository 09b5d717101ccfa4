"""The two tasks of the VR template framework, step by step over the cells that they share.

Cmd02 looks at the axes, checks C_Cmd, sets C_RunMD and publishes what it found; Control02 takes C_RunMD over, acts, and
sets the next one; an operator writes C_Cmd whenever he likes. Each step of a task is one row, so that a run is an
interleaving.
"""

from .cmd02 import CommandTask, CommandTaskRepaired
from .control02 import ActionTask, ActionTaskRepaired
from .properties import Properties, PropertiesRepaired
from .rounds import Rounds, RoundsRepaired

STANDARD = "template framework 1.0"
VIEWS = {"Cmd02": "cmd02", "Control02": "control02", "mode": "mode"}


class AsWritten(
    ActionTask,
    CommandTask,
    Properties,
    Rounds,
    name="vr-tasks",
    variant="as-written",
    standard=STANDARD,
    views=VIEWS,
):
    """The text as it stands."""


class Repaired(
    ActionTaskRepaired,
    CommandTaskRepaired,
    PropertiesRepaired,
    RoundsRepaired,
    name="vr-tasks",
    variant="repaired",
    standard=STANDARD,
    views=VIEWS,
):
    """The reading in which neither task undoes what the other one has done."""
