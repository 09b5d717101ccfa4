"""Recordings as the mcap package reads them, with everything that stands in them; and one with odd things."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from mcap.reader import make_reader
from mcap.writer import IndexType, Writer


@dataclass(frozen=True)
class Told:
    """One message: what it is, when, and where."""

    topic: str
    schema: str
    metadata: tuple[tuple[str, str], ...]
    log: int
    publish: int
    sequence: int
    data: bytes

    @property
    def added(self) -> bool:
        """Whether an annotation put it there; its sequence number then is of no interest."""
        return ("mmsverify", "added") in self.metadata


@dataclass(frozen=True)
class Read:
    """A whole file."""

    profile: str
    messages: list[Told]
    channels: list[tuple[str, str, str, Mapping[str, str]]]
    schemas: Mapping[str, tuple[str, bytes]]
    metadata: list[tuple[str, Mapping[str, str]]]
    attachments: list[tuple[str, str, bytes]]


def everything(path: Path) -> Read:
    """What the mcap package finds in a file."""
    with path.open("rb") as file:
        reader = make_reader(file)
        summary = reader.get_summary()
        assert summary is not None
        names = {number: schema.name for number, schema in summary.schemas.items()}
        messages = [
            Told(
                channel.topic, schema.name if schema else "", tuple(channel.metadata.items()),
                message.log_time, message.publish_time, message.sequence, message.data,
            )
            for schema, channel, message in reader.iter_messages()
        ]  # fmt: skip
        return Read(
            reader.get_header().profile,
            messages,
            [
                (each.topic, each.message_encoding, names.get(each.schema_id, ""), each.metadata)
                for each in summary.channels.values()
            ],
            {each.name: (each.encoding, each.data) for each in summary.schemas.values()},
            [(each.name, each.metadata) for each in reader.iter_metadata()],
            [(each.name, each.media_type, each.data) for each in reader.iter_attachments()],
        )


def odd_recording(path: Path, *, chunked: bool = True) -> Path:
    """A recording with what an audit has no use for: other channels, equal ones, times that differ, files."""
    with path.open("wb") as file:
        writer = Writer(file, use_chunking=chunked, index_types=IndexType.ALL)
        writer.start(profile="plant")
        schema = writer.register_schema("vr.Sample", "jsonschema", b'{"type": "object", "x-own": 1}')
        vr = {"controller": "press3", "sampling": "polled"}
        press = writer.register_channel("/press3/vr", "json", schema, vr)
        other = writer.register_schema("other.Kind", "protobuf", b"\x00\x01\xff")
        twins = [writer.register_channel("/camera", "protobuf", other, {"lens": "a"}) for _ in range(2)]
        writer.register_channel("/silent", "raw", 0, {})
        writer.register_schema("silent.Kind", "asn1", b"")
        writer.add_message(press, 0, b'{"C_RunMD":0}', 0, 7)
        writer.add_message(twins[0], 0, b"\x00\xff", 5, 8)
        writer.add_message(twins[1], 9000, b"\x01", 12_000, 3)
        writer.add_message(press, 8000, b'{"C_RunMD": 0}', 7500, 9)
        writer.add_attachment(1, 2, "plan.pdf", "application/pdf", b"%PDF\x00")
        writer.add_metadata("notes", {"line": "7"})
        writer.finish()  # type: ignore[no-untyped-call]
    return path
