"""Faults of the protocol: agreements of Initiate, invokeIDs, answers, and octets that are no PDU."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from independent import views
from independent.desk import Desk, initiation, named
from independent.fault import add, fault
from independent.objects import ARM
from independent.server import ADDITIONAL, OF_CLIENT, SERVICES, positive, rejected
from independent.situations import running, two
from mmsverify.formats.mms import Pdu, encode
from mmsverify.formats.trace import Sender
from mmsverify.samples import pdus

Octets = Callable[[bytes], bytes]


# Answers and invokeIDs.
@fault("*")
def reused_invoke(d: Desk) -> None:
    first = d.request("status", False)
    d.say("client", replace(first, service="identify", body=None))
    d.tape.wrong()
    d.say("server", d.perform(first).pdu)


@fault("*")
def too_many(d: Desk) -> None:
    asked = [d.request("identify") for _ in range(d.outstanding + 1)]
    d.tape.wrong()
    for one in asked:
        d.say("server", d.perform(one).pdu)


@fault("*")
def other_service(d: Desk) -> None:
    asked = d.request("status", False)
    d.say(
        "server",
        positive(replace(asked, service="identify"), {"vendorName": "A", "modelName": "B", "revision": "1"}),
    )
    d.tape.wrong()


@fault("*")
def other_invoke(d: Desk) -> None:
    asked = d.request("status", False)
    answer = d.perform(asked).pdu
    d.say("server", replace(answer, invoke_id=77))
    d.tape.wrong()
    d.say("server", answer)


@fault("*")
def reused_and_answered_late(d: Desk) -> None:
    first = d.request("status", False)
    second = replace(first, service="identify", body=None)
    d.say("client", second)
    d.tape.wrong()
    d.say("server", d.perform(second).pdu)
    d.say("server", d.perform(first).pdu)


@fault("*")
def answered_twice(d: Desk) -> None:
    asked = d.request("status", False)
    answer = d.perform(asked).pdu
    d.say("server", answer)
    d.say("server", answer)
    d.tape.wrong()


@fault("*")
def unasked_answer(d: Desk) -> None:
    d.status()
    d.say("server", Pdu("confirmed-ResponsePDU", 99, "stop"))
    d.tape.wrong()


@fault("*")
def unasked_error(d: Desk) -> None:
    d.status()
    d.say("server", pdus.failure(98, ("service", "object-state-conflict")))
    d.tape.wrong()


@fault("*")
def client_answers_unasked(d: Desk) -> None:
    d.say(
        "client",
        Pdu(
            "confirmed-ResponsePDU",
            5,
            "downloadSegment",
            {"loadData": ("non-coded", b"X"), "moreFollows": False},
        ),
    )
    d.tape.wrong()


# Agreements.
@fault("R-7.5.*", "B-*", "R-9.2*")
def supported_rejected(d: Desk) -> None:
    asked = d.request("status", False)
    d.say("server", rejected(asked))
    d.tape.wrong()


@fault("R-7.5.*", "B-*", "R-9.2*", "R-7.4.1*")
def select_rejected(d: Desk) -> None:
    asked = d.request("select", {})
    d.say("server", rejected(asked))
    d.tape.wrong()


def again(services: tuple[str, ...], additional: tuple[str, ...]) -> Callable[[Desk], None]:
    """The association is made anew, with fewer services."""

    def come(d: Desk) -> None:
        two(d)
        d.close()
        d.services, d.additional = services, additional
        d.open()
        d.look()

    return come


@fault("R-7.5.*", "B-*", "R-9.2*", "R-7.4.1*", back=1)
def additional_not_agreed(d: Desk) -> None:
    again(SERVICES, ("select",))(d)
    d.does("identify")
    asked = d.request("vMDStop")
    d.say("server", positive(asked))
    d.tape.wrong()


@fault("R-7.5.*", "B-*", "R-9.2*", back=1)
def service_not_agreed(d: Desk) -> None:
    again(tuple(s for s in SERVICES if s != "kill"), ADDITIONAL)(d)
    asked = d.request("kill", named("NONE"))
    d.say("server", positive(asked))
    d.tape.wrong()


@fault("R-7.5.*", "B-*", "R-9.2*", back=1)
def client_not_agreed(d: Desk) -> None:
    d.serve("identify", None, {"vendorName": "A", "modelName": "B", "revision": "1"})
    d.tape.wrong()


def _initiate(change: Callable[[dict[str, Any]], None]) -> Callable[[Desk], None]:
    def run(d: Desk) -> None:
        d.close()
        d.tape.link(d.name, "open")
        d.invoke = 0
        d.say("client", initiation("Request", OF_CLIENT, (), d.outstanding))
        answer = initiation("Response", d.services, d.additional, d.outstanding)
        body = {**answer.body, "initResponseDetail": dict(answer.body["initResponseDetail"])}
        change(body)
        d.say("server", Pdu(answer.kind, body=body))
        d.tape.wrong()

    return run


def _inside(**fields: Any) -> Callable[[dict[str, Any]], None]:
    return lambda body: body["initResponseDetail"].update(fields)


def _outside(**fields: Any) -> Callable[[dict[str, Any]], None]:
    return lambda body: body.update(fields)


for _name, _change, _clauses in (
    ("version_raised", _inside(negotiatedVersionNumber=2), ("R-7.5.2.1-1",)),
    ("version_zero", _inside(negotiatedVersionNumber=0), ("R-7.5.2.1-1",)),
    ("outstanding_raised", _outside(negotiatedMaxServOutstandingCalling=9), ("R-7.5.*", "B-*", "R-9.2*")),
    ("called_raised", _outside(negotiatedMaxServOutstandingCalled=9), ("R-7.5.*", "B-*", "R-9.2*")),
    ("parameter_added", _inside(negotiatedParameterCBB="11110001000"), ("R-7.5.2.2-1", "B-*")),
):
    add(f"initiate_{_name}", _initiate(_change), *_clauses)


@fault("R-9.2.2.4*", "B-*", "*")
def before_initiate(d: Desk) -> None:
    d.close()
    d.tape.link(d.name, "open")
    d.request("status", False)
    d.tape.wrong()
    d.open(link=False)


# Octets.
def tagged(octets: bytes, old: bytes, new: bytes) -> bytes:
    assert old in octets, octets.hex()
    return octets.replace(old, new, 1)


def longer(octets: bytes) -> bytes:
    """An element says that it is longer than its parent."""
    return octets[:3] + bytes([octets[3] + 40]) + octets[4:]


BROKEN: tuple[tuple[str, Octets], ...] = (
    ("cut", lambda octets: octets[:-2]),
    ("trailing", lambda octets: octets + b"\x05\x00\x01"),
    ("empty", lambda _: b""),
    ("no_pdu", lambda octets: b"\xb7" + octets[1:]),
    ("inner_length", longer),
    ("inner_tag", lambda octets: octets[:5] + tagged(octets[5:], b"\x80", b"\x9e")),
    ("no_invoke", lambda octets: bytes([octets[0], octets[1] - 3]) + octets[5:]),
    ("noise", lambda _: bytes(range(17, 40))),
)
for _name, _octets in BROKEN:
    for _side in ("client", "server"):

        def _garbled(d: Desk, side: Sender = _side, change: Octets = _octets) -> None:
            two(d)
            if side == "client":
                d.invoke += 1
                pdu = Pdu("confirmed-RequestPDU", d.invoke, "stop", named("PAINT"))
                octets = change(encode(pdu))
            else:
                pdu = d.perform(d.request("status", False)).pdu
                octets = change(encode(pdu))
            d.say(side, pdu, octets)
            d.tape.wrong()

        add(f"octets_{_name}_{_side}", _garbled, "*")


@fault("*")
def status_without_detail(d: Desk) -> None:
    two(d)
    asked = d.request("status", False)
    d.say("server", positive(asked, pdus.status(0, 0)))
    d.tape.wrong()


@fault("*")
def attributes_without_detail(d: Desk) -> None:
    two(d)
    asked = d.request("getProgramInvocationAttributes", "PAINT")
    body, _ = views.program(d.robot, "PAINT")
    d.say("server", positive(asked, body))
    d.tape.wrong()


@fault("R-9.2.2.4-1", level="any", ends=True)
def ends_by_itself(d: Desk) -> None:
    """The robot concludes because of an emergency stop (9.2.2.4)."""
    running(d)
    d.emergency()
    d.say("server", Pdu("conclude-RequestPDU"))
    d.tape.wrong()


@fault("R-7.4.4.3-2", "R-7.4.4.1.1.2-1")
def list_without_controlling(d: Desk) -> None:
    two(d)
    asked = d.request("select", {"controlled": [ARM]})
    d.tape.wrong()
    d.robot.deselect()
    d.say("server", positive(asked))
