"""Control02: SetPreMode, the action, SetNextMode, and the flags that they read (sections on the two functions).

An action may take as long as it likes; when it has ended, SetNextMode leads on.
"""

from mmsverify.model import Removed, Transition, if_, internal, repaired

from .vocabulary import Mode, Status, Vocabulary

PRE_MODE = (
    "V-PRE-0", "V-CTL02-1", "V-STA-N", "V-PRE-00", "V-PRE-01", "V-PRE-02", "V-PRE-03", "V-PRE-04", "V-PRE-05", "V-PRE-06",
    "V-PRE-07", "V-PRE-08", "V-PRE-09", "V-PRE-13", "V-PRE-14", "V-PRE-15", "V-PRE-16",
)  # fmt: skip
"""What SetPreMode makes of each mode."""


class Control(Vocabulary):
    """As written: what SetNextMode prints, and nothing else."""

    set_pre_mode = Transition(*PRE_MODE, on=internal("set_pre_mode"), then=[status().becomes(reported())])

    left = [arrived().becomes(False)]
    idle_ends = Transition("V-NEXT-00", "V-SM-DbgRdy", on=internal("set_next_mode"),
                           when=[mode() == Mode.IDLE], then=[mode().becomes(Mode.DBG_RDY)])  # fmt: skip
    home_ends = Transition("V-NEXT-02", "V-SM-HomeRdy", on=internal("set_next_mode"), when=[mode() == Mode.HOME],
                           then=[mode().becomes(Mode.HOME_RDY), homed().becomes(True), lost().becomes(False),
                                 arrived().becomes(True)])  # fmt: skip
    goes_to_origin = Transition("V-NEXT-03a", on=internal("set_next_mode"), when=[mode() == Mode.HOME_RDY, auto_org()],
                                then=[mode().becomes(Mode.ORG), *left])  # fmt: skip
    org_ends = Transition("V-NEXT-04", "V-SM-OrgRdy", on=internal("set_next_mode"),
                          when=[mode() == Mode.ORG], then=[mode().becomes(Mode.ORG_RDY)])  # fmt: skip
    run_ends = Transition("V-NEXT-06", on=internal("set_next_mode"), when=[mode() == Mode.RUN, ~paused()],
                          then=[mode().becomes(Mode.ORG)])  # fmt: skip
    stop_begins = Transition("V-NEXT-10", on=internal("set_next_mode"), when=[mode() == Mode.STOP_INSERT],
                             then=[mode().becomes(Mode.STOP)])  # fmt: skip
    stop_ends_homed = Transition("V-NEXT-07a", "V-SM-3", on=internal("set_next_mode"), when=[mode() == Mode.STOP, homed()],
                                 then=[mode().becomes(Mode.HOME_RDY)])  # fmt: skip
    stop_ends = Transition("V-NEXT-07b", "V-SM-3", on=internal("set_next_mode"), when=[mode() == Mode.STOP, ~homed()],
                           then=[mode().becomes(Mode.DBG_RDY)])  # fmt: skip
    serious_error_begins = Transition("V-NEXT-11", on=internal("set_next_mode"), when=[mode() == Mode.ERR_B_INSERT],
                                      then=[mode().becomes(Mode.ERR_B)])  # fmt: skip
    general_error_begins = Transition("V-NEXT-12", on=internal("set_next_mode"), when=[mode() == Mode.ERR_S_INSERT],
                                      then=[mode().becomes(Mode.ERR_S)])  # fmt: skip
    serious_error_ends = Transition("V-NEXT-08", "V-SM-4", on=internal("set_next_mode"), when=[mode() == Mode.ERR_B],
                                    then=[mode().becomes(Mode.DBG_RDY)])  # fmt: skip
    general_error_ends_homed = Transition("V-NEXT-09a", on=internal("set_next_mode"), when=[mode() == Mode.ERR_S, homed()],
                                          then=[mode().becomes(Mode.HOME_RDY)])  # fmt: skip
    general_error_ends = Transition("V-NEXT-09b", on=internal("set_next_mode"), when=[mode() == Mode.ERR_S, ~homed()],
                                    then=[mode().becomes(Mode.DBG_RDY)])  # fmt: skip
    flag_is_set = Transition("V-VR-15", "V-NEXT-03a", "V-NEXT-03b", on=internal("auto_org_changes"),
                             then=[auto_org().becomes(~auto_org())])  # fmt: skip


class ControlRepaired(Control):
    """The repaired reading: errors are left by ResetErr only, AutoOrg acts after homing only, a pause is reported."""

    pauses_now = (mode() == Mode.RUN) & paused()
    set_pre_mode = Transition(
        *PRE_MODE, "V-STA-10", "VR-09", on=internal("set_pre_mode"),
        then=[status().becomes(if_(pauses_now, Status.RUN_PAUSE, reported()))],
        repairs=repaired("VR-09", "V-PRE-06", because="otherwise no machine would ever report RunPause"))  # fmt: skip
    goes_to_origin = Transition(
        "V-NEXT-03a", "VR-10", on=internal("set_next_mode"), when=[mode() == Mode.HOME_RDY, auto_org(), arrived()],
        then=[mode().becomes(Mode.ORG), *left],
        repairs=repaired("VR-10", "V-NEXT-03a", because="after a Stop, or an action of HomeRdy, the machine would move by itself"))  # fmt: skip
    waiting_for_reset = repaired(
        "VR-11",
        "V-NEXT-08",
        "V-NEXT-09a",
        "V-NEXT-09b",
        because="the system waits for the command that clears the error",
    )
    serious_error_ends = Removed(repairs=waiting_for_reset)
    general_error_ends_homed = Removed(repairs=waiting_for_reset)
    general_error_ends = Removed(repairs=waiting_for_reset)
