"""The VMD and its operator (7.4.2, 7.4.3, 5.3.1.3.3.13, Table 1).

VMD Stop, VMD Reset, emergency action, local control and the two statuses.
"""

from mmsverify.model import (
    Procedure,
    Transition,
    accept,
    do,
    for_some,
    if_,
    internal,
    refuse,
    repaired,
    response,
)

from .vocabulary import Calibration, Logical, Physical, RobotState, State, Vocabulary, VocabularyRepaired


class Vmd(Vocabulary):
    """As written."""

    done_before = PI.some("done_before")

    # "Their state is a local matter": each of them ends in one of the states that are not RUNNING.
    halted = if_(to_idle.has(p), State.IDLE, if_(to_unrunnable.has(p), State.UNRUNNABLE, State.STOPPED))
    halt_all = [state[p].becomes(halted).over(p).when(active[p])]

    vmd_stop = Procedure(
        "R-7.4.2.2",
        on=response("vMDStop", request, user, to_idle, to_unrunnable, held),
        steps=[
            refuse("1", unless=holder[user], rule="vmd-stop.without-control", says="{user} does not hold R_CTRL"),
            do("2", motion().becomes(False), cites=["R-7.4.2-1", "R-7.3.3.4.1-3"]),
            do("3", robot_state().becomes(RobotState.INTERVENTION), cites=["R-T8-1"]),
            do("4", *halt_all),
            do("5", logical().becomes(Logical.NO_STATE_CHANGES_ALLOWED), cites=["R-T8-3"]),
            do("R-T8-4", physical().becomes(Physical.NEEDS_COMMISSIONING)),
            do("R-T8-2", local_control().becomes(for_some(r)(held.has(r))), device_local[r].becomes(held.has(r)).over(r)),
            accept("5"),
        ],
    )  # fmt: skip

    vmd_reset = Procedure(
        "R-7.4.3.2",
        on=response("vMDReset", request, user, prevented, step_fails, done_before),
        steps=[
            refuse("a", unless=holder[user], rule="vmd-reset.without-control", says="{user} does not hold R_CTRL"),
            refuse("b", when=robot_state() == RobotState.EXECUTING, rule="vmd-reset.executing", says="the robot is executing"),
            refuse("c", when=prevented, rule="vmd-reset.prevented", says="local conditions prevent it"),
            # Any step may fail, and then the service does: what had been deleted before stays deleted.
            do("d", state[p].becomes(State.NON_EXISTENT).over(p).when(deletable[p] & (~step_fails | done_before.has(p)))),
            refuse("1", when=step_fails, rule="vmd-reset.step-fails", says="a step of it failed"),
            do("d", *reset_domains),
            do("e", robot_state().becomes(RobotState.IDLE)),
            accept("f", "R-7.4.3.2-2"),
        ],
    )  # fmt: skip

    emergency_stop = Transition(
        "R-5.3.1.3.3.13-1", "R-6.3.5.13-1", "R-6.3.5.13-2",
        on=internal("emergency_stop", to_stopped, to_idle, to_unrunnable, status),
        when=[status != Logical.STATE_CHANGES_ALLOWED],
        then=[robot_state().becomes(RobotState.INTERVENTION), motion().becomes(False),
              state[p].becomes(halted).over(p).when(active[p] & to_stopped.has(p)),
              logical().becomes(status), physical().becomes(Physical.NEEDS_COMMISSIONING)],
        observation_only=True,
    )  # fmt: skip

    operator_recovers = Transition(
        "R-5.3.1.3.2.6-2", "R-5.3.1.3.3.13-2",
        on=internal("operator_recovers", status, condition),
        when=[robot_state() == RobotState.INTERVENTION, local_control() >> (status != Logical.STATE_CHANGES_ALLOWED)],
        then=[robot_state().becomes(if_(some_selected(), if_(selected_started(), RobotState.MOTION_PAUSED, RobotState.READY),
                                        if_(some_controlling(), RobotState.LOADED, RobotState.IDLE))),
              logical().becomes(status), physical().becomes(condition)],
        observation_only=True,
    )  # fmt: skip

    local_control_changes = Transition(
        "R-5.3.1.4-1", "R-5.3.1.4-2", "R-6.2.2.2-1", "R-6.2.3.2-1", "R-T1-1", "RP-18",
        on=internal("local_control_changes", taken, held, status),
        when=[taken == for_some(r)(held.has(r)), (taken | (robot_state() == RobotState.INTERVENTION)) >> (status != Logical.STATE_CHANGES_ALLOWED)],
        then=[local_control().becomes(taken), device_local[r].becomes(held.has(r)).over(r), logical().becomes(status)],
        observation_only=True,
    )  # fmt: skip

    status_changes = Transition(
        "R-T1-3", "R-6.3.4.7-2", "RP-18",
        on=internal("status_changes", status, condition),
        when=[(local_control() | (robot_state() == RobotState.INTERVENTION)) >> (status != Logical.STATE_CHANGES_ALLOWED),
              (robot_state() == RobotState.INTERVENTION) >> (condition == Physical.NEEDS_COMMISSIONING)],
        then=[logical().becomes(status), physical().becomes(condition)],
        observation_only=True,
    )  # fmt: skip


