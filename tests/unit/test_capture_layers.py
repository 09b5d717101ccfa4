"""TPKT to ACSE: MMS PDUs come out whole and in order; what cannot be read is told, and reading goes on."""

from __future__ import annotations

from itertools import pairwise

import pytest
from capture_wire import (
    BER,
    CC,
    CONCLUDE,
    CR,
    INITIATE,
    INITIATED,
    STATUS,
    STATUS_ANSWER,
    accept,
    connect,
    dt,
    li,
    mms,
    pdvs,
    tpkt,
)
from hypothesis import given, settings
from hypothesis import strategies as st

from mmsverify.formats.ber import element
from mmsverify.formats.capture.association import Association
from mmsverify.formats.capture.faults import Fault
from mmsverify.formats.capture.modbus import ModbusConnection
from mmsverify.formats.trace import Sender

FINISH = bytes.fromhex("0910c10e610c300a020101a00562038001" + "00")
DISCONNECT = bytes.fromhex("0a0dc10b61093007020101a0026300")
ABORT = bytes.fromhex("191511010bc110a00e610c300a020101a0056403800100")
ABORT_UNTAGGED = bytes.fromhex("191511010bc110a00ea00c300a020101a0056403800100")


def read(*turns: tuple[Sender, bytes], aligned: bool = True) -> list[bytes | Fault]:
    association = Association(aligned=aligned)
    return [item for sender, data in turns for item in association.feed(sender, data)]


def layers(found: list[bytes | Fault]) -> list[bytes | str]:
    """PDUs as they are, faults as the names of their layers."""
    return [item.layer if isinstance(item, Fault) else item for item in found]


def alone(tsdu: bytes) -> list[bytes | str]:
    return layers(read(("client", dt(tsdu))))


def begun(
    *turns: tuple[Sender, bytes], contexts: tuple[int, int] = (1, 3), results: str = "00"
) -> list[bytes | str]:
    """What comes after an association was made."""
    start: list[tuple[Sender, bytes]] = [
        ("client", CR + dt(connect(contexts))),
        ("server", CC + dt(accept(contexts, results))),
    ]
    found = layers(read(*start, *turns))
    assert found[:2] == [INITIATE, INITIATED]
    return found[2:]


def test_initiate_comes_out_of_the_association_and_requests_out_of_the_data_phase() -> None:
    assert begun(("client", dt(mms(STATUS))), ("server", dt(mms(STATUS_ANSWER)))) == [STATUS, STATUS_ANSWER]


def test_contexts_are_taken_from_the_negotiation() -> None:
    found = begun(("client", dt(mms(STATUS, 7)) + dt(mms(STATUS, 3))), contexts=(5, 7))
    assert found == [STATUS, "presentation"]


def test_a_context_that_was_refused_carries_nothing() -> None:
    association = [
        ("client", dt(connect())),
        ("server", dt(accept(results="02"))),
        ("client", dt(mms(STATUS))),
    ]
    assert layers(read(*association)) == [INITIATE, "presentation", "presentation"]  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "spdu", [FINISH, DISCONNECT, ABORT, ABORT_UNTAGGED, b"\x0a\x02\xc1\x00", b"\x19\x03\x11\x01\x02"]
)
def test_release_and_abort_carry_no_pdu_and_are_no_fault(spdu: bytes) -> None:
    assert begun(("client", dt(mms(CONCLUDE)) + dt(spdu))) == [CONCLUDE]


@pytest.mark.parametrize("size", [1, 2, 7, 125, 8189])
def test_a_tsdu_in_tpdus_of_any_size_is_joined(size: int) -> None:
    large = element(0xA0, b"\x02\x01\x01\x80\x02" + bytes(2) + element(0x04, bytes(range(256)) * 4))
    assert begun(("client", dt(mms(large), size) + dt(mms(STATUS), size))) == [large, STATUS]


@settings(max_examples=60, deadline=None)
@given(st.lists(st.integers(0, 260), max_size=12))
def test_it_does_not_matter_where_tcp_cuts(cuts: list[int]) -> None:
    stream = CR + dt(connect(), 40) + dt(mms(STATUS), 5) + dt(mms(CONCLUDE))
    places = [0, *sorted(cut for cut in cuts if cut < len(stream)), len(stream)]
    turns: list[tuple[Sender, bytes]] = [("client", stream[a:b]) for a, b in pairwise(places)]
    assert read(*turns) == [INITIATE, STATUS, CONCLUDE]


def test_mms_directly_on_transport_is_read() -> None:
    assert alone(INITIATE) == [INITIATE]


def test_without_the_beginning_values_are_taken_for_what_they_say() -> None:
    stream = dt(mms(STATUS, 9)) + dt(FINISH)
    assert read(("client", stream), aligned=False) == [STATUS]


