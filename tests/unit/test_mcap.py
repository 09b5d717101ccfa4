"""Recordings: what is written is what the mcap package reads; reading is complete, in order, no crash."""

from __future__ import annotations

import io
import random
import struct
import tracemalloc
import zlib
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest
import zstandard
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.reader import NonSeekingReader
from mcap.writer import CompressionType, IndexType, Writer

from mmsverify.errors import InputError, UsageError
from mmsverify.formats import mcap as mcap_module
from mmsverify.formats.mcap import TraceWriter, read_trace
from mmsverify.formats.trace import Channel, TraceMessage

CHUNKINGS = ["none", "lz4", "zstd", "unchunked"]
COMPRESSION = {"none": CompressionType.NONE, "lz4": CompressionType.LZ4, "zstd": CompressionType.ZSTD}


def recording(
    times: list[int], chunking: str = "zstd", *, bare: bool = False, chunk_size: int = 400, size: int = 20
) -> bytes:
    """A file by the mcap package: message i says i, at the given time, on one of two channels."""
    out = io.BytesIO()
    writer = Writer(
        out,
        chunk_size=chunk_size,
        compression=COMPRESSION.get(chunking, CompressionType.NONE),
        use_chunking=chunking != "unchunked",
        index_types=IndexType.NONE if bare else IndexType.ALL,
        repeat_channels=not bare,
        repeat_schemas=not bare,
        use_statistics=not bare,
        use_summary_offsets=not bare,
    )
    writer.start()
    schema = writer.register_schema("mms.MMSpdu", "asn1", b"")
    first = writer.register_channel("/r/mms/a1/client", "mms-ber", schema, {"vmd": "r", "sender": "client"})
    second = writer.register_channel("/odd", "who-knows", 0)
    for number, time in enumerate(times):
        writer.add_message(second if number % 3 == 2 else first, time, payload(number, size), time)
    writer.add_metadata("mmsverify.profile", {"model": "mms-robot"})
    writer.finish()  # type: ignore[no-untyped-call]
    return out.getvalue()


def payload(number: int, size: int = 20) -> bytes:
    return random.Random(number).randbytes(size - 4) + struct.pack("<I", number)


def numbers(messages: list[TraceMessage]) -> list[int]:
    return [int(struct.unpack("<I", message.data[-4:])[0]) for message in messages]


@pytest.fixture
def stored(tmp_path: Path) -> Callable[[bytes], Path]:
    def store(content: bytes) -> Path:
        path = tmp_path / "t.mcap"
        path.write_bytes(content)
        return path

    return store


@pytest.mark.parametrize("bare", [False, True])
@pytest.mark.parametrize("chunking", CHUNKINGS)
def test_every_chunking_is_read_with_or_without_indexes(
    stored: Callable[[bytes], Path], chunking: str, bare: bool
) -> None:
    trace = read_trace(stored(recording(list(range(100, 200)), chunking, bare=bare)))
    found = list(trace)
    assert numbers(found) == list(range(100))
    assert [message.index for message in found] == list(range(100))
    assert found[0].topic == "/r/mms/a1/client"
    assert [message.schema_name for message in found[:3]] == ["mms.MMSpdu", "mms.MMSpdu", ""]
    assert found[2].message_encoding == "who-knows"
    assert found[0].metadata == {"vmd": "r", "sender": "client"}
    assert not trace.truncated


