"""Creating, deleting, killing program invocations; what they do by themselves (7.3.3.2, .7, .8; 6.3.2.5).

Each part states the text as it stands, then the repaired reading of the same clauses.
"""

from mmsverify.model import (
    Procedure,
    Transition,
    accept,
    do,
    for_some,
    if_,
    integer,
    internal,
    parameter,
    refuse,
    repaired,
    response,
)  # fmt: skip

from .admission import ALL_BUT_RUNNING, EVERYTHING, admission
from .vocabulary import (
    Calibration,
    Control,
    DomainState,
    Mode,
    RobotState,
    State,
    Vocabulary,
    VocabularyRepaired,
)


class Programs(Vocabulary):
    """As written."""

    # What Create needs of the domains that it names, and what it and Delete do with them (base standard).
    domains_fit = [
        refuse("R-7.3.3.2.3-0", "B-CREATE", when=for_some(d)(domains.has(d) & (domain_state[d] != DomainState.READY)),
               rule="create.domain", says="a domain named is neither READY nor IN-USE"),
        refuse("R-7.3.3.2.3-0", "R-8.2.2-2", "R-8.2.3-2", "B-CREATE", when=for_some(d)(domains.has(d) & in_use[d] & ~sharable[d]),
               rule="create.unsharable", says="a domain named is in use and not sharable"),
    ]  # fmt: skip
    bind_domains = [uses[pi, d].becomes(domains.has(d)).over(d)]
    unbind_domains = [uses[pi, d].becomes(False).over(d)]

    others_controlling = for_some(p)((p != pi) & exists[p] & (control[p] == Control.CONTROLLING))

    # A robot that can hold only one task program: load and assign are one operation (5.3.1.3.3.4). Which
    # CONTROLLED program invocations are assigned with it is a local matter, but the arm's are (6.3.4.4).
    also_assigns = single_task() & (kind == Control.CONTROLLING)
    free_controlled = (
        exists[c]
        & (control[c] == Control.CONTROLLED)
        & (state[c] != State.UNRUNNABLE)
        & ~for_some(a)(controller[c, a])
    )
    comes_along = (arm[c] | assigned.has(c)) & free_controlled
    # What is selected then was left behind by VMD Reset; Select would deselect it first, in its steps f) and g).
    deassign_first = [
        controller[c, b].becomes(False).over(a, c, b).when(selected[a] & controls[a, c]),
        controls[a, c].becomes(False).over(a, c).when(selected[a]),
    ]  # fmt: skip
    assign_too = [
        controls[pi, c].becomes(True).over(c).when(comes_along),
        controller[c, a].becomes(True).over(c, a).when(comes_along & (a == pi)),
        selected[pi].becomes(True),
    ]  # fmt: skip

    create = Procedure(
        "R-7.3.3.2.3",
        on=response("createProgramInvocation", request, user, pi, kind, reuse, binds_arm, domains, assigned),
        steps=[
            refuse("0", "B-CREATE", when=exists[pi], rule="create.exists", says="{pi} exists already"),
            *domains_fit,
            refuse("R-5.3.1.3.3.4-2", when=also_assigns & some_controlling(), rule="create.second-task",
                   says="the robot holds another task program, and can hold only one"),
            do("0", state[pi].becomes(State.IDLE), control[pi].becomes(kind), deletable[pi].becomes(True),
               reusable[pi].becomes(reuse), arm[pi].becomes(binds_arm), error_code[pi].becomes(0), untried[pi].becomes(True), *bind_domains),
            do("a", controls[pi, c].becomes(False).over(c).when(kind == Control.CONTROLLING),
               mode[pi].becomes(Mode.FREE_RUN).when(kind == Control.CONTROLLING),
               located[pi].becomes(False).when(kind == Control.CONTROLLING)),
            do("b", controller[pi, a].becomes(False).over(a).when(kind == Control.CONTROLLED)),
            do("R-5.3.1.3.3.2-3", robot_state().becomes(RobotState.LOADED).when(kind == Control.CONTROLLING), cites=["R-6.3.5.2-1"]),
            accept("0", when=~also_assigns),
            do("R-7.4.4.2-f1", *deassign_first, cites=["R-7.4.4.2-f2"]),
            do("R-7.4.4.2-g", selected[a].becomes(False).over(a)),
            do("R-5.3.1.3.3.4-2", *assign_too, robot_state().becomes(RobotState.READY), cites=["R-6.3.4.4-1"]),
            accept("R-5.3.1.3.3.4-2"),
        ],
    )  # fmt: skip

    delete = Procedure(
        "R-7.3.3.8.1",
        on=response("deleteProgramInvocation", request, user, pi),
        steps=[
            refuse("a", "B-DELETE", unless=exists[pi], rule="delete.unknown", says="{pi} does not exist"),
            refuse("a", "B-DELETE", unless=deletable[pi], rule="delete.not-deletable", says="{pi} cannot be deleted by MMS"),
            refuse("a", "B-DELETE", unless=state[pi].isin([State.IDLE, State.STOPPED, State.UNRUNNABLE]),
                   rule="delete.state", says="{pi} is neither IDLE nor STOPPED nor UNRUNNABLE"),
            refuse("b", unless=holder[user], rule="delete.without-control", says="{user} does not hold R_CTRL"),
            refuse("c1", when=(control[pi] == Control.CONTROLLED) & for_some(a)(controller[pi, a] & (state[a] != State.IDLE)),
                   rule="delete.controller-active", says="the program invocation that controls {pi} is not IDLE"),
            do("c2", controls[a, pi].becomes(False).over(a).when((control[pi] == Control.CONTROLLED) & controller[pi, a])),
            do("d", controller[c, pi].becomes(False).over(c).when((control[pi] == Control.CONTROLLING) & controls[pi, c])),
            do("e", state[pi].becomes(State.NON_EXISTENT), *unbind_domains),
            do("R-5.3.1.3.3.3-1", robot_state().becomes(RobotState.IDLE).when((control[pi] == Control.CONTROLLING) & ~others_controlling),
               cites=["R-6.3.5.3-1"]),
            accept("e"),
        ],
    )  # fmt: skip

    kill = Procedure(
        "R-7.3.3.7.1",
        on=response("kill", request, user, pi),
        steps=[
            refuse("a", "B-KILL", unless=exists[pi], rule="kill.unknown", says="{pi} does not exist"),
            refuse("b", unless=holder[user], rule="kill.without-control", says="{user} does not hold R_CTRL"),
            do("c", state[pi].becomes(State.UNRUNNABLE)),
            accept("c"),
        ],
    )  # fmt: skip

    end_of_execution = Transition(
        "R-5.3.1.3.3.7-1", "R-6.3.5.7-1", "R-6.3.2.5-3", "B-END",
        on=internal("end_of_execution", pi),
        when=[state[pi] == State.RUNNING, ~calibrates[pi]],
        then=[state[pi].becomes(if_(reusable[pi], State.IDLE, State.UNRUNNABLE)),
              cycles[pi].becomes(0).when(mode[pi] == Mode.CYCLE_LIMITED),
              robot_state().becomes(RobotState.LOADED).when(selected[pi] & (robot_state() == RobotState.EXECUTING))],
    )  # fmt: skip

    remaining = parameter("remaining", integer())

    counts_cycles = Transition(
        "R-6.3.2.5-3", "R-6.3.2.6-1",
        on=internal("counts_cycles", pi, remaining),
        when=[runs[pi], mode[pi] == Mode.CYCLE_LIMITED, remaining >= 0, remaining < cycles[pi]],
        then=[cycles[pi].becomes(remaining)],
    )  # fmt: skip

    counts_steps = Transition(
        "R-6.3.2.5-4", "R-6.3.2.7-1",
        on=internal("counts_steps", pi, remaining),
        when=[runs[pi], mode[pi] == Mode.STEP_LIMITED, remaining >= 0, remaining < steps[pi]],
        then=[steps[pi].becomes(remaining)],
    )  # fmt: skip

    steps_exhausted = Transition(
        "R-6.3.2.5-4",
        on=internal("steps_exhausted", pi),
        when=[state[pi] == State.RUNNING, mode[pi] == Mode.STEP_LIMITED],
        then=[state[pi].becomes(State.STOPPED), steps[pi].becomes(0)],
    )  # fmt: skip


