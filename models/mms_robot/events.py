"""Event conditions: what must occur for R_RVS, R_SIV, R_RLC and R_ARM to be notified (6.3.9, 8.7)."""

from mmsverify.model import Assume, Occurs, Sometimes, for_all, for_some

from .vocabulary import RobotState, Vocabulary

# All four conditions are ACTIVE to begin with (8.7). Of R_RVS and R_ARM the text tells which way they change: from
# EXECUTING and from RUNNING to anything else, active to idle in the example (A5.1). For R_SIV and R_RLC it may be either.
TO_IDLE = ("active-to-idle",)
EITHER_WAY = ("active-to-idle", "idle-to-active")


class Events(Vocabulary):
    """The same in both readings."""

    one_arm_program = Assume("R-8.3.1-1", for_all(a, b)((standard_arm[a] & standard_arm[b]) >> (a == b)))

    executes = robot_state() == RobotState.EXECUTING
    arm_runs = for_some(p)(standard_arm[p] & runs[p])

    robot_left_executing = Occurs(
        "R-8.7.1-1", "R-6.3.9-1", of="R_RVS", before=executes, after=~executes, transitions=TO_IDLE
    )
    interlocks_became_violated = Occurs("R-8.7.2-1", "R-6.3.9-1", of="R_SIV", before=~interlocks_violated(), after=interlocks_violated(),
                                        transitions=EITHER_WAY)  # fmt: skip
    local_control_was_taken = Occurs(
        "R-8.7.3-1",
        "R-6.3.9-1",
        of="R_RLC",
        before=~local_control(),
        after=local_control(),
        transitions=EITHER_WAY,
    )
    local_control_was_given_back = Occurs("R-8.7.3-1", "R-6.3.9-1", of="R_RLC", before=local_control(), after=~local_control(),
                                          transitions=EITHER_WAY)  # fmt: skip
    arm_left_running = Occurs("R-8.7.4-1", "R-6.3.9-1", of="R_ARM", before=arm_runs,
                              after=for_all(p)(standard_arm[p] >> ~runs[p]), transitions=TO_IDLE)  # fmt: skip

    executing_is_left = Sometimes(
        "R-8.7.1-1", (robot_state() == RobotState.EXECUTING) & (robot_state().next != RobotState.EXECUTING)
    )
    interlocks_become_violated = Sometimes("R-8.7.2-1", ~interlocks_violated() & interlocks_violated().next)
    local_control_changes_sides = Sometimes("R-8.7.3-1", local_control() & ~local_control().next)
    arm_stops_running = Sometimes("R-8.7.4-1", for_some(p)(standard_arm[p] & runs[p] & ~runs[p].next),
                                  provided=for_some(p)(standard_arm[p]))  # fmt: skip
