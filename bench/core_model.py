"""The control core of program invocations: a small benchmark model, the same for every checker.

State, control and selection of N program invocations, one of which is the arm. Variants: ``as-written``
leaves the selection alone when the selected one is deleted; ``repaired`` clears it; ``repaired-motion``
also stops the motion when the arm's program ends. The ids ``C-...`` are the benchmark's own.
"""

# ruff: noqa: F821 (a class body sees the declarations of its bases)

from collections.abc import Mapping
from typing import Any

from mmsverify.model import (
    Always,
    Assume,
    Each,
    Enumeration,
    Initially,
    Model,
    Relation,
    Sometimes,
    Step,
    Transition,
    Variable,
    for_all,
    for_some,
    internal,
    parameter,
    repaired,
    service_is,
    unchanged,
)


class PIState(Enumeration):
    """The state of a program invocation."""

    NONEXISTENT = "NONEXISTENT"
    UNRUNNABLE = "UNRUNNABLE"
    IDLE = "IDLE"
    RUNNING = "RUNNING"
    STOPPED = "STOPPED"


class Control(Enumeration):
    """What a program invocation is to others."""

    NORMAL = "NORMAL"
    CONTROLLING = "CONTROLLING"
    CONTROLLED = "CONTROLLED"


NONEXISTENT, UNRUNNABLE, IDLE, RUNNING, STOPPED = PIState
NORMAL, CONTROLLING, CONTROLLED = Control


def scenario(sizes: Mapping[str, int], _profile: Mapping[str, Any]) -> tuple[dict[str, Any], dict[Any, Any]]:
    """``PI=N`` counts the arm: R_ARM, P1, P2 and so on."""
    names = ("R_ARM", *(f"P{i}" for i in range(1, sizes.get("PI", 3))))
    return {"PI": names}, {("arm", (name,)): name == "R_ARM" for name in names}


