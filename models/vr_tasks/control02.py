"""Control02, one round: SetPreMode takes the mode over, the action, SetNextMode (its main flow)."""

from mmsverify.model import Transition, if_, internal, repaired

from .vocabulary import Control02, Mode, Vocabulary


class ActionTask(Vocabulary):
    """As written: SetNextMode writes C_RunMD whatever stands there."""

    takes = Transition("V-CTL02-1", "V-PRE-0", on=internal("Control02.SetPreMode"), when=[control02() == Control02.TAKE],
                       then=[acting().becomes(mode()), control02().becomes(Control02.ACT)])  # fmt: skip
    acts = Transition("V-CTL02-2", on=internal("Control02.action"), when=[control02() == Control02.ACT],
                      then=[control02().becomes(Control02.NEXT)])  # fmt: skip
    goes_on = Transition("V-CTL02-3", "V-NEXT-N", on=internal("Control02.SetNextMode"), when=[control02() == Control02.NEXT],
                         then=[mode().becomes(Mode.WAITING), control02().becomes(Control02.TAKE)])  # fmt: skip


class ActionTaskRepaired(ActionTask):
    """The repaired reading: a mode that was set meanwhile stands."""

    goes_on = Transition(
        "V-CTL02-3", "V-NEXT-N", "VR-18", on=internal("Control02.SetNextMode"), when=[control02() == Control02.NEXT],
        then=[mode().becomes(if_(mode() == acting(), Mode.WAITING, mode())), control02().becomes(Control02.TAKE)],
        repairs=repaired("VR-18", "V-NEXT-N", because="a Stop that comes during the action would be overwritten"))  # fmt: skip
