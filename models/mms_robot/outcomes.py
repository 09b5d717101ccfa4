"""What is there after a service, and what it leaves alone (5.1.3, 6.3.2, 7.3.3, 7.4, 8.6.1; base standard).

Claims about steps, from what the clauses and the base standard say that a service is for and whom it concerns.
What may change an attribute at all is said of every step, whichever procedure takes it.
"""

from mmsverify.model import (
    MINUS,
    PLUS,
    Always,
    Sometimes,
    Step,
    answered,
    any_of,
    for_all,
    for_some,
    if_,
    repaired,
    service_is,
    unchanged,
)

from .vocabulary import Control, Logical, Mode, Physical, RobotState, State, Vocabulary, VocabularyRepaired

NAMING_ONE = (
    "start",
    "stop",
    "resume",
    "reset",
    "kill",
    "createProgramInvocation",
    "deleteProgramInvocation",
)
TWO_STEPS = ("start", "stop", "resume", "reset")
AT_WORK = ("start", "stop", "resume", "reset", "kill")
CHANGING = (
    *AT_WORK, "createProgramInvocation", "deleteProgramInvocation", "select", "alterPI", "vMDReset", "initiateDownloadSequence",
    "loadDomainContent", "deleteDomain",
)  # fmt: skip


class Outcomes(Vocabulary):
    """The same in both readings."""

    created = service_is("createProgramInvocation") & answered(PLUS)

    # Creation (7.3.3.2.3; base standard).
    created_as_asked = Step("B-CREATE", created >> (deletable[pi].next & (reusable[pi].next == reuse) & (arm[pi].next == binds_arm) & untried[pi].next),
                            says="what was created can be deleted, is reusable as asked, and has not been executed")  # fmt: skip
    created_controls_nothing = Step(
        "R-7.3.3.2.3-a", (created & (kind == Control.CONTROLLING) & ~single_task()) >> for_all(c)(~controls[pi, c].next), "R-7.3.3.2.3-b",
        says="what was created CONTROLLING controls nothing")  # fmt: skip
    created_is_uncontrolled = Step("R-7.3.3.2.3-b", (created & (kind == Control.CONTROLLED)) >> for_all(a)(~controller[pi, a].next),
                                   says="what was created CONTROLLED is UNCONTROLLED")  # fmt: skip
    fixed_from_creation = Step("B-CREATE", ~service_is("createProgramInvocation") >> unchanged(control, deletable, reusable, arm),
                               "R-7.3.3.2.3-0", says="what a program invocation is, it is from its creation")  # fmt: skip
    creation_spares_others = Step(
        "B-CREATE", service_is("createProgramInvocation") >> for_all(p)(
            (p != pi) >> ((control[p].next == control[p]) & (deletable[p].next == deletable[p]) & (reusable[p].next == reusable[p]) & (arm[p].next == arm[p])
                          & (mode[p].next == mode[p]) & (located[p].next == located[p]) & (untried[p].next == untried[p]) & (error_code[p].next == error_code[p]))),
        says="creating one program invocation makes no other one different")  # fmt: skip
    assigned_with_load = Step(
        "R-5.3.1.3.3.4-2", (created & single_task() & (kind == Control.CONTROLLING)) >> (
            selected[pi].next & for_all(c)((standard_arm[c] & exists[c] & (state[c] != State.UNRUNNABLE) & ~for_some(a)(controller[c, a])) >> controls[pi, c].next)),
        "R-6.3.4.4-1", says="a robot for one task program assigns it with the load, and R_ARM to it")  # fmt: skip
    assigned_as_told = Step(
        "R-5.3.1.3.3.4-2", service_is("createProgramInvocation") >> for_all(c)((controls[pi, c].next & ~controls[pi, c]) >> (single_task() & (arm[c] | assigned.has(c)))),
        says="with a load nothing is assigned but arms and what the robot adds")  # fmt: skip

    # Whom a service concerns (7.3.3.1).
    concerns_what_it_names = Step(
        "R-7.3.3.1-1", service_is(*NAMING_ONE) >> for_all(p)(((p != pi) & ~controls[pi, p]) >> (state[p].next == state[p])), "R-7.3.3.1-3",
        says="a service changes the state of the program invocation that it names and of those that this one controls, of no other")  # fmt: skip
    selection_starts_nothing = Step("R-7.4.4-1", service_is("select", "alterPI") >> unchanged(state, motion, untried),
                                    says="neither selecting nor altering makes anything run or stop")  # fmt: skip
    vmd_stop_spares_others = Step("R-7.4.2.2-4", service_is("vMDStop") >> for_all(p)(~active[p] >> (state[p].next == state[p])), "R-6.3.5.13-2",
                                  says="VMD Stop leaves what is not at work as it is")  # fmt: skip
    deleted_by_reset_only = Step(
        "R-7.4.3.2-d", for_all(p)((exists[p] & ~exists[p].next) >> (service_is("vMDReset", "deleteProgramInvocation") & deletable[p])),
        says="only Delete and VMD Reset remove a program invocation, and only one that MMS may delete")  # fmt: skip

    # Indication and response (base standard).
    entered_state = if_(
        service_is("start"),
        State.STARTING,
        if_(service_is("stop"), State.STOPPING, if_(service_is("resume"), State.RESUMING, State.RESETTING)),
    )
    indicated = Step("B-START", (service_is(*TWO_STEPS) & answered("")) >> ((state[pi].next == entered_state) & entered[request, pi].next),
                     "B-STOP", "B-RESUME", "B-RESET", says="between indication and response a program invocation is in the transient state of the service")  # fmt: skip
    indicated_alone = Step(
        "B-START", (service_is(*TWO_STEPS) & answered("")) >> for_all(p)((p != pi) >> ((state[p].next == state[p]) & ~entered[request, p].next)),
        "B-STOP", "B-RESUME", "B-RESET", says="an indication concerns the program invocation that it names")  # fmt: skip
    response_ends_it = Step("B-RESPONSE", (service_is(*TWO_STEPS) & ~answered("")) >> for_all(p)(~entered[request, p].next),
                            says="after its response a request holds no program invocation in a transient state")  # fmt: skip
    refused_goes_back = Step(
        "B-START", (service_is(*TWO_STEPS) & answered(MINUS) & ~destructive & ~panel & entered[request, pi] & (state[pi] == entered_state)) >> (state[pi].next == settled[pi]),
        "B-STOP", "B-RESUME", "B-RESET", says="a result(-) gives back the state that the request found")  # fmt: skip
    failed_is_unrunnable = Step("B-FAIL", (service_is(*TWO_STEPS) & destructive) >> (state[pi].next == State.UNRUNNABLE),
                                says="a destructive failure leaves the program invocation UNRUNNABLE")  # fmt: skip
    selecting_ends = Step("R-6.3.3-1", (service_is("select") & ~answered("")) >> for_all(p)(~selecting[request, p].next), "R-6.3.3-t103", "R-6.3.3-t106",
                          says="after the response to Select nothing is being selected by it")  # fmt: skip
    being_selected_is_named = Step(
        "R-6.3.3-t101", (service_is("select") & answered("")) >> for_all(p)(selecting[request, p].next == if_(controlling.present, controlling == p, selected[p])),
        "R-6.3.3-t104", says="being selected is what Select names; without a name, being deselected is what is selected")  # fmt: skip

    only_entered_changes = Step("B-START", (service_is(*TWO_STEPS) & answered(MINUS) & ~entered[request, pi]) >> (state[pi].next == state[pi]),
                                "B-STOP", "B-RESUME", "B-RESET", "B-FAIL", says="a result(-) changes no program invocation that its request has not entered")  # fmt: skip
    asked_is_tried = Step("RP-27", (service_is("start") & answered("")) >> ~untried[pi].next, "R-6.3.2.1-1",
                          says="what has been asked to start may have been executed")  # fmt: skip

    # Attributes of execution (5.3.2, 6.3.2).
    only_tasks_have_modes = Step(
        "R-6.3.2.5-1", ((service_is("start", "alterPI") | (service_is("resume") & (type_given | ~limit.present))) & (control[pi] != Control.CONTROLLING)) >> unchanged(mode, cycles, steps, starts_elsewhere),
        "R-7.3.3.3.1.1-1", "R-7.4.5.1.1.1-1", says="no program invocation but a CONTROLLING one gets a running mode, a count or a start location")  # fmt: skip
    only_tasks_take_details = Step(
        "R-7.3.3.3.1-1", (service_is("start") & answered(PLUS) & (location_given | limit.present)) >> (control[pi] == Control.CONTROLLING), "R-7.3.3.3.1.2-1",
        says="a Start with a start location or a running mode is for a CONTROLLING program invocation")  # fmt: skip
    only_tasks_take_types = Step("R-7.3.3.5.1.1-1", (service_is("resume") & answered(PLUS) & type_given) >> (control[pi] == Control.CONTROLLING),
                                 says="a Resume with a resume type is for a CONTROLLING program invocation")  # fmt: skip
    modes_of_others = Step(
        "R-6.3.2.5-1", service_is("start", "resume", "alterPI") >> for_all(p)(
            (p != pi) >> ((mode[p].next == mode[p]) & (cycles[p].next == cycles[p]) & (steps[p].next == steps[p]) & (starts_elsewhere[p].next == starts_elsewhere[p]))),
        says="a running mode is given to the program invocation named, and to no other")  # fmt: skip
    modes_are_given = Step("R-5.3.2-3", ~service_is("start", "resume", "alterPI", "createProgramInvocation") >> unchanged(mode),
                           says="nothing changes a running mode but the services that give one")  # fmt: skip
    locations_are_given = Step("R-7.3.3.3.1.1-2", ~service_is("start") >> unchanged(starts_elsewhere),
                               says="where execution begins is given by Start")  # fmt: skip
    count_is_of_mode = Step(
        "R-6.3.2.6-1", (service_is("start", "resume", "alterPI") & answered(PLUS)) >> (
            ((cycles[pi].next == cycles[pi]) | (mode[pi].next == Mode.CYCLE_LIMITED)) & ((steps[pi].next == steps[pi]) | (mode[pi].next == Mode.STEP_LIMITED))),
        "R-6.3.2.7-1", says="a count of cycles is given with cycle mode only, and one of steps with step mode")  # fmt: skip
    counts_in_their_mode = Step(
        "R-6.3.2.6-1", ~service_is("start", "resume", "alterPI") >> for_all(p)(
            ((cycles[p].next == cycles[p]) | (mode[p] == Mode.CYCLE_LIMITED)) & ((steps[p].next == steps[p]) | (mode[p] == Mode.STEP_LIMITED))),
        "R-6.3.2.7-1", says="cycles are counted in cycle mode only, and steps in step mode")  # fmt: skip
    errors_come_of_execution = Step(
        "R-6.3.2.1-1", for_all(p)((error_code[p].next != error_code[p]) >> (service_is("createProgramInvocation") | ~untried[p])), "R-7.3.3.2.3-0",
        says="an error is recorded of execution, and reset by creation")  # fmt: skip

    # R_CTRL (5.1.3, 8.6.1, 9.2.2.1; base standard).
    associated_from_initiate = Step("B-ASSOCIATION", (service_is("initiate") & answered(PLUS)) >> associated[user].next,
                                    says="who has initiated has an association")  # fmt: skip
    associated_until_release = Step("B-ASSOCIATION", service_is("release") >> ~associated[user].next,
                                    says="whose association has ended has none")  # fmt: skip
    others_stay_associated = Step("B-ASSOCIATION", for_all(u)((associated[u] & ~associated[u].next) >> service_is("release")),
                                  says="no association ends but by its own end")  # fmt: skip
    one_association = Always("R-9.2.2.1-2", for_all(u, v)((single_association() & associated[u] & associated[v]) >> (u == v)),
                             says="in the base class there is one association at a time")  # fmt: skip
    terms_of_ownership = Step(
        "B-SEMAPHORE", (service_is("takeControl") & answered(PLUS) & ~single_association()) >> ((limited[user].next == times_out) & (keeps[user].next == stays)),
        says="who takes control owns it for as long, and beyond its association, as it asked")  # fmt: skip
    new_association_owes_nothing = Step("B-SEMAPHORE", (service_is("initiate") & answered(PLUS)) >> (~limited[user].next & ~keeps[user].next),
                                        says="nothing is agreed of R_CTRL before it is taken")  # fmt: skip
    terms_end_with_ownership = Always("B-SEMAPHORE", for_all(u)((limited[u] | keeps[u]) >> holder[u]),
                                      says="how long control is owned is agreed of its owner only")  # fmt: skip
    taken_over_on_purpose = Step("B-SEMAPHORE", (service_is("takeControl") & answered(PLUS) & hung()) >> preempts,
                                 says="a token that hangs goes only to who asks to take it over")  # fmt: skip
    taken_is_unhung = Step("B-SEMAPHORE", (service_is("takeControl") & answered(PLUS)) >> ~hung().next, says="a token that was taken does not hang")  # fmt: skip
    own_token_given_back = Step("B-SEMAPHORE", (service_is("relinquishControl") & answered(PLUS)) >> holder[user], "R-5.1.3-2",
                                says="only its owner gives R_CTRL back")  # fmt: skip
    time_ends_ownership = Step("B-SEMAPHORE", service_is("ownership_times_out") >> (limited[user] & ~holder[user].next),
                               says="a controlTimeOut ends ownership, where one was given")  # fmt: skip
    nothing_else_hangs = Step("B-SEMAPHORE", (hung().next & ~hung()) >> (service_is("ownership_times_out") | (service_is("release") & holder[user] & keeps[user])),
                              says="a token hangs if its owner's time is over, or if it stays with an association that is gone")  # fmt: skip
    control_is_asked_for = Step(
        "R-5.1.3-2", for_all(u)((holder[u].next & ~holder[u]) >> (service_is("takeControl") | (service_is("initiate") & single_association()))), "R-9.2.2.1-5",
        says="nobody holds R_CTRL who has not taken it")  # fmt: skip

    # Statuses (7.4.2.2, Tables 1 and 8).
    stopped_needs_somebody = Step(
        "R-T8-3", (service_is("vMDStop") & answered(PLUS)) >> ((logical().next == Logical.NO_STATE_CHANGES_ALLOWED) & (physical().next == Physical.NEEDS_COMMISSIONING)
                                                             & (robot_state().next == RobotState.INTERVENTION)), "R-7.4.2.2-5", "R-T8-4", "R-T8-1", "R-7.4.2.2-3",
        says="VMD Stop ends in the statuses of Table 8")  # fmt: skip
    intervenes, intervenes_later = (
        robot_state() == RobotState.INTERVENTION,
        robot_state().next == RobotState.INTERVENTION,
    )
    left_for_full_service = Sometimes(
        "R-5.3.1.3.2.6-2", intervenes & ~intervenes_later & (logical().next == Logical.STATE_CHANGES_ALLOWED) & (physical().next == Physical.OPERATIONAL))  # fmt: skip
    limited_in_operation = Sometimes(
        "R-T1-3", ~intervenes & ~intervenes_later & ~local_control() & (logical() == Logical.STATE_CHANGES_ALLOWED) & (logical().next == Logical.LIMITED_SERVICES_PERMITTED)
        & (physical() == Physical.OPERATIONAL) & (physical().next == Physical.INOPERABLE))  # fmt: skip
    supported_in_local_control = Sometimes(
        "R-T1-1",
        ~local_control() & local_control().next & (logical().next == Logical.SUPPORT_SERVICES_ALLOWED),
    )
    limited_in_intervention = Sometimes(
        "R-T1-2", ~intervenes & intervenes_later & (logical().next == Logical.LIMITED_SERVICES_PERMITTED)
    )

    # What is claimed of each service, and of what happens by itself, is not claimed of nothing.
    kills = Sometimes(
        "R-7.3.3.7.1-c",
        service_is("kill") & answered(PLUS) & exists[pi] & (state[pi].next == State.UNRUNNABLE),
    )
    stops = Sometimes(
        "R-7.3.3.4.1-d",
        service_is("stop")
        & answered(PLUS)
        & (state[pi] == State.STOPPING)
        & (state[pi].next == State.STOPPED),
    )
    error_is_recorded = Sometimes(
        "R-6.3.2.1-1", for_some(p)((error_code[p] == 0) & (error_code[p].next != 0))
    )
    program_moves_on = Sometimes("R-6.3.2.4-1", for_some(p)(~located[p] & located[p].next))
    hangs_after_time = Sometimes(
        "B-SEMAPHORE",
        service_is("ownership_times_out") & ~hung() & hung().next,
        provided=~single_association(),
    )
    deletes = Sometimes(
        "R-7.3.3.8.1-e",
        service_is("deleteProgramInvocation") & answered(PLUS) & exists[pi] & ~exists[pi].next,
    )
    counts_down = Sometimes(
        "R-6.3.2.6-1",
        for_some(p)(
            (state[p] == State.RUNNING)
            & (state[p].next == State.RUNNING)
            & (cycles[p].next < cycles[p])
            & ~service_is("alterPI", "resume")
        ),
    )
    steps_down = Sometimes(
        "R-6.3.2.7-1",
        for_some(p)(
            (state[p] == State.RUNNING)
            & (state[p].next == State.RUNNING)
            & (steps[p].next < steps[p])
            & ~service_is("alterPI", "resume")
        ),
        provided=step_limited(),
    )
    ownership_ends_in_time = Sometimes(
        "B-SEMAPHORE",
        service_is("ownership_times_out") & holder[user] & ~holder[user].next,
        provided=~single_association(),
    )

    # At the panel (5.3.1.4).
    panel_serves_local_control = Step("R-5.3.1.4-3", (panel & ~local_control()) >> ~answered(PLUS),
                                      says="without local control nobody at the panel is served")  # fmt: skip


