"""The sockets of the server: LISTEN, ACCEPT, RECV, SEND, CLOSE, for any number of clients (sections 2 and 2.1).

Each call is made upon a socket. One that is not connected stops the robot; so does a second LISTEN.
"""

from mmsverify.model import (
    Always,
    Initially,
    Sometimes,
    Step,
    Transition,
    for_all,
    for_some,
    internal,
    repaired,
    service_is,
    unchanged,
)

from .vocabulary import Vocabulary


class Server(Vocabulary):
    """As written: the link is looked at while the server waits for data, and not again before it answers."""

    works = ~stopped()
    listens = Transition(
        "M-2-S1",
        "M-2.1-1",
        on=internal("TCP_LISTEN"),
        when=[works, ~listening()],
        then=[listening().becomes(True)],
    )
    ends_listening = Transition(
        "M-2.1-7", on=internal("TCP_END_LISTEN"), when=[works, listening()], then=[listening().becomes(False)]
    )

    connects = Transition(
        "M-2.1-3",
        "M-2.1-10",
        on=internal("connect", c),
        when=[~linked[c], ~served[c]],
        then=[linked[c].becomes(True)],
    )
    disconnects = Transition(
        "M-2-S4b", on=internal("disconnect", c), when=[linked[c]], then=[linked[c].becomes(False)]
    )

    accepts = Transition(
        "M-2-S2a", "M-2-S2b", "M-2.1-2", "M-2.1-11", on=internal("TCP_ACCEPT", s, c),
        when=[works, listening(), linked[c], ~served[c], for_all(d)(~serves[s, d])], then=[serves[s, c].becomes(True)],
    )  # fmt: skip
    receives = Transition(
        "M-2-S3a", "M-2-S4a", "M-2.1-5", "M-2.2-1", on=internal("TCP_RECV", s, c),
        when=[works, serves[s, c], linked[c], ~heard[c]], then=[heard[c].becomes(True)],
    )  # fmt: skip
    answers = Transition(
        "M-2-S3b", "M-2.1-4", "M-2.1-9", "M-2.2-8", on=internal("TCP_SEND", s, c), when=[works, serves[s, c], heard[c]],
        then=[heard[c].becomes(False), stopped().becomes(~linked[c])],
    )  # fmt: skip
    closes = Transition(
        "M-2-S4b", "M-2.1-6", "M-2.1-13", on=internal("TCP_CLOSE", s, c),
        when=[works, serves[s, c], ~linked[c], ~heard[c]], then=[serves[s, c].becomes(False)],
    )  # fmt: skip

    at_power_on = Initially(
        "M-2-S1",
        ~listening() & works & ~touched() & for_all(c)(~linked[c] & ~heard[c]) & for_all(s, c)(~serves[s, c]),
    )
    never_stopped = Always("M-2.1-8", works, "M-2.1-9", says="no call is ever made that stops the robot")
    no_call_is_abnormal = Step("M-2.1-8", service_is("TCP_LISTEN", "TCP_ACCEPT", "TCP_RECV", "TCP_SEND", "TCP_CLOSE", "TCP_END_LISTEN") >> unchanged(stopped),
                               "M-2.1-9", says="each call is made upon a socket that it can be made upon")  # fmt: skip
    one_socket_each = Always("M-2.1-12", for_all(s, t, c)((serves[s, c] & serves[t, c]) >> (s == t)), "M-2-S2b",
                             says="a client occupies one connection socket")  # fmt: skip
    one_client_each = Always("M-2.1-11", for_all(s, c, d)((serves[s, c] & serves[s, d]) >> (c == d)), "M-2.1-12",
                             says="no socket serves two clients: there are never more connections than sockets")  # fmt: skip
    heard_are_served = Always(
        "M-2-S3a", for_all(c)(heard[c] >> served[c]), says="requests are received on connection sockets only"
    )
    answered_once = Step("M-2-S3b", for_all(c)((heard[c] & ~heard[c].next) >> service_is("TCP_SEND", "TCP_CLOSE")), "M-2.2-8",
                         says="a request waits until it is answered")  # fmt: skip
    several = Sometimes("M-2.1-10", for_some(c, d)(~(c == d) & served[c] & served[d]))


class ServerRepaired(Server):
    """The repaired reading: before it sends, the server looks whether the connection is still there."""

    looks_first = repaired(
        "MR-01", "M-2-S3b", "M-2.1-8", because="a client may leave between its request and the answer"
    )
    answers = Transition(
        "M-2-S3b", "M-2.1-4", "M-2.1-8", "M-2.2-8", "MR-01", on=internal("TCP_SEND", s, c),
        when=[works, serves[s, c], heard[c], linked[c]], then=[heard[c].becomes(False)], repairs=looks_first,
    )  # fmt: skip
    closes = Transition(
        "M-2-S4b", "M-2.1-6", "M-2.1-13", "MR-01", on=internal("TCP_CLOSE", s, c),
        when=[works, serves[s, c], ~linked[c]], then=[serves[s, c].becomes(False), heard[c].becomes(False)], repairs=looks_first,
    )  # fmt: skip
    answers_who_is_there = Step(
        "M-2.1-8", service_is("TCP_SEND") >> for_all(c)((heard[c] & ~heard[c].next) >> linked[c]), "MR-01",
        says="SEND is called for a client that is there", repairs=repaired("MR-01", "M-2.1-8", because="stated for the server that looks first"))  # fmt: skip
