"""TCP: what a side said comes out once and in order, whatever the capture did to its segments."""

from __future__ import annotations

import random
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mmsverify.formats.capture.link import Endpoint, Segment
from mmsverify.formats.capture.tcp import Connection, Connections, Happening

CLIENT, SERVER = Endpoint("10.0.0.9", 40000), Endpoint("10.0.0.5", 102)
ISN = (1 << 32) - 5  # sequence numbers wrap early


def segment(
    number: int,
    at: int = 0,
    data: bytes = b"",
    *,
    back: int | None = None,
    server: bool = False,
    flags: str = "",
) -> Segment:
    """A segment that begins ``at`` octets into its stream; ``back`` acknowledges so many of the other."""
    source, target = (SERVER, CLIENT) if server else (CLIENT, SERVER)
    shift = 0 if "S" in flags else 1
    return Segment(
        packet=number,
        time=number * 10,
        source=source,
        target=target,
        seq=(ISN + shift + at) % (1 << 32),
        ack=None if back is None else (ISN + 1 + back) % (1 << 32),
        syn="S" in flags,
        fin="F" in flags,
        rst="R" in flags,
        data=data,
    )


def happenings(segments: list[Segment], *, end: bool = True) -> list[Happening]:
    connections = Connections()
    found = [happening for item in segments for _, happening in connections.feed(item)]
    return found + ([happening for _, happening in connections.end()] if end else [])


def told(segments: list[Segment]) -> list[str]:
    """Kinds, with the data where there are some."""
    return [happening.data.decode() or happening.kind for happening in happenings(segments)]


def shaken(*segments: Segment) -> list[Segment]:
    return [segment(1, flags="S"), segment(2, back=0, server=True, flags="S"), *segments]


def test_a_connection_opens_speaks_and_closes() -> None:
    found = told(
        shaken(
            segment(3, 0, b"ask", back=0),
            segment(4, 0, b"answer", back=3, server=True),
            segment(5, 3, back=6, flags="F"),
            segment(6, 6, back=4, server=True, flags="F"),
            segment(7, 4, back=7),
        )
    )
    assert found == ["open", "ask", "answer", "close"]


def test_the_opener_is_who_sent_the_syn() -> None:
    assert happenings(shaken())[0].source == CLIENT


def test_retransmitted_and_overlapping_octets_come_once() -> None:
    segments = shaken(
        segment(3, 0, b"abc"),
        segment(4, 0, b"abc"),
        segment(5, 2, b"cdef"),
        segment(6, 5, b"f"),
        segment(7, 6, b"g"),
    )
    assert told(segments) == ["open", "abc", "def", "g"]


def test_a_keep_alive_is_not_data() -> None:
    assert told(shaken(segment(3, 0, b"abc"), segment(4, 2, b"\0"), segment(5, 3, b"d"))) == [
        "open",
        "abc",
        "d",
    ]


def test_early_octets_wait_and_carry_the_time_of_what_they_waited_for() -> None:
    found = happenings(shaken(segment(3, 3, b"def"), segment(4, 0, b"abc")))[1:]
    assert [(happening.packet, happening.time, happening.data) for happening in found] == [
        (4, 40, b"abc"),
        (3, 40, b"def"),
    ]


def test_a_hole_that_the_receiver_acknowledged_is_a_gap_before_what_follows() -> None:
    later = [segment(4 + i, back=6, server=True) for i in range(20)]
    found = happenings(shaken(segment(3, 3, b"def"), *later), end=False)[1:]
    assert [(happening.kind, happening.time, happening.data) for happening in found] == [
        ("gap", 30, b""),
        ("data", 30, b"def"),
    ]


def test_a_hole_waits_as_long_as_nobody_acknowledged_it() -> None:
    later = [segment(4 + i, back=0, server=True) for i in range(20)]
    assert told([*shaken(segment(3, 3, b"def"), *later), segment(50, 0, b"abc")]) == ["open", "abc", "def"]


def test_a_hole_at_the_end_is_told_at_the_end() -> None:
    assert told(shaken(segment(3, 3, b"def"), segment(4, 9, b"x"))) == ["open", "gap", "def", "gap", "x"]


def test_acknowledged_octets_that_never_come_are_a_gap() -> None:
    assert told(shaken(segment(3, back=40, server=True))) == ["open", "gap"]


def test_a_mid_stream_start_has_no_open() -> None:
    assert told([segment(1, 500, b"abc", back=70), segment(2, 70, b"x", server=True)]) == ["abc", "x"]


