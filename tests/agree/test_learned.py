"""What was learned tells the same as thinking: audits by the automaton that builds itself, and without it.

Conversations are random, conforming and otherwise: stretches of them are said again and again, out of place,
so that what was learned of one moment meets another.
"""

from __future__ import annotations

import pickle
import random
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mmsverify.audit.device import Device
from mmsverify.audit.learning import learned, tables
from mmsverify.audit.learning.classes import split
from mmsverify.audit.telling import History
from mmsverify.auditing import audit_traces
from mmsverify.concrete.belief.values import ABSENT
from mmsverify.formats.mcap import TraceWriter, read_trace
from mmsverify.formats.mms import Pdu, encode
from mmsverify.formats.trace import TraceMessage
from mmsverify.resources import traces_dir
from mmsverify.results import Finding

sys.path.append(str(Path(__file__).parents[1] / "quality"))

from robot_conversations import conversation

SAMPLES = sorted(traces_dir().glob("*.mcap"))


WAYS: dict[str, dict[str, bool]] = {"tables": {"kernel": False}, "kernel": {"kernel": True}}


def told(path: Path, *, exact: bool = False, kernel: bool = False) -> list[Finding]:
    return list(audit_traces([path], profile=None, model=None, exact=exact, kernel=kernel).findings)


def same_in_all_ways(path: Path, times: int = 3) -> list[Finding]:
    """The findings, which are the same also when what was learned of the recording is known from before."""
    found = told(path, exact=True)
    for way, options in WAYS.items():
        for time in range(times):
            assert told(path, **options) == found, f"{way}, for the {time + 1}. time"
    return found


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_the_samples_are_told_alike(path: Path) -> None:
    same_in_all_ways(path)


def repeated(messages: list[TraceMessage], chance: random.Random, count: int) -> Iterator[TraceMessage]:
    """The messages, and then stretches of them: some many times over."""
    yield from messages
    for _ in range(count):
        begin = chance.randrange(len(messages))
        stretch = messages[begin : begin + chance.choice([1, 2, 4, 8, 16])]
        for _ in range(chance.choice([1, 1, 3, 6])):
            yield from stretch


def muddle(seed: int, path: Path, count: int) -> None:
    muddled(conversation(seed, 60).write(path), path, seed, count)


def muddled(source: Path, path: Path, seed: int, count: int) -> None:
    trace = read_trace(source)
    messages, profile = list(trace), trace.profile
    with TraceWriter(path) as writer:
        writer.add_profile(profile)
        for number, message in enumerate(repeated(messages, random.Random(seed), count), 1):
            writer.add(number * 1_000_000, message.channel, message.data)


