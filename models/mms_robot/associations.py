"""Associations and the semaphore R_CTRL (5.1.3, 8.6.1, 9.2.2)."""

from mmsverify.model import Procedure, Transition, accept, do, for_some, refuse, repaired, response

from .vocabulary import Vocabulary


class Associations(Vocabulary):
    """As written."""

    other_holds = for_some(u)(holder[u] & (u != user))

    initiate = Procedure(
        "R-9.2.2.1",
        on=response("initiate", user),
        steps=[
            refuse("2", when=single_association() & for_some(u)(associated[u]), rule="initiate.second-association",
                   says="the base class supports one association at a time", level="warning"),
            do("3", associated[user].becomes(True), holder[user].becomes(True).when(single_association())),
            accept("3"),
        ],
    )  # fmt: skip

    release = Transition(
        "R-9.2.2.4-2", "R-9.2.2.4-3",
        on=response("release", user),
        then=[associated[user].becomes(False), *end_transfers],
    )  # fmt: skip

    take_control = Procedure(
        "R-8.6.1",
        on=response("takeControl", request, user),
        steps=[
            refuse("R-9.2.2.1-3", "B-ASSOCIATION", unless=associated[user], rule="take-control.no-association", says="{user} has no association"),
            refuse("2", "R-5.1.3-2", "R-8.6.1-4", "B-SEMAPHORE", when=other_holds, rule="take-control.taken", says="another client holds R_CTRL"),
            do("3", holder[user].becomes(True), cites=["R-5.3.1.4-4"]),
            accept("3"),
        ],
    )  # fmt: skip

    relinquish_control = Procedure(
        "R-8.6.1",
        on=response("relinquishControl", request, user),
        steps=[
            refuse("3", "R-5.1.3-2", "B-SEMAPHORE", unless=holder[user], rule="relinquish-control.not-held", says="{user} does not hold R_CTRL"),
            do("2", holder[user].becomes(False)),
            accept("2"),
        ],
    )  # fmt: skip


class AssociationsRepaired(Associations):
    """The repaired reading: the token goes back when its owner's association ends (RP-16)."""

    release = Transition(
        "R-9.2.2.4-2", "R-9.2.2.4-3", "RP-16",
        on=response("release", user),
        then=[associated[user].becomes(False), holder[user].becomes(False), *end_transfers],
        repairs=repaired("RP-16", "R-8.6.1-3", because="a token that nobody can give back would lock every client out"),
    )  # fmt: skip
