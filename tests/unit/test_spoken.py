"""MMS messages of a recording as flat events: what is asked, what answers it, what cannot be read."""

from __future__ import annotations

from mmsverify.audit.spoken import Listener
from mmsverify.auditing import read_events
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.trace import TraceMessage
from mmsverify.resources import traces_dir

FAULTY = traces_dir() / "faulty-vmd-stop.mcap"
CLIENTS = traces_dir() / "two-clients.mcap"


def test_an_answer_knows_its_request_and_its_programs() -> None:
    events = {event.index: event for event in read_events(FAULTY)}
    answer = events[42]
    asked = events[answer.answers or 0]
    assert (answer.service, answer.answer) == ("getProgramInvocationAttributes", "result(+)")
    assert (asked.sender, asked.programs, asked.invoke_id) == ("client", ("Weld_Roof",), answer.invoke_id)
    assert answer.programs == asked.programs


def test_a_refusal_and_a_selection_are_told() -> None:
    events = list(read_events(CLIENTS))
    assert ("takeControl", "result(-)") in [(e.service, e.answer) for e in events]
    assert ("Weld_Door", "R_ARM") in [e.programs for e in events if e.service == "select"]


def test_octets_that_are_no_pdu_say_why() -> None:
    message = next(m for m in read_trace(FAULTY) if m.message_encoding == "mms-ber")
    (event,) = Listener().events([TraceMessage(0, 1, message.channel, b"\x30\x00")])
    assert event.fault
    assert event.kind == ""
