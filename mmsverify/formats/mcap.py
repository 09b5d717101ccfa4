"""Recordings in MCAP, read in event order: log time first, then position in the file.

Messages stream: at any moment only those chunks are held whose times overlap. What stands in one record is
``mcap_records``' business, the layout of the file ``mcap_survey``'s, writing ``mcap_write``'s.
"""

from __future__ import annotations

import os
from bisect import bisect_left
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import Any, BinaryIO, TypeVar

from mmsverify.errors import InputError
from mmsverify.formats.locations import Url, located
from mmsverify.formats.mcap_records import Definitions, Message
from mmsverify.formats.mcap_survey import Block, Survey, survey
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.passing import Passed
from mmsverify.formats.remote import Store
from mmsverify.formats.stretch import DisorderError, Stretch, joined
from mmsverify.formats.trace import PROFILE_RECORD, TraceMessage

__all__ = ["McapTrace", "TraceWriter", "read_trace"]

# Below this size the times that chunks claim are not trusted: everything is sorted by the messages' own
# times.
_SMALL = 16 << 20
# Messages that wait because later chunks claim earlier times. More than this is a file to be sorted first.
_LARGEST_WAIT = 384 << 20
_COST = 250  # octets of memory for one waiting message beside its data
M = TypeVar("M", bound=tuple[int, int, Any, bytes])
"""What is made of a message: log time, rank, anything, data."""
Load = Callable[[Block, BinaryIO, Definitions], list[M]]


@dataclass(frozen=True, slots=True)
class McapTrace:
    """One MCAP file. Iterating opens the file anew each time and yields its messages in event order.

    Iteration raises ``InputError`` where a chunk is damaged: an audit of wrong octets would blame the robot.
    A file that is merely cut off is read up to its last whole message (``truncated``, ``remark``).
    """

    path: str
    metadata: Mapping[str, Mapping[str, str]]
    truncated: bool
    remark: str
    _survey: Survey = field(repr=False)
    _store: Store | None = field(default=None, repr=False, compare=False)  # of a remote file

    @property
    def profile(self) -> Mapping[str, str]:
        """The pairs of the metadata record ``mmsverify.profile``; empty where the file has none."""
        return self.metadata.get(PROFILE_RECORD, {})

    @property
    def octets(self) -> int:
        """How large all messages are together, as far as the chunks tell, with what stands between them."""
        return sum(block.unpacked for block in self._survey.blocks)

    def __iter__(self) -> Iterator[TraceMessage]:
        index = 0
        for batch in self.batches():
            for time, _, channel, data in batch:
                yield TraceMessage(index, time, channel, data)
                index += 1

    def batches(self) -> Iterator[list[Message]]:
        """The same messages as lists of (log time, rank, channel, data), for readers in a hurry."""
        yield from self.batches_by(Block.load, _copied(self._survey))

    def batches_by(self, load: Load[M], known: Definitions) -> Iterator[list[M]]:
        """The same, of what ``load`` makes of a block; what the file defines goes to ``known``."""
        with self.open() as file:
            try:
                yield from _in_order(file, self._survey, load, known)
            except InputError as error:
                raise InputError(error.cause, place=self.path, cure=error.cure) from None

    def open(self) -> BinaryIO:
        """The file itself, from its first octet."""
        return _open(self.path, self._store)

    def definitions(self) -> Definitions:
        """The schemas and channels that stand outside chunks, as a copy."""
        return _copied(self._survey)

    def stretches(self, *, merged: bool = False) -> Iterator[Stretch]:
        """The same messages, as they stand in the file one chunk after the other.

        Raises ``DisorderError`` where that is not event order, as far as the chunks say so; that their
        messages are in order is for the reader to see. ``merged``: brought into order first, as `batches`.
        """
        yield from self._merged() if merged else self._as_they_stand()

    def _as_they_stand(self) -> Iterator[Stretch]:
        blocks = self._survey.blocks
        if any(block.start < before.end for before, block in pairwise(blocks)):
            raise DisorderError
        known = _copied(self._survey)
        index = last = 0
        with _open(self.path, self._store) as file:
            for block in blocks:
                wrong, ends = partial(block.wrong, place=self.path), block.position + block.size
                data, span = self._unpacked(file, block), (block.position, ends)
                stretch = Stretch(data, index, last, known, wrong, block.cut, span)
                del data
                yield stretch
                index, last = index + len(stretch.places), stretch.last
                stretch.data = b""  # the next one can stand where it stood, which the processor still knows

    def _unpacked(self, file: BinaryIO, block: Block) -> bytes:
        try:
            return block.unpack(file)
        except InputError as error:
            raise block.wrong(error, self.path) from None

    def _merged(self) -> Iterator[Stretch]:
        index = last = read = 0
        size = max((block.position + block.size for block in self._survey.blocks), default=0)
        for batch in self.batches():
            stretch = joined(batch, index, last)
            # What stands together here does not in the file: as much of it is passed as of all octets.
            begin, read = read, read + stretch.size
            stretch.span = size * begin // max(self.octets, read), size * read // max(self.octets, read)
            yield stretch
            index, last = index + len(stretch.places), stretch.last


