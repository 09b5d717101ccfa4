"""Associations and the semaphore R_CTRL (5.1.3, 8.6.1, 9.2.2)."""

from mmsverify.model import (
    BOOL,
    PLUS,
    Always,
    Initially,
    Observation,
    Procedure,
    Sometimes,
    Step,
    Transition,
    accept,
    answered,
    do,
    for_all,
    for_some,
    internal,
    needs,
    parameter,
    refuse,
    repaired,
    response,
    service_is,
    shown,
    unchanged,
)

from .vocabulary import Vocabulary


class Associations(Vocabulary):
    """As written."""

    other_holds = for_some(u)(holder[u] & (u != user))

    # Nothing is agreed about how ownership ends.
    plainly = [limited[user].becomes(False), keeps[user].becomes(False)]

    initiate = Procedure(
        "R-9.2.2.1",
        on=response("initiate", user),
        steps=[
            refuse("2", when=single_association() & for_some(u)(associated[u]), rule="initiate.second-association",
                   says="the base class supports one association at a time", level="warning"),
            do("3", associated[user].becomes(True), holder[user].becomes(True).when(single_association()), *plainly),
            accept("3"),
        ],
    )  # fmt: skip

    release = Transition(
        "R-9.2.2.4-2", "R-9.2.2.4-3",
        on=response("release", user),
        then=[associated[user].becomes(False), *plainly, *end_transfers],
    )  # fmt: skip

    take_control = Procedure(
        "R-8.6.1",
        on=response("takeControl", request, user, times_out, stays, preempts),
        steps=[
            refuse("R-9.2.2.1-3", "B-ASSOCIATION", unless=associated[user], rule="take-control.no-association", says="{user} has no association"),
            refuse("2", "R-5.1.3-2", "R-8.6.1-4", "B-SEMAPHORE", when=other_holds, rule="take-control.taken", says="another client holds R_CTRL"),
            refuse("R-8.6.1-3", "B-SEMAPHORE", when=hung() & ~preempts, rule="take-control.hung", says="the token of R_CTRL hangs, and nobody takes it over"),
            do("3", holder[user].becomes(True), limited[user].becomes(times_out & ~single_association()),
               keeps[user].becomes(stays & ~single_association()), hung().becomes(False), cites=["R-5.3.1.4-4"]),
            accept("3"),
        ],
    )  # fmt: skip

    relinquish_control = Procedure(
        "R-8.6.1",
        on=response("relinquishControl", request, user),
        steps=[
            refuse("3", "R-5.1.3-2", "B-SEMAPHORE", unless=holder[user], rule="relinquish-control.not-held", says="{user} does not hold R_CTRL"),
            do("2", holder[user].becomes(False), *plainly),
            accept("2"),
        ],
    )  # fmt: skip

    left_hanging = parameter("left_hanging", BOOL)
    ownership_times_out = Transition(
        "R-8.6.1-3", "B-SEMAPHORE",
        on=internal("ownership_times_out", user, left_hanging),
        when=[holder[user], limited[user]],
        then=[holder[user].becomes(False), *plainly, hung().becomes(left_hanging)],
    )  # fmt: skip

    # What messages show of R_CTRL.
    shown_owned = parameter("shown_owned", BOOL)
    shown_hung = parameter("shown_hung", BOOL)
    owned_tokens = Observation(
        "R-8.6.1-3", "B-SEMAPHORE",
        on=shown("ownedTokens", shown_owned),
        shows=[needs("R-8.6.1-3", "R-9.2.2.1-3", "B-SEMAPHORE", rule="semaphore.owned", that=for_some(u)(holder[u]) == shown_owned,
                     says="R_CTRL cannot be owned so")],
    )  # fmt: skip
    hung_tokens = Observation(
        "R-8.6.1-3", "B-SEMAPHORE",
        on=shown("hungTokens", shown_hung),
        shows=[needs("R-8.6.1-3", "B-SEMAPHORE", rule="semaphore.hung", that=hung() == shown_hung, says="the token of R_CTRL cannot hang so")],
    )  # fmt: skip

    # Claims.
    nothing_hangs_at_power_on = Initially("R-9.2.2.1-3", for_all(u)(~hung() & ~limited[u] & ~keeps[u]))
    hanging_is_unowned = Always("R-8.6.1-2", for_all(u)(hung() >> ~holder[u]), "B-SEMAPHORE",
                                says="a token that hangs is not owned as well")  # fmt: skip
    one_of_several_holds = Always("R-8.6.1-2", for_all(u, v)((~single_association() & holder[u] & holder[v]) >> (u == v)), "R-9.2.2.1-5",
                                  says="of several associated clients one holds R_CTRL at most")  # fmt: skip
    base_class_keeps_control = Always("R-9.2.2.1-3", for_all(u)(single_association() >> (~hung() & ~limited[u] & ~keeps[u])), "R-9.2.2.1-4",
                                      says="in the base class nothing ends ownership but the end of the association")  # fmt: skip
    base_class_gives_control = Step("R-9.2.2.1-3", (service_is("initiate") & answered(PLUS) & single_association()) >> holder[user].next,
                                    says="in the base class the association brings R_CTRL with it")  # fmt: skip
    others_must_take_control = Step("R-9.2.2.1-5", (service_is("initiate") & ~single_association()) >> unchanged(holder),
                                    says="with several associations none of them brings R_CTRL with it")  # fmt: skip
    nobody_loses_control_unasked = Step(
        "R-5.1.3-2", ~service_is("relinquishControl", "release", "ownership_times_out") >> for_all(u)(holder[u] >> holder[u].next), "R-5.3.1.2-1",
        says="who holds R_CTRL keeps it until it gives it back, goes away or its time is over")  # fmt: skip
    control_passes_on = Sometimes(
        "R-5.1.3-2",
        service_is("takeControl") & for_some(v)(holder[v].next & ~holder[v] & associated[v]),
        "R-8.6.1-4",
    )
    several_are_associated = Sometimes("R-5.1.3-1", for_some(u, v)(associated[u] & associated[v] & (u != v)),
                                       provided=~single_association())  # fmt: skip


class AssociationsRepaired(Associations):
    """The repaired reading: the token goes back when its owner's association ends (RP-16)."""

    release = Transition(
        "R-9.2.2.4-2", "R-9.2.2.4-3", "RP-16",
        on=response("release", user),
        then=[associated[user].becomes(False), hung().becomes(True).when(holder[user] & keeps[user]), holder[user].becomes(False),
              *plainly, *end_transfers],
        repairs=repaired("RP-16", "R-8.6.1-3", because="a token that nobody can give back would lock every client out"),
    )  # fmt: skip
    released_control_is_free = Step("R-8.6.1-3", service_is("release") >> ~holder[user].next, "RP-16",
                                    says="who has gone away does not hold R_CTRL",
                                    repairs=repaired("RP-16", "R-8.6.1-3", because="stated for the token that goes back"))  # fmt: skip