@pytest.mark.parametrize("small", [0, 1 << 24])
@pytest.mark.parametrize("chunking", CHUNKINGS)
def test_log_time_orders_messages_and_position_decides_ties(
    stored: Callable[[bytes], Path], monkeypatch: pytest.MonkeyPatch, chunking: str, small: int
) -> None:
    monkeypatch.setattr(mcap_module, "_SMALL", small)
    dice = random.Random(7)
    times = [max(0, i // 3 + dice.randint(-20, 20)) for i in range(300)]
    found = list(read_trace(stored(recording(times, chunking))))
    assert numbers(found) == sorted(range(300), key=lambda i: (times[i], i))


def test_reading_agrees_with_the_mcap_package(stored: Callable[[bytes], Path]) -> None:
    content = recording([i * 7 % 50 for i in range(200)])
    judge = NonSeekingReader(io.BytesIO(content)).iter_messages()
    theirs = [(message.log_time, channel.topic, message.data) for _, channel, message in judge]
    ours = [(message.time, message.topic, message.data) for message in read_trace(stored(content))]
    assert ours == theirs


def test_metadata_is_known_before_the_first_message(stored: Callable[[bytes], Path]) -> None:
    trace = read_trace(stored(recording([1, 2])))
    assert trace.profile == {"model": "mms-robot"}
    assert trace.metadata == {"mmsverify.profile": {"model": "mms-robot"}}


def test_a_trace_can_be_read_twice(stored: Callable[[bytes], Path]) -> None:
    trace = read_trace(stored(recording(list(range(50)))))
    assert list(trace) == list(trace)


@pytest.mark.parametrize("chunking", CHUNKINGS)
def test_a_file_cut_anywhere_gives_a_growing_prefix(stored: Callable[[bytes], Path], chunking: str) -> None:
    content = recording(list(range(60)), chunking)
    longest = 0
    for size in range(8, len(content) - 1, 13):
        trace = read_trace(stored(content[:size]))
        found = list(trace)
        assert trace.truncated
        assert "cut off" in trace.remark
        assert numbers(found) == list(range(len(found)))
        assert len(found) >= longest
        longest = len(found)
    assert longest == 60


@pytest.mark.parametrize("chunking", ["none", "lz4", "zstd"])
def test_a_cut_chunk_gives_the_messages_that_are_whole(
    stored: Callable[[bytes], Path], chunking: str
) -> None:
    content = recording(list(range(20_000)), chunking, chunk_size=1 << 22, size=60)
    found = list(read_trace(stored(content[: len(content) * 2 // 5])))
    assert numbers(found) == list(range(len(found)))
    assert 5_000 < len(found) < 10_000


def test_a_damaged_chunk_is_an_error_of_one_line(stored: Callable[[bytes], Path]) -> None:
    content = bytearray(recording(list(range(60)), "none"))
    content[content.index(payload(30))] ^= 1
    with pytest.raises(InputError, match="CRC") as caught:
        list(read_trace(stored(bytes(content))))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("chunking", ["zstd", "unchunked"])
def test_a_damaged_data_section_is_an_error(stored: Callable[[bytes], Path], chunking: str) -> None:
    out = io.BytesIO()
    compression = COMPRESSION.get(chunking, CompressionType.NONE)
    writer = Writer(out, compression=compression, use_chunking=chunking != "unchunked", enable_data_crcs=True)
    writer.start()
    writer.add_message(writer.register_channel("/odd", "who-knows", 0), 5, b"message", 5)
    writer.add_metadata("note", {"key": "value"})
    writer.finish()  # type: ignore[no-untyped-call]
    assert len(list(read_trace(stored(out.getvalue())))) == 1
    with pytest.raises(InputError, match="CRC"):
        read_trace(stored(out.getvalue().replace(b"value", b"volue")))


def test_chunks_that_lie_about_their_times_are_sorted_or_refused(
    stored: Callable[[bytes], Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    content = recording(list(range(60)), "none", bare=True)
    true, lie = struct.pack("<QQ", 13, 20), struct.pack("<QQ", 100, 120)
    assert content.count(true) == 1
    trace = read_trace(stored(content.replace(true, lie)))
    assert numbers(list(trace)) == list(range(60))
    monkeypatch.setattr(mcap_module, "_SMALL", 0)
    with pytest.raises(InputError, match="before the time that it claims"):
        list(trace)


def chunk(
    data: bytes, compression: bytes = b"", *, size: int | None = None, claimed: int | None = None
) -> bytes:
    """A finished file with one chunk that may lie about its unpacked size and about its record's length."""
    fields = struct.pack("<QQQI", 1, 2, len(data) if size is None else size, 0)
    body = fields + struct.pack("<I", len(compression)) + compression + struct.pack("<Q", len(data)) + data
    header = struct.pack("<BQ", 1, 8) + bytes(8)
    record = struct.pack("<BQ", 6, len(body) if claimed is None else claimed) + body
    footer = struct.pack("<BQ", 15, 4) + bytes(4) + struct.pack("<BQ", 2, 20) + bytes(20)
    return b"\x89MCAP0\r\n" + header + record + footer + b"\x89MCAP0\r\n"


def zeros(count: int) -> bytes:
    return zstandard.compress(bytes(count))


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"not MCAP at all",
        chunk(b"", size=100 << 30),
        chunk(b"", claimed=100 << 30),
        chunk(zeros(1 << 28), b"zstd", size=1000),
        chunk(zeros(1 << 10), b"zstd", size=1 << 27),
        chunk(b"garbage", b"zstd", size=100),
        chunk(b"garbage", b"lz4", size=100),
        chunk(b"abc", b"brotli", size=100),
        chunk(struct.pack("<BQ", 5, 3) + b"abc"),
        chunk(struct.pack("<BQ", 5, 1 << 62) + b"abc"),
        chunk(struct.pack("<BQ", 4, 4) + struct.pack("<I", 1 << 31)),
    ],
)
def test_a_hostile_file_is_an_error_of_one_line_and_little_memory(
    stored: Callable[[bytes], Path], content: bytes
) -> None:
    path = stored(content)
    tracemalloc.start()
    try:
        with pytest.raises(InputError) as caught:
            list(read_trace(path))
        assert tracemalloc.get_traced_memory()[1] < 8 << 20
    finally:
        tracemalloc.stop()
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_folder_a_missing_file_and_a_nul_are_input_errors(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "absent.mcap", "a\0b"):
        with pytest.raises(InputError):
            read_trace(path)


@settings(max_examples=150, deadline=None)
@given(st.data())
def test_flipped_octets_never_crash_the_reader(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    content = bytearray(recording(list(range(30)), data.draw(st.sampled_from(CHUNKINGS))))
    for _ in range(3):  # each may turn one record of another kind into a message
        content[data.draw(st.integers(8, len(content) - 1))] = data.draw(st.integers(0, 255))
    path = tmp_path_factory.mktemp("flip") / "t.mcap"
    path.write_bytes(content)
    with suppress(InputError):
        assert len(list(read_trace(path))) <= 33


def written() -> bytes:
    out = io.BytesIO()
    with TraceWriter(out) as writer:
        writer.add_profile({"model": "mms-robot"})
        writer.add(10, Channel.mms("cell7", "a1", "client"), b"\x8b\x00")
        writer.add(11, Channel.mms("cell7", "a1", "server"), b"\x8c\x00")
        writer.add(12, Channel.vr("cell7", "scan"), b'{"C_RunMD": 1}')
        writer.add(13, Channel.modbus("cell7", "c1", "client"), bytes(12))
        writer.add(14, Channel.link("cell7"), b'{"connection": "a1", "event": "open", "role": "mms"}')
    return out.getvalue()


def test_what_is_written_is_what_the_mcap_package_reads() -> None:
    reader = NonSeekingReader(io.BytesIO(written()), validate_crcs=True)
    found = [(s.name if s else None, channel, message) for s, channel, message in reader.iter_messages()]
    assert [(channel.topic, channel.message_encoding, name) for name, channel, _ in found] == [
        ("/cell7/mms/a1/client", "mms-ber", "mms.MMSpdu"),
        ("/cell7/mms/a1/server", "mms-ber", "mms.MMSpdu"),
        ("/cell7/vr", "json", "vr.Sample"),
        ("/cell7/modbus/c1/client", "modbus-tcp", None),
        ("/cell7/link", "json", "link.Event"),
    ]
    assert found[0][1].metadata == {"vmd": "cell7", "association": "a1", "sender": "client"}
    assert found[2][1].metadata == {"controller": "cell7", "sampling": "scan"}
    assert [message.log_time for _, _, message in found] == [10, 11, 12, 13, 14]


def test_the_same_calls_give_the_same_octets() -> None:
    assert zlib.crc32(written()) == zlib.crc32(written())


def test_what_is_written_is_read_back(stored: Callable[[bytes], Path]) -> None:
    found = list(read_trace(stored(written())))
    assert [message.channel for message in found[:3]] == [
        Channel.mms("cell7", "a1", "client"),
        Channel.mms("cell7", "a1", "server"),
        Channel.vr("cell7", "scan"),
    ]


def test_a_name_with_a_slash_and_a_path_without_folder_are_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="without '/'"):
        Channel.mms("cell/7", "a1", "client")
    with pytest.raises(UsageError, match="cannot be written"):
        TraceWriter(tmp_path / "absent" / "out.mcap")