def test_a_mid_stream_loss_shows_by_the_acknowledgment() -> None:
    assert told([segment(1, back=70), segment(2, 75, b"x", server=True)]) == ["gap", "x"]


def test_a_reset_ends_the_connection_after_what_waits() -> None:
    assert told(shaken(segment(3, 3, b"def"), segment(4, 6, flags="R"))) == ["open", "gap", "def", "reset"]


def test_a_refused_connection_never_opens() -> None:
    assert told([segment(1, flags="S"), segment(2, back=0, server=True, flags="R")]) == ["reset"]


def test_one_side_that_finished_is_a_close_at_the_end_of_the_capture() -> None:
    assert told(shaken(segment(3, 0, b"a", flags="F"))) == ["open", "a", "close"]


def test_the_same_ports_can_be_used_again() -> None:
    again = Segment(9, 90, CLIENT, SERVER, 12345, None, True, False, False, b"")
    first = Segment(10, 100, CLIENT, SERVER, 12346, None, False, False, False, b"new")
    assert told([*shaken(segment(3, 0, b"old", flags="F")), again, first]) == [
        "open",
        "old",
        "close",
        "open",
        "new",
    ]


def test_a_repeated_or_late_syn_is_not_another_connection() -> None:
    segments = [segment(2, back=0, server=True, flags="S"), segment(1, flags="S"), segment(3, flags="S")]
    assert told([*segments, segment(4, 0, b"abc")]) == ["open", "abc"]


def test_a_jump_beyond_any_window_is_a_gap() -> None:
    assert told(shaken(segment(3, 0, b"a"), segment(4, 1 << 28, b"b"), segment(5, (1 << 28) + 1, b"c"))) == [
        "open",
        "a",
        "gap",
        "b",
        "c",
    ]


@settings(max_examples=150, deadline=None)
@given(st.binary(min_size=1, max_size=400), st.integers(0, 1 << 30), st.booleans())
def test_shuffled_repeated_overlapping_segments_give_the_stream(text: bytes, seed: int, wide: bool) -> None:
    dice = random.Random(seed)
    cuts = sorted({0, len(text), *(dice.randrange(len(text)) for _ in range(8))})
    spans = [(a, min(len(text), b + dice.randrange(9 if wide else 1))) for a, b in pairwise(cuts)]
    spans += dice.choices(spans, k=4)
    dice.shuffle(spans)
    segments = [segment(3 + i, a, text[a:b]) for i, (a, b) in enumerate(spans)]
    found = happenings(shaken(*segments))
    assert b"".join(happening.data for happening in found) == text
    assert not [happening for happening in found if happening.kind == "gap"]


@pytest.mark.parametrize("count", [1500])
def test_octets_behind_a_hole_do_not_pile_up(count: int) -> None:
    segments = [segment(3 + i, 10 + 2 * i, b"x") for i in range(count)]
    found = happenings(shaken(*segments), end=False)
    assert len(found) > count


def heard(segments: list[Segment], monkeypatch: pytest.MonkeyPatch, *, short: bool) -> list[Happening]:
    """What a capture's segments bring about, by the short way for plain ones or without it."""
    with monkeypatch.context() as patch:
        if not short:
            patch.setattr(Connection, "_plain", lambda *_: False)
        connections = Connections()
        told = [happening for each in segments for _, happening in connections.feed(each)]
        return told + [happening for _, happening in connections.end()]


@pytest.mark.parametrize("seed", range(150))
def test_the_short_way_for_plain_segments_tells_the_same(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Conversations with few or many losses, repetitions, overlaps and swaps; some begin in the middle."""
    rare = random.Random(seed)
    odds = rare.choice([0.002, 0.02, 0.2])
    at, made = {False: 0, True: 0}, list[Segment]()
    for number in range(900):
        server = rare.random() < 0.5
        size = rare.choice([0, 1, 5, 400])
        back = at[not server]
        begin = at[server] - (rare.randrange(6) if rare.random() < odds else 0)
        flags = "F" if rare.random() < odds / 40 else ""
        made.append(
            segment(
                number, max(begin, 0), bytes([number % 251]) * size, back=back, server=server, flags=flags
            )
        )
        at[server] += size
    if seed % 2:
        made = [segment(0, flags="S"), segment(0, server=True, flags="S", back=0), *made]
    kept = [each for each in made if rare.random() > odds]
    for place in range(len(kept) - 1):
        if rare.random() < odds:
            kept[place], kept[place + 1] = kept[place + 1], kept[place]
    assert heard(kept, monkeypatch, short=True) == heard(kept, monkeypatch, short=False)
