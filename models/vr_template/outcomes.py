"""What each function brings about: SetPreMode, SetNextMode, DoCmd (the tables of their sections, row by row).

The rows of the model say what a function may do; here stands what must have come about when it is done.
"""

from mmsverify.model import PLUS, Always, Sometimes, Step, answered, repaired, service_is

from .vocabulary import Mode, Status, Vocabulary

OWN = [Mode.DBG_SUB, Mode.HOME_SUB, Mode.ORG_SUB, Mode.RUN_SUB]
"""Modes of the user's own actions."""


class Outcomes(Vocabulary):
    """The same in both readings."""

    changes = mode().next != mode()

    # What the status says, once SetPreMode has set it.
    told = service_is("set_pre_mode")
    nothing_begun = Always("V-PRE-00", (mode() == Mode.IDLE) >> (status() == Status.IDLE), "V-STA-00", says="before anything has begun the status says so")  # fmt: skip
    tells_waiting = Step("V-PRE-01", (told & waits()) >> ((mode() == Mode.DBG_RDY) & (status().next == Status.DBG_RDY)
                         | (mode() == Mode.HOME_RDY) & (status().next == Status.HOME_RDY) | (mode() == Mode.ORG_RDY) & (status().next == Status.ORG_RDY)),
                         "V-PRE-03", "V-PRE-05", "V-STA-01", "V-STA-03", "V-STA-05", says="where the machine waits the status says in which of the three states")  # fmt: skip
    tells_homing = Step("V-PRE-02", (told & (mode() == Mode.HOME)) >> (status().next == Status.HOME), "V-STA-02", says="while the machine homes the status says so")  # fmt: skip
    tells_way = Step("V-PRE-04", (told & (mode() == Mode.ORG)) >> (status().next == Status.ORG), "V-STA-04", says="on the way to the work origin the status says so")  # fmt: skip
    tells_flow = Step("V-PRE-06", (told & (mode() == Mode.RUN) & ~paused()) >> (status().next == Status.RUN_AUTO), "V-STA-06",
                      says="while the automatic flow goes on the status says so")  # fmt: skip
    tells_halt = Step("V-PRE-07", (told & (mode() == Mode.STOP)) >> (status().next == Status.STOP), "V-STA-07", says="while the machine is stopped the status says so")  # fmt: skip
    tells_error = Step("V-PRE-08", (told & mode().isin([Mode.ERR_B, Mode.ERR_S]))
                       >> ((mode() == Mode.ERR_B) & (status().next == Status.ERR_B_PAUSE) | (mode() == Mode.ERR_S) & (status().next == Status.ERR_S_PAUSE)),
                       "V-PRE-09", "V-STA-08", "V-STA-09", says="after an error the status says of which kind it is")  # fmt: skip
    tells_action = Step("V-PRE-13", (told & mode().isin(OWN))
                        >> ((mode() == Mode.DBG_SUB) & (status().next == Status.DBG_SUB) | (mode() == Mode.HOME_SUB) & (status().next == Status.HOME_SUB)
                            | (mode() == Mode.ORG_SUB) & (status().next == Status.ORG_SUB) | (mode() == Mode.RUN_SUB) & (status().next == Status.RUN_SUB)),
                        "V-PRE-14", "V-PRE-15", "V-PRE-16", "V-STA-11", "V-STA-12", "V-STA-13", "V-STA-14",
                        says="while a user's action goes on the status says of which mode it is")  # fmt: skip

    # What comes after an action that has ended.
    ended = service_is("set_next_mode")
    beginning_ends_in_debugging = Step("V-NEXT-00", (ended & (mode() == Mode.IDLE)) >> (mode().next == Mode.DBG_RDY), "V-SM-DbgRdy",
                                       says="after the initialisation the machine waits in debug mode")  # fmt: skip
    homing_ends_homed = Step("V-NEXT-02", (ended & (mode() == Mode.HOME)) >> ((mode().next == Mode.HOME_RDY) & homed().next), "V-SM-HomeRdy",
                             says="after homing the machine is homed and waits in home mode")  # fmt: skip
    origin_is_asked_for = Step("V-NEXT-03b", (ended & (mode() == Mode.HOME_RDY) & ~auto_org()) >> ~changes, "V-VR-15",
                               says="without CF_AutoOrg no way to the work origin follows homing")  # fmt: skip
    origin_follows_homing = Step("V-NEXT-03a", (ended & arrived() & auto_org()) >> (mode().next == Mode.ORG), "V-VR-15",
                                 says="with CF_AutoOrg the way to the work origin follows homing")  # fmt: skip
    origin_follows_at_once = Always("V-VR-15", arrived() >> (mode() == Mode.HOME_RDY), says="homing has just ended only as long as the machine waits in HomeRdy after it")  # fmt: skip
    way_ends_at_origin = Step("V-NEXT-04", (ended & (mode() == Mode.ORG)) >> (mode().next == Mode.ORG_RDY), "V-SM-OrgRdy",
                              says="at the end of the way to the work origin the machine waits there")  # fmt: skip
    flow_ends_at_origin = Step("V-NEXT-06", (ended & (mode() == Mode.RUN)) >> (mode().next == Mode.ORG), says="after the automatic flow the machine goes to the work origin")  # fmt: skip
    held_flow_does_not_end = Step("V-SM-2", (ended & (mode() == Mode.RUN)) >> ~paused(), "V-DO-05", says="a flow that is held does not come to its end")  # fmt: skip
    halt_is_begun = Step("V-NEXT-10", (ended & (mode() == Mode.STOP_INSERT)) >> (mode().next == Mode.STOP), says="a Stop that cuts in is a Stop")  # fmt: skip
    halt_ends = Step("V-NEXT-07a", (ended & (mode() == Mode.STOP)) >> ((mode().next == Mode.HOME_RDY) & homed() | (mode().next == Mode.DBG_RDY) & ~homed()),
                     "V-NEXT-07b", says="after a Stop the machine waits, in home mode if it is homed")  # fmt: skip
    error_is_begun = Step("V-NEXT-11", (ended & mode().isin([Mode.ERR_B_INSERT, Mode.ERR_S_INSERT]))
                          >> ((mode() == Mode.ERR_B_INSERT) & (mode().next == Mode.ERR_B) | (mode() == Mode.ERR_S_INSERT) & (mode().next == Mode.ERR_S)),
                          "V-NEXT-12", says="an error that cuts in stays one of its kind")  # fmt: skip
    action_ends = Step("V-NEXT-13", (ended & mode().isin(OWN))
                       >> ((mode() == Mode.DBG_SUB) & (mode().next == Mode.DBG_RDY) | (mode() == Mode.HOME_SUB) & (mode().next == Mode.HOME_RDY)
                           | (mode() == Mode.ORG_SUB) & (mode().next == Mode.ORG_RDY) | (mode() == Mode.RUN_SUB) & (mode().next == Mode.RUN)),
                       "V-NEXT-14", "V-NEXT-15", "V-NEXT-16", says="after a user's action the machine is in the mode that the action belongs to")  # fmt: skip

    # What a command that is admitted brings about.
    obeyed = answered(PLUS)
    home_is_homing = Step("V-DO-01", (obeyed & service_is("home")) >> (mode().next == Mode.HOME), "V-CMD-01", says="Home makes the machine home")  # fmt: skip
    org_is_way = Step("V-DO-02", (obeyed & service_is("org")) >> (mode().next == Mode.ORG), "V-CMD-02", says="Org sends the machine to its work origin")  # fmt: skip
    run_is_flow = Step("V-DO-03", (obeyed & service_is("run")) >> ((mode().next == Mode.RUN) & ~paused().next), "V-CMD-03", says="Run starts the automatic flow")  # fmt: skip
    stop_is_halt = Step("V-DO-04", (obeyed & service_is("stop")) >> mode().next.isin([Mode.STOP, Mode.STOP_INSERT]), "V-CMD-04", says="Stop halts what goes on")  # fmt: skip
    hold_keeps_mode = Step("V-DO-05", service_is("pause", "step", "resume") >> ~changes, "V-DO-06", "V-DO-07", says="Pause, Step and Resume leave the mode alone")  # fmt: skip
    pause_holds = Step("V-DO-05", (obeyed & service_is("pause", "step") & (mode() == Mode.RUN)) >> paused().next, "V-DO-06", "V-CMD-05", "V-CMD-06",
                       says="after Pause, and after one more step, the automatic flow is held")  # fmt: skip
    resume_goes_on = Step("V-DO-07", (obeyed & service_is("resume")) >> ~paused().next, "V-CMD-07", says="after Resume the automatic flow is not held")  # fmt: skip
    error_is_serious = Step("V-DO-08", (obeyed & service_is("onErrB")) >> mode().next.isin([Mode.ERR_B, Mode.ERR_B_INSERT]), "V-CMD-08",
                            says="a serious error leads to its mode")  # fmt: skip
    error_is_general = Step("V-DO-09", (obeyed & service_is("onErrS")) >> mode().next.isin([Mode.ERR_S, Mode.ERR_S_INSERT]), "V-CMD-09",
                            says="a general error leads to its mode")  # fmt: skip
    reset_of_serious_error = Step("V-DO-10a", (obeyed & service_is("resetErr") & (mode() == Mode.ERR_B)) >> (mode().next == Mode.DBG_RDY), "V-SM-4",
                                  says="ResetErr leads from a serious error to debug mode")  # fmt: skip
    reset_of_general_error = Step("V-DO-10b", (obeyed & service_is("resetErr") & (mode() == Mode.ERR_S))
                                  >> ((mode().next == Mode.HOME_RDY) & homed() | (mode().next == Mode.DBG_RDY) & ~homed()), "V-DO-10c", "V-SM-3",
                                  says="ResetErr leads from a general error to home mode, if the machine is homed")  # fmt: skip

    goes_to_origin_on_command = Sometimes("V-DO-02", obeyed & service_is("org") & (mode().next == Mode.ORG), "V-CMD-02")  # fmt: skip
    goes_on_to_origin = Sometimes("V-NEXT-03a", ended & (mode() == Mode.HOME_RDY) & (mode().next == Mode.ORG), "V-VR-15")  # fmt: skip


class OutcomesRepaired(Outcomes):
    """The repaired reading: only the automatic flow is held, and the status says so."""

    tells_held_flow = Step("V-STA-10", (told & (mode() == Mode.RUN) & paused()) >> (status().next == Status.RUN_PAUSE), "VR-09", says="while the automatic flow is held the status says so",
                           repairs=repaired("VR-09", "V-STA-10", because="as printed nothing reports it"))  # fmt: skip
    only_the_flow_is_held = Always("V-SM-2", paused() >> mode().isin([Mode.RUN, Mode.RUN_SUB]), "VR-04", says="nothing but the automatic flow is held",
                                   repairs=repaired("VR-04", "V-SM-2", because="where Pause is admitted is a reading"))  # fmt: skip
    only_a_held_flow_goes_on = Step("V-CMD-07", (obeyed & service_is("resume")) >> paused(), "VR-05", says="Resume is for a flow that is held",
                                    repairs=repaired("VR-05", "V-CMD-07", because="where Resume is admitted is a reading"))  # fmt: skip