class VmdRepaired(Vmd, VocabularyRepaired):
    """The repaired reading."""

    # A selected program invocation that becomes UNRUNNABLE is deselected first (RP-04).
    lost = selected[a] & active[a] & to_unrunnable.has(a)
    not_stopped = to_idle.has(p) | to_unrunnable.has(p)
    deselect_lost = [
        controller[c, a].becomes(False).over(c, a).when(lost),
        controls[a, c].becomes(False).over(a, c).when(lost),
    ]  # fmt: skip

    vmd_stop = Procedure(
        "R-7.4.2.2",
        on=response("vMDStop", request, user, panel, to_idle, to_unrunnable),
        steps=[
            refuse("R-3.2.1-1", "RP-10", when=local_control() != panel, rule="vmd-stop.local-control", says="the robot is in local control"),
            refuse("1", unless=holder[user] | panel, rule="vmd-stop.without-control", says="{user} does not hold R_CTRL"),
            do("2", motion().becomes(False), cites=["R-7.4.2-1", "R-7.3.3.4.1-3", "RP-03"]),
            do("3", intervention().becomes(True), cites=["R-T8-1", "R-6.3.5.13-3"]),
            do("R-6.1.3.2.6-2", *deselect_lost, cites=["RP-04"]),
            do("R-6.3.6-5", calibration[r].becomes(Calibration.NOT_CALIBRATED).over(p, r).when(cut_short[p, r] & active[p] & not_stopped),
               joint_calibration[r, j].becomes(Calibration.NOT_CALIBRATED).over(p, r, j).when(cut_short[p, r] & active[p] & not_stopped),
               cites=["RP-26"]),
            do("4", *halt_all, selected[a].becomes(False).over(a).when(lost)),
            do("5", logical().becomes(Logical.NO_STATE_CHANGES_ALLOWED), cites=["R-T8-3"]),
            do("R-T8-4", physical().becomes(Physical.NEEDS_COMMISSIONING)),
            accept("5", "R-T8-2", "RP-28"),
        ],
        repairs=repaired("RP-12", "R-7.4.2.2-3", "R-T8-2",
                         because="MANUAL-INTERVENTION-REQUIRED is stored by itself, and an undefined local control is no change of it"),
    )  # fmt: skip

    vmd_reset = Procedure(
        "R-7.4.3.2",
        on=response("vMDReset", request, user, panel, prevented, to_idle),
        steps=[
            refuse("R-5.3.1.3.3.13-2", "RP-09", when=intervention(), rule="vmd-reset.intervention",
                   says="the robot is in MANUAL-INTERVENTION-REQUIRED, which only an operator's action may end"),
            refuse("R-3.2.1-1", "RP-10", when=local_control() != panel, rule="vmd-reset.local-control", says="the robot is in local control"),
            refuse("R-6.1.3.2.5-2", "B-STATUS", "RP-11", unless=panel | logical().isin([Logical.STATE_CHANGES_ALLOWED, Logical.SUPPORT_SERVICES_ALLOWED]),
                   rule="vmd-reset.logical-status", level="warning", says="the logical status of the VMD does not admit the service"),
            refuse("a", unless=holder[user] | panel, rule="vmd-reset.without-control", says="{user} does not hold R_CTRL"),
            refuse("b", when=robot_state() == RobotState.EXECUTING, rule="vmd-reset.executing", says="the robot is executing"),
            refuse("c", "R-7.4.3.2-1", "RP-01", when=prevented, rule="vmd-reset.prevented", says="local conditions prevent it"),
            do("R-6.3.6-5", calibration[r].becomes(Calibration.NOT_CALIBRATED).over(p, r).when(cut_short[p, r] & to_idle.has(p)),
               joint_calibration[r, j].becomes(Calibration.NOT_CALIBRATED).over(p, r, j).when(cut_short[p, r] & to_idle.has(p)),
               cites=["RP-26"]),
            do("R-6.1.3.2.6-2", controller[c, a].becomes(False).over(c, a), controls[a, c].becomes(False).over(a, c),
               selected[a].becomes(False).over(a), motion().becomes(False), cites=["RP-08"]),
            do("d", state[p].becomes(if_(deletable[p], State.NON_EXISTENT,
                                         if_(to_idle.has(p), State.IDLE, if_(active[p], State.STOPPED, state[p])))).over(p).when(exists[p]),
               *clear_domains),
            accept("f", "R-7.4.3.2-e", "R-7.4.3-1", "R-7.4.3.2-2"),
        ],
        repairs=repaired("RP-08", "R-7.4.3.2-d", "R-7.4.3.2-e",
                         because="the text leaves references to deleted program invocations, and calls the robot IDLE beside controlling ones"),
    )  # fmt: skip

    emergency_stop = Transition(
        "R-5.3.1.3.3.13-1", "R-6.3.5.13-1", "R-6.3.5.13-2", "RP-03", "RP-18",
        on=internal("emergency_stop", to_stopped, to_idle, to_unrunnable, status),
        when=[status != Logical.STATE_CHANGES_ALLOWED],
        then=[intervention().becomes(True), motion().becomes(False),
              controller[c, a].becomes(False).over(c, a).when(lost & to_stopped.has(a)),
              controls[a, c].becomes(False).over(a, c).when(lost & to_stopped.has(a)),
              selected[a].becomes(False).over(a).when(lost & to_stopped.has(a)),
              calibration[r].becomes(Calibration.NOT_CALIBRATED).over(p, r).when(cut_short[p, r] & active[p] & to_stopped.has(p) & not_stopped),
              joint_calibration[r, j].becomes(Calibration.NOT_CALIBRATED).over(p, r, j).when(cut_short[p, r] & active[p] & to_stopped.has(p) & not_stopped),
              state[p].becomes(halted).over(p).when(active[p] & to_stopped.has(p)),
              logical().becomes(status), physical().becomes(Physical.NEEDS_COMMISSIONING)],
        observation_only=True,
        repairs=repaired("RP-12", "R-6.3.5.13-1", because="MANUAL-INTERVENTION-REQUIRED is stored by itself"),
    )  # fmt: skip

    operator_recovers = Transition(
        "R-5.3.1.3.2.6-2", "R-5.3.1.3.3.13-2", "RP-09", "RP-18",
        on=internal("operator_recovers", to_idle, to_stopped, to_unrunnable, cleared, status, condition),
        when=[intervention(), local_control() >> (status != Logical.STATE_CHANGES_ALLOWED)],
        then=[
            intervention().becomes(False), logical().becomes(status), physical().becomes(condition),
            controller[c, a].becomes(False).over(c, a).when(cleared | (selected[a] & to_unrunnable.has(a))),
            controls[a, c].becomes(False).over(a, c).when(cleared | (selected[a] & to_unrunnable.has(a))),
            selected[a].becomes(False).over(a).when(cleared | to_unrunnable.has(a)),
            calibration[r].becomes(Calibration.NOT_CALIBRATED).over(p, r).when(cut_short[p, r] & (to_idle.has(p) | to_unrunnable.has(p))),
            joint_calibration[r, j].becomes(Calibration.NOT_CALIBRATED).over(p, r, j).when(cut_short[p, r] & (to_idle.has(p) | to_unrunnable.has(p))),
            state[p].becomes(if_(to_unrunnable.has(p), State.UNRUNNABLE, if_(to_idle.has(p), State.IDLE, if_(to_stopped.has(p), State.STOPPED, state[p]))))
            .over(p).when(exists[p]),
        ],
        observation_only=True,
        never_after=["emergency_stop"],
        repairs=repaired("RP-12", "R-5.3.1.3.2.6-2", because="the robot state follows from what the operator leaves"),
    )  # fmt: skip

    local_control_changes = Transition(
        "R-5.3.1.4-1", "R-5.3.1.4-2", "R-6.2.2.2-1", "R-6.2.3.2-1", "R-T1-1", "RP-18",
        on=internal("local_control_changes", taken, held, status),
        when=[taken == for_some(r)(held.has(r)), (taken | intervention()) >> (status != Logical.STATE_CHANGES_ALLOWED)],
        then=[local_control().becomes(taken), device_local[r].becomes(held.has(r)).over(r), logical().becomes(status)],
        observation_only=True,
        repairs=repaired("RP-12", "R-T1-1", because="MANUAL-INTERVENTION-REQUIRED is stored by itself"),
    )  # fmt: skip

    status_changes = Transition(
        "R-T1-3", "R-6.3.4.7-2", "RP-18",
        on=internal("status_changes", status, condition),
        when=[(local_control() | intervention()) >> (status != Logical.STATE_CHANGES_ALLOWED),
              intervention() >> (condition == Physical.NEEDS_COMMISSIONING)],
        then=[logical().becomes(status), physical().becomes(condition)],
        observation_only=True,
        repairs=repaired("RP-12", "R-6.3.4.7-2", because="MANUAL-INTERVENTION-REQUIRED is stored by itself"),
    )  # fmt: skip