def test_a_stream_that_starts_inside_a_tpkt_is_read_from_the_next_one() -> None:
    stream = dt(mms(STATUS))[9:] + dt(mms(CONCLUDE))
    assert layers(read(("client", stream), aligned=False)) == ["tpkt", CONCLUDE]


def test_after_a_hole_the_next_tpkt_is_found_and_half_a_tsdu_is_forgotten() -> None:
    association = Association(aligned=True)
    assert not list(association.feed("client", dt(mms(STATUS), 10)[:40]))
    association.lose("client")
    found = list(association.feed("client", dt(mms(STATUS), 10)[-5:] + dt(mms(CONCLUDE))))
    assert layers(found) == ["tpkt", CONCLUDE]


def test_the_other_side_is_not_touched_by_a_hole() -> None:
    association = Association(aligned=True)
    first, rest = dt(mms(STATUS_ANSWER))[:9], dt(mms(STATUS_ANSWER))[9:]
    assert not list(association.feed("server", first))
    association.lose("client")
    assert list(association.feed("server", rest)) == [STATUS_ANSWER]


def test_several_values_in_one_tsdu_are_several_pdus() -> None:
    value = element(0x30, b"\x02\x01\x03" + element(0xA0, STATUS))
    assert alone(b"\x01\x00\x01\x00" + element(0x61, value * 3)) == [STATUS] * 3


def test_values_come_as_single_type_octet_aligned_or_arbitrary() -> None:
    forms = [element(0xA0, STATUS), element(0x81, STATUS), element(0x82, b"\0" + STATUS)]
    values = b"".join(element(0x30, BER + b"\x02\x01\x03" + form) for form in forms)
    assert alone(b"\x01\x00\x01\x00" + element(0x61, values)) == [STATUS] * 3


def test_long_length_indicators_are_read() -> None:
    large = element(0xA8, bytes(4) + element(0x04, bytes(400)))
    assert read(("client", dt(connect(pdu=large)))) == [large]


def test_an_accept_that_claims_too_much_is_told_and_read_all_the_same() -> None:
    octets = accept()
    found = read(("server", dt(octets[:1] + bytes([octets[1] + 1]) + octets[2:])))
    assert layers(found) == ["session", INITIATED]
    assert isinstance(found[0], Fault)
    assert not found[0].lost


def test_user_data_behind_an_empty_parameter_are_told_and_read() -> None:
    octets = accept()
    at = octets.index(b"\xc1") + 1
    found = read(("server", dt(octets[:at] + b"\x00" + octets[at + 1 :])))
    assert layers(found) == ["session", INITIATED]


@pytest.mark.parametrize(
    ("tsdu", "layer"),
    [
        (b"\x32\x01\x00\x00", "session"),
        (b"\x01\x00\x02\x00", "session"),
        (b"\x01\x00\x01\x03\x19\x01\x01" + pdvs(3, STATUS), "session"),
        (b"\x0d\xff\x00", "session"),
        (b"\x01\x00\x01\x00\x60\x00", "presentation"),
        (b"\x01\x00\x01\x00\x61\x05\x30", "presentation"),
        (b"\x0d" + li(b"\xc1" + li(b"\x31\x00")), "presentation"),
        (b"\x09" + li(b"\xc1" + li(pdvs(1, b"\x60\x03\xbe\x05\x00"))), "acse"),
        (mms(b"\x30\x00"), "mms"),
        (mms(STATUS[:-1]), "mms"),
        (mms(STATUS + b"\0"), "mms"),
        (STATUS + b"\0", "mms"),
        (mms(b""), "mms"),
        (connect(pdu=b""), "mms"),
    ],
)
def test_what_a_layer_cannot_read_is_told_and_the_next_message_is_read(tsdu: bytes, layer: str) -> None:
    assert layers(read(("client", dt(tsdu) + dt(mms(CONCLUDE))))) == [layer, CONCLUDE]


@pytest.mark.parametrize(
    "tpdu", [b"\x00", b"\x09\xf0\x80", b"\x00\x0f\x80", b"\x02\xe0\x00", b"\x04\xf0\x00\x00\x80"]
)
def test_what_is_no_tpdu_is_told_and_the_next_message_is_read(tpdu: bytes) -> None:
    padded = tpdu + bytes(max(0, 3 - len(tpdu)))
    assert layers(read(("client", tpkt(padded) + dt(mms(CONCLUDE))))) == ["cotp", CONCLUDE]


def test_octets_between_two_tpkts_are_told() -> None:
    found = layers(read(("client", dt(mms(STATUS)) + b"\x00\x00\x03\x00noise" + dt(mms(CONCLUDE)))))
    assert (found[0], found[-1], set(found[1:-1])) == (STATUS, CONCLUDE, {"tpkt"})


