"""What the standard claims of a program invocation's counters, error code, program location (6.3.2, 7.3.3, 7.4.5)."""

from mmsverify.model import (
    PLUS,
    Always,
    Initially,
    Sometimes,
    Step,
    Transition,
    answered,
    any_of,
    for_all,
    for_some,
    integer,
    internal,
    parameter,
    service_is,
    unchanged,
)  # fmt: skip

from .vocabulary import Control, Mode, State, Vocabulary


class Attributes(Vocabulary):
    """The same in both readings."""

    # What execution leaves in the attributes: errors are recorded and reset, the program moves on.
    recorded = parameter("recorded", integer())
    moved = PI.some("moved")
    execution_recorded = Transition(
        "R-6.3.2.1-1", "R-6.3.2.4-1", "RP-27",
        on=internal("execution_recorded", pi, recorded, moved),
        when=[~untried[pi]],
        then=[error_code[pi].becomes(recorded), located[pi].becomes(moved.has(pi))],
        observation_only=True,
    )  # fmt: skip

    errors_at_power_on = Initially("R-8.3.1-5", for_all(p)(error_code[p] == 0), "R-8.3.2-2")
    rest_of_attributes_at_power_on = Initially(
        "R-6.3.2.4-1", for_all(p)(~located[p] & ~starts_elsewhere[p] & ~untried[p])
    )

    untried_without_error = Always("R-7.3.3.2.3-0", for_all(p)(untried[p] >> (error_code[p] == 0)), "R-6.3.2.1-1",
                                   says="no error is recorded of what has not been executed since it was created")  # fmt: skip
    untried_not_located = Always(
        "R-7.3.3.2.3-a", for_all(p)((untried[p] & (control[p] == Control.CONTROLLING)) >> ~located[p]),
        says="what has not been executed since it was created has no program location")  # fmt: skip
    created_without_error = Step("R-7.3.3.2.3-0", (service_is("createProgramInvocation") & answered(PLUS)) >> (error_code[pi].next == 0),
                                 says="what was created has no error recorded")  # fmt: skip
    created_runs_freely = Step(
        "R-7.3.3.2.3-a",
        (service_is("createProgramInvocation") & answered(PLUS) & (kind == Control.CONTROLLING)) >> ((mode[pi].next == Mode.FREE_RUN) & ~located[pi].next),
        says="what was created CONTROLLING is FREE-RUN and has no program location")  # fmt: skip
    error_recorded = Sometimes("R-6.3.2.1-1", for_some(p)(exists[p] & (error_code[p] != 0)))
    location_shown = Sometimes("R-6.3.2.4-1", for_some(p)(runs[p] & located[p]))

    # Where execution begins (7.3.3.3.1.1).
    begins_where_told = Step(
        "R-7.3.3.3.3-e4", (service_is("start") & answered(PLUS) & (control[pi] == Control.CONTROLLING)) >> (starts_elsewhere[pi].next == location_given),
        "R-7.3.3.3.3-e5", "R-7.3.3.3.1.1-2", says="execution begins at the start location, or at the first step where none is given")  # fmt: skip

    # Running modes and their counters (5.3.2, 6.3.2.5 to 6.3.2.7).
    told_mode = answered(PLUS) & (control[pi] == Control.CONTROLLING) & limit.present
    mode_kept = Step("R-7.3.3.5.3-e2", (service_is("resume") & answered(PLUS) & ~limit.present) >> unchanged(mode, cycles, steps),
                     says="Resume in continue mode keeps the running mode and its counts")  # fmt: skip
    counted = limit.present & (limit != Mode.FREE_RUN)
    start_count_positive = Step("R-7.3.3.3.1.4-2", (service_is("start") & told_mode & counted) >> (count > 0), "R-7.3.3.3.1.5-2",
                                says="a program is started for a positive count")  # fmt: skip
    resume_count_positive = Step("R-7.3.3.5.1.5-2", (service_is("resume") & told_mode & counted) >> (count > 0), "R-7.3.3.5.1.6-2",
                                 says="a program is resumed for a positive count")  # fmt: skip
    nothing_left_to_resume = Step(
        "R-7.3.3.5.3-e1", (service_is("resume") & answered(PLUS) & ~limit.present & (control[pi] == Control.CONTROLLING)) >> ~any_of(
            (mode[pi] == Mode.CYCLE_LIMITED) & (cycles[pi] == 0), (mode[pi] == Mode.STEP_LIMITED) & (steps[pi] == 0)),
        says="what has no cycle or step left is not resumed")  # fmt: skip

    setting = service_is("start", "resume", "alterPI")
    cycles_run = Step("R-6.3.2.6-1", for_all(p)((cycles[p].next != cycles[p]) >> (setting | (runs[p] & (cycles[p].next < cycles[p])))),
                      says="the remaining cycles become fewer, and only while the program runs")  # fmt: skip
    steps_run = Step("R-6.3.2.7-1", for_all(p)((steps[p].next != steps[p]) >> (setting | (runs[p] & (steps[p].next < steps[p])))),
                     says="the remaining steps become fewer, and only while the program runs")  # fmt: skip
    # What happens to a task program when nobody does anything to it: told by what becomes of it.
    by_somebody = service_is(
        "start", "stop", "resume", "reset", "vMDStop", "vMDReset", "emergency_stop", "operator_recovers"
    )
    task_by_itself = (control[p] == Control.CONTROLLING) & (state[p] == State.RUNNING) & ~by_somebody
    nothing_counts_freely = Step(
        "R-6.3.2.5-2", for_all(p)(((mode[p] == Mode.FREE_RUN) & ~setting) >> ((cycles[p].next == cycles[p]) & (steps[p].next == steps[p]))),
        says="in FREE-RUN nothing is counted that could end execution")  # fmt: skip
    returns_without_cycles = Step(
        "R-6.3.2.5-3", for_all(p)((task_by_itself & (mode[p] == Mode.CYCLE_LIMITED) & (state[p].next == State.IDLE)) >> (cycles[p].next == 0)),
        says="a CYCLE-LIMITED task program that returns to IDLE by itself has no cycle left")  # fmt: skip
    stops_without_steps = Step(
        "R-6.3.2.5-4", for_all(p)((task_by_itself & ~service_is("fails_by_itself") & (state[p].next == State.STOPPED))
                                  >> ((mode[p] == Mode.STEP_LIMITED) & (steps[p].next == 0))),
        "R-6.3.2.5-2", says="a task program that is STOPPED by itself is STEP-LIMITED and has no step left")  # fmt: skip
    runs_freely = Sometimes(
        "R-5.3.2-3",
        for_some(p)(
            (state[p] == State.RUNNING) & (control[p] == Control.CONTROLLING) & (mode[p] == Mode.FREE_RUN)
        ),
    )
    runs_cycles = Sometimes(
        "R-5.3.2-3",
        for_some(p)((state[p] == State.RUNNING) & (mode[p] == Mode.CYCLE_LIMITED) & (cycles[p] > 0)),
        "R-5.3.2-1",
    )
    runs_steps = Sometimes(
        "R-5.3.2-3",
        for_some(p)((state[p] == State.RUNNING) & (mode[p] == Mode.STEP_LIMITED) & (steps[p] > 0)),
        "R-5.3.2-2",
        provided=step_limited(),
    )
    cycles_end = Sometimes(
        "R-6.3.2.5-3", service_is("end_of_execution") & (mode[pi] == Mode.CYCLE_LIMITED) & (cycles[pi] > 0)
    )
    steps_end = Sometimes(
        "R-6.3.2.5-4", service_is("steps_exhausted") & (steps[pi] > 0), provided=step_limited()
    )