class CorePart(Model):
    """State, actions and properties; the variants say how deletion and the end of a program go."""

    PI = Each("ProgramInvocation")
    p, a, b, c = PI.elements("p a b c")
    chosen = PI.some("chosen")
    kind = parameter("kind", Control)

    state = Variable(PIState, PI)
    control = Variable(Control, PI)
    refers = Relation(PI, PI, doc="c refers to the controlling a")
    controls = Relation(PI, PI, doc="the list of a has c")
    selected = Relation(PI)
    motion = Relation()
    arm = Relation(PI, rigid=True, doc="the predefined one")

    one_arm = Assume("C-arm", for_all(a, b)((arm[a] & arm[b]) >> (a == b)))
    states_at_first = Initially(
        "C-init",
        for_all(p)(
            (arm[p] & (state[p] == IDLE) & (control[p] == CONTROLLED))
            | (~arm[p] & (state[p] == NONEXISTENT) & (control[p] == NORMAL))
        ),
    )
    links_at_first = Initially("C-init", for_all(a, c)(~refers[c, a] & ~controls[a, c]))
    rest_at_first = Initially("C-init", for_all(p)(~selected[p]) & ~motion())

    ready = for_all(c)(controls[p, c] >> state[c].isin((IDLE, STOPPED, RUNNING)))
    may_run = (control[p] == CONTROLLING) >> (selected[p] & ready)
    selected_idle = for_all(a)(selected[a] >> (state[a] == IDLE))
    run = (
        state[p].becomes(RUNNING),
        state[c].becomes(RUNNING).when(controls[p, c]).over(c),
        motion().becomes(True).when(arm[p] | for_some(c)(controls[p, c] & arm[c])),
    )
    unlink_selected = (
        refers[c, a].becomes(False).when(selected[a] & controls[a, c]).over(c, a),
        controls[a, c].becomes(False).when(selected[a]).over(a, c),
    )
    unlink_deleted = (
        controls[a, p].becomes(False).when((control[p] == CONTROLLED) & refers[p, a]).over(a),
        refers[c, p].becomes(False).when((control[p] == CONTROLLING) & controls[p, c]).over(c),
        controls[p, c].becomes(False).over(c),
        refers[p, a].becomes(False).over(a),
        state[p].becomes(NONEXISTENT),
        control[p].becomes(NORMAL),
    )
    may_delete = (
        ~arm[p],
        state[p].isin((IDLE, STOPPED, UNRUNNABLE)),
        (control[p] == CONTROLLED) >> for_all(a)(refers[p, a] >> (state[a] == IDLE)),
    )
    unlink_ended = (
        refers[c, p].becomes(False).when((control[p] == CONTROLLING) & selected[p] & controls[p, c]).over(c),
        controls[p, c].becomes(False).when((control[p] == CONTROLLING) & selected[p]).over(c),
        selected[a].becomes(False).when((control[p] == CONTROLLING) & selected[p]).over(a),
        state[p].becomes(IDLE),
    )

    create = Transition("C-create", on=internal("create", p, kind), when=[
        state[p] == NONEXISTENT,
        ~arm[p],
    ], then=[
        state[p].becomes(IDLE),
        control[p].becomes(kind),
        refers[p, a].becomes(False).over(a),
        controls[p, c].becomes(False).over(c),
    ])  # fmt: skip
    delete = Transition("C-delete", on=internal("delete", p), when=may_delete, then=unlink_deleted)
    select = Transition("C-select", on=internal("select", p, chosen), when=[
        control[p] == CONTROLLING,
        state[p] == IDLE,
        for_all(c)(chosen.has(c) >> (
            (state[c] != NONEXISTENT) & (control[c] == CONTROLLED) & for_all(a)(refers[c, a] >> selected[a])
        )),
        selected_idle,
    ], then=[
        refers[c, a].becomes(False).when(selected[a] & controls[a, c] & ~chosen.has(c)).over(c, a),
        refers[c, a].becomes(a == p).when(chosen.has(c)).over(c, a),
        controls[a, c].becomes(False).when(selected[a]).over(a, c),
        controls[p, c].becomes(chosen.has(c)).over(c),
        selected[a].becomes(a == p).over(a),
    ])  # fmt: skip
    deselect = Transition("C-deselect", on=internal("deselect"), when=[selected_idle], then=[
        *unlink_selected,
        selected[a].becomes(False).over(a),
    ])  # fmt: skip
    start = Transition("C-start", on=internal("start", p), when=[state[p] == IDLE, may_run], then=run)
    stop = Transition("C-stop", on=internal("stop", p), when=[state[p] == RUNNING], then=[
        state[p].becomes(STOPPED),
        motion().becomes(False).when(arm[p]),
    ])  # fmt: skip
    resume = Transition("C-resume", on=internal("resume", p), when=[state[p] == STOPPED, may_run], then=run)
    reset = Transition("C-reset", on=internal("reset", p), when=[state[p] == STOPPED], then=[
        state[p].becomes(IDLE),
    ])  # fmt: skip
    kill = Transition("C-kill", on=internal("kill", p), when=[state[p].isin((IDLE, RUNNING, STOPPED))], then=[
        state[p].becomes(UNRUNNABLE),
        motion().becomes(False).when(arm[p]),
    ])  # fmt: skip
    end = Transition(
        "C-end", on=internal("end", p), when=[state[p] == RUNNING], then=unlink_ended
    )  # fmt: skip

    p1 = Always("C-P1", for_all(a, b, c)((controls[a, c] & controls[b, c]) >> (a == b)))
    p2 = Always("C-P2", for_all(p)(selected[p] >> ((state[p] != NONEXISTENT) & (control[p] == CONTROLLING))))
    p3 = Always("C-P3", for_all(a, c)(controls[a, c] == refers[c, a]))
    p4 = Always("C-P4", for_all(a, c)(controls[a, c] >> (
        (control[a] == CONTROLLING) & (control[c] == CONTROLLED)
        & (state[a] != NONEXISTENT) & (state[c] != NONEXISTENT)
    )))  # fmt: skip
    p5 = Always("C-P5", for_all(a, c)(controls[a, c] >> selected[a]))
    p6 = Always("C-P6", for_all(p)((motion() & arm[p]) >> (state[p] == RUNNING)))
    one_selected = Always("C-selected", for_all(a, b)((selected[a] & selected[b]) >> (a == b)))
    creation_keeps_selection = Step("C-create", service_is("create") >> unchanged(selected))
    controlled_runs = Sometimes("C-start", for_some(a, c)(controls[a, c] & (state[c] == RUNNING)))
    something_moves = Sometimes("C-start", motion())


class Core(CorePart, name="core", variant="as-written", standard="benchmark", scenario=scenario):
    """The benchmark as it is printed."""


class RepairedCore(CorePart, name="core", variant="repaired", standard="benchmark", scenario=scenario):
    """Deletion of the selected program invocation clears the selection."""

    delete = Transition(
        "C-delete", on=internal("delete", p), when=may_delete,
        then=[*unlink_deleted, selected[p].becomes(False)],
        repairs=repaired("RP-core-1", "C-delete", because="the selection would name what does not exist"),
    )  # fmt: skip


class RepairedMotion(
    RepairedCore, name="core", variant="repaired-motion", standard="benchmark", scenario=scenario
):
    """The end of the arm's program also ends the motion."""

    end = Transition(
        "C-end", on=internal("end", p), when=[state[p] == RUNNING],
        then=[*unlink_ended, motion().becomes(False).when(arm[p])],
        repairs=repaired("RP-core-2", "C-end", because="the arm would stay enabled without a program"),
    )  # fmt: skip
