"""What the transitions bring about and by what they are caused (5.3.1.3.3, 6.3.2.2, 6.3.3, 6.3.5, 7.3.3).

Claims about steps, each stated from the clause that describes the transition, not from the procedure that makes it.
"""

from mmsverify.model import (
    MINUS,
    PLUS,
    Sometimes,
    Step,
    Unspecified,
    answered,
    any_of,
    for_all,
    for_some,
    if_,
    repaired,
    service_is,
)

from .vocabulary import Control, Mode, RobotState, State, Vocabulary, VocabularyRepaired

PROGRAM_SERVICES = (
    "start",
    "stop",
    "resume",
    "reset",
    "kill",
    "deleteProgramInvocation",
    "select",
    "alterPI",
    "vMDStop",
    "vMDReset",
)


class Transitions(Vocabulary):
    """As written."""

    before, later = robot_state(), robot_state().next
    is_task = control[pi] == Control.CONTROLLING

    changed_in_local_control = Sometimes("R-T1-N", local_control() & local_control().next & (before != later))

    # Load and Clear (5.3.1.3.3.2, .3; 6.3.5.2, .3).
    load_makes_loaded = Step(
        "R-5.3.1.3.3.2-2",
        (service_is("createProgramInvocation") & answered(PLUS) & (kind == Control.CONTROLLING) & (before == RobotState.IDLE)) >> (later == if_(single_task(), RobotState.READY, RobotState.LOADED)),
        "R-5.3.1.3.3.4-2", says="the first task program makes an idle robot LOADED, and READY where it is assigned with it")  # fmt: skip
    load_concerns_task_programs = Step(
        "R-5.3.1.3.3.2-1", (service_is("createProgramInvocation") & (kind != Control.CONTROLLING)) >> (later == before),
        says="only a program that controls the arm counts as loaded")  # fmt: skip
    clear_keeps_loaded = Step(
        "R-5.3.1.3.3.3-2",
        (service_is("deleteProgramInvocation") & answered(PLUS) & (before == RobotState.LOADED) & some_controlling().next) >> (later == RobotState.LOADED),
        says="while another task program remains, Clear leaves the robot LOADED")  # fmt: skip
    clear_needs_load = Step(
        "R-6.3.5.3-3", ((before == RobotState.LOADED) & (later == RobotState.IDLE)) >> some_controlling(),
        says="what is cleared has been loaded before")  # fmt: skip
    clear_by_reset = Sometimes(
        "R-6.3.5.3-2", (before == RobotState.LOADED) & (later == RobotState.IDLE) & service_is("vMDReset"), provided=~never_idle)  # fmt: skip

    # Assign and Deassign (5.3.1.3.3.4, .5; 6.3.5.4, .5; figure 10).
    assign_makes_ready = Step(
        "R-5.3.1.3.3.4-1", (service_is("select") & answered(PLUS) & controlling.present) >> (later == RobotState.READY),
        says="what has been assigned makes the robot READY")  # fmt: skip
    ready_left_by_deassign = Step(
        "R-5.3.1.3.3.5-1", ((before == RobotState.READY) & (later == RobotState.LOADED)) >> service_is("select"),
        says="from READY to LOADED leads a Deassign only")  # fmt: skip
    deassign_needs_assign = Step(
        "R-6.3.5.5-2", ((before == RobotState.READY) & (later == RobotState.LOADED)) >> some_selected(),
        says="what is deassigned has been assigned before")  # fmt: skip
    assigned_anew = Sometimes(
        "R-5.3.1.3.3.5-2",
        (before == RobotState.READY) & (later == RobotState.READY) & service_is("select") & controlling.present)  # fmt: skip
    refused_select_selects_nothing = Step(
        "R-6.3.3-t102", (service_is("select") & answered(MINUS)) >> for_all(p)((selected[p].next == selected[p]) & ~selecting[request, p].next),
        "R-6.3.3-t105", "R-7.4.4-1", says="after Select response(-) figure 10 is where it was before the indication")  # fmt: skip

    # Program start, reset, continue (5.3.1.3.3.6, .8, .10).
    start_makes_executing = Step(
        "R-5.3.1.3.3.6-1", (service_is("start") & answered(PLUS) & (before == RobotState.READY) & selected[pi] & is_task) >> (later == RobotState.EXECUTING),
        says="Start of the selected task program makes the robot EXECUTING")  # fmt: skip
    reset_makes_ready = Step(
        "R-5.3.1.3.3.8-1", (service_is("reset") & answered(PLUS) & (before == RobotState.MOTION_PAUSED) & selected[pi]) >> (later == RobotState.READY),
        says="Reset of the paused task program makes the robot READY")  # fmt: skip
    resume_makes_executing = Step(
        "R-5.3.1.3.3.10-1", (service_is("resume") & answered(PLUS) & (before == RobotState.MOTION_PAUSED) & selected[pi] & is_task) >> (later == RobotState.EXECUTING),
        says="Resume of the paused task program makes the robot EXECUTING")  # fmt: skip

    # Clear(abort) and Clear(abandon) (5.3.1.3.3.11, .12).
    abort_deassigns = Step(
        "R-5.3.1.3.3.11-1", (service_is("vMDReset") & answered(PLUS)) >> for_all(a)(~selected[a].next), "R-5.3.1.3.3.12-1",
        says="Clear(abort) and Clear(abandon) deassign the task program")  # fmt: skip
    abort_removes_programs = Step(
        "R-5.3.1.3.3.11-2",
        (service_is("vMDReset") & answered(PLUS)) >> for_all(p)((exists[p] & (control[p] == Control.CONTROLLING)) >> (state[p].next == State.NON_EXISTENT)),
        "R-5.3.1.3.3.12-2", says="Clear(abort) and Clear(abandon) remove all task programs")  # fmt: skip

    # Who may act, and what a service propagates (5.1.3, 7.3.3.1, 7.3.3.3).
    only_holder_acts = Step(
        "R-5.3.1.2-1", (service_is(*PROGRAM_SERVICES) & answered(PLUS)) >> (holder[user] | panel), "R-5.1.3-2", "R-7.3.3.3-1",
        says="no program is selected, started, stopped or removed by a client without R_CTRL")  # fmt: skip
    start_carries_controlled = Step(
        "R-7.3.3.1-1",
        (service_is("start", "resume") & answered(PLUS) & (control[pi] == Control.CONTROLLING)) >> for_all(c)(controls[pi, c] >> (state[c].next == State.RUNNING)),
        "R-6.3.2.2-2", "R-7.3.3.1-2", says="what a started or resumed task program controls is RUNNING with it")  # fmt: skip
    started_controls_its_own = Unspecified(
        "R-7.3.3.3.3-d1", "Start and Resume check the list of controlled program invocations, but the text states no outcome where the check fails",
        "R-7.3.3.5.3-d1")  # fmt: skip
    controlled_act_alone = Step(
        "R-7.3.3.1-3",
        (service_is("start", "stop", "resume", "reset", "kill") & ~answered("") & (control[pi] == Control.CONTROLLED))
        >> for_all(p)((p != pi) >> (state[p].next == state[p])),
        says="a service on a controlled program invocation is not propagated")  # fmt: skip
    stopped_arm_rests = Step(
        "R-7.3.3.4.1-2", (service_is("stop") & answered(PLUS) & arm[pi] & (control[pi] == Control.CONTROLLED)) >> ~motion().next,
        says="stopping the arm's program stops the arm at once")  # fmt: skip
    stops_by_arm = Sometimes(
        "R-6.3.2.2-3", motion() & ~motion().next & service_is("stop") & arm[pi] & (control[pi] == Control.CONTROLLED), "R-6.3.5.9-2",
        provided=for_some(p)(predefined[p] & predefined_arm[p] & (predefined_control[p] == Control.CONTROLLED)))  # fmt: skip
    stops_all = Sometimes("R-7.3.3.4.1-3", motion() & ~motion().next & service_is("vMDStop"), "R-6.3.2.2-3")  # fmt: skip

    # Running modes that a service sets (7.3.3.3.1, 7.3.3.5.1, 7.4.5.1).
    given_mode = Step(
        "R-7.3.3.3.4.2-1",
        (service_is("start", "resume", "alterPI") & answered(PLUS) & limit.present & (control[pi] == Control.CONTROLLING)) >> (mode[pi].next == limit),
        "R-7.4.5-1", "R-7.3.3.5.4.3-1", "R-7.4.5.3.1-1", says="the running mode is the one that the request chose")  # fmt: skip
    given_cycles = Step(
        "R-7.3.3.3.1.4-1",
        (service_is("start", "resume", "alterPI") & answered(PLUS) & limit.present & (limit == Mode.CYCLE_LIMITED) & (control[pi] == Control.CONTROLLING))
        >> (cycles[pi].next == count),
        "R-7.3.3.5.1.5-1", "R-7.4.5.1.1.3-1", says="the remaining cycle count is the one that the request gave")  # fmt: skip
    given_steps = Step(
        "R-7.3.3.3.1.5-1",
        (service_is("start", "resume", "alterPI") & answered(PLUS) & limit.present & (limit == Mode.STEP_LIMITED) & (control[pi] == Control.CONTROLLING))
        >> (steps[pi].next == count),
        "R-7.3.3.5.1.6-1", "R-7.4.5.1.1.5-1", says="the remaining step count is the one that the request gave")  # fmt: skip

    # The base state machine, which figure 10 refines (6.3.3): from, to.
    was, becomes = state[p], state[p].next
    base_arrows = any_of(
        becomes == was,
        (was == State.NON_EXISTENT) & (becomes == State.IDLE) & service_is("createProgramInvocation"),
        (was == State.IDLE) & becomes.isin([State.STARTING, State.RUNNING]),
        (was == State.STARTING) & becomes.isin([State.RUNNING, State.IDLE, State.UNRUNNABLE]),
        (was == State.RUNNING) & becomes.isin([State.STOPPING, State.STOPPED, State.IDLE, State.UNRUNNABLE]),
        (was == State.STOPPING) & becomes.isin([State.STOPPED, State.RUNNING, State.UNRUNNABLE]),
        (was == State.STOPPED) & becomes.isin([State.RESUMING, State.RESETTING, State.RUNNING, State.IDLE, State.UNRUNNABLE]),
        (was == State.RESUMING) & becomes.isin([State.RUNNING, State.STOPPED, State.UNRUNNABLE]),
        (was == State.RESETTING) & becomes.isin([State.IDLE, State.STOPPED, State.UNRUNNABLE]),
        (was != State.NON_EXISTENT) & (becomes == State.UNRUNNABLE) & (service_is("kill") | destructive),
        was.isin([State.IDLE, State.STOPPED, State.UNRUNNABLE]) & (becomes == State.NON_EXISTENT) & service_is("deleteProgramInvocation"),
        service_is("vMDReset", "vMDStop", "emergency_stop", "operator_recovers"),
    )  # fmt: skip
    program_diagram = Step(
        "R-6.3.3-2", for_all(p)(base_arrows),
        says="program invocations change their state along the base standard's diagram")  # fmt: skip