class ProgramsRepaired(Programs, VocabularyRepaired):
    """The repaired reading."""

    moves_arm = arm[pi] & (control[pi] == Control.CONTROLLED)

    # The selected program invocation goes away: it is deselected first, and what it controlled and still runs
    # is stopped.
    deselect_first = [
        state[c].becomes(State.STOPPED).over(c).when(selected[pi] & controls[pi, c] & (state[c] == State.RUNNING)),
        controller[c, a].becomes(False).over(c, a).when(selected[pi] & (a == pi)),
        controls[a, c].becomes(False).over(a, c).when(selected[pi] & (a == pi)),
        motion().becomes(False).when(selected[pi] | (moves_arm & runs[pi])),
        selected[a].becomes(False).over(a).when(a == pi),
    ]  # fmt: skip

    create = Procedure(
        "R-7.3.3.2.3",
        on=response("createProgramInvocation", request, user, panel, pi, kind, reuse, binds_arm, domains, assigned),
        steps=[
            *admission("create", panel, local_control(), logical(), ALL_BUT_RUNNING),
            refuse("0", "B-CREATE", when=exists[pi], rule="create.exists", says="{pi} exists already"),
            *domains_fit,
            refuse("R-5.3.1.3.3.13-2", "RP-29", when=also_assigns & intervention(), rule="create.intervention", level="warning",
                   says="the robot is in MANUAL-INTERVENTION-REQUIRED, and {pi} would be selected too"),
            refuse("R-7.4.4.2-a", "RP-29", when=also_assigns & ~(holder[user] | panel), rule="create.without-control", level="warning",
                   says="{user} does not hold R_CTRL, and {pi} would be selected too"),
            refuse("R-5.3.1.3.3.4-2", "RP-29", when=also_assigns & some_controlling(), rule="create.second-task", level="warning",
                   says="the robot holds another task program, and can hold only one"),
            do("0", state[pi].becomes(State.IDLE), control[pi].becomes(kind), deletable[pi].becomes(True),
               reusable[pi].becomes(reuse), arm[pi].becomes(binds_arm), error_code[pi].becomes(0), untried[pi].becomes(True), *bind_domains),
            do("a", controls[pi, c].becomes(False).over(c), mode[pi].becomes(Mode.FREE_RUN), located[pi].becomes(False)),
            do("b", controller[pi, a].becomes(False).over(a)),
            accept("0", when=~also_assigns),
            do("R-5.3.1.3.3.4-2", *assign_too, cites=["RP-29", "R-6.3.4.4-1"]),
            accept("R-5.3.1.3.3.4-2"),
        ],
        repairs=repaired("RP-13", "R-5.3.1.3.3.2-3", because="a new task program does not change READY, EXECUTING or MOTION-PAUSED"),
    )  # fmt: skip

    delete = Procedure(
        "R-7.3.3.8.1",
        on=response("deleteProgramInvocation", request, user, panel, pi),
        steps=[
            *admission("delete", panel, local_control(), logical(), ALL_BUT_RUNNING),
            refuse("a", "B-DELETE", unless=exists[pi], rule="delete.unknown", says="{pi} does not exist"),
            refuse("a", "B-DELETE", unless=deletable[pi], rule="delete.not-deletable", says="{pi} cannot be deleted by MMS"),
            refuse("a", "B-DELETE", unless=state[pi].isin([State.IDLE, State.STOPPED, State.UNRUNNABLE]),
                   rule="delete.state", says="{pi} is neither IDLE nor STOPPED nor UNRUNNABLE"),
            refuse("b", unless=holder[user] | panel, rule="delete.without-control", says="{user} does not hold R_CTRL"),
            refuse("c1", when=(control[pi] == Control.CONTROLLED) & for_some(a)(controller[pi, a] & (state[a] != State.IDLE)),
                   rule="delete.controller-active", says="the program invocation that controls {pi} is not IDLE"),
            refuse("R-7.3.3.8.1-e", "RP-04", when=selected[pi] & motion(), rule="delete.in-motion", level="warning",
                   says="{pi} is selected and motion is enabled"),
            do("R-6.1.3.2.6-2", *deselect_first, cites=["RP-04"]),
            do("c2", controls[a, pi].becomes(False).over(a)),
            do("d", controller[c, pi].becomes(False).over(c)),
            do("e", state[pi].becomes(State.NON_EXISTENT), controller[pi, a].becomes(False).over(a),
               controls[pi, c].becomes(False).over(c), *unbind_domains),
            accept("e"),
        ],
        repairs=repaired("RP-04", "R-7.3.3.8.1-e", "R-6.1.3.2.6-2", "R-6.3.2.3-2",
                         because="the text leaves the selected attribute and the list of a deleted program invocation dangling"),
    )  # fmt: skip

    kill = Procedure(
        "R-7.3.3.7.1",
        on=response("kill", request, user, panel, pi),
        steps=[
            *admission("kill", panel, local_control(), logical(), EVERYTHING),
            refuse("a", "B-KILL", unless=exists[pi], rule="kill.unknown", says="{pi} does not exist"),
            refuse("b", unless=holder[user] | panel, rule="kill.without-control", says="{user} does not hold R_CTRL"),
            do("R-6.1.3.2.6-2", *deselect_first, cites=["RP-03", "RP-04"]),
            do("R-6.3.6-5", *breaks_off, cites=["RP-26"]),
            do("c", state[pi].becomes(State.UNRUNNABLE)),
            accept("c"),
        ],
        repairs=repaired("RP-04", "R-7.3.3.7.1-c", because="a killed program invocation cannot control the robot, nor move its arm"),
    )  # fmt: skip

    end_of_execution = Transition(
        "R-5.3.1.3.3.7-1", "R-5.3.1.3.3.7-2", "R-6.3.5.7-1", "R-6.3.2.5-3", "B-END",
        on=internal("end_of_execution", pi),
        when=[state[pi] == State.RUNNING, ~calibrates[pi]],
        then=[
            state[c].becomes(State.IDLE).over(c).when(selected[pi] & controls[pi, c] & started[c]),
            state[pi].becomes(if_(reusable[pi], State.IDLE, State.UNRUNNABLE)),
            controller[c, a].becomes(False).over(c, a).when(selected[pi] & (a == pi)),
            controls[a, c].becomes(False).over(a, c).when(selected[pi] & (a == pi)),
            motion().becomes(False).when(selected[pi] | moves_arm),
            cycles[pi].becomes(0).when(mode[pi] == Mode.CYCLE_LIMITED),
            selected[a].becomes(False).over(a).when(a == pi),
        ],
        repairs=repaired("RP-05", "R-5.3.1.3.3.7-1", "R-6.3.2.5-3",
                         because="the robot is LOADED again only if the selection is cleared; a new Select is due before the next Start"),
    )  # fmt: skip

    steps_exhausted = Transition(
        "R-6.3.2.5-4",
        on=internal("steps_exhausted", pi),
        when=[state[pi] == State.RUNNING, mode[pi] == Mode.STEP_LIMITED],
        then=[state[pi].becomes(State.STOPPED), steps[pi].becomes(0), motion().becomes(False).when(moves_arm)],
        repairs=repaired("RP-03", "R-6.3.2.5-4", because="motion is not enabled by an arm program that has left RUNNING"),
    )  # fmt: skip

    fails_by_itself = Transition(
        "R-6.3.2.1-1", "B-FAIL", "RP-18",
        on=internal("fails_by_itself", pi, destructive),
        when=[state[pi] == State.RUNNING],
        then=[
            calibration[r].becomes(Calibration.NOT_CALIBRATED).over(r).when(destructive & calibrates_device[pi, r]),
            joint_calibration[r, j].becomes(Calibration.NOT_CALIBRATED).over(r, j).when(destructive & calibrates_device[pi, r]),
            state[c].becomes(State.STOPPED).over(c).when(destructive & selected[pi] & controls[pi, c] & (state[c] == State.RUNNING)),
            state[pi].becomes(if_(destructive, State.UNRUNNABLE, State.STOPPED)),
            controller[c, a].becomes(False).over(c, a).when(destructive & selected[pi] & (a == pi)),
            controls[a, c].becomes(False).over(a, c).when(destructive & selected[pi] & (a == pi)),
            motion().becomes(False).when((destructive & selected[pi]) | moves_arm),
            selected[a].becomes(False).over(a).when(destructive & (a == pi)),
        ],
        observation_only=True,
        repairs=repaired("RP-18", "R-6.3.2.1-1", because="a program may stop on its own error, which no message announces"),
    )  # fmt: skip
