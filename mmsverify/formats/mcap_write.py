"""Writing recordings as MCAP: zstd chunks, indexes and summary, by the mcap package.

The same calls give the same octets: nothing of the clock, the machine or a package's version goes in.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from types import TracebackType
from typing import BinaryIO

from mcap.writer import CompressionType, IndexType, Writer

from mmsverify.errors import UsageError
from mmsverify.formats.trace import PROFILE_RECORD, Channel, Schema

_MOST_CHANNELS = (1 << 16) - 1


class TraceWriter:
    """Writes one recording; a context manager. Channels and schemas are registered when first used.

    ``target`` is a path or a binary stream; a stream stays open. Raises ``UsageError`` where the path cannot
    be written. Without ``indexed`` no index is written at the end, nor kept in memory until then.
    """

    def __init__(
        self,
        target: str | os.PathLike[str] | BinaryIO,
        *,
        compress: bool = True,
        indexed: bool = True,
        profile: str = "",
    ) -> None:
        self._owned = isinstance(target, (str, os.PathLike))
        self._stream = _create(target) if isinstance(target, (str, os.PathLike)) else target
        compression = CompressionType.ZSTD if compress else CompressionType.NONE
        indexes = IndexType.ALL if indexed else IndexType.NONE
        self._writer = Writer(self._stream, compression=compression, index_types=indexes)
        self._writer.start(profile=profile, library="mmsverify")
        self._channels: dict[tuple[Channel, int | None], int] = {}
        self._schemas: dict[Schema, int] = {}
        self._count = 0

    @property
    def count(self) -> int:
        """How many messages were added."""
        return self._count

    def add(self, time: int, channel: Channel, data: bytes) -> None:
        """Add one message; ``time`` in ns. Events are ordered by time, then by the order of these calls."""
        number = self.register(channel)
        sequence = self._count & 0xFFFFFFFF
        self._writer.add_message(number, log_time=time, data=data, publish_time=time, sequence=sequence)
        self._count += 1

    def add_copy(self, time: int, number: int, data: bytes, *, publish: int, sequence: int) -> None:
        """Add a message of another recording to a channel by its number; ``publish``: its time in ns."""
        self._writer.add_message(number, log_time=time, data=data, publish_time=publish, sequence=sequence)
        self._count += 1

    def add_attachment(self, name: str, media_type: str, data: bytes, *, log: int, created: int) -> None:
        """Add a file to the recording; ``log`` and ``created`` are times in ns."""
        self._writer.add_attachment(
            create_time=created, log_time=log, name=name, media_type=media_type, data=data
        )

    def add_profile(self, pairs: Mapping[str, str]) -> None:
        """Add the metadata record that names the model and the profile's keys."""
        self.add_metadata(PROFILE_RECORD, pairs)

    def add_metadata(self, name: str, pairs: Mapping[str, str]) -> None:
        """Add a metadata record of any name."""
        self._writer.add_metadata(name, dict(pairs))

    def flush(self) -> None:
        """Hand all that was added to the operating system: a reader of the unfinished file finds it."""
        self._writer.flush()  # type: ignore[no-untyped-call]

    def close(self) -> None:
        """Write indexes and summary; close the file if this writer opened it."""
        self._writer.finish()  # type: ignore[no-untyped-call]
        if self._owned:
            self._stream.close()

    def __enter__(self) -> TraceWriter:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def register(self, channel: Channel, number: int | None = None) -> int:
        """The number of the channel in this file, which holds it from now on.

        ``number`` is the one it had elsewhere: channels that only differ in it stay two.
        """
        key = channel, number
        known = self._channels.get(key)
        if known is None:
            known = self._channels[key] = self._defined(channel)
        return known

    def _defined(self, channel: Channel) -> int:
        if len(self._channels) == _MOST_CHANNELS:
            cause = f"more than {_MOST_CHANNELS:,} channels do not fit into one recording"
            raise UsageError(cause, cure="write several")
        schema = self.register_schema(channel.schema) if channel.schema else 0
        return self._writer.register_channel(
            channel.topic, channel.message_encoding, schema, dict(channel.metadata)
        )

    def register_schema(self, schema: Schema) -> int:
        """The number of the schema in this file, which holds it from now on."""
        if schema not in self._schemas:
            self._schemas[schema] = self._writer.register_schema(schema.name, schema.encoding, schema.data)
        return self._schemas[schema]


def _create(path: str | os.PathLike[str]) -> BinaryIO:
    try:
        return open(path, "wb")
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise UsageError(f"cannot be written: {reason}", place=os.fspath(path)) from None
