"""What a broken property means for a plant, by the name of the claim: one sentence for whoever reads the findings."""

CONSEQUENCES = {
    "one_controller": "Two task programs give orders to one arm program; whichever speaks last moves the arm.",
    "one_reference": "An arm program cannot tell whose orders it follows.",
    "lists_follow_references": "An arm program takes orders from a task program that does not know of it: Start leaves the arm standing, and "
    "Stop of the task program does not reach it.",
    "references_follow_lists": "A task program believes that it controls an arm program which obeys another one, or nobody.",
    "listed_are_controlled": "Start of a task program acts on a name that stands for nothing, or for a program of another kind.",
    "references_are_controlling": "An arm program refers to a task program that is gone: it can be given to no other one before it is deleted itself.",
    "only_selected_controls": "A task program that is not selected still holds an arm program; Select of the right one is refused.",
    "one_selected": "Two task programs are selected: clients that look at Status disagree about what the next Start moves.",
    "selected_is_controlling": "Status names a selected task program that no longer exists; the next program created under its name is selected "
    "without any Select, and Start moves the robot with it.",
    "selected_can_run": "The selected task program can never be started, and nothing says so: the cell waits for a robot that answers every Start "
    "with result(-).",
    "idle_has_no_controlling": "Status says that no task program is there, though one is and can be selected and started.",
    "idle_has_none_selected": "Status says ROBOT-IDLE while a task program is selected: a client that relies on the robot state alone starts it.",
    "idle_arm_uncontrolled": "The arm program is still bound to a task program that was cleared away; the next task program cannot have the arm.",
    "loaded_has_controlling": "Status says that nothing is selected, or that something is loaded, and neither is so.",
    "loaded_arm_uncontrolled": "The arm program stays bound to a task program although nothing is selected.",
    "ready_has_idle_selected": "Status says ready to start, but Start is refused, for nothing is selected or the selected program is not IDLE.",
    "ready_controls_arm": "The robot says that it is ready, but the selected task program does not control the arm: Start runs a program that moves "
    "nothing.",
    "executing_enables_motion": "Status says ROBOT-EXECUTING while the arm cannot move: nobody looks for the reason why the cell stands still.",
    "executing_runs": "Status says ROBOT-EXECUTING after the task program has been killed or reset: guards stay closed, or open late, for a robot "
    "that does nothing.",
    "paused_disables_motion": "A robot that says it is paused may move: whoever reaches in is in danger.",
    "paused_runs": "Status says that the robot is paused in a program which is not there any more; Resume can never succeed.",
    "intervention_stops_motion": "A robot that asks for an operator may still move while the operator steps in.",
    "intervention_logical": "A robot that waits for an operator admits services which change its state from afar.",
    "intervention_physical": "The physical status does not say that somebody has to go there.",
    "motion_only_executing": "The arm may move in a state in which everybody takes it for standing.",
    "motion_has_running_arm": "The arm may move though no arm program runs.",
    "predicates_exhaustive": "In such a state no definition of 6.3.4 applies: two makers will show two different robot states, and a client cannot "
    "rely on either.",
    "predicates_exclusive": "Two definitions of 6.3.4 apply at once: whether the robot waits for an operator is a matter of taste.",
    "local_control_logical": "Somebody at the panel holds the robot, and it still admits changes from afar.",
    "one_holder": "Two clients hold R_CTRL and both may start motion: the exclusion on which every cell with two hosts rests is gone.",
    "holder_is_associated": "A client that has gone away keeps R_CTRL for ever: nobody can stop the robot by a service any more.",
    "remote_cannot_in_local_control": "Somebody works at the panel, and a client far away changes what the robot will do next.",
    "refusal_has_no_effect": "A client reads result(-) and believes that nothing has changed, but something has.",
    "refusal_keeps_states": "A client reads result(-) to its Start or Resume, yet programs that it controls have been started and stopped again: "
    "the arm may have moved.",
    "intervention_left_by_operator": "A service from afar ends MANUAL-INTERVENTION-REQUIRED while the operator is still inside the fence.",
    "association_changes_nothing": "Plugging or pulling a network cable changes what the robot does.",
    "calibrating_until_finished": "A calibration program that was killed or reset leaves its arm CALIBRATING for ever: a client waits for an end that never comes.",
    "calibration_does_not_load": "The robot says that it is loaded when the calibration program is all that is left.",
    "local_devices_are_not_changed": "Somebody holds the arm at the panel, and a client far away starts to calibrate it.",
    "start_count_positive": "A program is started for no cycle or step at all: what it does then, no two controllers agree.",
    "resume_count_positive": "A program is resumed for no cycle or step at all: what it does then, no two controllers agree.",
    "figure_8": "The robot changes its state in a way that figure 8 does not show: a client programmed from the figure loses track.",
    "clear_needs_load": "Status falls back to ROBOT-IDLE although no task program was there to be cleared: counts of programs go wrong.",
    "ready_left_by_deassign": "Creating another task program takes READY away from the assigned one: the next Start is answered from a state that "
    "no client expects.",
    "abort_deassigns": "After Clear(abort) the old task program is still selected: Start needs no new Select and runs a program that was aborted.",
    "abort_removes_programs": "After Clear(abort) a task program is still there that the robot claims not to have.",
    "program_diagram": "A program takes a way that no state diagram shows: a client that follows it by the diagram is wrong about what runs.",
    "lists_end": "The list of a deleted task program lives on; a new program of that name controls what it never selected.",
    "references_end": "The reference of a deleted arm program lives on; a new program of that name is controlled from the start.",
    "used_domains_exist": "A program that cannot be deleted has lost the domain that holds its text: its next Start runs nothing, or what was "
    "loaded under that name since.",
    "unshared_has_one_user": "Two programs are bound to a domain that only one may have: what one of them changes, the other executes.",
    "only_existing_use": "A deleted program still counts as bound to its domain: a new program of that name inherits a program text that nobody gave it.",
    "loading_is_bound": "A download goes on into a domain that VMD Reset has deleted: the robot asks for segments of nothing.",
    "one_download": "Two clients load the same domain at once; what it holds in the end is a mixture.",
    "uploads_have_domain": "A client goes on reading a program that is not there any more, and files it as the current one.",
    "remote_cannot_change_domains": "Somebody works at the panel, and a client far away exchanges the programs under his hands.",
}  # fmt: skip
