"""Captures to traces: names, senders, link events, counts, and what could not be read."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path

import pytest
from capture_wire import (
    ACK,
    CONCLUDE,
    CONCLUDED,
    CR,
    INITIATE,
    INITIATED,
    RST,
    STATUS,
    STATUS_ANSWER,
    SYN,
    Talk,
    accept,
    captured,
    connect,
    dt,
    ethernet,
    mms,
    pcap,
)

from mmsverify.errors import InputError
from mmsverify.formats.capture import ImportedInput, Ports, import_captures
from mmsverify.formats.mcap import TraceWriter, read_trace

Row = tuple[str, bytes | str]
ADU = bytes.fromhex("000100000006ff0408d20002")


def imported(
    tmp_path: Path, *contents: bytes, ports: Ports | None = None, hosts: Mapping[str, str] | None = None
) -> tuple[list[ImportedInput], list[Row]]:
    """Import captures; give the result and the trace: topic and message (of link events the names)."""
    paths = [tmp_path / f"{number}.pcap" for number in range(len(contents))]
    for path, content in zip(paths, contents, strict=True):
        path.write_bytes(content)
    trace = tmp_path / "out.mcap"
    with TraceWriter(trace) as writer:
        inputs = import_captures(paths, writer, ports=ports, hosts=hosts)
    rows: list[Row] = []
    for message in read_trace(trace):
        if message.schema_name == "link.Event":
            event = json.loads(message.data)
            rows.append((message.topic, f"{event['connection']} {event['event']} {event['role']}"))
        else:
            rows.append((message.topic, message.data))
    return inputs, rows


def whole() -> Talk:
    talk = Talk().associate()
    talk.say(("client", dt(mms(STATUS))), ("server", dt(mms(STATUS_ANSWER))))
    return talk.say(("client", dt(mms(CONCLUDE))), ("server", dt(mms(CONCLUDED)))).close()


ASKS, ANSWERS, LINK = "/10.0.0.5/mms/a1/client", "/10.0.0.5/mms/a1/server", "/10.0.0.5/link"


def test_one_association_gives_its_pdus_between_open_and_close(tmp_path: Path) -> None:
    inputs, rows = imported(tmp_path, captured(whole()))
    assert rows == [
        (LINK, "a1 open mms"),
        (ASKS, INITIATE),
        (ANSWERS, INITIATED),
        (ASKS, STATUS),
        (ANSWERS, STATUS_ANSWER),
        (ASKS, CONCLUDE),
        (ANSWERS, CONCLUDED),
        (LINK, "a1 close mms"),
    ]
    assert asdict(inputs[0]) == {
        "path": str(tmp_path / "0.pcap"),
        "frames": 14,
        "pdus": {"mms": 6, "modbus": 0, "vr": 0},
        "undecoded": [],
        "remarks": (),
    }


def test_the_same_capture_gives_the_same_octets(tmp_path: Path) -> None:
    path = tmp_path / "c.pcap"
    path.write_bytes(captured(whole()))
    traces = [io.BytesIO(), io.BytesIO()]
    for trace in traces:
        with TraceWriter(trace) as writer:
            import_captures([path], writer)
    assert traces[0].getvalue() == traces[1].getvalue()


def test_messages_carry_the_time_of_the_packet_that_completes_them(tmp_path: Path) -> None:
    octets = dt(mms(STATUS))
    talk = Talk().associate().say(("client", octets[:9]), ("server", dt(mms(STATUS))), ("client", octets[9:]))
    path = tmp_path / "c.pcap"
    path.write_bytes(captured(talk))
    with TraceWriter(tmp_path / "t.mcap") as writer:
        import_captures([path], writer)
    times = [(message.metadata.get("sender"), message.time) for message in read_trace(tmp_path / "t.mcap")]
    start = 1_700_000_000_000_000_000
    assert times[-2:] == [("server", start + 8_000_000), ("client", start + 9_000_000)]


def test_captures_in_one_trace_keep_distinct_associations(tmp_path: Path) -> None:
    inputs, rows = imported(tmp_path, captured(whole()), captured(whole()))
    assert [entry.pdus["mms"] for entry in inputs] == [6, 6]
    assert {topic for topic, _ in rows} == {
        LINK,
        ASKS,
        ANSWERS,
        *(t.replace("a1", "a2") for t in (ASKS, ANSWERS)),
    }


def test_associations_are_named_in_order_and_kept_apart(tmp_path: Path) -> None:
    one, two = Talk().associate(), Talk(client=("10.0.0.9", 40001)).associate()
    mixed = [packet for pair in zip(one.packets, two.packets, strict=True) for packet in pair]
    _, rows = imported(tmp_path, pcap(ethernet(packet) for packet in mixed))
    assert [row for row in rows if row[1] == INITIATED] == [
        (ANSWERS, INITIATED),
        (ANSWERS.replace("a1", "a2"), INITIATED),
    ]


def test_addresses_can_have_names(tmp_path: Path) -> None:
    _, rows = imported(tmp_path, captured(whole()), hosts={"10.0.0.5": "cell7"})
    assert {topic.split("/")[1] for topic, _ in rows} == {"cell7"}


def test_ip_version_6_is_read(tmp_path: Path) -> None:
    talk = Talk(client=("fd00::9", 40000), server=("fd00::5", 102)).associate()
    assert ("/fd00::5/mms/a1/server", INITIATED) in imported(tmp_path, captured(talk))[1]


@pytest.mark.parametrize("ports", [None, Ports(mms=frozenset({10102}))])
def test_mms_on_another_port_is_found_by_content_or_by_option(tmp_path: Path, ports: Ports | None) -> None:
    talk = Talk(server=("10.0.0.5", 10102)).associate().close()
    _, rows = imported(tmp_path, captured(talk), ports=ports)
    assert rows == [
        ("/10.0.0.5:10102/link", "a1 open mms"),
        ("/10.0.0.5:10102/mms/a1/client", INITIATE),
        ("/10.0.0.5:10102/mms/a1/server", INITIATED),
        ("/10.0.0.5:10102/link", "a1 close mms"),
    ]


def test_other_protocols_on_other_ports_are_nobodys(tmp_path: Path) -> None:
    web = Talk(server=("10.0.0.5", 80)).shake().say(("client", b"GET / HTTP/1.1\r\n\r\n")).close()
    desktop = (
        Talk(server=("10.0.0.5", 3389))
        .shake()
        .say(("client", bytes.fromhex("0300000b06e00000000000")))
        .close()
    )
    inputs, rows = imported(tmp_path, captured(web, desktop))
    assert rows == []
    assert inputs[0].undecoded == []


@pytest.mark.parametrize("port", [102, 10102])
def test_a_recording_from_the_middle_is_read_without_open(tmp_path: Path, port: int) -> None:
    talk = Talk(server=("10.0.0.5", port)).say(
        ("server", dt(mms(STATUS_ANSWER))), ("client", dt(mms(STATUS)))
    )
    inputs, rows = imported(tmp_path, captured(talk))
    assert [(topic.split("/")[-1], data) for topic, data in rows] == [
        ("server", STATUS_ANSWER),
        ("client", STATUS),
    ]
    assert inputs[0].undecoded == []


def test_without_a_handshake_the_connection_request_tells_the_client(tmp_path: Path) -> None:
    talk = Talk(client=("10.0.0.9", 2000), server=("10.0.0.5", 10102))
    talk.say(("client", CR), ("client", dt(connect())), ("server", dt(accept())))
    assert ("/10.0.0.5:10102/mms/a1/client", INITIATE) in imported(tmp_path, captured(talk))[1]


def test_a_lost_segment_is_a_gap_and_the_rest_is_read(tmp_path: Path) -> None:
    talk = Talk().associate()
    talk.say(("client", dt(mms(STATUS))), ("client", dt(mms(CONCLUDE)))).close()
    del talk.packets[7]
    inputs, rows = imported(tmp_path, captured(talk))
    assert rows[3:] == [(LINK, "a1 gap mms"), (ASKS, CONCLUDE), (LINK, "a1 close mms")]
    assert inputs[0].pdus["mms"] == 3


def test_reordered_and_repeated_segments_do_no_harm(tmp_path: Path) -> None:
    talk = whole()
    talk.packets[5], talk.packets[6] = talk.packets[6], talk.packets[5]
    talk.packets.insert(8, talk.packets[7])
    talk.packets[3:3] = talk.packets[:3]
    inputs, rows = imported(tmp_path, captured(talk))
    assert [data for topic, data in rows if topic == ASKS] == [INITIATE, STATUS, CONCLUDE]
    assert [data for topic, data in rows if topic == ANSWERS] == [INITIATED, STATUS_ANSWER, CONCLUDED]
    assert inputs[0].undecoded == []


def test_a_reset_connection_says_so(tmp_path: Path) -> None:
    talk = Talk().associate()
    talk.packet("server", flags=RST | ACK)
    assert imported(tmp_path, captured(talk))[1][-1] == (LINK, "a1 reset mms")


def test_a_refused_connection_leaves_no_trace(tmp_path: Path) -> None:
    talk = Talk()
    talk.packet("client", flags=SYN)
    talk.packet("server", flags=RST | ACK)
    assert imported(tmp_path, captured(talk))[1] == []


def test_what_cannot_be_read_is_counted_by_packet_and_becomes_a_gap(tmp_path: Path) -> None:
    talk = (
        Talk()
        .associate()
        .say(("client", dt(b"\x32\x01")), ("client", dt(b"\x32\x02")), ("client", dt(mms(STATUS))))
    )
    inputs, rows = imported(tmp_path, captured(talk))
    assert [(entry.packet, entry.layer) for entry in inputs[0].undecoded] == [(8, "session"), (9, "session")]
    assert "S7" in inputs[0].undecoded[0].reason
    assert rows[3:] == [(LINK, "a1 gap mms"), (ASKS, STATUS)]


def test_an_oddity_that_costs_nothing_is_counted_and_is_no_gap(tmp_path: Path) -> None:
    octets = accept()
    odd = octets[:1] + bytes([octets[1] + 1]) + octets[2:]
    talk = Talk().shake().say(("client", CR), ("client", dt(connect())), ("server", dt(odd)))
    inputs, rows = imported(tmp_path, captured(talk))
    assert [(entry.packet, entry.layer) for entry in inputs[0].undecoded] == [(6, "session")]
    assert rows[1:] == [(ASKS, INITIATE), (ANSWERS, INITIATED)]


def test_half_a_message_at_the_end_is_told_where_it_began(tmp_path: Path) -> None:
    talk = Talk().associate().say(("client", dt(mms(STATUS))[:11])).close()
    inputs, rows = imported(tmp_path, captured(talk))
    assert [(entry.packet, entry.layer) for entry in inputs[0].undecoded] == [(8, "tpkt")]
    assert rows[-2:] == [(LINK, "a1 gap mms"), (LINK, "a1 close mms")]


def test_a_snapped_packet_is_counted_and_is_a_gap(tmp_path: Path) -> None:
    talk = Talk().associate().say(("client", dt(mms(STATUS))), ("client", dt(mms(CONCLUDE)))).close()
    talk.packets[7] = talk.packets[7][:-4]
    inputs, rows = imported(tmp_path, captured(talk))
    assert [(entry.packet, entry.layer) for entry in inputs[0].undecoded] == [(8, "tcp")]
    assert rows[3:] == [(LINK, "a1 gap mms"), (ASKS, CONCLUDE), (LINK, "a1 close mms")]


def test_modbus_is_read_and_what_is_no_modbus_is_counted(tmp_path: Path) -> None:
    talk = Talk(server=("10.0.0.5", 502)).shake()
    talk.say(("client", ADU * 2), ("server", ADU), ("client", b"GET / HTTP/1.1")).close()
    inputs, rows = imported(tmp_path, captured(talk))
    asks = "/10.0.0.5/modbus/c1/client"
    assert rows == [
        (LINK, "c1 open modbus"),
        (asks, ADU),
        (asks, ADU),
        ("/10.0.0.5/modbus/c1/server", ADU),
        (LINK, "c1 gap modbus"),
        (LINK, "c1 close modbus"),
    ]
    assert inputs[0].pdus == {"mms": 0, "modbus": 3, "vr": 0}
    assert [(entry.packet, entry.layer) for entry in inputs[0].undecoded] == [(6, "modbus")]


def test_an_unreadable_capture_beside_a_good_one_is_reported(tmp_path: Path) -> None:
    inputs, rows = imported(tmp_path, b"no capture", captured(whole()))
    assert [(entry.frames, entry.pdus["mms"]) for entry in inputs] == [(0, 0), (14, 6)]
    assert [(entry.packet, entry.layer) for entry in inputs[0].undecoded] == [(0, "file")]
    assert len(rows) == 8


def test_nothing_readable_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"0\.pcap: neither pcap nor pcapng"):
        imported(tmp_path, b"no capture")
    with pytest.raises(InputError, match="link type 147"):
        imported(tmp_path, pcap([b"x"], link=147))


def test_a_capture_that_breaks_off_is_read_to_the_break(tmp_path: Path) -> None:
    inputs, _ = imported(tmp_path, captured(whole())[:-5])
    assert (inputs[0].frames, inputs[0].pdus["mms"]) == (13, 6)
    assert [(entry.packet, entry.layer) for entry in inputs[0].undecoded] == [(14, "file")]


@pytest.mark.parametrize(
    ("first", "found"),
    [
        ("000100000006ff0408d20002", True),  # a request
        ("0001000000060104020001ff", False),  # its counts disagree
        ("000100000007010404000100ff", True),  # an answer, where the capture begins late
        ("000100000006ff0408d2007e", False),  # 126 registers
        ("000100000006ff0408d20002ff", False),  # an octet too many
        ("000100010006ff0408d20002", False),  # another protocol
        ("000100000006ff4108d20002", False),  # another function code
    ],
)
def test_modbus_is_found_on_any_port_by_its_first_octets(first: str, found: bool, tmp_path: Path) -> None:
    talk = Talk(server=("10.0.0.5", 1502)).shake()
    talk.say(("client", bytes.fromhex(first)), ("server", b"hello"))
    inputs, rows = imported(tmp_path, captured(talk.close()))
    assert inputs[0].pdus["modbus"] == found
    assert len(inputs[0].undecoded) == found
    assert ("/10.0.0.5:1502/link", "c1 open modbus") in rows if found else rows == []


ASK, ANSWER = bytes.fromhex("000000000006010300000002"), bytes.fromhex("00000000000701030400010002")


@pytest.mark.parametrize("shaken", [True, False])
@pytest.mark.parametrize(
    "turns",
    [
        [("client", ASK * 2), ("server", ANSWER * 2)],
        [("client", ASK[:7]), ("client", ASK[7:]), ("server", ANSWER)],
        [("server", ANSWER), ("client", ASK), ("server", ANSWER)],
        [("server", bytes.fromhex("000000000006011000000002")), ("client", ASK), ("server", ANSWER)],
        [("server", bytes.fromhex("000000000003018302")), ("client", ASK), ("server", ANSWER)],
        [("client", bytes.fromhex("000000000005012b0e0100")), ("server", b"?"), ("client", ASK)],
    ],
)
def test_modbus_is_found_wherever_a_capture_begins(
    turns: list[tuple[str, bytes]], shaken: bool, tmp_path: Path
) -> None:
    talk = Talk(client=("10.0.0.9", 40000), server=("10.0.0.5", 50200))
    talk = talk.shake() if shaken else talk
    inputs, rows = imported(tmp_path, captured(talk.say(*turns)))
    sides = {topic for topic, _ in rows}
    said = b"".join(data for topic, data in rows if isinstance(data, bytes) and topic.endswith("client"))
    asked = b"".join(data for side, data in turns if side == "client")
    assert sides - {"/10.0.0.5:50200/link"} <= {
        f"/10.0.0.5:50200/modbus/c1/{s}" for s in ("client", "server")
    }
    assert said == asked
    assert inputs[0].pdus["modbus"] + len(inputs[0].undecoded) >= len(turns) - 1
