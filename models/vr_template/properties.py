"""What must hold of the framework, stated from what the text is for (sections on states, commands and errors)."""

from mmsverify.model import (
    MINUS,
    PLUS,
    Always,
    Initially,
    Sometimes,
    Step,
    answered,
    repaired,
    service_is,
    unchanged,
)

from .vocabulary import Mode, Status, Vocabulary

HOMED = [Mode.HOME_RDY, Mode.ORG, Mode.ORG_RDY, Mode.RUN, Mode.HOME_SUB, Mode.ORG_SUB, Mode.RUN_SUB]
"""Modes for which the machine must have been homed."""
BROKEN_OFF = [Mode.STOP, Mode.STOP_INSERT, Mode.ERR_B, Mode.ERR_B_INSERT, Mode.ERR_S, Mode.ERR_S_INSERT]
"""Where a Stop or an error leads."""
ERRORS = BROKEN_OFF[2:]


class Properties(Vocabulary):
    """The same in both readings."""

    at_power_on = Initially("V-SM-Idle", (mode() == Mode.IDLE) & (status() == Status.IDLE) & (homed() == homed_at_power_on())
                            & ~lost() & ~paused() & ~auto_org() & ~arrived(), "V-STA-00")  # fmt: skip

    changes = mode().next != mode()
    homed_before_moving = Always(
        "V-FUN-2", mode().isin(HOMED) >> homed(), says="no mode that needs homing is entered unhomed"
    )
    new_home_after_serious_error = Always("V-SM-5", lost() >> ~mode().isin(HOMED), "V-SM-4",
                                          says="after a serious error nothing but debugging is possible before a new Home")  # fmt: skip
    serious_error_costs_homing = Always("V-SM-5", mode().isin([Mode.ERR_B, Mode.ERR_B_INSERT]) >> lost(), "V-SM-ErrB",
                                        says="in a serious error the machine counts as not homed")  # fmt: skip
    serious_error_waits = Step("V-DEV-3", ((mode() == Mode.ERR_B) & changes) >> (service_is("resetErr") | mode().next.isin(ERRORS)),
                               says="a serious error is left by ResetErr only")  # fmt: skip
    general_error_waits = Step("V-DEV-4", ((mode() == Mode.ERR_S) & changes) >> (service_is("resetErr") | mode().next.isin(ERRORS)),
                               says="a general error is left by ResetErr only")  # fmt: skip
    serious_error_ends_in_debugging = Step("V-SM-4", ((mode() == Mode.ERR_B) & changes) >> mode().next.isin([Mode.DBG_RDY, *ERRORS]),
                                           says="from a serious error the way leads to DbgRdy")  # fmt: skip
    general_error_like_stop = Step(
        "V-SM-3", (mode().isin([Mode.STOP, Mode.ERR_S]) & changes & ~mode().next.isin(BROKEN_OFF))
        >> ((mode().next == Mode.HOME_RDY) & homed() | (mode().next == Mode.DBG_RDY) & ~homed()),
        says="after a Stop or a general error a homed machine is in HomeRdy, another one in DbgRdy")  # fmt: skip
    runs_from_origin = Step("V-FUN-2", ((mode().next == Mode.RUN) & changes) >> mode().isin([Mode.ORG_RDY, Mode.RUN_SUB]),
                            says="the automatic flow begins in OrgRdy only")  # fmt: skip
    no_home_while_running = Step("V-CHK-3", mode().isin([Mode.RUN, Mode.RUN_SUB]) >> (mode().next != Mode.HOME),
                                 says="no Home while the automatic flow runs")  # fmt: skip
    debug_action_from_waiting = Step(
        "V-SUBD-2",
        ((mode().next == Mode.DBG_SUB) & changes) >> waits(),
        says="actions 101-199 begin in a waiting state",
    )
    home_action_from_homed = Step("V-SUBH-2", ((mode().next == Mode.HOME_SUB) & changes) >> mode().isin([Mode.HOME_RDY, Mode.ORG_RDY]),
                                  says="actions 201-299 begin in HomeRdy or OrgRdy")  # fmt: skip
    origin_action_from_origin = Step("V-SUBO-2", ((mode().next == Mode.ORG_SUB) & changes) >> (mode() == Mode.ORG_RDY),
                                     says="actions 301-399 begin in OrgRdy")  # fmt: skip
    run_action_from_run = Step("V-CMD-401", ((mode().next == Mode.RUN_SUB) & changes) >> (mode() == Mode.RUN),
                               says="actions 401-499 begin in Run")  # fmt: skip
    debug_action_returns = Step("V-SUBD-3", ((mode() == Mode.DBG_SUB) & changes & ~mode().next.isin(BROKEN_OFF)) >> (mode().next == Mode.DBG_RDY),
                                says="after an action 101-199 the machine is in DbgRdy")  # fmt: skip
    home_action_returns = Step("V-SUBH-3", ((mode() == Mode.HOME_SUB) & changes & ~mode().next.isin(BROKEN_OFF)) >> (mode().next == Mode.HOME_RDY),
                               says="after an action 201-299 the machine is in HomeRdy")  # fmt: skip
    origin_action_returns = Step("V-SUBO-3", ((mode() == Mode.ORG_SUB) & changes & ~mode().next.isin(BROKEN_OFF)) >> (mode().next == Mode.ORG_RDY),
                                 says="after an action 301-399 the machine is in OrgRdy")  # fmt: skip
    refused_changes_nothing = Step("V-CMD02-2b", answered(MINUS) >> unchanged(mode, status, homed, lost, paused, auto_org, arrived), "V-CHK-2",
                                   says="a command that is not allowed changes nothing")  # fmt: skip
    waits_for_commands = Step("V-SM-1", (waits() & changes) >> (~service_is("set_next_mode") | arrived()), "V-NEXT-03b",
                              says="in a waiting state nothing moves without a command, but on to the origin after homing")  # fmt: skip
    modes_change_as_commanded = Step("V-CTL02-N", changes >> (answered(PLUS) | service_is("set_next_mode")), "V-CMD02-2a", "V-CMD02-2c", "V-DO-00",
                                     says="the mode changes by commands and by SetNextMode only")  # fmt: skip
    next_is_nothing_in_debugging = Step("V-NEXT-01", (service_is("set_next_mode") & (mode() == Mode.DBG_RDY)) >> ~changes,
                                        says="SetNextMode leaves DbgRdy alone")  # fmt: skip
    next_is_nothing_at_origin = Step("V-NEXT-05", (service_is("set_next_mode") & (mode() == Mode.ORG_RDY)) >> ~changes,
                                     says="SetNextMode leaves OrgRdy alone")  # fmt: skip
    status_waits_for_mode = Step(
        "V-STA-N",
        ~service_is("set_pre_mode") >> unchanged(status),
        says="the status follows the mode by SetPreMode only",
    )

    reaches_home = Sometimes("V-SM-Home", mode() == Mode.HOME)
    reaches_org = Sometimes("V-SM-Org", mode() == Mode.ORG)
    reaches_run = Sometimes("V-SM-Run", mode() == Mode.RUN)
    reaches_stop = Sometimes("V-SM-Stop", mode() == Mode.STOP)
    reaches_org_ready = Sometimes("V-SM-OrgRdy", mode() == Mode.ORG_RDY)
    recovers = Sometimes("V-SM-4", (mode() == Mode.ERR_B) & (mode().next == Mode.DBG_RDY))
    needs_home_again = Sometimes("V-SM-5", lost())
    pauses = Sometimes("V-SM-2", (mode() == Mode.RUN) & paused(), "V-DO-05")
    shows_pause = Sometimes("V-STA-10", status() == Status.RUN_PAUSE)


class PropertiesRepaired(Properties):
    """The repaired reading."""

    serious_error_clears_home = Always("V-SM-5", lost() >> ~homed(), "VR-08", says="after a serious error CF_Home is 0 until the next Home",
                                       repairs=repaired("VR-08", "V-SM-5", because="stated for the flag that is cleared"))  # fmt: skip
