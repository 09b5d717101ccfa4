"""Selecting the controlling program invocation (7.4.4), and the IDLE sub-states of figure 10 (6.3.3)."""

from mmsverify.model import (
    Derived,
    Procedure,
    Transition,
    accept,
    do,
    for_all,
    for_some,
    indication,
    refuse,
    repaired,
    response,
)  # fmt: skip

from .admission import ALL_BUT_RUNNING, admission
from .vocabulary import Control, RobotState, State, Vocabulary, VocabularyRepaired


class Selection(Vocabulary):
    """As written."""

    # The sub-states of IDLE of a controlling program invocation (figure 10): transient ones last from indication
    # to response.
    not_selected = Derived(
        (state[p] == State.IDLE)
        & (control[p] == Control.CONTROLLING)
        & ~selected[p]
        & ~for_some(q)(selecting[q, p]),
        over=[p],
    )
    being_selected = Derived((state[p] == State.IDLE) & ~selected[p] & for_some(q)(selecting[q, p]), over=[p])
    idle_selected = Derived((state[p] == State.IDLE) & selected[p] & ~for_some(q)(selecting[q, p]), over=[p])
    being_deselected = Derived(
        (state[p] == State.IDLE) & selected[p] & for_some(q)(selecting[q, p]), over=[p]
    )

    t101 = Transition(
        "R-6.3.3-t101", "R-6.3.3-1",
        on=indication("select", request, controlling),
        when=[controlling.present],
        then=[selecting[request, p].becomes(p == controlling).over(p)],
    )  # fmt: skip
    t104 = Transition(
        "R-6.3.3-t104", "R-6.3.3-1",
        on=indication("select", request, controlling),
        when=[~controlling.present],
        then=[selecting[request, p].becomes(selected[p]).over(p)],
    )  # fmt: skip

    unfit = for_some(c)(
        controlled.has(c)
        & ~((control[c] == Control.CONTROLLED) & for_all(a)(controller[c, a] >> selected[a]))
    )
    selected_active = for_some(a)(selected[a] & (state[a] != State.IDLE))

    select = Procedure(
        "R-7.4.4.2",
        on=response("select", request, user, controlling, controlled),
        always=[selecting[request, p].becomes(False).over(p)],
        steps=[
            refuse("a", unless=holder[user], rule="select.without-control", says="{user} does not hold R_CTRL"),
            refuse("b", when=controlling.present & (control[controlling] != Control.CONTROLLING), rule="select.not-controlling",
                   says="{controlling} is not CONTROLLING"),
            refuse("c", when=controlling.present & (state[controlling] != State.IDLE), rule="select.not-idle",
                   says="{controlling} is not IDLE"),
            refuse("d", when=unfit, rule="select.controlled-elsewhere",
                   says="a program invocation of the list is not CONTROLLED, or is controlled by one that is not selected"),
            refuse("e", when=selected_active, rule="select.selected-active", says="the selected program invocation is not IDLE"),
            do("f1", controller[c, b].becomes(False).over(a, c, b).when(selected[a] & controls[a, c])),
            do("f2", controls[a, c].becomes(False).over(a, c).when(selected[a])),
            do("R-6.3.5.5-1", robot_state().becomes(RobotState.LOADED).when(some_selected())),
            do("g", selected[a].becomes(False).over(a)),
            accept("h", "R-6.3.3-t106", when=~controlling.present),
            refuse("i", when=for_some(c)(controls[controlling, c]), rule="select.list-not-empty",
                   says="the list of {controlling} is not empty"),
            do("j", selected[controlling].becomes(True)),
            do("k", controls[controlling, c].becomes(False).over(c).when(~for_some(p)(controlled.has(p)))),
            do("l", controller[c, b].becomes(b == controlling).over(c, b).when(controlled.has(c)),
               controls[controlling, c].becomes(True).over(c).when(controlled.has(c))),
            do("R-6.3.5.4-1", robot_state().becomes(RobotState.READY)),
            accept("m", "R-6.3.3-t103"),
        ],
    )  # fmt: skip


class SelectionRepaired(Selection, VocabularyRepaired):
    """The repaired reading: all checks first, then the effects."""

    unknown = controlling.present & ~exists[controlling]
    unknown_listed = for_some(c)(controlled.has(c) & ~exists[c])
    unrunnable_listed = for_some(c)(controlled.has(c) & (state[c] == State.UNRUNNABLE))
    others_list = for_some(c)(controls[controlling, c]) & ~selected[controlling]

    select = Procedure(
        "R-7.4.4.2",
        on=response("select", request, user, panel, controlling, controlled, named_twice),
        always=[selecting[request, p].becomes(False).over(p)],
        steps=[
            refuse("R-5.3.1.3.3.13-2", "RP-09", when=intervention(), rule="select.intervention",
                   says="the robot is in MANUAL-INTERVENTION-REQUIRED"),
            *admission("select", panel, local_control(), logical(), ALL_BUT_RUNNING),
            refuse("a", unless=holder[user] | panel, rule="select.without-control", says="{user} does not hold R_CTRL"),
            refuse("b", "RP-14", when=unknown, rule="select.unknown", says="{controlling} does not exist"),
            refuse("b", when=controlling.present & (control[controlling] != Control.CONTROLLING), rule="select.not-controlling",
                   says="{controlling} is not CONTROLLING"),
            refuse("c", when=controlling.present & (state[controlling] != State.IDLE), rule="select.not-idle",
                   says="{controlling} is not IDLE"),
            refuse("d", "RP-14", when=unknown_listed, rule="select.unknown-controlled",
                   says="a program invocation of the list does not exist"),
            refuse("d", "RP-14", when=named_twice, rule="select.named-twice", level="warning",
                   says="the list names a program invocation twice"),
            refuse("d", when=unfit, rule="select.controlled-elsewhere",
                   says="a program invocation of the list is not CONTROLLED, or is controlled by one that is not selected"),
            refuse("R-7.3.3.3.3-d4", "RP-15", when=unrunnable_listed, rule="select.unrunnable", level="warning",
                   says="a program invocation of the list is UNRUNNABLE and can never be started"),
            refuse("e", when=selected_active, rule="select.selected-active", says="the selected program invocation is not IDLE"),
            refuse("i", "RP-01", when=controlling.present & others_list, rule="select.list-not-empty",
                   says="the list of {controlling} is not empty"),
            do("f1", controller[c, b].becomes(False).over(a, c, b).when(selected[a] & controls[a, c])),
            do("f2", controls[a, c].becomes(False).over(a, c).when(selected[a])),
            do("g", selected[a].becomes(False).over(a)),
            accept("h", "R-6.3.5.5-1", "R-6.3.3-t106", when=~controlling.present),
            do("j", selected[controlling].becomes(True)),
            do("l", controller[c, b].becomes(b == controlling).over(c, b).when(controlled.has(c)),
               controls[controlling, c].becomes(True).over(c).when(controlled.has(c)), cites=["R-7.4.4.2-k"]),
            accept("m", "R-6.3.5.4-1", "R-6.3.3-t103"),
        ],
        repairs=repaired("RP-01", "R-7.4.4.2-i", because="step i) refuses after f) and g) have deselected: a result(-) with an effect"),
    )  # fmt: skip
