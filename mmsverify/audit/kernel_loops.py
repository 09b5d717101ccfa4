"""The loops of the kernel, as numba compiles them: plain functions over arrays, each octet looked at once.

They do what `walk` and `trail` do, with states, steps and classes as numbers. Nothing is decided here that is
not decided there; a test holds one to the other. Arrays are handed on one by one, for a tuple of them costs
more than the rest of the loop; columns are named below.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba.extending import register_jitable

_U = np.uint64
UNKNOWN, DISORDER = 1, 2
STAYS = -1
"""The number of moves, or of sources, of a step that leaves all in place."""

DEVICE, ROLE = range(2)
"""Of a channel: whose it is (-1: nobody's), and which part it has in the conversation."""
STATE, WHOLE, COUNT, PENDING, INVOKES = range(5)
"""Of a device: its state (-1: unknown), whether its messages have no invokeIDs, how many it has itself, how
many steps are new to it; then its invokeIDs."""
HASH, HEAD, PART, AT, SIZE, NUMBER = range(6)
"""Of a class: a hash (0: no class), the octets before the invokeID, the role, where the others stand in the
pool and how many they are, its number."""
KEY, STEP = range(2)
"""Of an entry: state and event in one number (0: no entry), and the step."""
TARGET, MOVING, TRACING = range(3)
"""Of a step: its target, how many moves and sources it has."""
STEPS, PLACES, LAST = range(3)
"""What is counted: steps of the trail, places, and the log time of the last message."""

_MESSAGE, _HEAD, _DATA = 5, 9, 31  # of MCAP: an opcode, the octets of a record's head, of a message's
_ERROR, _LONG, _NEGATIVE = 0xA2, 0x80, 0x80  # as in `walk`
NONE = 0xFFFF_FFFF_FFFF_FFFF
"""Stands for the head of a message that has no invokeID."""
_FACTOR = 0x9E37_79B9_7F4A_7C15


@register_jitable
def word(data: Any, at: Any) -> Any:
    """The eight octets from ``at`` on, the first the lowest."""
    i = _U(at)  # what cannot be negative is not counted from the end
    return (
        _U(data[i])
        | _U(data[i + _U(1)]) << _U(8)
        | _U(data[i + _U(2)]) << _U(16)
        | _U(data[i + _U(3)]) << _U(24)
        | _U(data[i + _U(4)]) << _U(32)
        | _U(data[i + _U(5)]) << _U(40)
        | _U(data[i + _U(6)]) << _U(48)
        | _U(data[i + _U(7)]) << _U(56)
    )


@register_jitable
def part(data: Any, at: Any, size: Any) -> Any:
    """One to eight octets, as `word`."""
    return word(data, at) & (_U(NONE) >> _U(8 * (8 - size)))


@register_jitable
def digest(head: Any, role: Any, data: Any, at: Any, size: Any) -> Any:
    """A hash of a message without its invokeID; never 0."""
    found = (head ^ _U(role) * _U(_FACTOR)) * _U(_FACTOR) ^ _U(size)
    left = size
    while left >= 8:
        found = (found ^ word(data, at)) * _U(_FACTOR)
        found ^= found >> _U(29)
        at += 8
        left -= 8
    if left:
        found = (found ^ part(data, at, left)) * _U(_FACTOR)
    found ^= found >> _U(32)
    return found | _U(1)


@register_jitable
def same(data: Any, at: Any, pool: Any, other: Any, size: Any) -> Any:
    """Whether as many octets are the same."""
    left = size
    while left >= 8:
        if word(data, at) != word(pool, other):
            return False
        at += 8
        other += 8
        left -= 8
    return left == 0 or part(data, at, left) == part(pool, other, left)


@register_jitable
def class_of(classes: Any, pool: Any, head: Any, role: Any, data: Any, at: Any, size: Any) -> Any:
    """The number of a class, 0 if it has none."""
    hashed = digest(head, role, data, at, size)
    mask = _U(len(classes) - 1)
    slot = (hashed >> _U(8)) & mask
    while classes[slot, HASH] != 0:
        if (
            _U(classes[slot, HASH]) == hashed
            and _U(classes[slot, HEAD]) == head
            and classes[slot, PART] == role
            and classes[slot, SIZE] == size
            and same(data, at, pool, classes[slot, AT], size)
        ):
            return classes[slot, NUMBER]
        slot = (slot + _U(1)) & mask
    return 0


@register_jitable
def slot_of(entries: Any, key: Any) -> Any:
    """The slot of a key, or the free one where it belongs."""
    mask = _U(len(entries) - 1)
    slot = (_U(key) * _U(_FACTOR) >> _U(20)) & mask
    while entries[slot, KEY] != 0 and entries[slot, KEY] != key:
        slot = (slot + _U(1)) & mask
    return slot


@register_jitable
def key_of(state: Any, event: Any) -> Any:
    """State and event as one number."""
    return (state << 32 | event) + 1


@register_jitable
def move(moves: Any, count: Any, step: Any, devices: Any, device: Any, scratch: Any, invoke: Any) -> None:
    """Move the invokeIDs of a device as a step does."""
    for n in range(count):
        source = moves[step, n]
        scratch[n] = invoke if source < 0 else devices[device, INVOKES + source]
    for n in range(count):
        devices[device, INVOKES + n] = scratch[n]
    devices[device, COUNT] = count


@register_jitable
def relation_of(devices: Any, device: Any, invoke: Any) -> Any:
    """Which of the device's invokeIDs it is, from 1; the last one, should two be the same; 0 if none is."""
    found = 0
    for n in range(devices[device, COUNT]):
        if devices[device, INVOKES + n] == invoke:
            found = n + 1
    return found


@register_jitable
def unsigned(data: Any, at: Any, size: Any) -> Any:
    """The number of an invokeID; -1 where it is negative or longer than it need be."""
    if size < 1 or size > 4 or data[at] >= _NEGATIVE:
        return -1
    if size > 1 and data[at] == 0 and data[at + 1] < _NEGATIVE:
        return -1
    found = np.int64(0)
    for n in range(size):
        found = found << 8 | np.int64(data[at + n])
    return found


@register_jitable
def parted(data: Any, at: Any, end: Any) -> Any:
    """A PDU without its invokeID: the head before it, where the rest begins, the invokeID; -1 if unusual."""
    octets = np.int64(4)
    if data[at + 1] >= _LONG:
        octets += np.int64(data[at + 1]) & 0x7F
    if octets > 6:
        return _U(0), at, -1
    width = np.int64(data[at + octets - 1])
    rest = at + octets + width
    if rest > end:
        return _U(0), at, -1
    return part(data, at, octets), rest, unsigned(data, at + octets, width)


def follow(
    data: Any, at: Any, size: Any, channels: Any, devices: Any, classes: Any, pool: Any, entries: Any,
    steps: Any, moves: Any, scratch: Any, trail: Any, places: Any, counts: Any,
) -> Any:  # fmt: skip
    """Pass the messages that the tables know: the offset of the first that they do not, and why."""
    last, n, passed = counts[LAST], counts[STEPS], counts[PLACES]
    why = UNKNOWN
    while at < size:
        length = np.int64(word(data, at + 1))
        number = np.int64(data[at + 9]) | np.int64(data[at + 10]) << 8
        device, role = channels[number, DEVICE], channels[number, ROLE]
        begin, end = at + _DATA, at + _HEAD + length
        if data[at] != _MESSAGE or device < 0 or length < _DATA - _HEAD or end > size or end < at:
            break
        head, rest, invoke, relation = _U(NONE), begin, np.int64(-1), 0
        if devices[device, WHOLE] == 0 and data[begin] <= _ERROR:
            head, rest, invoke = parted(data, begin, end)
            if invoke < 0:
                break
            relation = relation_of(devices, device, invoke)
        known = class_of(classes, pool, head, role, data, rest, end - rest)
        if known == 0 or devices[device, STATE] < 0:
            break
        key = key_of(devices[device, STATE], known << 4 | relation)
        slot = slot_of(entries, key)
        if entries[slot, KEY] == 0:
            break
        time = np.int64(word(data, at + 15))
        if time < last:
            why = DISORDER
            break
        step = entries[slot, STEP]
        if steps[step, MOVING] != STAYS:
            move(moves, steps[step, MOVING], step, devices, device, scratch, invoke)
        devices[device, STATE] = steps[step, TARGET]
        devices[device, PENDING] += 1
        trail[n, 0], trail[n, 1], trail[n, 2] = step, at, device
        places[passed] = at
        last, n, passed, at = time, n + 1, passed + 1, end
    counts[LAST], counts[STEPS], counts[PLACES] = last, n, passed
    return at, why


def last_of_each(trail: Any, begin: Any, end: Any, device: Any, last: Any) -> None:
    """The offset of the last message of each step of a device, into ``last`` by step."""
    for n in range(begin, end):
        if trail[n, 2] == device:
            last[trail[n, 0]] = trail[n, 1]


def origin(trail: Any, steps: Any, sources: Any, begin: Any, end: Any, device: Any, place: Any) -> Any:
    """Where a mark of the present state comes from: an offset or -1, and its number before the trail."""
    for n in range(end - 1, begin - 1, -1):
        step = trail[n, 0]
        if trail[n, 2] == device and steps[step, TRACING] != STAYS:
            place = sources[step, place]
            if place < 0:
                return trail[n, 1], -1
    return -1, place


def put_class(classes: Any, pool: Any, head: Any, role: Any, at: Any, size: Any, number: Any) -> None:
    """Enter a class, the octets of which stand in the pool."""
    hashed = digest(head, role, pool, at, size)
    mask = _U(len(classes) - 1)
    slot = (hashed >> _U(8)) & mask
    while classes[slot, HASH] != 0:
        slot = (slot + _U(1)) & mask
    classes[slot, HASH], classes[slot, HEAD] = np.int64(hashed), np.int64(head)
    classes[slot, PART], classes[slot, AT], classes[slot, SIZE] = role, at, size
    classes[slot, NUMBER] = number


def put_step(entries: Any, state: Any, event: Any, step: Any) -> None:
    """Enter a step by the state and the event."""
    key = key_of(state, event)
    slot = slot_of(entries, key)
    entries[slot, KEY], entries[slot, STEP] = key, step
