"""What was learned of one recording is right for the next; recordings in any order of file are told alike."""

from __future__ import annotations

import json
import random
import struct
import sys
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import replace
from itertools import count
from pathlib import Path
from typing import Any

import pytest
from mcap.writer import CompressionType, Writer

from mmsverify.audit.learning import lasting, mirror
from mmsverify.auditing import audit_traces
from mmsverify.formats import mcap_records as rec
from mmsverify.formats.mcap import TraceWriter, read_trace
from mmsverify.formats.trace import Channel, TraceMessage
from mmsverify.resources import traces_dir
from mmsverify.results import Finding

sys.path.append(str(Path(__file__).parents[1] / "quality"))

from robot_conversations import conversation

WAYS = ({"exact": True}, {"kernel": False}, {"kernel": True})


def told(path: Path, **way: bool) -> tuple[int, int, list[Finding]]:
    audit = audit_traces([path], profile=None, model=None, **way)  # type: ignore[arg-type]
    return audit.inputs[0].messages, audit.inputs[0].skipped, list(audit.findings)


def alike(path: Path) -> list[Finding]:
    found = told(path, exact=True)
    for way in WAYS[1:] * 2:
        assert told(path, **way) == found, way
    return found[2]


def unordered(path: Path, messages: Iterable[TraceMessage], profile: Mapping[str, str], chunk: int) -> None:
    """The messages as they come, whatever their times are, in chunks of so many octets."""
    with path.open("wb") as file:
        writer = Writer(file, chunk_size=chunk, compression=CompressionType.ZSTD)
        writer.start()
        writer.add_metadata("mmsverify.profile", dict(profile))
        schemas, channels = dict[str, int](), dict[str, int]()
        for message in messages:
            channel = message.channel
            if channel.topic not in channels:
                name = channel.schema_name
                if name and name not in schemas:
                    schemas[name] = writer.register_schema(name, "asn1", b"")
                channels[channel.topic] = writer.register_channel(
                    channel.topic, channel.message_encoding, schemas.get(name, 0), dict(channel.metadata)
                )
            writer.add_message(channels[channel.topic], message.time, message.data, message.time)
        writer.finish()  # type: ignore[no-untyped-call]


def renamed(message: TraceMessage, vmd: str, time: int) -> TraceMessage:
    names = {**message.metadata, "vmd": vmd} if "vmd" in message.metadata else {"name": vmd}
    topic = message.topic.replace(message.metadata.get("vmd", message.metadata.get("name", "")), vmd)
    return replace(message, time=time, channel=replace(message.channel, topic=topic, metadata=names))


@pytest.fixture(autouse=True)
def fresh(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lasting, "_OF_THREAD", lasting._OfThread())


@pytest.mark.slow
def test_robots_with_other_programs_are_told_alike_in_turn(tmp_path: Path) -> None:
    paths = [tmp_path / f"{seed}.mcap" for seed in (11, 12)]
    for seed, path in zip((11, 12), paths, strict=True):
        conversation(seed, 150).write(path)
    paths += [traces_dir() / "two-clients.mcap", traces_dir() / "faulty-press.mcap"]
    exact = {path: told(path, exact=True) for path in paths}
    chance = random.Random(5)
    for _ in range(16):
        path, way = chance.choice(paths), chance.choice(WAYS[1:])
        assert told(path, **way) == exact[path]


@pytest.mark.parametrize("chunk", [400, 4_000, 1 << 20])
def test_chunks_out_of_order_are_brought_into_order(chunk: int, tmp_path: Path) -> None:
    trace = read_trace(traces_dir() / "two-clients.mcap")
    messages = [replace(message, time=10 * message.index) for message in trace]
    shuffled = messages[:]
    random.Random(chunk).shuffle(shuffled)
    unordered(tmp_path / "made.mcap", shuffled, trace.profile, chunk)
    found = alike(tmp_path / "made.mcap")
    expected = told(traces_dir() / "two-clients.mcap", exact=True)[2]
    assert [(each.index, each.message) for each in found] == [(each.index, each.message) for each in expected]


def test_two_robots_in_one_recording_are_told_alike(tmp_path: Path) -> None:
    path = tmp_path / "made.mcap"
    sources = [conversation(seed, 60) for seed in (21, 22)]
    files = [tmp_path / f"{number}.mcap" for number in range(2)]
    for source, file in zip(sources, files, strict=True):
        source.write(file)
    robots = [list(read_trace(file)) for file in files]
    with TraceWriter(path) as writer:
        for number in range(max(map(len, robots)) * 3):
            for which, robot in enumerate(robots):
                said = renamed(robot[number % len(robot)], f"cell{which}", 10 * number + which)
                writer.add(said.time, said.channel, said.data)
    alike(path)


def test_links_that_come_before_the_first_message_are_not_forgotten(tmp_path: Path) -> None:
    trace = read_trace(traces_dir() / "two-clients.mcap")
    said = [message for message in trace if message.message_encoding == "mms-ber"][40:]
    events = [("cell-controller", "open"), ("maintenance", "open"), ("cell-controller", "gap")] * 2
    path = tmp_path / "made.mcap"
    with TraceWriter(path) as writer:
        writer.add_profile(trace.profile)
        for time, (connection, event) in enumerate(events):
            link = {"connection": connection, "event": event, "role": "mms"}
            writer.add(time, Channel.link("weld9"), json.dumps(link).encode())
        for message in said:
            writer.add(message.time, message.channel, message.data)
    alike(path)


