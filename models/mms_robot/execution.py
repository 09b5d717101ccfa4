"""Starting, stopping, resuming and resetting program invocations (7.3.3.3 to 7.3.3.6).

An indication enters the transient state, the response leaves it; between the two the responder performs the
procedure. ``entered`` remembers which request did so: another request that finds the transient state is
refused and must not leave it.
"""

from mmsverify.model import (
    Procedure,
    Transition,
    accept,
    any_of,
    do,
    for_each,
    if_,
    indication,
    may,
    refuse,
    response,
)  # fmt: skip

from .vocabulary import Control, Mode, RobotState, State, Vocabulary


class Execution(Vocabulary):
    """As written."""

    is_controlling = control[pi] == Control.CONTROLLING
    moves_arm = arm[pi] & (control[pi] == Control.CONTROLLED)
    forget = [entered[request, p].becomes(False).over(p)]
    set_mode = [
        mode[pi].becomes(limit).when(limit.present),
        cycles[pi].becomes(count).when(limit.present & (limit == Mode.CYCLE_LIMITED)),
        steps[pi].becomes(count).when(limit.present & (limit == Mode.STEP_LIMITED)),
    ]  # fmt: skip
    can_run = state[c].isin([State.IDLE, State.STOPPED, State.RUNNING])

    start_indicated = Transition(
        "R-7.3.3.3.3-a", "B-START",
        on=indication("start", request, pi),
        when=[state[pi] == State.IDLE],
        then=[state[pi].becomes(State.STARTING), untried[pi].becomes(False), entered[request, p].becomes(p == pi).over(p)],
    )  # fmt: skip
    start = Procedure(
        "R-7.3.3.3.3",
        on=response("start", request, user, pi, location_given, limit, count),
        always=[*forget],
        on_refusal=[state[pi].becomes(State.IDLE).when(entered[request, pi] & (state[pi] == State.STARTING))],
        steps=[
            refuse("a", "B-START", unless=entered[request, pi] & (state[pi] == State.STARTING), rule="start.not-idle",
                   says="{pi} is not IDLE"),
            refuse("b", unless=holder[user], rule="start.without-control", says="{user} does not hold R_CTRL"),
            refuse("c1", when=~is_controlling & (location_given | limit.present), rule="start.parameters",
                   says="{pi} is not CONTROLLING and takes neither start location nor running mode"),
            do("R-6.3.6-3", *calibrating),
            do("c2", state[pi].becomes(State.RUNNING).when(~is_controlling)),
            accept("c2", when=~is_controlling),
            refuse("d0", unless=selected[pi], rule="start.not-selected", says="{pi} is not the selected program invocation"),
            for_each("d4", c, "R-7.3.3.3.3-d2", "R-7.3.3.3.3-d3", where=controls[pi, c], possible=can_run,
                     body=[state[c].becomes(State.RUNNING), untried[c].becomes(False)],
                     undo=[state[c].becomes(State.STOPPED), motion().becomes(False).when(arm[c])],
                     rule="start.controlled-cannot-run", says="a program invocation that {pi} controls cannot enter RUNNING"),
            do("e1", *set_mode, cites=["R-7.3.3.3.3-e2", "R-7.3.3.3.3-e3"]),
            do("e4", starts_elsewhere[pi].becomes(location_given), cites=["R-7.3.3.3.3-e5"]),
            may("f", motion().becomes(True).when(moves_arm)),
            do("g", state[pi].becomes(State.RUNNING)),
            do("R-6.3.5.6-1", robot_state().becomes(RobotState.EXECUTING)),
            accept("g"),
        ],
    )  # fmt: skip

    stop_indicated = Transition(
        "R-7.3.3.4.1-a", "B-STOP",
        on=indication("stop", request, pi),
        when=[state[pi] == State.RUNNING],
        then=[state[pi].becomes(State.STOPPING), entered[request, p].becomes(p == pi).over(p)],
    )  # fmt: skip
    stop = Procedure(
        "R-7.3.3.4.1",
        on=response("stop", request, user, pi),
        always=[*forget],
        on_refusal=[state[pi].becomes(State.RUNNING).when(entered[request, pi] & (state[pi] == State.STOPPING))],
        steps=[
            refuse("a", "B-STOP", unless=entered[request, pi] & (state[pi] == State.STOPPING), rule="stop.not-running",
                   says="{pi} is not RUNNING"),
            refuse("b", unless=holder[user], rule="stop.without-control", says="{user} does not hold R_CTRL"),
            do("c", motion().becomes(False).when(moves_arm)),
            do("R-6.3.5.9-1", robot_state().becomes(RobotState.MOTION_PAUSED).when(moves_arm & (robot_state() == RobotState.EXECUTING))),
            do("d", state[pi].becomes(State.STOPPED)),
            accept("d"),
        ],
    )  # fmt: skip

    resume_indicated = Transition(
        "R-7.3.3.5.3-a", "B-RESUME",
        on=indication("resume", request, pi),
        when=[state[pi] == State.STOPPED],
        then=[state[pi].becomes(State.RESUMING), entered[request, p].becomes(p == pi).over(p)],
    )  # fmt: skip
    nothing_left = any_of(
        (mode[pi] == Mode.CYCLE_LIMITED) & (cycles[pi] == 0),
        (mode[pi] == Mode.STEP_LIMITED) & (steps[pi] == 0),
    )
    resume = Procedure(
        "R-7.3.3.5.3",
        on=response("resume", request, user, pi, type_given, limit, count),
        always=[*forget],
        on_refusal=[state[pi].becomes(State.STOPPED).when(entered[request, pi] & (state[pi] == State.RESUMING))],
        steps=[
            refuse("a", "B-RESUME", unless=entered[request, pi] & (state[pi] == State.RESUMING), rule="resume.not-stopped",
                   says="{pi} is not STOPPED"),
            refuse("b", unless=holder[user], rule="resume.without-control", says="{user} does not hold R_CTRL"),
            refuse("c1", when=~is_controlling & type_given, rule="resume.parameters", says="{pi} is not CONTROLLING and takes no resume type"),
            do("R-6.3.6-3", *calibrating),
            do("c2", state[pi].becomes(State.RUNNING).when(~is_controlling)),
            accept("c2", when=~is_controlling),
            for_each("d4", c, "R-7.3.3.5.3-d2", "R-7.3.3.5.3-d3", where=controls[pi, c], possible=can_run,
                     body=[state[c].becomes(State.RUNNING), untried[c].becomes(False)],
                     undo=[state[c].becomes(State.STOPPED), motion().becomes(False).when(arm[c])],
                     rule="resume.controlled-cannot-run", says="a program invocation that {pi} controls cannot enter RUNNING"),
            refuse("e1", when=~limit.present & nothing_left, rule="resume.nothing-left", says="no cycle or step of {pi} remains"),
            do("f1", *set_mode, cites=["R-7.3.3.5.3-f2", "R-7.3.3.5.3-f3"]),
            do("g", state[pi].becomes(State.RUNNING), cites=["R-7.3.3.5.3-e2"]),
            do("R-6.3.5.10-1", robot_state().becomes(RobotState.EXECUTING).when(selected[pi] & (robot_state() == RobotState.MOTION_PAUSED))),
            accept("g"),
        ],
    )  # fmt: skip

    reset_indicated = Transition(
        "R-7.3.3.6.1-a", "B-RESET",
        on=indication("reset", request, pi),
        when=[state[pi] == State.STOPPED],
        then=[state[pi].becomes(State.RESETTING), entered[request, p].becomes(p == pi).over(p)],
    )  # fmt: skip
    reset = Procedure(
        "R-7.3.3.6.1",
        on=response("reset", request, user, pi),
        always=[*forget],
        on_refusal=[state[pi].becomes(State.STOPPED).when(entered[request, pi] & (state[pi] == State.RESETTING))],
        steps=[
            refuse("a", "B-RESET", unless=entered[request, pi] & (state[pi] == State.RESETTING), rule="reset.not-stopped",
                   says="{pi} is not STOPPED"),
            refuse("b", unless=holder[user], rule="reset.without-control", says="{user} does not hold R_CTRL"),
            do("c", state[pi].becomes(if_(reusable[pi], State.IDLE, State.UNRUNNABLE))),
            do("R-6.3.5.8-1", robot_state().becomes(RobotState.READY).when(selected[pi] & (robot_state() == RobotState.MOTION_PAUSED))),
            accept("c"),
        ],
    )  # fmt: skip

    alter = Procedure(
        "R-7.4.5.2",
        on=response("alterPI", request, user, pi, limit, count),
        steps=[
            refuse("a", unless=holder[user], rule="alter.without-control", says="{user} does not hold R_CTRL"),
            refuse("b", unless=is_controlling, rule="alter.not-controlling", says="{pi} is not CONTROLLING"),
            do("c1", *set_mode, cites=["R-7.4.5.2-c2", "R-7.4.5.2-c3"]),
            accept("c1"),
        ],
    )  # fmt: skip
