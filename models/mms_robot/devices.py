"""Physical resources: power, calibration, local control, safety interlocks (6.1.3, 6.2, 6.3.6).

A device is named by the domain that represents it. What the VMD says of all devices together is stored beside
what each says of itself, so that their agreement is a property and not a given. Calibration follows from what
the calibration program does; the rest comes and goes by itself, in one internal row.
"""

from mmsverify.model import (
    Assume,
    Derived,
    Initially,
    Transition,
    for_all,
    for_some,
    if_,
    internal,
    parameter,
)  # fmt: skip

from .vocabulary import Calibration, State, Vocabulary


class Devices(Vocabulary):
    """As written; the repaired reading changes none of it."""

    # Power-on, and what a profile must respect.
    devices_at_power_on = Initially(
        "R-6.2.1-2", for_all(r)(~device_local[r] & ~power[r] & (calibration[r] == Calibration.NOT_CALIBRATED))
    )
    joints_at_power_on = Initially(
        "R-6.2.2.1-2", for_all(r, j)(joint_calibration[r, j] == Calibration.NOT_CALIBRATED)
    )
    resources_at_power_on = Initially(
        "R-6.1.3.1-3", ~any_power() & (all_calibrated() == ~for_some(r)(needs_calibration[r])), "R-6.1.3.1-4"
    )
    interlocks_at_power_on = Initially("R-6.1.3.2.1-1", ~interlocks_violated())
    calibrator_is_standard = Assume(
        "R-6.3.6-2", for_all(p, r)(calibrates_device[p, r] >> (calibrates[p] & needs_calibration[r]))
    )
    one_calibrator = Assume(
        "R-6.3.6-2", for_all(a, b, r)((calibrates_device[a, r] & calibrates_device[b, r]) >> (a == b))
    )

    # A resource without a calibration program of its own is calibrated in some way that no message shows.
    has_calibrator = Derived(for_some(p)(calibrates_device[p, r]), over=[r])
    unfinished = Derived(for_some(p)(calibrates_device[p, r] & started[p]), over=[r])
    still_calibrating = Derived(unfinished[r] & (calibration[r] == Calibration.CALIBRATING), over=[r])
    in_calibration = Derived(for_some(p)(calibrates_device[p, r] & runs[p]), over=[r])

    # Which joints are calibrated while an arm is not: some, but not all.
    not_all_joints = for_some(j)(~calibrated_joints.has(j))
    partly = if_(calibrated_joints.has(j), Calibration.CALIBRATED, Calibration.NOT_CALIBRATED)
    outcome = parameter("outcome", Calibration)
    calibration_ends = Transition(
        "R-6.3.6-4", "R-6.3.6-5", "R-6.3.6-6", "R-8.3.2-2", "RP-18",
        on=internal("calibration_ends", pi, outcome, calibrated_joints),
        when=[calibrates[pi], state[pi] == State.RUNNING, outcome != Calibration.CALIBRATING, not_all_joints],
        then=[
            state[pi].becomes(State.IDLE),
            calibration[r].becomes(outcome).over(r).when(calibrates_device[pi, r]),
            joint_calibration[r, j].becomes(if_(outcome == Calibration.CALIBRATED, Calibration.CALIBRATED, partly)).over(r, j)
            .when(calibrates_device[pi, r]),
            all_calibrated().becomes(
                (outcome == Calibration.CALIBRATED)
                & for_all(r)(needs_calibration[r] >> (calibrates_device[pi, r] | (calibration[r] == Calibration.CALIBRATED)))
            ).when(for_some(r)(calibrates_device[pi, r])),
        ],
    )  # fmt: skip

    powered = Device.some("powered")
    found_calibrated = Device.some("found_calibrated")
    found_calibrating = Device.some("found_calibrating")
    violated = Device.some("violated")
    found = if_(
        found_calibrated.has(r) & ~unfinished[r], Calibration.CALIBRATED,
        if_(found_calibrating.has(r) & (still_calibrating[r] | ~has_calibrator[r]), Calibration.CALIBRATING, Calibration.NOT_CALIBRATED),
    )  # fmt: skip
    devices_change = Transition(
        "R-6.1.3.2.1-1", "R-6.2.2.3-1", "R-6.2.3.3-1", "R-6.3.6-1", "R-6.1.3.2.3-1", "R-6.1.3.2.4-1", "RP-18",
        on=internal("devices_change", powered, found_calibrated, found_calibrating, calibrated_joints, violated),
        when=[not_all_joints],
        then=[
            power[r].becomes(powered.has(r)).over(r),
            any_power().becomes(for_some(r)(powered.has(r))),
            interlocks_violated().becomes(for_some(r)(violated.has(r))),
            calibration[r].becomes(found).over(r).when(needs_calibration[r] & ~in_calibration[r]),
            joint_calibration[r, j].becomes(if_(found == Calibration.NOT_CALIBRATED, partly, found)).over(r, j)
            .when(needs_calibration[r] & ~in_calibration[r]),
            all_calibrated().becomes(for_all(r)(needs_calibration[r] >> (found_calibrated.has(r) & ~unfinished[r]))),
        ],
        observation_only=True,
    )  # fmt: skip
