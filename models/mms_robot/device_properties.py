"""What the standard claims of physical resources and of what the VMD says of them (6.1.3.2, 6.2, 6.3.6)."""

from mmsverify.model import PLUS, Always, Sometimes, Step, answered, for_all, for_some, service_is, unchanged

from .properties import BY_MESSAGE
from .vocabulary import Calibration, Control, RobotState, State, Vocabulary


class DeviceProperties(Vocabulary):
    """Stated from the clauses about the attributes, for both readings."""

    # What the VMD says of all resources is what they say, one by one.
    powered_is_reported = Always("R-6.1.3.2.3-1", for_all(r)(power[r] >> any_power()),
                                 says="power is on in the VMD if a physical resource is powered")  # fmt: skip
    reported_is_powered = Always("R-6.1.3.2.3-1", any_power() >> for_some(r)(power[r]),
                                 says="power is on in the VMD only if some physical resource is powered")  # fmt: skip
    reported_is_calibrated = Always(
        "R-6.1.3.2.4-1", for_all(r)((all_calibrated() & needs_calibration[r]) >> (calibration[r] == Calibration.CALIBRATED)),
        says="all are calibrated only if each that has a calibration attribute is")  # fmt: skip
    calibrated_is_reported = Always(
        "R-6.3.6-6", all_calibrated() | for_some(r)(needs_calibration[r] & (calibration[r] != Calibration.CALIBRATED)), "R-6.1.3.2.4-1",
        says="if each physical resource that has a calibration attribute is CALIBRATED, then all are")  # fmt: skip
    held_is_local_control = Always("R-6.1.3.2.5-1", for_all(r)(device_local[r] >> local_control()),
                                   says="the VMD is in local control if a local agent holds a physical resource")  # fmt: skip
    local_control_is_held = Always("R-6.1.3.2.5-1", local_control() >> for_some(r)(device_local[r]),
                                   says="the VMD is in local control only if a local agent holds some physical resource")  # fmt: skip

    # An arm is calibrated by its joints (6.2.2.4).
    arm_calibrated_by_joints = Always(
        "R-6.2.2.4-1", for_all(r, j)((jointed[r] & needs_calibration[r] & (calibration[r] == Calibration.CALIBRATED))
                                     >> (joint_calibration[r, j] == Calibration.CALIBRATED)),
        says="an arm is CALIBRATED only if all its joints are")  # fmt: skip
    joint_calibrating_is_reported = Always(
        "R-6.2.2.4-1", for_all(r, j)((jointed[r] & needs_calibration[r] & (joint_calibration[r, j] == Calibration.CALIBRATING))
                                     >> (calibration[r] == Calibration.CALIBRATING)),
        says="an arm is CALIBRATING if one of its joints is")  # fmt: skip
    arm_calibrating_by_joint = Always(
        "R-6.2.2.4-1", for_all(r)((jointed[r] & needs_calibration[r] & (calibration[r] == Calibration.CALIBRATING))
                                  >> for_some(j)(joint_calibration[r, j] == Calibration.CALIBRATING)),
        says="an arm is CALIBRATING only if one of its joints is")  # fmt: skip
    arm_uncalibrated_by_joint = Always(
        "R-6.2.2.4-1", for_all(r)((jointed[r] & needs_calibration[r] & (calibration[r] == Calibration.NOT_CALIBRATED))
                                  >> for_some(j)(joint_calibration[r, j] == Calibration.NOT_CALIBRATED)),
        says="an arm is NOT-CALIBRATED only if one of its joints is")  # fmt: skip

    # Calibration (6.3.6).
    calibrating_while_executing = Always(
        "R-6.3.6-3", for_all(p, r)((calibrates_device[p, r] & runs[p]) >> (calibration[r] == Calibration.CALIBRATING)),
        says="while the calibration program executes, its physical resource is CALIBRATING")  # fmt: skip
    calibrating_until_finished = Always(
        "R-6.3.6-5", for_all(p, r)((calibrates_device[p, r] & (calibration[r] == Calibration.CALIBRATING)) >> started[p]),
        says="once its calibration program has finished, a physical resource is CALIBRATED or NOT-CALIBRATED")  # fmt: skip
    finished_is_idle = Step(
        "R-6.3.6-4",
        for_all(p, r)((calibrates_device[p, r] & started[p] & (calibration[r] != Calibration.CALIBRATED) & (calibration[r].next == Calibration.CALIBRATED))
                      >> (state[p].next == State.IDLE)),
        "R-6.3.6-5", says="a physical resource becomes CALIBRATED when its calibration program has finished, and that is IDLE then")  # fmt: skip
    calibration_does_not_load = Always(
        "R-5.3.3-1", (robot_state() == RobotState.LOADED) >> for_some(p)(exists[p] & ~calibrates[p] & (control[p] == Control.CONTROLLING)),
        "R-6.3.6-7", says="it takes another program than that of calibration to make the robot LOADED")  # fmt: skip
    calibration_is_not_listed = Always("R-6.3.6-7", for_all(a, c)(controls[a, c] >> ~calibrates[c]),
                                       says="no list names the calibration program")  # fmt: skip

    # Local control of resources.
    local_devices_are_not_changed = Step(
        "R-6.2.1-6", (local_control() & service_is(*BY_MESSAGE) & ~panel & ~destructive) >> for_all(r)(
            (power[r].next == power[r]) & (device_local[r].next == device_local[r]) & (calibration[r].next == calibration[r])),
        says="in local control no service changes the state of a physical resource, nor who holds it")  # fmt: skip

    # In local control and not (5.3.1.4, Table 1, Table 8).
    panel_needs_local_control = Step(
        "R-5.3.1.4-3", (panel & ~local_control()) >> unchanged(state, control, controls, controller, selected, motion, mode, cycles, steps),
        says="nobody at the panel stops or modifies a task program without local control")  # fmt: skip
    remote_has_control = Sometimes("R-5.3.1.4-4", ~local_control() & for_some(u)(holder[u]))
    nobody_has_control = Sometimes(
        "R-6.1.3.2.5-2", ~local_control() & for_some(p)(selected[p] & runs[p]) & ~for_some(u)(holder[u])
    )
    stopped_in_local_control = Sometimes(
        "R-T8-2", service_is("vMDStop") & answered(PLUS) & local_control().next
    )
    stopped_from_afar = Sometimes("R-T8-2", service_is("vMDStop") & answered(PLUS) & ~local_control().next)

    # All of it can be.
    power_comes = Sometimes("R-6.1.3.1-3", any_power(), "R-5.2.1.2.1-1")
    interlocks_trip = Sometimes("R-6.1.3.1-1", interlocks_violated())
    interlocks_are_reset = Sometimes("R-6.1.3.2.1-1", interlocks_violated() & ~interlocks_violated().next)
    all_are_calibrated = Sometimes(
        "R-6.1.3.1-4", all_calibrated() & for_some(r)(needs_calibration[r]), "R-5.2.1.2.1-1"
    )
    device_is_held = Sometimes("R-6.2.2.2-1", for_some(r)(device_local[r]), "R-6.2.3.2-1")
    device_calibrated = Sometimes(
        "R-6.3.6-1", for_some(r)(needs_calibration[r] & (calibration[r] == Calibration.CALIBRATED))
    )
    device_calibrating = Sometimes(
        "R-6.3.6-1", for_some(r)(needs_calibration[r] & (calibration[r] == Calibration.CALIBRATING))
    )
    device_not_calibrated = Sometimes(
        "R-6.3.6-1", for_some(r)(needs_calibration[r] & (calibration[r] == Calibration.NOT_CALIBRATED))
    )
    calibration_completes = Sometimes(
        "R-6.3.6-5", service_is("calibration_ends") & for_some(r)(calibrates_device[pi, r] & (calibration[r] == Calibration.CALIBRATING) & (calibration[r].next == Calibration.CALIBRATED)))  # fmt: skip
    calibration_fails = Sometimes(
        "R-6.3.6-5", service_is("calibration_ends") & for_some(r)(calibrates_device[pi, r] & (calibration[r] == Calibration.CALIBRATING) & (calibration[r].next == Calibration.NOT_CALIBRATED)))  # fmt: skip