def test_messages_have_the_channel_that_was_theirs(tmp_path: Path) -> None:
    """A channel's number means another one later in the chunk: what was said before is told of the first."""
    messages = list(read_trace(traces_dir() / "production-run.mcap"))
    said = [message for message in messages if message.message_encoding == "mms-ber"]
    path = tmp_path / "made.mcap"
    request = next(message for message in said if message.data[0] == 0xA0)
    conclude = [(replace(said[0].channel, topic="/other"), b"\xab\x00"), (said[1].channel, b"\xac\x00")]
    beginning = [(message.channel, message.data) for message in said[:2]]
    parts = [*beginning, (request.channel, request.data), *conclude]
    chunks: list[bytes] = []
    known = _Numbers(chunks)
    for time, (channel, data) in enumerate(parts * 8):
        known.say(time, channel, data)
    octets = b"".join(chunks)
    chunk = (
        struct.pack("<QQQI", 0, 40, len(octets), 0) + b"\0\0\0\0" + struct.pack("<Q", len(octets)) + octets
    )
    path.write_bytes(rec.MAGIC + rec.HEAD.pack(rec.CHUNK, len(chunk)) + chunk)
    assert {finding.topic for finding in alike(path)} == {request.channel.topic}


class _Numbers:
    """Records of a chunk, in which a number may be given to another channel."""

    def __init__(self, chunks: list[bytes]) -> None:
        self._chunks = chunks
        self._given: dict[int, Channel] = {}

    def define(self, number: int, channel: Channel) -> None:
        pairs = b"".join(map(_text, (part for pair in channel.metadata.items() for part in pair)))
        names = _text(channel.topic) + _text(channel.message_encoding)
        body = struct.pack("<HH", number, 0) + names + struct.pack("<I", len(pairs)) + pairs
        self._chunks.append(rec.HEAD.pack(rec.CHANNEL, len(body)) + body)
        self._given[number] = channel

    def say(self, time: int, channel: Channel, data: bytes) -> None:
        number = 1 if channel.metadata["sender"] == "client" else 2
        if self._given.get(number) != channel:
            self.define(number, channel)
        size = rec.MESSAGE_FIXED + len(data)
        self._chunks.append(rec.MESSAGE_HEAD.pack(rec.MESSAGE, size, number, 0, time, time) + data)


def _text(text: str) -> bytes:
    return struct.pack("<I", len(text)) + text.encode()


@pytest.mark.parametrize("begin", [2**63 - 40, 2**63 + 1, 2**64 - 100])
def test_times_of_64_bits_are_told_alike(begin: int, tmp_path: Path) -> None:
    path = tmp_path / "made.mcap"
    with TraceWriter(path) as writer:
        for message in list(read_trace(traces_dir() / "two-clients.mcap"))[:58]:
            writer.add(begin + message.index, message.channel, message.data)
    alike(path)


@pytest.mark.parametrize("octets", [1, 2, 3, 5, 9])
def test_lengths_in_more_octets_than_they_need_are_told_alike(octets: int, tmp_path: Path) -> None:
    path = tmp_path / "made.mcap"
    said = list(read_trace(traces_dir() / "production-run.mcap"))[:40]
    with TraceWriter(path) as writer:
        for number, message in enumerate(said * 3):
            data = message.data
            if data[0] in (0xA0, 0xA1, 0xA3) and data[1] < 0x80:
                data = bytes((data[0], 0x80 | octets)) + data[1].to_bytes(octets) + data[2:]
            writer.add(number, message.channel, data)
    alike(path)


@pytest.mark.slow
@pytest.mark.parametrize("number", range(1, 60, 7))
def test_after_an_interrupt_nothing_is_taken_for_learned(
    number: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = traces_dir() / "two-clients.mcap"
    expected, calls, given = told(path, exact=True), count(), mirror._row

    def row(*args: Any) -> int:
        if next(calls) == number:
            raise KeyboardInterrupt
        return given(*args)

    with monkeypatch.context() as patched, suppress(KeyboardInterrupt):
        patched.setattr(mirror, "_row", row)
        for _ in range(3):
            told(path, kernel=True)
    assert told(path, kernel=True) == expected


@pytest.mark.slow
def test_an_association_that_is_met_late_makes_the_beginning_uncertain(tmp_path: Path) -> None:
    """Its first message answers a request that nobody has seen, performed at any time before."""
    messages = [
        m for m in read_trace(traces_dir() / "production-run.mcap") if m.message_encoding == "mms-ber"
    ]
    answers = [m for m in messages if m.metadata["sender"] == "server" and m.data[0] == 0xA1]
    late = Channel.mms(messages[0].metadata["vmd"], "a9", "server")
    path = tmp_path / "made.mcap"
    with TraceWriter(path) as writer:
        for message in messages[:120]:
            writer.add(message.time, message.channel, message.data)
        writer.add(messages[120].time, late, answers[4].data)
        for message in messages[120:]:
            writer.add(message.time + 1, message.channel, message.data)
    alike(path)