@pytest.mark.parametrize(
    ("octets", "layer"), [(dt(mms(STATUS))[:9], "tpkt"), (dt(mms(STATUS), 9)[:16], "cotp")]
)
def test_what_is_left_at_the_end_is_told(octets: bytes, layer: str) -> None:
    association = Association(aligned=True)
    assert not list(association.feed("client", octets))
    fault = association.end("client")
    assert fault is not None
    assert fault.layer == layer
    assert association.end("server") is None


@settings(max_examples=300, deadline=None)
@given(st.data())
def test_hostile_octets_never_crash_an_association(data: st.DataObject) -> None:
    stream = bytearray(CR + dt(connect()) + dt(accept()) + dt(mms(STATUS), 9) + dt(FINISH) + dt(ABORT))
    for _ in range(data.draw(st.integers(0, 6))):
        stream[data.draw(st.integers(0, len(stream) - 1))] = data.draw(st.integers(0, 255))
    noise = data.draw(st.binary(max_size=30))
    found = read(
        ("client", bytes(stream) + noise), ("server", noise + bytes(stream)), aligned=data.draw(st.booleans())
    )
    assert all(len(item) > 0 for item in found if isinstance(item, bytes))


@settings(max_examples=200, deadline=None)
@given(st.binary(max_size=80))
def test_any_tsdu_is_read_or_told(tsdu: bytes) -> None:
    found = layers(read(("client", dt(tsdu) + dt(mms(CONCLUDE)))))
    assert found[-1:] == [CONCLUDE] or tsdu[:1] in (
        b"\x0d",
        b"\x0e",
    )  # a negotiation may exclude what follows


ADU = bytes.fromhex("000100000006ff0408d20002")


def test_modbus_adus_are_found_however_tcp_cuts() -> None:
    for size in range(1, 30):
        connection = ModbusConnection()
        stream = ADU * 3
        pieces = [stream[at : at + size] for at in range(0, len(stream), size)]
        assert [item for piece in pieces for item in connection.feed("client", piece)] == [ADU] * 3


@pytest.mark.parametrize(
    "noise", [b"GET / HTTP/1.1", b"\0\1\0\0\0\1x", b"\0\1\0\0\1\0x", b"\x16\x03\x01\0\x85"]
)
def test_what_is_no_modbus_is_told_and_the_next_segment_is_read(noise: bytes) -> None:
    connection = ModbusConnection()
    found = [*connection.feed("client", ADU + noise), *connection.feed("client", ADU)]
    assert layers(found) == [ADU, "modbus", ADU]


def test_half_an_adu_at_the_end_is_told() -> None:
    connection = ModbusConnection()
    assert not list(connection.feed("server", ADU[:8]))
    fault = connection.end("server")
    assert fault is not None
    assert "8 octets" in fault.reason


SAID = [CR, CC, dt(connect()), dt(accept()), dt(mms(STATUS)), dt(mms(STATUS_ANSWER)), dt(mms(CONCLUDE))]
SAID += [dt(mms(STATUS, 1)), dt(mms(STATUS, 7)), dt(STATUS), dt(mms(STATUS), 11), dt(FINISH), dt(ABORT)]
changes = st.lists(st.tuples(st.integers(0, 80), st.integers(0, 255)), max_size=2)
turns = st.tuples(st.sampled_from(["client", "server"]), st.sampled_from(SAID), changes, st.integers(0, 3))


@settings(max_examples=400, deadline=None)
@given(st.lists(turns, max_size=8), st.booleans(), st.booleans())
def test_the_short_way_through_the_layers_gives_what_the_long_one_gives(
    said: list[tuple[Sender, bytes, list[tuple[int, int]], int]], associated: bool, aligned: bool
) -> None:
    begin: list[tuple[Sender, bytes]] = [("client", dt(connect())), ("server", dt(accept()))]
    spoken = begin if associated and aligned else []
    for sender, octets, changed, cut in said:
        made = bytearray(octets)
        for at, octet in changed:
            made[at % len(made)] = octet
        spoken.append((sender, bytes(made[: len(made) - cut])))
    short, long = Association(aligned=aligned), Association(aligned=aligned)
    for sender, octets in spoken:
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(Association, "_plain", lambda *_: None)
            expected = list(long.feed(sender, octets))
        assert list(short.feed(sender, octets)) == expected


def test_the_short_way_through_the_layers_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    association = Association(aligned=True)
    assert list(association.feed("client", dt(connect()))) == [INITIATE]
    assert list(association.feed("server", dt(accept()))) == [INITIATED]
    monkeypatch.setattr("mmsverify.formats.capture.session.read", lambda _: pytest.fail("the long way"))
    assert list(association.feed("client", dt(mms(STATUS)))) == [STATUS]