def read_trace(path: str | os.PathLike[str] | Url, *, fetched: Passed | None = None) -> McapTrace:
    """Survey an MCAP file: metadata and truncation are known at once, messages come by iterating.

    A string such as ``s3://bucket/x.mcap`` is a URL, which fsspec opens (extra ``remote``); ``fetched`` is
    told the octets of it that have come, now and later. Raises ``InputError`` for what cannot be read at all:
    not MCAP, empty, a folder, no permission, lying lengths.
    """
    location = located(path)
    store = Store(location, fetched) if isinstance(location, Url) else None
    place = str(location) if isinstance(path, Url) or store else os.fspath(path)
    with _open(place, store) as file:
        try:
            found = survey(file)
        except InputError as error:
            raise InputError(error.cause, place=place, cure=error.cure) from None
        except OSError as error:
            raise InputError(error.strerror or str(error), place=place) from None
    return McapTrace(place, found.metadata, bool(found.remark), found.remark, found, store)


def _open(place: str, store: Store | None) -> BinaryIO:
    if store is not None:
        return store.open()
    try:
        if Path(place).is_dir():
            raise InputError(
                "a folder without recordings", place=place, cure="name one that holds .mcap files"
            )
        if not Path(place).is_file() and Path(place).exists():
            raise InputError("not a regular file", place=place, cure="name an MCAP file")
        return open(place, "rb")
    except (OSError, ValueError) as error:
        cause = getattr(error, "strerror", None) or str(error)
        raise InputError(cause, place=place, cure="name an MCAP file that can be read") from None


def _copied(found: Survey) -> Definitions:
    return Definitions(dict(found.known.schemas), dict(found.known.channels))


def _in_order(file: BinaryIO, found: Survey, load: Load[M], known: Definitions) -> Iterator[list[M]]:
    if sum(block.unpacked for block in found.blocks) <= _SMALL:
        yield sorted(message for block in found.blocks for message in load(block, file, known))
        return
    plan = sorted(found.blocks, key=lambda block: (block.start, block.number))
    if plan != found.blocks:  # a later chunk goes first: it may lean on channels that an earlier one defines
        for block in found.blocks:
            block.load(file, known)
    yield from _merged(file, plan, load, known)


def _merged(file: BinaryIO, plan: list[Block], load: Load[M], known: Definitions) -> Iterator[list[M]]:
    """What is earlier than the start of the next block can go; the rest waits for what that block holds."""
    waiting: list[M] = []
    gone = -1
    for block, following in pairwise([*plan, None]):
        assert block is not None
        waiting += load(block, file, known)
        waiting.sort()  # ranks differ, so the comparison never reaches the channel
        if waiting and waiting[0][0] < gone:
            raise InputError(f"octet {block.position}: a chunk holds messages before the time that it claims")
        at = len(waiting) if following is None else bisect_left(waiting, (following.start,))
        if at:
            gone = waiting[at - 1][0]
            yield waiting[:at]
        waiting = waiting[at:]
        _refuse_long_wait(waiting)


def _refuse_long_wait(waiting: Sequence[Any]) -> None:
    held = len(waiting) * _COST
    if held > _LARGEST_WAIT or held + sum(len(message[3]) for message in waiting) > _LARGEST_WAIT:
        raise InputError("too many messages are out of time order", cure="sort the recording by log time")
