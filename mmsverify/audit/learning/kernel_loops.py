"""The loops of the kernel, as numba compiles them: each octet of a message is looked at once.

They do what `walk` and `trail` do, with states, steps and classes as numbers. Nothing is decided here that is
not decided there; a test holds one to the other. Tables are rows of 64-bit integers, handed on as addresses:
arrays would be counted at every call, which costs more than all the rest. What an address may be read is
checked before: `follow` stays ``SPARE`` octets within the stretch, all other numbers are ours.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import types
from numba.extending import intrinsic, register_jitable

from mmsverify.audit.learning.tables import MOST_MARKS

_U = np.uint64
UNKNOWN, DISORDER = 1, 2
STAYS = -1
"""The number of moves, or of sources, of a step that leaves all in place."""
SPARE = 8
"""Octets are looked at eight at a time: as many must stand behind whatever is looked at."""

CHANNEL_ROW, DEVICE, ROLE = 2, 0, 1
"""Of a channel: whose it is (-1: nobody's), and which part it has in the conversation."""
DEVICE_ROW, STATE, WHOLE, COUNT, PENDING, LATEST, INVOKES = 32, 0, 1, 2, 3, 4, 16
"""Of a device: its state (-1: unknown), whether its messages have no invokeIDs, how many it has itself, how
many steps are new to it, its last step (-1: unknown); then its invokeIDs."""
CLASS_ROW, HASH, HEAD, PART, AT, SIZE, NUMBER = 8, 0, 1, 2, 3, 4, 5
"""Of a class: a hash (0: no class), the octets before the invokeID, the role, the address of the others and
how many they are, its number."""
ENTRY_ROW, KEY, STEP = 2, 0, 1
"""Of an entry: state and event in one number (0: no entry), and the step."""
STEP_ROW, TARGET, MOVING, TRACING, FROM, EVENT, CLASS, GUESS = 8, 0, 1, 2, 3, 4, 5, 6
"""Of a step: its target, how many moves and sources it has, the state that it leaves, its event, the slot of
the event's class, and the step that came after it when it was taken last (-1: none yet)."""
PASSED, LAST = 0, 1
"""What is counted: the messages passed, and the log time of the last one."""

_MESSAGE, _HEAD, _DATA = 5, 9, 31  # of MCAP: an opcode, the octets of a record's head, of a message's
_ERROR, _LONG, _NEGATIVE = 0xA2, 0x80, 0x80  # as in `walk`
NONE = 0xFFFF_FFFF_FFFF_FFFF
"""Stands for the head of a message that has no invokeID."""
_FACTOR = 0x9E37_79B9_7F4A_7C15


def _reader(kind: Any) -> Any:
    """A function that reads a number at an address, whatever that is a multiple of."""

    def read(context: Any, address: Any) -> Any:  # noqa: ARG001 - the form that numba wants
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:  # noqa: ARG001
            pointer = context.get_value_type(kind).as_pointer()
            found = builder.load(builder.inttoptr(args[0], pointer))
            found.align = 1
            return found

        return kind(types.int64), generate

    return intrinsic(read)


def _writer() -> Any:
    def write(context: Any, address: Any, value: Any) -> Any:  # noqa: ARG001 - the form that numba wants
        def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:  # noqa: ARG001
            pointer = context.get_value_type(types.int64).as_pointer()
            builder.store(args[1], builder.inttoptr(args[0], pointer)).align = 1
            return context.get_dummy_value()

        return types.void(types.int64, types.int64), generate

    return intrinsic(write)


word, octet, _signed, _short = (
    _reader(kind) for kind in (types.uint64, types.uint8, types.int64, types.int8)
)
_write = _writer()


@register_jitable
def get(table: Any, width: Any, row: Any, column: Any) -> Any:
    """One number of a table."""
    return _signed(table + (row * width + column) * 8)


@register_jitable
def put(table: Any, width: Any, row: Any, column: Any, value: Any) -> None:
    """Write one number of a table."""
    _write(table + (row * width + column) * 8, np.int64(value))


@register_jitable
def part(at: Any, size: Any) -> Any:
    """One to eight octets as one number, the first the lowest."""
    return word(at) & (_U(NONE) >> _U(8 * (8 - size)))


@register_jitable
def digest(head: Any, role: Any, at: Any, size: Any) -> Any:
    """A hash of a message without its invokeID; never 0."""
    found = (head ^ _U(role) * _U(_FACTOR)) * _U(_FACTOR) ^ _U(size)
    end = at + size
    while at + 8 <= end:
        found = (found ^ word(at)) * _U(_FACTOR)
        found ^= found >> _U(29)
        at += 8
    if at < end:
        found = (found ^ part(at, end - at)) * _U(_FACTOR)
    found ^= found >> _U(32)
    return found | _U(1)


@register_jitable
def same(at: Any, other: Any, size: Any) -> Any:
    """Whether as many octets are the same."""
    end = at + size
    while at + 8 <= end:
        if word(at) != word(other):
            return False
        at += 8
        other += 8
    return at == end or part(at, end - at) == part(other, end - at)


@register_jitable
def is_class(classes: Any, slot: Any, head: Any, role: Any, at: Any, size: Any) -> Any:
    """Whether a message is of the class in that slot."""
    return (
        get(classes, CLASS_ROW, slot, SIZE) == size
        and _U(get(classes, CLASS_ROW, slot, HEAD)) == head
        and get(classes, CLASS_ROW, slot, PART) == role
        and same(at, get(classes, CLASS_ROW, slot, AT), size)
    )


@register_jitable
def class_slot(classes: Any, mask: Any, head: Any, role: Any, at: Any, size: Any) -> Any:
    """The slot of a class, -1 if it has none."""
    hashed = digest(head, role, at, size)
    slot = np.int64(hashed >> _U(8)) & mask
    while True:
        found = _U(get(classes, CLASS_ROW, slot, HASH))
        if found == _U(0):
            return np.int64(-1)
        if found == hashed and is_class(classes, slot, head, role, at, size):
            return slot
        slot = slot + 1 & mask


@register_jitable
def entry_slot(entries: Any, mask: Any, key: Any) -> Any:
    """The slot of a key, or the free one where it belongs."""
    slot = np.int64(_U(key) * _U(_FACTOR) >> _U(40)) & mask
    while True:
        found = get(entries, ENTRY_ROW, slot, KEY)
        if found in (0, key):
            return slot
        slot = slot + 1 & mask


@register_jitable
def key_of(state: Any, event: Any) -> Any:
    """State and event as one number."""
    return (state << 32 | event) + 1


@register_jitable
def move(moves: Any, count: Any, step: Any, own: Any, scratch: Any, invoke: Any) -> None:
    """Move the invokeIDs of a device (``own`` is its row) as a step does."""
    for n in range(count):
        source = np.int64(_short(moves + step * MOST_MARKS + n))
        put(scratch, 1, n, 0, invoke if source < 0 else get(own, 1, INVOKES + source, 0))
    for n in range(count):
        put(own, 1, INVOKES + n, 0, get(scratch, 1, n, 0))
    put(own, 1, COUNT, 0, count)


@register_jitable
def relation_of(own: Any, invoke: Any) -> Any:
    """Which of the device's invokeIDs it is, from 1; the last one, should two be the same; 0 if none is."""
    found = 0
    for n in range(get(own, 1, COUNT, 0)):
        if get(own, 1, INVOKES + n, 0) == invoke:
            found = n + 1
    return found


@register_jitable
def unsigned(at: Any, size: Any) -> Any:
    """The number of an invokeID; -1 where it is negative or longer than it need be."""
    if size < 1 or size > 4 or octet(at) >= _NEGATIVE:
        return np.int64(-1)
    if size > 1 and octet(at) == 0 and octet(at + 1) < _NEGATIVE:
        return np.int64(-1)
    found = np.int64(0)
    for n in range(size):
        found = found << 8 | np.int64(octet(at + n))
    return found


@register_jitable
def parted(at: Any, end: Any) -> Any:
    """A PDU without its invokeID: the head before it, where the rest begins, the invokeID; -1 if unusual."""
    octets = np.int64(4)
    if octet(at + 1) >= _LONG:
        octets += np.int64(octet(at + 1)) & 0x7F
    if octets > 6:
        return _U(0), at, np.int64(-1)
    width = np.int64(octet(at + octets - 1))
    rest = at + octets + width
    if rest > end:
        return _U(0), at, np.int64(-1)
    return part(at, octets), rest, unsigned(at + octets, width)


@register_jitable
def step_of(
    rest: Any, size: Any, head: Any, role: Any, relation: Any, state: Any, guess: Any, classes: Any,
    entries: Any, mask: Any, steps: Any,
) -> Any:  # fmt: skip
    """The step of an event, -1 if none is known; the one that is guessed is looked at first."""
    if (
        guess >= 0
        and get(steps, STEP_ROW, guess, FROM) == state
        and get(steps, STEP_ROW, guess, EVENT) & 15 == relation
        and is_class(classes, get(steps, STEP_ROW, guess, CLASS), head, role, rest, size)
    ):
        return guess
    slot = class_slot(classes, mask, head, role, rest, size)
    if slot < 0:
        return np.int64(-1)
    key = key_of(state, get(classes, CLASS_ROW, slot, NUMBER) << 4 | relation)
    entry = entry_slot(entries, mask, key)
    return (
        get(entries, ENTRY_ROW, entry, STEP) if get(entries, ENTRY_ROW, entry, KEY) == key else np.int64(-1)
    )


def follow(
    data: Any, at: Any, size: Any, channels: Any, devices: Any, classes: Any, entries: Any, mask: Any,
    steps: Any, moves: Any, scratch: Any, trail: Any, places: Any, counts: Any,
) -> Any:  # fmt: skip
    """Pass the messages that the tables know: the offset of the first that they do not, and why."""
    last, passed, why = counts[LAST], counts[PASSED], UNKNOWN
    while at + _DATA + SPARE <= size:
        place = data + at
        length, number = np.int64(word(place + 1)), np.int64(word(place + 9)) & 0xFFFF
        device, role = get(channels, CHANNEL_ROW, number, DEVICE), get(channels, CHANNEL_ROW, number, ROLE)
        fits = _DATA - _HEAD <= length <= size - at - _HEAD - SPARE
        if octet(place) != _MESSAGE or device < 0 or not fits:
            break
        own, begin, end = devices + device * DEVICE_ROW * 8, place + _DATA, place + _HEAD + length
        head, rest, invoke, relation = _U(NONE), begin, np.int64(-1), np.int64(0)
        if get(own, 1, WHOLE, 0) == 0 and octet(begin) <= _ERROR:
            head, rest, invoke = parted(begin, end)
            if invoke < 0:
                break
            relation = relation_of(own, invoke)
        latest, state = get(own, 1, LATEST, 0), get(own, 1, STATE, 0)
        guess = get(steps, STEP_ROW, latest, GUESS) if latest >= 0 else latest
        step = step_of(rest, end - rest, head, role, relation, state, guess, classes, entries, mask, steps)
        time = np.int64(word(place + 15))
        if step < 0 or state < 0 or time < 0:  # a time of 64 bits is for others
            break
        if time < last:
            why = DISORDER
            break
        if latest >= 0:
            put(steps, STEP_ROW, latest, GUESS, step)
        moving = get(steps, STEP_ROW, step, MOVING)
        if moving != STAYS:
            move(moves, moving, step, own, scratch, invoke)
        put(own, 1, STATE, 0, get(steps, STEP_ROW, step, TARGET))
        put(own, 1, LATEST, 0, step)
        put(own, 1, PENDING, 0, get(own, 1, PENDING, 0) + 1)
        trail[passed], places[passed] = step << 8 | device, at
        last, passed, at = time, passed + 1, at + _HEAD + length
    counts[LAST], counts[PASSED] = last, passed
    return at, why


def last_of_each(trail: Any, begin: Any, end: Any, device: Any, last: Any) -> None:
    """Which of the messages passed was the last of each step of a device, into ``last`` by step."""
    for n in range(begin, end):
        if trail[n] >= 0 and trail[n] & 0xFF == device:
            last[trail[n] >> 8] = n


def origin(trail: Any, steps: Any, sources: Any, begin: Any, end: Any, device: Any, place: Any) -> Any:
    """Where a mark of the present state comes from: which of the messages passed or -1, and which mark."""
    for n in range(end - 1, begin - 1, -1):
        step = trail[n] >> 8
        if trail[n] >= 0 and trail[n] & 0xFF == device and steps[step, TRACING] != STAYS:
            place = sources[step, place]
            if place < 0:
                return n, -1
    return -1, place


def put_class(classes: Any, mask: Any, head: Any, role: Any, at: Any, size: Any, number: Any) -> Any:
    """Enter a class, the octets of which stand in the pool; the slot of it."""
    hashed = digest(head, role, at, size)
    slot = np.int64(hashed >> _U(8)) & mask
    while get(classes, CLASS_ROW, slot, HASH) != 0:
        slot = slot + 1 & mask
    put(classes, CLASS_ROW, slot, HASH, hashed)
    put(classes, CLASS_ROW, slot, HEAD, head)
    put(classes, CLASS_ROW, slot, PART, role)
    put(classes, CLASS_ROW, slot, AT, at)
    put(classes, CLASS_ROW, slot, SIZE, size)
    put(classes, CLASS_ROW, slot, NUMBER, number)
    return slot


def put_step(entries: Any, mask: Any, state: Any, event: Any, step: Any) -> None:
    """Enter a step by the state and the event."""
    key = key_of(state, event)
    slot = entry_slot(entries, mask, key)
    put(entries, ENTRY_ROW, slot, KEY, key)
    put(entries, ENTRY_ROW, slot, STEP, step)
