"""Figure 8 (5.3.1.3.1): each of its transitions can be taken, each robot state is reached.

No transition happens that it does not show.
"""

from mmsverify.model import Sometimes, Step, any_of, repaired, service_is

from .vocabulary import RobotState, Vocabulary, VocabularyRepaired


class Figure8(Vocabulary):
    """As written."""

    before, later = robot_state(), robot_state().next

    idle_reached = Sometimes(
        "R-5.3.1.3.2.1-1", robot_state() == RobotState.IDLE, "R-6.3.5.2-2", provided=~never_idle
    )
    loaded_reached = Sometimes("R-5.3.1.3.2.2-1", robot_state() == RobotState.LOADED)
    ready_reached = Sometimes("R-5.3.1.3.2.3-1", robot_state() == RobotState.READY)
    executing_reached = Sometimes("R-5.3.1.3.2.4-1", robot_state() == RobotState.EXECUTING)
    paused_reached = Sometimes("R-5.3.1.3.2.5-2", robot_state() == RobotState.MOTION_PAUSED)
    intervention_reached = Sometimes("R-5.3.1.3.2.6-2", robot_state() == RobotState.INTERVENTION)

    t01_load = Sometimes(
        "R-5.3.1.3.1-t01", (before == RobotState.IDLE) & (later == RobotState.LOADED) & service_is("createProgramInvocation"), "R-6.3.5.2-1",
        provided=~never_idle & ~single_task())  # fmt: skip
    t02_clear = Sometimes(
        "R-5.3.1.3.1-t02", (before == RobotState.LOADED) & (later == RobotState.IDLE) & service_is("deleteProgramInvocation", "vMDReset"), "R-6.3.5.3-1",
        provided=~never_idle)  # fmt: skip
    t03_assign = Sometimes(
        "R-5.3.1.3.1-t03", (before == RobotState.LOADED) & (later == RobotState.READY) & service_is("select"), "R-6.3.5.4-1")  # fmt: skip
    t04_deassign = Sometimes(
        "R-5.3.1.3.1-t04", (before == RobotState.READY) & (later == RobotState.LOADED) & service_is("select"), "R-6.3.5.5-1")  # fmt: skip
    t05_program_start = Sometimes(
        "R-5.3.1.3.1-t05", (before == RobotState.READY) & (later == RobotState.EXECUTING) & service_is("start"), "R-6.3.5.6-1")  # fmt: skip
    t06_end_of_execution_taken = Sometimes(
        "R-5.3.1.3.1-t06", (before == RobotState.EXECUTING) & (later == RobotState.LOADED) & service_is("end_of_execution"), "R-6.3.5.7-1")  # fmt: skip
    t07_program_reset = Sometimes(
        "R-5.3.1.3.1-t07", (before == RobotState.MOTION_PAUSED) & (later == RobotState.READY) & service_is("reset"), "R-6.3.5.8-1")  # fmt: skip
    t08_pause = Sometimes(
        "R-5.3.1.3.1-t08", (before == RobotState.EXECUTING) & (later == RobotState.MOTION_PAUSED) & service_is("stop"), "R-6.3.5.9-1")  # fmt: skip
    t09_continue_taken = Sometimes(
        "R-5.3.1.3.1-t09", (before == RobotState.MOTION_PAUSED) & (later == RobotState.EXECUTING) & service_is("resume"), "R-6.3.5.10-1")  # fmt: skip
    t10_clear_abort = Sometimes(
        "R-5.3.1.3.1-t10", (before == RobotState.MOTION_PAUSED) & (later == RobotState.IDLE) & service_is("vMDReset"), "R-6.3.5.11-1", provided=~never_idle)  # fmt: skip
    t11_clear_abandon = Sometimes(
        "R-5.3.1.3.1-t11", (before == RobotState.READY) & (later == RobotState.IDLE) & service_is("vMDReset"), "R-6.3.5.12-1", provided=~never_idle)  # fmt: skip
    t12_emergency_action = Sometimes(
        "R-5.3.1.3.1-t12", (before == RobotState.EXECUTING) & (later == RobotState.INTERVENTION) & service_is("vMDStop"), "R-6.3.5.13-3")  # fmt: skip

    load_and_assign = Sometimes(
        "R-5.3.1.3.3.4-2", (before == RobotState.IDLE) & (later == RobotState.READY) & service_is("createProgramInvocation"),
        provided=single_task() & ~never_idle)  # fmt: skip

    # The arrows of the figure; the operator's way out of MANUAL-INTERVENTION-REQUIRED may lead anywhere (5.3.1.3.2.6).
    arrows = any_of(
        later == before,
        (before == RobotState.IDLE) & (later == RobotState.LOADED),
        (before == RobotState.LOADED) & later.isin([RobotState.IDLE, RobotState.READY]),
        (before == RobotState.READY) & later.isin([RobotState.LOADED, RobotState.EXECUTING, RobotState.IDLE]),
        (before == RobotState.EXECUTING) & later.isin([RobotState.LOADED, RobotState.MOTION_PAUSED]),
        (before == RobotState.MOTION_PAUSED)
        & later.isin([RobotState.READY, RobotState.EXECUTING, RobotState.IDLE]),
        (before == RobotState.IDLE)
        & (later == RobotState.READY)
        & single_task()
        & service_is("createProgramInvocation"),
        later == RobotState.INTERVENTION,
        before == RobotState.INTERVENTION,
    )
    figure_8 = Step("R-5.3.1.3.1-0", arrows, says="the robot state changes along the arrows of figure 8 only")


class Figure8Repaired(Figure8, VocabularyRepaired):
    """The repaired reading."""

    figure_8 = Step(
        "R-5.3.1.3.1-0",
        arrows | any_of(
            (before == RobotState.READY) & (later == RobotState.MOTION_PAUSED) & service_is("start"),
            (before == RobotState.READY) & (later == RobotState.LOADED) & service_is("kill", "deleteProgramInvocation"),
            (before == RobotState.READY) & (later == RobotState.IDLE) & service_is("deleteProgramInvocation"),
            (before == RobotState.EXECUTING) & (later == RobotState.LOADED) & service_is("kill", "fails_by_itself"),
            (before == RobotState.MOTION_PAUSED) & (later == RobotState.LOADED)
            & service_is("end_of_execution", "kill", "deleteProgramInvocation", "fails_by_itself", "reset"),
            (before == RobotState.MOTION_PAUSED) & (later == RobotState.IDLE) & service_is("deleteProgramInvocation"),
            later.isin([RobotState.IDLE, RobotState.LOADED]) & service_is("vMDReset"),
            (later == RobotState.LOADED) & service_is("start", "stop", "resume", "reset") & destructive,
        ),
        says="the robot state changes along the arrows of figure 8 and those that RP-20 adds",
        repairs=repaired("RP-20", "R-5.3.1.3.1-0", because="the figure has no arrow for programs that end, are killed or deleted outside EXECUTING"),
    )  # fmt: skip