class OutcomesRepaired(Outcomes, VocabularyRepaired):
    """The repaired reading."""

    # What the logical status admits (RP-11).
    no_changes_admitted = Step(
        "B-STATUS", (logical().isin([Logical.NO_STATE_CHANGES_ALLOWED, Logical.LIMITED_SERVICES_PERMITTED]) & service_is(*CHANGING) & ~panel) >> ~answered(PLUS),
        "R-6.1.3.2.5-2", says="where the logical status forbids changes of the state, no service that makes one is granted",
        repairs=repaired("RP-11", "R-6.1.3.2.5-2", because="the text leaves to the base standard what the logical status admits"))  # fmt: skip
    support_services_only = Step(
        "B-STATUS", ((logical() == Logical.SUPPORT_SERVICES_ALLOWED) & service_is(*AT_WORK) & ~panel) >> ~answered(PLUS),
        "R-6.1.3.2.5-2", says="where only support services are allowed, nothing is started, stopped, resumed, reset or killed",
        repairs=repaired("RP-11", "R-6.1.3.2.5-2", because="the text leaves to the base standard what the logical status admits"))  # fmt: skip

    # Selection and control.
    selected_by_holder = Step(
        "R-5.3.1.2-1", for_all(p)((service_is("select", "createProgramInvocation") & answered(PLUS) & selected[p].next & ~selected[p]) >> (holder[user] | panel)), "R-5.1.3-2",
        says="nothing is selected for a client without R_CTRL",
        repairs=repaired("RP-29", "R-5.3.1.3.3.4-2", because="a Create that selects is refused as Select would be"))  # fmt: skip
    nothing_selected_in_intervention = Step(
        "R-5.3.1.3.3.13-2", intervention() >> for_all(p)(selected[p].next >> selected[p]), "RP-09",
        says="in MANUAL-INTERVENTION-REQUIRED nothing becomes selected",
        repairs=repaired("RP-29", "R-5.3.1.3.3.13-2", because="a Create that selects is refused as Select would be"))  # fmt: skip
    led_until_idle = Step(
        "R-7.3.3.8.1-c1", for_all(a, c)((service_is("deleteProgramInvocation") & exists[c] & ~exists[c].next & controller[c, a] & (c != a)) >> (state[a] == State.IDLE)),
        says="what a task program at work controls is not deleted",
        repairs=repaired("RP-04", "R-7.3.3.8.1-c1", because="stated of whichever step deletes"))  # fmt: skip
    deselected_by_end = Step("R-5.3.1.3.3.7-2", service_is("end_of_execution") >> (~selected[pi].next & for_all(c)(~controls[pi, c].next | ~selected[pi])),
                             says="once execution has ended, nothing executes again before another Assign",
                             repairs=repaired("RP-05", "R-5.3.1.3.3.7-1", because="the selection is cleared at the end"))  # fmt: skip
    ended_is_idle = Step("B-END", service_is("end_of_execution") >> (state[pi].next == if_(reusable[pi], State.IDLE, State.UNRUNNABLE)),
                         says="a program that has ended is IDLE, or UNRUNNABLE where it is not reusable",
                         repairs=repaired("RP-05", "R-5.3.1.3.3.7-1", because="stated for what ends by itself"))  # fmt: skip
    controlled_end_too = Step(
        "R-5.3.1.3.3.7-1", (service_is("end_of_execution") & selected[pi]) >> for_all(c)((controls[pi, c] & started[c]) >> (state[c].next == State.IDLE)),
        says="what the task program controls returns to IDLE with it",
        repairs=repaired("RP-05", "R-5.3.1.3.3.7-1", because="the arm's program ends with the task program"))  # fmt: skip
    left_programs_stop = Step(
        "R-6.1.3.2.6-2", service_is(*NAMING_ONE, "fails_by_itself", "end_of_execution", "vMDStop", "vMDReset") >> for_all(a, c)(
            (selected[a] & ~selected[a].next & controls[a, c]) >> (state[c].next != State.RUNNING)), "RP-04",
        says="what the selected program invocation controlled does not run on when that goes away",
        repairs=repaired("RP-04", "R-7.3.3.7.1-c", because="nothing would lead it any more"))  # fmt: skip
    reset_takes_along = Step(
        "R-6.3.5.8-1", (service_is("reset") & answered(PLUS) & selected[pi]) >> for_all(c)((controls[pi, c] & started[c]) >> (state[c].next == State.IDLE)),
        says="what the task program controls is reset with it",
        repairs=repaired("RP-06", "R-6.3.5.8-1", because="the arm's program must return with the task program"))  # fmt: skip
    resumed_was_selected = Step(
        "R-6.3.5.10-1", (service_is("resume") & answered(PLUS) & (control[pi] == Control.CONTROLLING)) >> selected[pi], "RP-19",
        says="a task program that is resumed is the selected one",
        repairs=repaired("RP-19", "R-6.3.5.10-1", because="no less is asked of Resume than of Start"))  # fmt: skip
    listed_can_run = Step(
        "R-7.3.3.3.3-d4", (service_is("select") & answered(PLUS)) >> for_all(c)(controlled.has(c) >> (exists[c] & (state[c] != State.UNRUNNABLE))), "RP-15",
        says="what Select lists can be started",
        repairs=repaired("RP-15", "R-7.4.4.2-d", because="Start of the task program could never succeed"))  # fmt: skip
    no_calibration_beside_task = Always(
        "R-6.3.6-3", for_all(p, a)((calibrates[p] & runs[p] & selected[a]) >> ~runs[a]), "RP-17",
        says="the calibration program and the selected task program do not run beside each other",
        repairs=repaired("RP-17", "R-6.3.6-3", because="both would move the same arm"))  # fmt: skip
    running_was_tried = Always("R-6.3.2.1-1", for_all(p)(runs[p] >> ~untried[p]), "RP-27", says="what runs has been executed",
                               repairs=repaired("RP-27", "R-6.3.2.1-1", because="stated for the attributes that execution leaves"))  # fmt: skip
    only_tasks_are_altered = Step("R-7.4.5.1.1.1-1", (service_is("alterPI") & answered(PLUS)) >> (exists[pi] & (control[pi] == Control.CONTROLLING)), "RP-14",
                                  says="what is altered is an existing CONTROLLING program invocation",
                                  repairs=repaired("RP-14", "R-7.4.5.2-b", because="a name that does not exist is refused"))  # fmt: skip
    counts_not_negative = Always("R-6.3.2.6-1", for_all(p)((cycles[p] >= 0) & (steps[p] >= 0)), "R-6.3.2.7-1", "RP-14",
                                 says="no less than nothing is left",
                                 repairs=repaired("RP-14", "R-7.4.5.2-b", because="a count that is not positive is refused"))  # fmt: skip
    alter_count_positive = Step(
        "R-7.3.3.3.1.4-2", (service_is("alterPI") & answered(PLUS) & limit.present & (limit != Mode.FREE_RUN)) >> (count > 0), "R-7.3.3.3.1.5-2",
        says="a program is altered to a positive count",
        repairs=repaired("RP-14", "R-7.4.5.2-b", because="no less is asked of Alter than of Start"))  # fmt: skip

    # Motion (3.2.2, 7.3.3.3.3 f, 7.3.3.4.1 c).
    started_arm_moves = Step(
        "R-7.3.3.3.3-f", (service_is("start", "resume") & answered(PLUS) & arm[pi] & (control[pi] == Control.CONTROLLED)) >> motion().next,
        says="starting or resuming the arm's program enables motion",
        repairs=repaired("RP-02", "R-7.3.3.3.3-f", because="motion is enabled when the arm's program enters RUNNING"))  # fmt: skip
    left_arm_rests = Step(
        "R-3.2.2-1", for_all(c)((arm[c] & (control[c] == Control.CONTROLLED) & runs[c] & ~runs[c].next) >> ~motion().next), "RP-03",
        says="when the arm's program leaves RUNNING, motion ends",
        repairs=repaired("RP-03", "R-7.3.3.4.1-c", because="whatever makes it leave RUNNING"))  # fmt: skip
    pause_has_a_cause = Step(
        "R-6.3.5.9-1", ((robot_state() == RobotState.EXECUTING) & (robot_state().next == RobotState.MOTION_PAUSED)) >> any_of(
            for_some(c)(arm[c] & (control[c] == Control.CONTROLLED) & runs[c] & ~runs[c].next),
            for_all(a)(selected[a] >> (state[a] != State.RUNNING))), "R-5.3.1.3.3.9-1", "R-7.3.3.4.1-1",
        says="the robot pauses only if an arm's program does not run any more, or after its task program has been stopped",
        repairs=repaired("RP-07", "R-7.3.3.4.1-1", because="after Stop of the task program the arm comes to rest by itself"))  # fmt: skip
    arm_rests_after_stop = Sometimes(
        "R-7.3.3.4.1-1", for_some(a, c)(selected[a] & (state[a] == State.STOPPED) & controls[a, c] & arm[c] & (state[c].next == State.RUNNING))
        & motion() & (robot_state().next == RobotState.MOTION_PAUSED) & unchanged(state), "R-5.3.1.3.3.9-1",
        provided=for_some(p)(predefined[p] & predefined_arm[p] & (predefined_control[p] == Control.CONTROLLED)),
        repairs=repaired("RP-07", "R-7.3.3.4.1-1", because="stated for the rest after Stop"))  # fmt: skip
    motion_leaves_programs = Step("R-7.3.3.4.1-1", service_is("arm_comes_to_rest") >> unchanged(state, selected, controls, controller),
                                  says="that the arm comes to rest changes no program",
                                  repairs=repaired("RP-07", "R-7.3.3.4.1-1", because="stated for the rest after Stop"))  # fmt: skip

    kept_token_hangs = Step("B-SEMAPHORE", (service_is("release") & holder[user] & keeps[user]) >> hung().next, "R-8.6.1-3",
                            says="a token that stays with an association hangs when that is gone",
                            repairs=repaired("RP-16", "R-8.6.1-3", because="stated for the token that goes back"))  # fmt: skip
