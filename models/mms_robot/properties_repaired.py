"""The claims that the repaired reading states otherwise, and the invariants from which the others follow."""

from mmsverify.model import (
    PLUS,
    Always,
    Assume,
    Derived,
    Initially,
    Step,
    answered,
    any_of,
    for_all,
    repaired,
    service_is,
)  # fmt: skip

from .properties import Properties
from .vocabulary import Control, Logical, Physical, RobotState, State, VocabularyRepaired


class PropertiesRepaired(Properties, VocabularyRepaired):
    """The repaired reading."""

    robot_at_power_on = Initially("R-6.3.5.2-2", ~intervention(), "R-6.3.5.1-1",
                                  repairs=repaired("RP-12", "R-6.3.5.2-2", because="the robot state follows from the rest"))  # fmt: skip
    ready_controls_arm = Always(
        "R-6.3.4.4-1", for_all(a, c)(((robot_state() == RobotState.READY) & arm[c] & controller[c, a]) >> selected[a]),
        repairs=repaired("RP-12", "R-6.3.4.4-1", because="an arm is not required in the list; if it is controlled, then by the selected one"))  # fmt: skip

    list_of_selected = Assume("R-7.4.4.2-i", for_all(a, c)(predefined_controls[a, c] >> selected_at_power_on[a]), "R-7.4.4.2-f2",
                              repairs=repaired("RP-30", "R-7.4.4.2-i", because="the list of one that is not selected would stand for ever, and keep it from being selected"))  # fmt: skip

    # Each says all that an entry implies, so that one of them alone is enough to exclude it.
    lists_end = Always("R-6.3.2.3-1",
                       for_all(a, c)(controls[a, c] >> (exists[a] & (control[a] == Control.CONTROLLING) & selected[a]
                                                        & exists[c] & (control[c] == Control.CONTROLLED))),
                       says="only an existing CONTROLLING program invocation has a list, of existing CONTROLLED ones, while it is selected",
                       repairs=repaired("RP-04", "R-6.3.2.3-1", because="nothing dangles"))  # fmt: skip
    references_end = Always("R-6.3.2.8-1",
                            for_all(a, c)(controller[c, a] >> (exists[c] & (control[c] == Control.CONTROLLED)
                                                               & exists[a] & (control[a] == Control.CONTROLLING))),
                            says="only an existing CONTROLLED program invocation has a controlling reference, to an existing CONTROLLING one",
                            repairs=repaired("RP-04", "R-6.3.2.8-1", because="nothing dangles"))  # fmt: skip
    idle_predicate = Derived(~intervention() & ~some_controlling() & ~some_selected(),
                             repairs=repaired("RP-12", "R-6.3.4.2-1", because="manual intervention comes first"))  # fmt: skip
    loaded_predicate = Derived(~intervention() & some_controlling() & ~some_selected(),
                               repairs=repaired("RP-12", "R-6.3.4.3-1", because="manual intervention comes first"))  # fmt: skip
    ready_predicate = Derived(
        ~intervention() & some_selected() & for_all(a)(selected[a] >> state[a].isin([State.IDLE, State.STARTING])),
        repairs=repaired("RP-12", "R-6.3.4.4-1", because="STARTING counts as IDLE, and an arm is not required"))  # fmt: skip
    executing_predicate = Derived(
        ~intervention() & motion() & some_selected() & for_all(a)(selected[a] >> started[a]),
        repairs=repaired("RP-12", "R-6.3.4.5-2", because="STOPPING counts as RUNNING, RESUMING and RESETTING as STOPPED or RUNNING"))  # fmt: skip
    paused_predicate = Derived(
        ~intervention() & ~motion() & some_selected() & for_all(a)(selected[a] >> started[a]),
        repairs=repaired("RP-12", "R-6.3.4.6-2", because="STOPPING counts as RUNNING, RESUMING and RESETTING as STOPPED or RUNNING"))  # fmt: skip
    intervention_predicate = Derived(
        intervention() & ~motion() & (logical() != Logical.STATE_CHANGES_ALLOWED) & (physical() == Physical.NEEDS_COMMISSIONING),
        repairs=repaired("RP-12", "R-6.3.4.7-3", because="the two statuses alone do not make MANUAL-INTERVENTION-REQUIRED"))  # fmt: skip

    executing_exclusive = Always("R-6.3.4.5-1", ~(executing_predicate() & any_of(idle_predicate(), loaded_predicate(), ready_predicate(), paused_predicate())),
                                 repairs=repaired("RP-12", "R-6.3.4.5-1", because="stated for the mapping"))  # fmt: skip
    ready_exclusive = Always("R-6.3.4.4-1", ~(ready_predicate() & any_of(idle_predicate(), loaded_predicate(), paused_predicate())),
                             repairs=repaired("RP-12", "R-6.3.4.4-1", because="stated for the mapping"))  # fmt: skip

    intervention_refuses = Step(
        "R-5.3.1.3.3.13-2", (intervention() & service_is("start", "resume", "select", "vMDReset")) >> ~answered(PLUS), "RP-09",
        says="in MANUAL-INTERVENTION-REQUIRED nothing is started, resumed, selected or reset",
        repairs=repaired("RP-09", "R-5.3.1.3.3.13-2", because="stated for the services that would lead out of it"))  # fmt: skip
    motion_needs_selected = Always("R-6.3.4.5-2", motion() >> for_all(a)(selected[a] >> started[a]), "RP-07",
                                   repairs=repaired("RP-07", "R-6.3.4.5-2", because="no motion of a task program that has not been started"))  # fmt: skip