@pytest.fixture(autouse=True)
def compares(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(learned, "COMPARES", True)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "count"), [("diverse", 2400), ("faulty", 1500), ("mid-operation", 2500)])
def test_logs_of_all_kinds_are_told_alike(
    name: str, count: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Values that nobody looks at, findings all the time, a beginning that is missing and gaps."""
    path = tmp_path / "made.mcap"
    monkeypatch.syspath_prepend(str(Path(__file__).parents[2] / "bench"))
    import_module("logs").LOGS[name].write(path, count)
    same_in_all_ways(path, times=5)


@pytest.mark.parametrize("seed", range(3))
def test_muddled_conversations_are_told_alike(seed: int, tmp_path: Path) -> None:
    path = tmp_path / "made.mcap"
    muddle(seed, path, 12)
    same_in_all_ways(path)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("name", ["press-day", "faulty-press"])
def test_muddled_samples_of_a_controller_are_told_alike(name: str, seed: int, tmp_path: Path) -> None:
    path = tmp_path / "made.mcap"
    muddled(traces_dir() / f"{name}.mcap", path, seed, 300)
    assert len(same_in_all_ways(path)) > 10


def test_where_nothing_comes_again_nothing_is_learned_for_a_while(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(learned, "_TRIAL", 4)
    monkeypatch.setattr(learned, "_REST", 20)
    path = tmp_path / "made.mcap"
    muddle(5, path, 8)
    same_in_all_ways(path, times=2)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 104))
def test_many_muddled_conversations_are_told_alike(seed: int, tmp_path: Path) -> None:
    path = tmp_path / "made.mcap"
    muddle(seed, path, 30)
    same_in_all_ways(path)


@pytest.mark.slow
def test_what_is_forgotten_costs_no_finding(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tables, "LARGEST", 100_000)
    monkeypatch.setattr(tables, "MOST_CLASSES", 20)
    path = tmp_path / "made.mcap"
    muddle(3, path, 6)
    same_in_all_ways(path, times=2)


def test_a_conversation_that_repeats_itself_is_not_thought_about(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = 0
    judged = Device.message

    def counted(device: Device, message: TraceMessage, read: Any = None) -> Iterator[Finding]:
        nonlocal asked
        asked += 1
        return judged(device, message, read)

    monkeypatch.setattr(Device, "message", counted)
    path = tmp_path / "made.mcap"
    status = [m for m in read_trace(traces_dir() / "production-run.mcap") if m.message_encoding == "mms-ber"]
    with TraceWriter(path) as writer:
        for number in range(500):
            for at, side in enumerate(status[2:4]):
                writer.add(1 + 10 * number + at, side.channel, side.data)
    assert told(path) == []
    assert asked < 20


kinds = st.sampled_from(["confirmed-RequestPDU", "confirmed-ResponsePDU"])


@given(kinds, st.integers(0, 2**31 - 1), st.integers(0, 2**31 - 1))
def test_a_class_is_what_is_left_without_the_invoke_id(kind: str, one: int, other: int) -> None:
    body = {"confirmed-RequestPDU": False, "confirmed-ResponsePDU": "cell"}[kind]
    service = {"confirmed-RequestPDU": "status", "confirmed-ResponsePDU": "vMDStop"}[kind]
    pdus = [
        encode(Pdu(kind, number, service, body if service == "status" else None)) for number in (one, other)
    ]
    first, second = (split(octets) for octets in pdus)
    assert first is not None
    assert second is not None
    assert (first[1], second[1]) == (one, other)
    same_size = len(pdus[0]) == len(pdus[1])
    assert (first[0] == second[0]) == same_size


@pytest.mark.parametrize(
    "octets", ["a006020200058000", "a0050201ff8000", "a00a02060001000000008000", "a0030205", "a0"]
)
def test_an_invoke_id_of_an_unusual_form_makes_no_class(octets: str) -> None:
    assert split(bytes.fromhex(octets)) is None


@given(st.binary(max_size=20))
def test_octets_of_any_kind_have_a_class_or_none(octets: bytes) -> None:
    parts = split(octets)
    assert parts is None or set(parts[0]) <= set(octets)


def test_what_is_not_given_is_not_given_where_a_state_is_put_back() -> None:
    assert pickle.loads(pickle.dumps([ABSENT, ABSENT]))[1] is ABSENT


KEY = ("state", ("P",))


@pytest.mark.parametrize(
    "steps",
    [
        [(1, ("A",)), (2, ())],
        [(1, ("A",)), (2, ()), (3, ("B",)), (4, ())],
        [(1, ("A",)), (1, ())],
        [(1, ()), (2, ("A",)), (2, ()), (3, ())],
    ],
)
def test_who_wrote_a_cell_is_known_from_the_last_of_each_step(
    steps: list[tuple[int, tuple[str, ...]]],
) -> None:
    """Steps that were looked up are written down later, and only the last of those that are the same."""
    thought, looked_up = History(), History()
    wrote = {}
    for index, own in steps:
        thought.write(KEY, index, own)
        wrote[index] = thought.written_at(index)
    looked_up.write_down((wrote[index], index) for index in wrote)
    assert looked_up.writers == thought.writers
