"""What a service has brought about when it answers result(+) (7.3.3, 7.4, 8.6.1).

They are claims about its step, the same in both readings.
"""

from mmsverify.model import PLUS, Always, Step, answered, for_all, for_some, service_is

from .vocabulary import Control, RobotState, State, Vocabulary


class Services(Vocabulary):
    """Stated from what the services are for, whatever their steps are."""

    started_runs = Step("R-7.3.3.3.3-g", (service_is("start") & answered(PLUS)) >> (state[pi].next == State.RUNNING), "B-START",
                        says="what was started is RUNNING")  # fmt: skip
    stopped_is_stopped = Step("R-7.3.3.4.1-d", (service_is("stop") & answered(PLUS)) >> (state[pi].next == State.STOPPED), "B-STOP",
                              says="what was stopped is STOPPED")  # fmt: skip
    resumed_runs = Step("R-7.3.3.5.3-g", (service_is("resume") & answered(PLUS)) >> (state[pi].next == State.RUNNING), "B-RESUME",
                        says="what was resumed is RUNNING")  # fmt: skip
    reset_is_idle = Step("R-7.3.3.6.1-c", (service_is("reset") & answered(PLUS)) >> state[pi].next.isin([State.IDLE, State.UNRUNNABLE]), "B-RESET",
                         says="what was reset is IDLE, or UNRUNNABLE if it is not reusable")  # fmt: skip
    killed_is_unrunnable = Step("R-7.3.3.7.1-c", (service_is("kill") & answered(PLUS)) >> (state[pi].next == State.UNRUNNABLE), "B-KILL",
                                says="what was killed is UNRUNNABLE")  # fmt: skip
    deleted_is_gone = Step("R-7.3.3.8.1-e", (service_is("deleteProgramInvocation") & answered(PLUS)) >> (state[pi].next == State.NON_EXISTENT), "B-DELETE",
                           says="what was deleted does not exist")  # fmt: skip
    created_is_idle = Step(
        "R-7.3.3.2.3-0",
        (service_is("createProgramInvocation") & answered(PLUS)) >> ((state[pi].next == State.IDLE) & (control[pi].next == kind)), "B-CREATE",
        says="what was created is IDLE and has the control attribute asked for")  # fmt: skip
    named_is_selected = Step("R-7.4.4.2-j", (service_is("select") & answered(PLUS) & controlling.present) >> selected[controlling].next,
                             says="what Select names is selected")  # fmt: skip
    listed_is_controlled = Step(
        "R-7.4.4.2-l",
        (service_is("select") & answered(PLUS) & controlling.present) >> for_all(c)(controlled.has(c) >> controls[controlling, c].next),
        says="what Select lists is controlled by what it names")  # fmt: skip
    nothing_named_none_selected = Step("R-7.4.4.2-g", (service_is("select") & answered(PLUS) & ~controlling.present) >> for_all(a)(~selected[a].next),
                                       "R-7.4.4.2-h", says="Select without a name leaves nothing selected")  # fmt: skip
    vmd_stop_halts = Step("R-7.4.2.2-2", (service_is("vMDStop") & answered(PLUS)) >> (~motion().next & for_all(p)(state[p].next != State.RUNNING)),
                          "R-7.4.2.2-4", says="VMD Stop ends motion, and nothing is RUNNING after it")  # fmt: skip
    vmd_reset_deletes = Step("R-7.4.3.2-d", (service_is("vMDReset") & answered(PLUS)) >> for_all(p)(deletable[p] >> (state[p].next == State.NON_EXISTENT)),
                             says="VMD Reset deletes what can be deleted")  # fmt: skip
    taken_control_is_held = Step("R-8.6.1-2", (service_is("takeControl") & answered(PLUS)) >> holder[user].next, "B-SEMAPHORE",
                                 says="who took control holds R_CTRL")  # fmt: skip
    given_control_is_free = Step("R-8.6.1-2", (service_is("relinquishControl") & answered(PLUS)) >> ~holder[user].next, "B-SEMAPHORE",
                                 says="who gave control back does not hold R_CTRL")  # fmt: skip

    started_was_selected = Step(
        "R-7.3.3.3.3-d0", (service_is("start") & answered(PLUS) & (control[pi] == Control.CONTROLLING)) >> selected[pi],
        says="a task program that is started is the selected one")  # fmt: skip
    motion_by_running_arm = Step(
        "R-7.3.3.3.3-f", (~motion() & motion().next)
        >> for_some(c)(arm[c] & (control[c] == Control.CONTROLLED) & (state[c].next == State.RUNNING)),
        says="motion is enabled by a controlled program bound to an arm that is RUNNING then")  # fmt: skip
    not_reset_while_executing = Step(
        "R-7.4.3.2-b", (service_is("vMDReset") & answered(PLUS)) >> (robot_state() != RobotState.EXECUTING),
        says="the robot is not reset while it is executing")  # fmt: skip
    none_without_task = Always("R-6.1.3.2.6-3", ~some_controlling() >> ~some_selected(),
                               says="without a task program the selected program invocation is NONE")  # fmt: skip
