"""What each call upon a socket is for, stated from the list of calls and not from the rows (section 2.1)."""

from mmsverify.model import Sometimes, Step, for_all, for_some, service_is, unchanged

from .vocabulary import Vocabulary

CALLS = ["TCP_LISTEN", "TCP_ACCEPT", "TCP_RECV", "TCP_SEND", "TCP_CLOSE", "TCP_END_LISTEN"]


class Calls(Vocabulary):
    """The same in both readings."""

    accepted = serves[s, c].next & ~serves[s, c]
    freed = serves[s, c] & ~serves[s, c].next
    received = heard[c].next & ~heard[c]
    answered_now = heard[c] & ~heard[c].next
    comes, leaves = linked[c].next & ~linked[c], linked[c] & ~linked[c].next

    nothing_after_a_stop = Step(
        "M-2.1-9", stopped() >> ~service_is(*CALLS), says="a robot that has stopped calls nothing"
    )
    listen_listens = Step("M-2.1-1", service_is("TCP_LISTEN") >> (listening().next & ~listening()), "M-2-S1",
                          says="LISTEN makes a socket that waits for connections, where there is none")  # fmt: skip
    end_listen_ends = Step(
        "M-2.1-7",
        service_is("TCP_END_LISTEN") >> (listening() & ~listening().next),
        says="END_LISTEN ends the waiting",
    )
    listening_stays = Step("M-2-S1", ~service_is("TCP_LISTEN", "TCP_END_LISTEN") >> unchanged(listening),
                           says="the socket for connections stays while connections come and go")  # fmt: skip
    accept_connects = Step("M-2.1-2", service_is("TCP_ACCEPT") >> for_some(s, c)(accepted & linked[c] & listening()), "M-2-S2b",
                           says="ACCEPT makes the connection socket of a client that asks for it")  # fmt: skip
    only_accept_connects = Step(
        "M-2-S2a",
        for_all(s, c)(accepted >> service_is("TCP_ACCEPT")),
        says="connection sockets are made by ACCEPT",
    )
    recv_receives = Step("M-2.1-5", service_is("TCP_RECV") >> for_some(c)(received & linked[c]), "M-2-S3a",
                         says="RECV takes a request of a client that is there")  # fmt: skip
    only_recv_receives = Step(
        "M-2.2-1", for_all(c)(received >> service_is("TCP_RECV")), says="requests come by RECV"
    )
    send_answers = Step(
        "M-2.1-4",
        service_is("TCP_SEND") >> for_some(c)(answered_now),
        "M-2-S3b",
        says="SEND answers a request",
    )
    close_frees = Step(
        "M-2.1-6",
        service_is("TCP_CLOSE") >> for_some(s, c)(freed),
        "M-2.1-13",
        says="CLOSE frees a connection socket",
    )
    freed_when_left = Step("M-2-S4b", for_all(s, c)(freed >> (service_is("TCP_CLOSE") & ~linked[c])), "M-2.1-13",
                           says="a connection socket is freed by CLOSE, when its client has left")  # fmt: skip
    upon_its_own_socket = Step("M-2.1-12", service_is("TCP_RECV", "TCP_SEND", "TCP_CLOSE") >> serves[s, c], "M-2.1-8",
                               says="RECV, SEND and CLOSE are called upon the connection socket of their client")  # fmt: skip
    comes_again_when_freed = Step("M-2.1-13", for_all(c)(comes >> ~served[c]),
                                  says="a client comes again only once its socket has been closed")  # fmt: skip
    connect_comes = Step("M-2.1-3", service_is("connect") >> for_some(c)(comes), says="a client connects")
    disconnect_leaves = Step(
        "M-2-S4b", service_is("disconnect") >> for_some(c)(leaves), says="a client leaves"
    )
    clients_go_by_themselves = Step("M-2.1-10", ~service_is("connect", "disconnect") >> for_all(c)(linked[c].next == linked[c]),
                                    says="the server ends no client's side of a connection")  # fmt: skip

    waiting_ends = Sometimes("M-2.1-7", listening() & ~listening().next)
    requests_come = Sometimes("M-2-S3a", for_some(c)(received))
    answers_go = Sometimes("M-2-S3b", for_some(c)(answered_now & linked[c]))
    sockets_are_freed = Sometimes("M-2.1-13", for_some(s, c)(freed))
