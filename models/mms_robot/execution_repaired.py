"""Starting, stopping, resuming and resetting, repaired (7.3.3.3 to 7.3.3.6).

All checks come first, it is told when motion is enabled, and MOTION-PAUSED can be left.
"""

from mmsverify.model import (
    MINUS,
    Procedure,
    Transition,
    accept,
    do,
    for_all,
    for_some,
    if_,
    internal,
    refuse,
    repaired,
    response,
)

from .admission import ALL_BUT_RUNNING, EVERYTHING, admission
from .execution import Execution
from .vocabulary import Mode, State, VocabularyRepaired


class ExecutionRepaired(Execution, VocabularyRepaired):
    """The repaired reading."""

    paused = (
        ~motion() & ~intervention()
    )  # ROBOT-MOTION-PAUSED, of a selected program invocation that has been started (RP-12)
    drives_arm = for_some(c)(controls[pi, c] & arm[c])
    all_can_run = for_all(c)(controls[pi, c] >> can_run)
    calibration_runs = for_some(p)(calibrates[p] & started[p])
    task_runs = for_some(p)(selected[p] & started[p])
    led_by_running = for_some(a)(controller[pi, a] & selected[a] & (state[a] == State.RUNNING))
    in_intervention = refuse("R-5.3.1.3.3.13-2", "RP-09", when=intervention(), rule="execution.intervention",
                             says="the robot is in MANUAL-INTERVENTION-REQUIRED")  # fmt: skip
    bad_count = limit.present & (limit != Mode.FREE_RUN) & (count <= 0)
    no_steps = limit.present & (limit == Mode.STEP_LIMITED) & ~step_limited()
    run_all = [
        state[c].becomes(State.RUNNING).over(c).when(is_controlling & controls[pi, c]),
        untried[c].becomes(False).over(c).when((c == pi) | (is_controlling & controls[pi, c])),
        state[pi].becomes(State.RUNNING),
        motion().becomes(True).when(moves_arm | (is_controlling & drives_arm)),
    ]  # fmt: skip
    # Entered by this request's indication, or (at the panel) found in the state from which the service acts.
    may_start = if_(panel, state[pi] == State.IDLE, entered[request, pi] & (state[pi] == State.STARTING))
    may_stop = if_(panel, state[pi] == State.RUNNING, entered[request, pi] & (state[pi] == State.STOPPING))
    may_resume = if_(panel, state[pi] == State.STOPPED, entered[request, pi] & (state[pi] == State.RESUMING))
    may_reset = if_(panel, state[pi] == State.STOPPED, entered[request, pi] & (state[pi] == State.RESETTING))
    acts_while_running = selected[pi] & paused & (state[pi] == State.RUNNING)

    start = Procedure(
        "R-7.3.3.3.3",
        on=response("start", request, user, panel, pi, location_given, limit, count),
        always=[*forget],
        on_refusal=[state[pi].becomes(State.IDLE).when(~panel & entered[request, pi] & (state[pi] == State.STARTING))],
        steps=[
            in_intervention,
            *admission("start", panel, local_control(), logical(), EVERYTHING),
            refuse("a", "B-START", "RP-14", unless=exists[pi], rule="start.unknown", says="{pi} does not exist"),
            refuse("a", "B-START", unless=may_start, rule="start.not-idle", says="{pi} is not IDLE"),
            refuse("b", unless=holder[user] | panel, rule="start.without-control", says="{user} does not hold R_CTRL"),
            refuse("c1", "R-7.3.3.3.1-1", when=~is_controlling & (location_given | limit.present), rule="start.parameters",
                   says="{pi} is not CONTROLLING and takes neither start location nor running mode"),
            refuse("R-6.3.5.9-1", "RP-19", when=moves_arm & ~led_by_running, rule="start.arm-alone", level="warning",
                   says="{pi} moves the arm, and no selected and RUNNING program invocation controls it"),
            refuse("R-6.3.6-3", "RP-17", when=calibrates[pi] & task_runs, rule="start.calibration-beside-task", level="warning",
                   says="the selected program invocation has been started"),
            refuse("d0", "R-5.3.1.3.3.7-2", when=is_controlling & ~selected[pi], rule="start.not-selected",
                   says="{pi} is not the selected program invocation"),
            refuse("d4", "R-7.3.3.3.3-d2", "R-7.3.3.3.3-d3", when=is_controlling & ~all_can_run, rule="start.controlled-cannot-run",
                   says="a program invocation that {pi} controls cannot enter RUNNING"),
            refuse("R-6.3.6-3", "RP-17", when=is_controlling & calibration_runs, rule="start.task-beside-calibration", level="warning",
                   says="the calibration program has been started"),
            refuse("R-7.3.3.3.1.4-2", "R-7.3.3.3.1.5-2", "RP-14", when=bad_count, rule="start.count", says="the count {count} is not positive"),
            refuse("R-7.3.3.3.1.5-3", "R-7.3.3.3.4.2-2", when=no_steps, rule="start.steps-unsupported", says="STEP-LIMITED is not supported"),
            do("e1", *set_mode, cites=["R-7.3.3.3.3-e2", "R-7.3.3.3.3-e3"]),
            do("e4", starts_elsewhere[pi].becomes(location_given).when(is_controlling), cites=["R-7.3.3.3.3-e5"]),
            do("R-6.3.6-3", *calibrating),
            do("g", *run_all, cites=["R-7.3.3.3.3-f", "R-6.3.5.6-1", "RP-02"]),
            accept("g"),
        ],
        repairs=repaired("RP-02", "R-7.3.3.3.3-c2", "R-7.3.3.3.3-f",
                         because="c2) ends the procedure before f) for every program invocation that f) speaks of: motion would never be enabled"),
    )  # fmt: skip

    stop = Procedure(
        "R-7.3.3.4.1",
        on=response("stop", request, user, panel, pi),
        always=[*forget],
        on_refusal=[state[pi].becomes(State.RUNNING).when(~panel & entered[request, pi] & (state[pi] == State.STOPPING))],
        steps=[
            *admission("stop", panel, local_control(), logical(), EVERYTHING),
            refuse("a", "B-STOP", "RP-14", unless=exists[pi], rule="stop.unknown", says="{pi} does not exist"),
            refuse("a", "B-STOP", unless=may_stop, rule="stop.not-running", says="{pi} is not RUNNING"),
            refuse("b", unless=holder[user] | panel, rule="stop.without-control", says="{user} does not hold R_CTRL"),
            do("c", motion().becomes(False).when(moves_arm), cites=["R-6.3.5.9-1"]),
            do("d", state[pi].becomes(State.STOPPED)),
            accept("d"),
        ],
        repairs=repaired("RP-12", "R-6.3.5.9-1", because="the robot state follows from motion enabled; Stop need not set it"),
    )  # fmt: skip

    arm_comes_to_rest = Transition(
        "R-7.3.3.4.1-1", "R-5.3.1.3.3.9-1", "RP-07",
        on=internal("arm_comes_to_rest", pi),
        when=[selected[pi], state[pi].isin([State.STOPPED, State.RESUMING, State.RESETTING])],
        then=[motion().becomes(False)],
        repairs=repaired("RP-07", "R-7.3.3.4.1-1", because="after Stop of the task program alone, motion ceases some time later"),
    )  # fmt: skip

    resume = Procedure(
        "R-7.3.3.5.3",
        on=response("resume", request, user, panel, pi, type_given, limit, count),
        always=[*forget],
        on_refusal=[state[pi].becomes(State.STOPPED).when(~panel & entered[request, pi] & (state[pi] == State.RESUMING))],
        steps=[
            in_intervention,
            *admission("resume", panel, local_control(), logical(), EVERYTHING),
            refuse("a", "B-RESUME", "RP-14", unless=exists[pi], rule="resume.unknown", says="{pi} does not exist"),
            refuse("a", "B-RESUME", unless=may_resume | acts_while_running, rule="resume.not-stopped", says="{pi} is not STOPPED"),
            refuse("b", unless=holder[user] | panel, rule="resume.without-control", says="{user} does not hold R_CTRL"),
            refuse("c1", when=~is_controlling & type_given, rule="resume.parameters", says="{pi} is not CONTROLLING and takes no resume type"),
            refuse("R-6.3.5.10-1", "RP-19", when=moves_arm & ~led_by_running, rule="resume.arm-alone", level="warning",
                   says="{pi} moves the arm, and no selected and RUNNING program invocation controls it"),
            refuse("R-6.3.6-3", "RP-17", when=calibrates[pi] & task_runs, rule="resume.calibration-beside-task", level="warning",
                   says="the selected program invocation has been started"),
            refuse("R-6.3.5.10-1", "RP-19", when=is_controlling & ~selected[pi], rule="resume.not-selected", level="warning",
                   says="{pi} is not the selected program invocation"),
            refuse("d4", "R-7.3.3.5.3-d2", "R-7.3.3.5.3-d3", when=is_controlling & ~all_can_run, rule="resume.controlled-cannot-run",
                   says="a program invocation that {pi} controls cannot enter RUNNING"),
            refuse("R-6.3.6-3", "RP-17", when=is_controlling & calibration_runs, rule="resume.task-beside-calibration", level="warning",
                   says="the calibration program has been started"),
            refuse("e1", when=is_controlling & ~limit.present & nothing_left, rule="resume.nothing-left", says="no cycle or step of {pi} remains"),
            refuse("R-7.3.3.5.1.5-2", "R-7.3.3.5.1.6-2", "RP-14", when=bad_count, rule="resume.count", says="the count {count} is not positive"),
            refuse("R-7.3.3.5.1.6-1", when=no_steps, rule="resume.steps-unsupported", says="STEP-LIMITED is not supported"),
            do("f1", *set_mode, cites=["R-7.3.3.5.3-f2", "R-7.3.3.5.3-f3"]),
            do("R-6.3.6-3", *calibrating),
            do("g", *run_all, cites=["R-7.3.3.5.3-e2", "R-6.3.5.10-1", "RP-02", "RP-06"]),
            accept("g"),
        ],
        repairs=repaired("RP-06", "R-6.3.5.10-1", "R-7.3.3.5.3-a",
                         because="paused by Stop of the arm alone, the selected program invocation is RUNNING, and the text lets no service continue"),
    )  # fmt: skip

    reset = Procedure(
        "R-7.3.3.6.1",
        on=response("reset", request, user, panel, pi),
        always=[*forget],
        on_refusal=[state[pi].becomes(State.STOPPED).when(~panel & entered[request, pi] & (state[pi] == State.RESETTING))],
        steps=[
            *admission("reset", panel, local_control(), logical(), EVERYTHING),
            refuse("a", "B-RESET", "RP-14", unless=exists[pi], rule="reset.unknown", says="{pi} does not exist"),
            refuse("a", "B-RESET", unless=may_reset | acts_while_running, rule="reset.not-stopped", says="{pi} is not STOPPED"),
            refuse("b", unless=holder[user] | panel, rule="reset.without-control", says="{user} does not hold R_CTRL"),
            refuse("R-6.3.5.8-1", "RP-07", when=selected[pi] & motion(), rule="reset.in-motion", level="warning",
                   says="{pi} is selected and motion is enabled"),
            do("R-6.3.5.8-1", state[c].becomes(State.IDLE).over(c).when(selected[pi] & controls[pi, c] & started[c]), cites=["RP-06"]),
            do("R-6.1.3.2.6-2", controller[c, a].becomes(False).over(c, a).when(~reusable[pi] & selected[pi] & (a == pi)),
               controls[a, c].becomes(False).over(a, c).when(~reusable[pi] & selected[pi] & (a == pi)),
               selected[a].becomes(False).over(a).when(~reusable[pi] & (a == pi)), cites=["RP-04"]),
            do("R-6.3.6-5", *breaks_off, cites=["RP-26"]),
            do("c", state[pi].becomes(if_(reusable[pi], State.IDLE, State.UNRUNNABLE))),
            accept("c"),
        ],
        repairs=repaired("RP-07", "R-6.3.5.8-1", "R-7.3.3.6.1-c",
                         because="figure 8 leads from MOTION-PAUSED to READY only, and the arm's program must return with the task program"),
    )  # fmt: skip

    alter = Procedure(
        "R-7.4.5.2",
        on=response("alterPI", request, user, panel, pi, limit, count),
        steps=[
            *admission("alter", panel, local_control(), logical(), ALL_BUT_RUNNING),
            refuse("a", unless=holder[user] | panel, rule="alter.without-control", says="{user} does not hold R_CTRL"),
            refuse("R-7.4.5.1.1.1-1", "RP-14", unless=exists[pi], rule="alter.unknown", says="{pi} does not exist"),
            refuse("b", unless=is_controlling, rule="alter.not-controlling", says="{pi} is not CONTROLLING"),
            refuse("R-7.3.3.3.1.4-2", "R-7.3.3.3.1.5-2", "RP-14", when=bad_count, rule="alter.count", level="warning",
                   says="the count {count} is not positive"),
            refuse("R-7.4.5.1.1.5-1", when=no_steps, rule="alter.steps-unsupported", says="STEP-LIMITED is not supported"),
            do("c1", *set_mode, cites=["R-7.4.5.2-c2", "R-7.4.5.2-c3"]),
            accept("c1"),
        ],
        repairs=repaired("RP-14", "R-7.4.5.2-b", because="the text does not say what happens to a name that does not exist or a count that is not positive"),
    )  # fmt: skip

    # A service that fails for a reason of the controller's own, and says that the program invocation is UNRUNNABLE now.
    fail = [
        *breaks_off,
        state[c].becomes(State.STOPPED).over(c).when(selected[pi] & controls[pi, c] & (state[c] == State.RUNNING)),
        controller[c, a].becomes(False).over(c, a).when(selected[pi] & (a == pi)),
        controls[a, c].becomes(False).over(a, c).when(selected[pi] & (a == pi)),
        motion().becomes(False).when(selected[pi] | (moves_arm & runs[pi])),
        selected[a].becomes(False).over(a).when(a == pi),
        state[pi].becomes(State.UNRUNNABLE),
        entered[request, p].becomes(False).over(p),
    ]  # fmt: skip
    start_fails = Transition(
        "R-7.3.3.3.3-d4", "B-FAIL", on=response("start", request, pi, destructive), when=[destructive, exists[pi], entered[request, pi]], then=fail, answer=MINUS,
        repairs=repaired("RP-04", "R-7.3.3.3.3-d4", because="a destructive failure of the selected program invocation deselects it"))  # fmt: skip
    stop_fails = Transition(
        "R-7.3.3.4.1-a", "B-FAIL", on=response("stop", request, pi, destructive), when=[destructive, exists[pi], entered[request, pi]], then=fail, answer=MINUS,
        repairs=repaired("RP-04", "R-7.3.3.4.1-a", because="a destructive failure of the selected program invocation deselects it"))  # fmt: skip
    resume_fails = Transition(
        "R-7.3.3.5.3-d4", "B-FAIL", on=response("resume", request, pi, destructive), when=[destructive, exists[pi], entered[request, pi]], then=fail, answer=MINUS,
        repairs=repaired("RP-04", "R-7.3.3.5.3-d4", because="a destructive failure of the selected program invocation deselects it"))  # fmt: skip
    reset_fails = Transition(
        "R-7.3.3.6.1-a", "B-FAIL", on=response("reset", request, pi, destructive), when=[destructive, exists[pi], entered[request, pi]], then=fail, answer=MINUS,
        repairs=repaired("RP-04", "R-7.3.3.6.1-a", because="a destructive failure of the selected program invocation deselects it"))  # fmt: skip
