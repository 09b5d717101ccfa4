"""What the standard claims of itself: invariants, reachability, steps of figure 8 (clauses 5.3, 6.1.3, 6.3).

A property is stated from the clauses that speak of states, never from the procedures that it judges.
"""

from mmsverify.model import (
    MINUS,
    Always,
    Assume,
    Derived,
    Initially,
    Step,
    answered,
    any_of,
    for_all,
    for_some,
    if_,
    service_is,
    unchanged,
)  # fmt: skip

from .vocabulary import Control, Logical, Mode, Physical, RobotState, State, Vocabulary

BY_MESSAGE = (
    "createProgramInvocation", "deleteProgramInvocation", "kill", "start", "stop", "resume", "reset", "select", "alterPI", "vMDStop", "vMDReset",
)  # fmt: skip


class Properties(Vocabulary):
    """As written."""

    # Power-on (6.3.5.2, 6.3.5.4) and what a profile must respect (8.3).
    at_power_on = Initially(
        "R-6.3.5.2-2", for_all(p)(state[p] == if_(predefined[p], State.IDLE, State.NON_EXISTENT))
    )
    control_at_power_on = Initially("R-6.3.2-1", for_all(p)(control[p] == predefined_control[p]))
    deletable_at_power_on = Initially("R-6.3.5.2-2", for_all(p)(deletable[p] == predefined_deletable[p]))
    reusable_at_power_on = Initially("R-6.3.5.2-2", for_all(p)(reusable[p] == predefined_reusable[p]))
    arm_at_power_on = Initially("R-6.1.2.1-1", for_all(p)(arm[p] == predefined_arm[p]))
    selection_at_power_on = Initially(
        "R-6.3.5.2-3", for_all(p)(selected[p] == selected_at_power_on[p]), "R-6.3.5.4-3"
    )
    lists_at_power_on = Initially(
        "R-6.3.2.3-2",
        for_all(p, c)(
            (controls[p, c] == predefined_controls[p, c]) & (controller[c, p] == predefined_controls[p, c])
        ),
        "R-6.3.5.4-3",
    )
    modes_at_power_on = Initially(
        "R-6.3.2.5-1", for_all(p)((mode[p] == Mode.FREE_RUN) & (cycles[p] == 0) & (steps[p] == 0))
    )
    rest_at_power_on = Initially("R-5.3.1.3.2.1-2", ~motion() & ~local_control())
    status_at_power_on = Initially(
        "R-5.3.1.3.2.1-2", (logical() == Logical.STATE_CHANGES_ALLOWED) & (physical() == Physical.OPERATIONAL)
    )
    nobody_at_power_on = Initially("R-9.2.2.1-3", for_all(u)(~associated[u] & ~holder[u]))
    no_request_at_power_on = Initially("R-9.2.2.1-3", for_all(q, p)(~entered[q, p] & ~selecting[q, p]))
    robot_at_power_on = Initially(
        "R-6.3.5.2-2",
        robot_state()
        == if_(
            for_some(p)(selected_at_power_on[p]),
            RobotState.READY,
            if_(some_controlling(), RobotState.LOADED, RobotState.IDLE),
        ),
        "R-6.3.5.1-1",
    )
    selected_predefined = Assume(
        "R-6.3.5.4-3",
        for_all(p)(
            selected_at_power_on[p] >> (predefined[p] & (predefined_control[p] == Control.CONTROLLING))
        ),
    )
    one_selected_predefined = Assume(
        "R-6.1.1-2", for_all(a, b)((selected_at_power_on[a] & selected_at_power_on[b]) >> (a == b))
    )
    lists_predefined = Assume(
        "R-6.3.2.3-2",
        for_all(a, c)(
            predefined_controls[a, c]
            >> (
                predefined[a]
                & (predefined_control[a] == Control.CONTROLLING)
                & predefined[c]
                & (predefined_control[c] == Control.CONTROLLED)
            )
        ),
        "R-6.3.2.3-1",
    )
    one_list_predefined = Assume(
        "R-6.3.1-3",
        for_all(a, b, c)((predefined_controls[a, c] & predefined_controls[b, c]) >> (a == b)),
        "R-7.3.3.1-4",
    )
    one_task_predefined = Assume(
        "R-5.3.1.3.3.4-2",
        for_all(a, b)(
            (
                single_task()
                & predefined[a]
                & (predefined_control[a] == Control.CONTROLLING)
                & predefined[b]
                & (predefined_control[b] == Control.CONTROLLING)
            )
            >> (a == b)
        ),
    )
    calibration_predefined = Assume(
        "R-8.3.2-3", for_all(p)(calibrates[p] >> ~predefined_deletable[p]), "R-8.3.2-2", "R-6.3.6-2"
    )
    calibration_normal = Assume(
        "R-6.3.6-7", for_all(p)(calibrates[p] >> (predefined[p] & (predefined_control[p] == Control.NORMAL)))
    )
    arm_predefined = Assume("R-8.3.1-6", for_all(p)(standard_arm[p] >> (predefined[p] & (predefined_control[p] == Control.CONTROLLED)
                                                                     & ~predefined_deletable[p] & predefined_reusable[p] & predefined_arm[p])),
                           "R-8.3.1-1", "R-8.3.1-3", "R-8.3.1-4")  # fmt: skip

    # Controlling and controlled program invocations (6.3.1, 6.3.2).
    one_controller = Always("R-6.3.1-3", for_all(a, b, c)((controls[a, c] & controls[b, c]) >> (a == b)), "R-7.3.3.1-4",
                            says="a controlled program invocation is on the list of at most one controlling one")  # fmt: skip
    one_reference = Always("R-6.3.2.8-1", for_all(a, b, c)((controller[c, a] & controller[c, b]) >> (a == b)),
                           says="a controlled program invocation refers to at most one controlling one")  # fmt: skip
    # The reference is an attribute of CONTROLLED program invocations only (6.3.2.8): what one of another kind keeps of it is none.
    refers = controller[c, a] & exists[c] & (control[c] == Control.CONTROLLED)
    lists_follow_references = Always("R-6.3.2.8-2", for_all(a, c)(refers >> controls[a, c]),
                                     says="the controlling program invocation that is referred to has the controlled one on its list")  # fmt: skip
    references_follow_lists = Always("R-6.3.2.3-2", for_all(a, c)((controls[a, c] & exists[a] & (control[a] == Control.CONTROLLING)) >> controller[c, a]),
                                     says="each program invocation on a list refers to the list's owner")  # fmt: skip
    listed_are_controlled = Always("R-6.3.2.3-2", for_all(a, c)((controls[a, c] & exists[a]) >> (exists[c] & (control[c] == Control.CONTROLLED))),
                                   says="each program invocation on a list exists and is CONTROLLED")  # fmt: skip
    references_are_controlling = Always("R-6.3.2.8-2", for_all(a, c)(refers >> (exists[a] & (control[a] == Control.CONTROLLING))),
                                        says="the program invocation that is referred to exists and is CONTROLLING")  # fmt: skip
    only_selected_controls = Always("R-7.3.3.1-4", for_all(a, c)((controls[a, c] & exists[a]) >> selected[a]), "R-6.1.1-2",
                                    says="nothing is controlled unless its controller is selected")  # fmt: skip

    # The selected program invocation (6.1.3.2.6).
    one_selected = Always(
        "R-6.1.1-2",
        for_all(a, b)((selected[a] & selected[b]) >> (a == b)),
        says="at most one program invocation is selected",
    )
    selected_is_controlling = Always("R-6.1.3.2.6-2", for_all(a)(selected[a] >> (exists[a] & (control[a] == Control.CONTROLLING))),
                                     "R-6.3.5.4-2", says="the selected program invocation exists and is CONTROLLING")  # fmt: skip
    selected_can_run = Always("R-6.1.3.1-0", for_all(a)(selected[a] >> (state[a] != State.UNRUNNABLE)), "R-6.3.4.4-1",
                              says="the selected program invocation is not UNRUNNABLE")  # fmt: skip

    # The robot states (6.3.4): each predicate.
    idle_has_no_controlling = Always("R-6.3.4.2-1", (robot_state() == RobotState.IDLE) >> ~some_controlling())
    idle_has_none_selected = Always("R-6.3.4.2-2", (robot_state() == RobotState.IDLE) >> ~some_selected())
    idle_arm_uncontrolled = Always(
        "R-6.3.4.2-3",
        for_all(c, a)(((robot_state() == RobotState.IDLE) & arm[c]) >> ~refers),
    )
    loaded_has_controlling = Always(
        "R-6.3.4.3-1", (robot_state() == RobotState.LOADED) >> (some_controlling() & ~some_selected())
    )
    loaded_arm_uncontrolled = Always(
        "R-6.3.4.3-1",
        for_all(c, a)(((robot_state() == RobotState.LOADED) & arm[c]) >> ~refers),
    )
    ready_has_idle_selected = Always(
        "R-6.3.4.4-1",
        (robot_state() == RobotState.READY)
        >> (some_selected() & for_all(a)(selected[a] >> state[a].isin([State.IDLE, State.STARTING]))),
    )
    ready_controls_arm = Always(
        "R-6.3.4.4-1",
        for_all(a, c)(
            ((robot_state() == RobotState.READY) & selected[a] & standard_arm[c]) >> controller[c, a]
        ),
    )
    executing_enables_motion = Always(
        "R-5.3.1.3.2.4-1", (robot_state() == RobotState.EXECUTING) >> motion(), "R-6.3.4.5-1"
    )
    executing_runs = Always(
        "R-6.3.4.5-2",
        (robot_state() == RobotState.EXECUTING) >> (some_selected() & for_all(a)(selected[a] >> started[a])),
    )
    paused_disables_motion = Always(
        "R-5.3.1.3.2.5-1", (robot_state() == RobotState.MOTION_PAUSED) >> ~motion(), "R-6.3.4.6-1"
    )
    paused_runs = Always(
        "R-6.3.4.6-2",
        (robot_state() == RobotState.MOTION_PAUSED)
        >> (some_selected() & for_all(a)(selected[a] >> started[a])),
    )
    intervention_stops_motion = Always(
        "R-5.3.1.3.2.6-1", (robot_state() == RobotState.INTERVENTION) >> ~motion(), "R-6.3.4.7-1"
    )
    intervention_logical = Always(
        "R-6.3.4.7-2",
        (robot_state() == RobotState.INTERVENTION) >> (logical() != Logical.STATE_CHANGES_ALLOWED),
        "R-T1-2",
    )
    intervention_physical = Always(
        "R-6.3.4.7-3",
        (robot_state() == RobotState.INTERVENTION) >> (physical() == Physical.NEEDS_COMMISSIONING),
        "R-T8-4",
    )
    motion_only_executing = Always(
        "R-6.2.2.5-2", motion() >> (robot_state() == RobotState.EXECUTING), "R-5.3.1.3.2.4-1"
    )
    motion_has_running_arm = Always(
        "R-3.2.2-1",
        motion() >> for_some(c)(arm[c] & (control[c] == Control.CONTROLLED) & runs[c]),
        "R-7.3.3.4.1-c",
        says="motion is enabled only while a controlled program invocation bound to an arm runs",
    )

    # The predicates of 6.3.4 as the text gives them, over the rest of the state: exhaustive and exclusive?
    idle_predicate = Derived(~some_controlling() & ~some_selected())
    loaded_predicate = Derived(some_controlling() & ~some_selected())
    ready_predicate = Derived(
        some_selected()
        & for_all(a, c)(
            (selected[a] >> (state[a] == State.IDLE)) & ((selected[a] & standard_arm[c]) >> controller[c, a])
        )
    )
    executing_predicate = Derived(
        motion() & some_selected() & for_all(a)(selected[a] >> state[a].isin([State.RUNNING, State.STOPPED]))
    )
    paused_predicate = Derived(
        ~motion() & some_selected() & for_all(a)(selected[a] >> state[a].isin([State.RUNNING, State.STOPPED]))
    )
    intervention_predicate = Derived(
        ~motion()
        & (logical() != Logical.STATE_CHANGES_ALLOWED)
        & (physical() == Physical.NEEDS_COMMISSIONING)
    )
    predicates_exhaustive = Always(
        "R-6.3.4.2-1",
        any_of(idle_predicate(), loaded_predicate(), ready_predicate(), executing_predicate(), paused_predicate(), intervention_predicate()),
        "R-6.3.4.3-1", "R-6.3.4.4-1", "R-6.3.4.5-2", "R-6.3.4.6-2", "R-6.3.4.7-3", says="some predicate of 6.3.4 holds in every state")  # fmt: skip
    predicates_exclusive = Always(
        "R-6.3.4.7-3", intervention_predicate() >> ~any_of(idle_predicate(), loaded_predicate(), ready_predicate(), executing_predicate(), paused_predicate()),
        "R-6.3.4.2-1", says="no two predicates of 6.3.4 hold in one state")  # fmt: skip

    # Local control and R_CTRL.
    local_control_logical = Always(
        "R-T1-1", local_control() >> (logical() != Logical.STATE_CHANGES_ALLOWED), "R-6.1.3.2.5-1"
    )
    one_holder = Always("R-8.6.1-2", for_all(u, v)((holder[u] & holder[v]) >> (u == v)), "R-5.3.1.2-1", "R-5.1.3-2",
                        says="at most one client holds R_CTRL")  # fmt: skip
    holder_is_associated = Always("R-9.2.2.1-3", for_all(u)(holder[u] >> associated[u]),
                                  says="the holder of R_CTRL has an association")  # fmt: skip
    calibration_is_normal = Always(
        "R-6.3.6-7", for_all(p)(calibrates[p] >> (control[p] == Control.NORMAL)), "R-8.3.2-3"
    )
    arm_is_controlled = Always("R-8.3.1-6", for_all(p)(standard_arm[p] >> (control[p] == Control.CONTROLLED)))
    arm_moves_arm = Always(
        "R-8.3.1-1",
        for_all(p)(standard_arm[p] >> arm[p]),
        says="R_ARM is bound to the domain of the robot arm",
    )
    arm_remains = Always(
        "R-8.3.1-3", for_all(p)((standard_arm[p] | calibrates[p]) >> (exists[p] & ~deletable[p])), "R-8.3.2-2"
    )

    steps_supported = Always(
        "R-6.3.2.5-5",
        for_all(p)((mode[p] == Mode.STEP_LIMITED) >> step_limited()),
        "R-7.3.3.3.1.5-3",
        "R-7.4.5.1.1.5-1",
        "R-5.3.2-2",
        says="nothing is STEP-LIMITED where that is not supported",
    )
    one_task = Always(
        "R-5.3.1.3.3.4-2",
        for_all(a, b)(
            (
                single_task()
                & exists[a]
                & (control[a] == Control.CONTROLLING)
                & exists[b]
                & (control[b] == Control.CONTROLLING)
            )
            >> (a == b)
        ),
        says="a robot that can hold only one task program holds no second one",
    )

    # Steps. A declared destructive failure (B-FAIL) is no refusal: it has an effect and says so.
    remote_cannot_in_local_control = Step(
        "R-3.2.1-1",
        (local_control() & service_is(*BY_MESSAGE) & ~panel & ~destructive)
        >> (unchanged(selected, controls, controller, motion, control, deletable, reusable, arm, mode, cycles, steps, logical, physical,
                      local_control, error_code, located, starts_elsewhere)
            & for_all(p)(settled[p].next == settled[p])),
        "R-6.2.1-6", says="in local control no service from afar changes anything but that it is being handled",
    )  # fmt: skip
    refusal_has_no_effect = Step(
        "R-7.4.4.2-i", (answered(MINUS) & ~destructive) >> unchanged(control, deletable, reusable, arm, controls, controller, mode, cycles, steps, selected, motion,
                                                   local_control, logical, physical, holder, robot_state),
        "R-7.3.3.3.3-d4", "R-7.3.3.5.3-d4", says="a result(-) has no effect")  # fmt: skip
    refusal_keeps_states = Step(
        "R-7.3.3.3.3-d4", (answered(MINUS) & ~destructive) >> for_all(p)(
            (state[p].next == state[p]) | state[p].isin([State.STARTING, State.STOPPING, State.RESUMING, State.RESETTING])),
        "R-7.3.3.5.3-d4", says="a result(-) leaves no program invocation in another state, transient ones apart")  # fmt: skip
    intervention_left_by_operator = Step(
        "R-5.3.1.3.3.13-2", ((robot_state() == RobotState.INTERVENTION) & ~service_is("operator_recovers")) >> (robot_state().next == RobotState.INTERVENTION),
        "R-5.3.1.3.2.6-2", says="manual intervention is never left but by the operator")  # fmt: skip
    association_changes_nothing = Step(
        "R-9.2.2.4-2", service_is("initiate", "release") >> unchanged(state, control, controls, controller, selected, motion, logical, physical, robot_state),
        "R-9.2.2.4-3", says="setting up or ending an association does not change the execution state")  # fmt: skip
