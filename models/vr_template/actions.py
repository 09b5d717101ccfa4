"""The user's own actions, of whose commands no table is given: any number of 101 to 499 begins one (sections on sub-actions).

Where a table lists them, ``own`` takes the place of this file.
"""

from mmsverify.model import (
    PLUS,
    Procedure,
    Sometimes,
    Step,
    Transition,
    accept,
    answered,
    do,
    internal,
    refuse,
    repaired,
    response,
    service_is,
)

from .vocabulary import Mode, Vocabulary


class Actions(Vocabulary):
    """As written: where such an action may begin, and the mode in which it ends."""

    left = [arrived().becomes(False)]

    debug_action = Procedure("V-DO-101", on=response("dbgSub"), steps=[
        refuse("V-SUBD-2", "V-CHK-2", unless=waits(), rule="debug-action.not-waiting",
               says="an action 101-199 outside DbgRdy, HomeRdy and OrgRdy"),
        do("V-DO-101", mode().becomes(Mode.DBG_SUB), *left), accept("V-DO-101", "V-CMD-101", "V-SUBD-1"),
    ])  # fmt: skip
    home_action = Procedure("V-DO-201", on=response("homeSub"), steps=[
        refuse("V-SUBH-2", "V-CHK-2", unless=mode().isin([Mode.HOME_RDY, Mode.ORG_RDY]), rule="home-action.not-homed",
               says="an action 201-299 outside HomeRdy and OrgRdy"),
        do("V-DO-201", mode().becomes(Mode.HOME_SUB), *left), accept("V-DO-201", "V-CMD-201", "V-SUBH-1"),
    ])  # fmt: skip
    origin_action = Procedure("V-DO-301", on=response("orgSub"), steps=[
        refuse("V-SUBO-2", "V-CHK-2", unless=mode() == Mode.ORG_RDY, rule="origin-action.not-ready",
               says="an action 301-399 outside OrgRdy"),
        do("V-DO-301", mode().becomes(Mode.ORG_SUB)), accept("V-DO-301", "V-CMD-301", "V-SUBO-1"),
    ])  # fmt: skip
    run_action = Procedure("V-DO-401", on=response("runSub"), steps=[
        refuse("V-CMD-401", "V-CHK-2", unless=mode() == Mode.RUN, rule="run-action.not-running", says="an action 401-499 outside Run"),
        do("V-DO-401", mode().becomes(Mode.RUN_SUB)), accept("V-DO-401", "V-CMD-401"),
    ])  # fmt: skip

    debug_action_ends = Transition("V-NEXT-13", "V-SUBD-3", on=internal("set_next_mode"), when=[mode() == Mode.DBG_SUB],
                                   then=[mode().becomes(Mode.DBG_RDY)])  # fmt: skip
    home_action_ends = Transition("V-NEXT-14", "V-SUBH-3", on=internal("set_next_mode"), when=[mode() == Mode.HOME_SUB],
                                  then=[mode().becomes(Mode.HOME_RDY)])  # fmt: skip
    origin_action_ends = Transition("V-NEXT-15", "V-SUBO-3", on=internal("set_next_mode"), when=[mode() == Mode.ORG_SUB],
                                    then=[mode().becomes(Mode.ORG_RDY)])  # fmt: skip
    run_action_ends = Transition("V-NEXT-16", on=internal("set_next_mode"), when=[mode() == Mode.RUN_SUB],
                                 then=[mode().becomes(Mode.RUN)])  # fmt: skip

    action_is_done = Step("V-DO-101", (answered(PLUS) & service_is("dbgSub", "homeSub", "orgSub", "runSub"))
                          >> (service_is("dbgSub") & (mode().next == Mode.DBG_SUB) | service_is("homeSub") & (mode().next == Mode.HOME_SUB)
                              | service_is("orgSub") & (mode().next == Mode.ORG_SUB) | service_is("runSub") & (mode().next == Mode.RUN_SUB)),
                          "V-DO-201", "V-DO-301", "V-DO-401", says="a user's action is done in the mode that its number belongs to")  # fmt: skip
    reaches_debug_action = Sometimes("V-SM-DbgSub", mode() == Mode.DBG_SUB)
    reaches_home_action = Sometimes("V-SM-HomeSub", mode() == Mode.HOME_SUB)
    reaches_origin_action = Sometimes("V-SM-OrgSub", mode() == Mode.ORG_SUB)


class ActionsRepaired(Actions):
    """The repaired reading."""

    run_action = Procedure("V-DO-401", on=response("runSub"), steps=[
        refuse("V-CHK-2", "VR-04", unless=mode() == Mode.RUN, rule="run-action.not-running", level="warning", says="an action 401-499 outside Run"),
        do("V-DO-401", mode().becomes(Mode.RUN_SUB)), accept("V-DO-401", "V-CMD-401"),
    ], repairs=repaired("VR-04", "V-CHK-2", because="the actions 401 to 499 are kept free, and where they are allowed is not said"))  # fmt: skip
