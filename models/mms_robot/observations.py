"""What messages show of the state (6.3.8, 7.3.2, 7.3.3.9, 8.3, 8.5.3, 8.5.4).

They are Status, UnsolicitedStatus, GetProgramInvocationAttributes and the standardized variables. A variable
shows the instant at which it was read: only a reading says that those of one Read are of one instant (RP-22).
"""

from mmsverify.model import BOOL, Observation, for_all, for_some, integer, needs, optional, parameter, shown

from .vocabulary import Calibration, Control, Logical, Mode, Physical, RobotState, State, Vocabulary


class Observations(Vocabulary):
    """As written; the repaired reading changes none of it."""

    shown_robot = optional("shown_robot", RobotState)
    shown_logical = parameter("shown_logical", Logical)
    shown_physical = parameter("shown_physical", Physical)
    shown_local = optional("shown_local", BOOL)
    shown_power = optional("shown_power", BOOL)
    shown_calibrated = optional("shown_calibrated", BOOL)
    shown_interlocks = optional("shown_interlocks", BOOL)
    selected_is = PI.maybe("selected_is")
    detailed = parameter("detailed", BOOL)

    # Program start leads to EXECUTING (5.3.1.3.3.6); that it does not without an arm to move, only a reading says.
    claims_armless_motion = (
        detailed
        & (shown_robot == RobotState.EXECUTING)
        & (robot_state() == RobotState.MOTION_PAUSED)
        & for_some(a)(selected[a] & ~for_some(c)(controls[a, c] & arm[c]))
    )

    # What contradicts itself within one message comes first, then what contradicts the state.
    status = Observation(
        "R-7.3.2.1-3", "R-7.3.2.1.1.2-1", "R-7.3.2.1.1.3-1", "R-6.3.8.1-1", "R-6.3.9-1",
        on=shown("status", detailed, shown_robot, selected_is, shown_logical, shown_physical,
                 shown_interlocks, shown_power, shown_calibrated, shown_local),
        shows=[
            needs("R-T1-1", "R-6.1.3.2.5-1", rule="status.local-control",
                  that=(shown_local.present & shown_local) >> (shown_logical != Logical.STATE_CHANGES_ALLOWED),
                  says="local control is TRUE beside logical status STATE-CHANGES-ALLOWED"),
            needs("R-6.3.4.7-2", "R-T1-2", rule="status.intervention-logical",
                  that=(detailed & (shown_robot == RobotState.INTERVENTION)) >> (shown_logical != Logical.STATE_CHANGES_ALLOWED),
                  says="MANUAL-INTERVENTION-REQUIRED beside logical status STATE-CHANGES-ALLOWED"),
            needs("R-6.3.4.7-3", rule="status.intervention-physical",
                  that=(detailed & (shown_robot == RobotState.INTERVENTION)) >> (shown_physical == Physical.NEEDS_COMMISSIONING),
                  says="MANUAL-INTERVENTION-REQUIRED beside a physical status other than NEEDS-COMMISSIONING"),
            needs("R-6.3.4.2-2", "R-7.3.2.1.1.4-1", rule="status.idle-selected",
                  that=~(detailed & (shown_robot == RobotState.IDLE) & selected_is.present),
                  says="ROBOT-IDLE beside a selected program invocation"),
            needs("R-6.3.4.3-1", "R-7.3.2.1.1.4-1", rule="status.loaded-selected",
                  that=~(detailed & (shown_robot == RobotState.LOADED) & selected_is.present),
                  says="ROBOT-LOADED beside a selected program invocation"),
            needs("R-6.3.4.4-1", "R-7.3.2.1.1.4-1", rule="status.ready-unselected",
                  that=~(detailed & (shown_robot == RobotState.READY) & ~selected_is.present),
                  says="ROBOT-READY without a selected program invocation"),
            needs("R-6.3.4.5-2", "R-7.3.2.1.1.4-1", rule="status.executing-unselected",
                  that=~(detailed & (shown_robot == RobotState.EXECUTING) & ~selected_is.present),
                  says="ROBOT-EXECUTING without a selected program invocation"),
            needs("R-6.3.4.6-2", "R-7.3.2.1.1.4-1", rule="status.paused-unselected",
                  that=~(detailed & (shown_robot == RobotState.MOTION_PAUSED) & ~selected_is.present),
                  says="ROBOT-MOTION-PAUSED without a selected program invocation"),
            needs("R-6.1.3.1-5", "R-6.1.3.2.5-1", rule="status.local-control-value",
                  that=shown_local.present >> (local_control() == shown_local), says="local control is {local_control}"),
            needs("R-6.1.3.1-1", "R-6.1.3.2.1-1", rule="status.interlocks",
                  that=shown_interlocks.present >> (interlocks_violated() == shown_interlocks), says="the safety interlocks cannot be as shown"),
            needs("R-6.1.3.1-3", "R-6.1.3.2.3-1", rule="status.power",
                  that=shown_power.present >> (any_power() == shown_power), says="the power of the physical resources cannot be as shown"),
            needs("R-6.1.3.1-4", "R-6.1.3.2.4-1", "R-6.3.6-6", rule="status.calibrated",
                  that=shown_calibrated.present >> (all_calibrated() == shown_calibrated), says="all physical resources calibrated cannot be as shown"),
            needs("R-6.1.3.2.6-2", "R-7.3.2.1.1.4-1", "R-6.3.5.4-2", rule="status.selected-kind",
                  that=(detailed & selected_is.present) >> (exists[selected_is] & (control[selected_is] == Control.CONTROLLING)),
                  says="the selected program invocation {selected_is} is not an existing CONTROLLING one"),
            needs("R-7.3.2.1.1.4-1", "R-6.1.3.2.6-1", "R-6.1.3.2.6-3", rule="status.selected",
                  that=detailed >> for_all(a)(selected[a] == (selected_is.present & (a == selected_is))),
                  says="another program invocation is selected, or none"),
            needs("R-6.3.4.5-1", "RP-12", "RP-20", rule="status.executing-without-arm", level="warning", that=~claims_armless_motion,
                  says="the selected program invocation controls no arm, so that motion is not enabled"),
            needs("R-7.3.2.1.1.1-1", "R-6.1.3.1-2", rule="status.robot-state",
                  that=detailed >> ((robot_state() == shown_robot) | claims_armless_motion), says="the robot cannot be in {shown_robot}"),
            needs("R-7.3.2.1-1", "B-STATUS", rule="status.logical", that=logical() == shown_logical,
                  says="the logical status cannot be {shown_logical}"),
            needs("R-7.3.2.1-1", "B-STATUS", rule="status.physical", that=physical() == shown_physical,
                  says="the physical status cannot be {shown_physical}"),
        ],
    )  # fmt: skip

    shown_state = parameter("shown_state", State)
    shown_control = parameter("shown_control", Control)
    shown_deletable = parameter("shown_deletable", BOOL)
    shown_reusable = parameter("shown_reusable", BOOL)
    listed = PI.some("listed")
    controller_is = PI.maybe("controller_is")
    shown_mode = optional("shown_mode", Mode)
    shown_count = parameter("shown_count", integer())
    shown_error = parameter("shown_error", integer())
    shown_location = optional("shown_location", BOOL)
    extended = parameter("extended", BOOL)

    attributes = Observation(
        "R-7.3.3.9-1", "R-6.3.8.3-1",
        on=shown("getProgramInvocationAttributes", pi, shown_state, shown_deletable, shown_reusable, extended, shown_control,
                 listed, controller_is, shown_mode, shown_count, shown_error, shown_location),
        shows=[
            needs("R-8.3.1-6", "R-7.3.3.9.2.2-1", rule="attributes.arm-control",
                  that=(extended & standard_arm[pi]) >> (shown_control == Control.CONTROLLED), says="{pi} must be CONTROLLED"),
            needs("R-8.3.2-3", "R-6.3.6-7", rule="attributes.calibration-control",
                  that=(extended & calibrates[pi]) >> (shown_control == Control.NORMAL), says="{pi} must be NORMAL"),
            needs("R-8.3.1-3", rule="attributes.arm-deletable", that=standard_arm[pi] >> ~shown_deletable, says="{pi} must not be deletable"),
            needs("R-8.3.1-4", rule="attributes.arm-reusable", that=standard_arm[pi] >> shown_reusable, says="{pi} must be reusable"),
            needs("R-8.3.2-2", rule="attributes.calibration-fixed", that=calibrates[pi] >> (~shown_deletable & shown_reusable),
                  says="{pi} must be reusable and not deletable"),
            needs("R-7.3.3.9-1", "B-ATTRIBUTES", rule="attributes.unknown",
                  that=exists[pi] & (shown_state != State.NON_EXISTENT), says="{pi} does not exist"),
            needs("R-7.3.3.9.2.2-1", "R-6.3.2.2-1", rule="attributes.control",
                  that=extended >> (control[pi] == shown_control), says="the control attribute of {pi} cannot be {shown_control}"),
            needs("R-7.3.3.9-1", "B-ATTRIBUTES", rule="attributes.deletable", that=deletable[pi] == shown_deletable,
                  says="mmsDeletable of {pi} cannot be {shown_deletable}"),
            needs("R-7.3.3.9-1", "B-ATTRIBUTES", rule="attributes.reusable", that=reusable[pi] == shown_reusable,
                  says="reusable of {pi} cannot be {shown_reusable}"),
            needs("R-7.3.3.9-1", "R-6.3.6-3", "R-6.3.6-4", "B-ATTRIBUTES", rule="attributes.state",
                  that=calibrates[pi] >> (state[pi] == shown_state), says="{pi} cannot be {shown_state}"),
            needs("R-7.3.3.9-1", "B-ATTRIBUTES", rule="attributes.state", that=state[pi] == shown_state,
                  says="{pi} cannot be {shown_state}"),
            needs("R-7.3.3.9.2.4-1", "R-6.3.2.3-2", rule="attributes.list",
                  that=(extended & (shown_control == Control.CONTROLLING)) >> for_all(c)(controls[pi, c] == listed.has(c)),
                  says="the list of {pi} cannot be the one shown"),
            needs("R-7.3.3.9.2.11-1", "R-6.3.2.8-2", "R-6.3.2.8-3", rule="attributes.controller",
                  that=(extended & (shown_control == Control.CONTROLLED)) >> for_all(a)(controller[pi, a] == (controller_is.present & (a == controller_is))),
                  says="the controlling reference of {pi} cannot be the one shown"),
            needs("R-7.3.3.9.2.9-1", "R-7.3.3.9.4.2-1", rule="attributes.step-limited",
                  that=(shown_mode.present & (shown_mode == Mode.STEP_LIMITED)) >> step_limited(),
                  says="the robot does not have the running mode STEP-LIMITED"),
            needs("R-7.3.3.9.2.6-1", "R-6.3.2.5-1", rule="attributes.mode",
                  that=shown_mode.present >> (mode[pi] == shown_mode), says="the running mode of {pi} cannot be {shown_mode}"),
            needs("R-7.3.3.9.2.6-1", "R-6.3.2.6-1", rule="attributes.cycles",
                  that=(shown_mode.present & (shown_mode == Mode.CYCLE_LIMITED)) >> (cycles[pi] == shown_count),
                  says="{pi} cannot have {shown_count} cycles left"),
            needs("R-7.3.3.9.2.6-1", "R-6.3.2.7-1", rule="attributes.steps",
                  that=(shown_mode.present & (shown_mode == Mode.STEP_LIMITED)) >> (steps[pi] == shown_count),
                  says="{pi} cannot have {shown_count} steps left"),
            needs("R-7.3.3.9.2.1-1", "R-6.3.2.1-1", "R-7.3.3.2.3-0", rule="attributes.error-code",
                  that=extended >> (error_code[pi] == shown_error), says="the error code of {pi} cannot be {shown_error}"),
            needs("R-7.3.3.9.2.5-1", "R-7.3.3.2.3-a", rule="attributes.location",
                  that=shown_location.present >> (located[pi] == shown_location), says="{pi} has not been executed and can have no program location"),
        ],
    )  # fmt: skip

    unknown_attributes = Observation(
        "R-7.3.3.9.3-1",
        on=shown("noProgramInvocationAttributes", pi),
        shows=[needs("R-7.3.3.9.3-1", "B-ATTRIBUTES", rule="attributes.refused", level="warning", that=~exists[pi], says="{pi} exists")],
    )  # fmt: skip

    local_control_shown = Observation(
        "R-8.5.3.3-1", "R-6.3.8.2-1",
        on=shown("R_VLOCAL", shown_local),
        shows=[needs("R-8.5.3.3-1", rule="variable.local-control", that=local_control() == shown_local, says="local control cannot be {shown_local}")],
    )  # fmt: skip

    power_shown = Observation(
        "R-8.5.3.1-1", "R-6.3.8.2-1",
        on=shown("R_VPWR", shown_power),
        shows=[needs("R-8.5.3.1-1", "R-6.1.3.2.3-1", rule="variable.power", that=any_power() == shown_power, says="R_VPWR cannot be {shown_power}")],
    )  # fmt: skip
    all_calibrated_shown = Observation(
        "R-8.5.3.2-1", "R-6.3.8.2-1",
        on=shown("R_VCAL", shown_calibrated),
        shows=[needs("R-8.5.3.2-1", "R-6.1.3.2.4-1", "R-6.3.6-6", rule="variable.all-calibrated", that=all_calibrated() == shown_calibrated,
                     says="R_VCAL cannot be {shown_calibrated}")],
    )  # fmt: skip
    interlocks_shown = Observation(
        "R-8.5.3.4-1", "R-6.3.8.2-1",
        on=shown("R_VSAFEV", shown_interlocks),
        shows=[needs("R-8.5.3.4-1", "R-6.1.3.2.1-1", rule="variable.interlocks", that=interlocks_violated() == shown_interlocks,
                     says="R_VSAFEV cannot be {shown_interlocks}")],
    )  # fmt: skip

    # Of one physical resource, named by its domain.
    device = Device.element("device")
    shown_calibration = parameter("shown_calibration", Calibration)
    device_power_shown = Observation(
        "R-8.5.4.1-1", "R-6.2.2.3-1", "R-6.2.3.3-1",
        on=shown("R_DPWR", device, shown_power),
        shows=[needs("R-8.5.4.1-1", "R-6.1.3.2.3-1", rule="variable.device-power", that=power[device] == shown_power,
                     says="R_DPWR of {device} cannot be {shown_power}")],
    )  # fmt: skip
    device_calibration_shown = Observation(
        "R-8.5.4.2-1", "R-6.3.6-1", "R-6.2.3.4-1",
        on=shown("R_DCAL", device, shown_calibration),
        shows=[needs("R-6.2.3.4-1", rule="variable.device-without-calibration", that=needs_calibration[device], says="{device} has no calibration attribute"),
               needs("R-8.5.4.2-1", "R-6.3.6-3", "R-6.3.6-5", rule="variable.device-calibration", that=calibration[device] == shown_calibration,
                     says="{device} cannot be {shown_calibration}")],
    )  # fmt: skip
    device_local_shown = Observation(
        "R-8.5.4.3-1", "R-6.2.2.2-1", "R-6.2.3.2-1",
        on=shown("R_DLOCAL", device, shown_local),
        shows=[needs("R-8.5.4.3-1", "R-6.1.3.2.5-1", rule="variable.device-local", that=shown_local >> local_control(),
                     says="R_DLOCAL of {device} cannot be {shown_local}, for the robot is not in local control"),
               needs("R-8.5.4.3-1", "R-6.1.3.2.5-1", rule="variable.device-local", that=device_local[device] == shown_local,
                     says="R_DLOCAL of {device} cannot be {shown_local}")],
    )  # fmt: skip

    # The base standard does not say that the values of one Read are of one instant: hence warnings (RP-22).
    shown_powered = Device.some("shown_powered")
    shown_uncalibrated = Device.some("shown_uncalibrated")
    shown_held = Device.some("shown_held")
    read_together = Observation(
        "R-6.3.8.2-1", "RP-22",
        on=shown("readTogether", shown_power, shown_calibrated, shown_local, shown_powered, shown_uncalibrated, shown_held),
        shows=[
            needs("R-6.1.3.2.3-1", "R-8.5.3.1-1", "R-8.5.4.1-1", "RP-22", rule="read.power", level="warning",
                  that=for_all(r)((shown_power.present & shown_powered.has(r)) >> shown_power), says="R_VPWR is FALSE beside a device whose R_DPWR is TRUE"),
            needs("R-6.1.3.2.4-1", "R-8.5.3.2-1", "R-8.5.4.2-1", "RP-22", rule="read.calibrated", level="warning",
                  that=for_all(r)((shown_calibrated.present & shown_uncalibrated.has(r)) >> ~shown_calibrated),
                  says="R_VCAL is TRUE beside a device that is not calibrated"),
            needs("R-6.1.3.2.5-1", "R-8.5.3.3-1", "R-8.5.4.3-1", "RP-22", rule="read.local-control", level="warning",
                  that=for_all(r)((shown_local.present & shown_held.has(r)) >> shown_local), says="R_VLOCAL is FALSE beside a device whose R_DLOCAL is TRUE"),
        ],
    )  # fmt: skip

    state_after_failure = Observation(
        "R-7.3.3.3.3-a", "B-FAIL",
        on=shown("stateAfterFailure", pi, shown_state),
        shows=[needs("R-7.3.3.3.3-a", "B-FAIL", rule="failure.state", level="warning", that=state[pi] == shown_state,
                     says="{pi} cannot be {shown_state} after this failure")],
    )  # fmt: skip