class TransitionsRepaired(Transitions, VocabularyRepaired):
    """The repaired reading."""

    ready_left_by_deassign = Step(
        "R-5.3.1.3.3.5-1",
        ((before == RobotState.READY) & (later == RobotState.LOADED)) >> any_of(service_is("select", "kill", "deleteProgramInvocation", "vMDReset"), destructive),
        says="from READY to LOADED leads a Deassign, or what takes the selected task program away",
        repairs=repaired("RP-20", "R-5.3.1.3.3.5-1", because="the selected task program can be killed or deleted"))  # fmt: skip
    moves_something = for_some(c)(controls[pi, c] & arm[c])
    start_makes_executing = Step(
        "R-5.3.1.3.3.6-1",
        (service_is("start") & answered(PLUS) & (before == RobotState.READY) & selected[pi] & is_task)
        >> if_(moves_something, later == RobotState.EXECUTING, later == RobotState.MOTION_PAUSED),
        says="Start of the selected task program makes the robot EXECUTING, or without an arm MOTION-PAUSED",
        repairs=repaired("RP-20", "R-5.3.1.3.3.6-1", because="without an arm in the list there is no motion to enable"))  # fmt: skip
    resume_makes_executing = Step(
        "R-5.3.1.3.3.10-1",
        (service_is("resume") & answered(PLUS) & (before == RobotState.MOTION_PAUSED) & selected[pi] & is_task)
        >> if_(moves_something, later == RobotState.EXECUTING, later == RobotState.MOTION_PAUSED),
        says="Resume of the paused task program makes the robot EXECUTING, or without an arm MOTION-PAUSED",
        repairs=repaired("RP-20", "R-5.3.1.3.3.10-1", because="without an arm in the list there is no motion to enable"))  # fmt: skip
    reset_makes_ready = Step(
        "R-5.3.1.3.3.8-1",
        (service_is("reset") & answered(PLUS) & (before == RobotState.MOTION_PAUSED) & selected[pi] & reusable[pi]) >> (later == RobotState.READY),
        says="Reset of the paused task program makes the robot READY, if it is reusable",
        repairs=repaired("RP-04", "R-5.3.1.3.3.8-1", because="what is not reusable becomes UNRUNNABLE and is deselected"))  # fmt: skip
    assign_makes_ready = Step(
        "R-5.3.1.3.3.4-1",
        (service_is("select") & answered(PLUS) & controlling.present & (before != RobotState.INTERVENTION)) >> (later == RobotState.READY),
        says="what has been assigned makes the robot READY",
        repairs=repaired("RP-09", "R-5.3.1.3.3.4-1", because="nothing is assigned in MANUAL-INTERVENTION-REQUIRED"))  # fmt: skip
    abort_removes_programs = Step(
        "R-5.3.1.3.3.11-2",
        (service_is("vMDReset") & answered(PLUS))
        >> for_all(p)((exists[p] & (control[p] == Control.CONTROLLING) & deletable[p]) >> (state[p].next == State.NON_EXISTENT)),
        "R-5.3.1.3.3.12-2", says="Clear(abort) and Clear(abandon) remove all task programs that can be deleted",
        repairs=repaired("RP-08", "R-5.3.1.3.3.11-2", because="a predefined task program that cannot be deleted remains, and the robot is LOADED"))  # fmt: skip

    # By local activity, too (5.3.1.3.3.1, 6.3.4.1): somebody at the panel.
    loaded_at_the_panel = Sometimes(
        "R-5.3.1.3.3.1-1", (before == RobotState.IDLE) & (later == RobotState.LOADED) & panel, "R-6.3.4.1-3",
        provided=~never_idle & ~single_task())  # fmt: skip
    assigned_at_the_panel = Sometimes(
        "R-5.3.1.3.3.1-1", (before == RobotState.LOADED) & (later == RobotState.READY) & panel, "R-6.3.4.1-3")  # fmt: skip
    started_at_the_panel = Sometimes(
        "R-5.3.1.3.3.1-1", (before == RobotState.READY) & (later == RobotState.EXECUTING) & panel, "R-6.3.4.1-3")  # fmt: skip
    paused_at_the_panel = Sometimes(
        "R-5.3.1.3.3.1-1", (before == RobotState.EXECUTING) & (later == RobotState.MOTION_PAUSED) & panel, "R-6.3.4.1-3")  # fmt: skip

    started_controls_its_own = Step(
        "R-7.3.3.3.3-d1",
        (service_is("start", "resume") & answered(PLUS) & (control[pi] == Control.CONTROLLING))
        >> for_all(c)(controls[pi, c] >> ((control[c] == Control.CONTROLLED) & controller[c, pi])),
        "R-7.3.3.5.3-d1", says="each element of the list is CONTROLLED and refers to what is started",
        repairs=repaired("RP-01", "R-7.3.3.3.3-d1", "R-7.3.3.5.3-d1", because="the check cannot fail where lists and references agree"))  # fmt: skip
    program_diagram = Step(
        "R-6.3.3-2", for_all(p)(base_arrows | ((becomes == State.IDLE) & service_is("end_of_execution", "reset"))),
        says="program invocations change their state along the base standard's diagram; controlled ones follow to IDLE",
        repairs=repaired("RP-05", "R-6.3.3-2", because="what the selected task program controls returns to IDLE with it, in whatever state it is"))  # fmt: skip
