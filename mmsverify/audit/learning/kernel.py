"""The quick way through a stretch by compiled loops (extra ``fast``): the same as `walk`, many times as fast.

The loops pass what the arrays know. Where they stop at something that the tables know, it is entered, and
they go on; at all else, whoever called goes on.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from mmsverify.audit.learning import kernel_loops as loops
from mmsverify.audit.learning.classes import ERROR
from mmsverify.audit.learning.learned import Learned, Listener
from mmsverify.audit.learning.mirror import DEVICES, Arrays, Mirror
from mmsverify.audit.learning.tables import Step, event
from mmsverify.audit.learning.trail import ListedTrail, Origin
from mmsverify.audit.learning.walk import Walk
from mmsverify.formats import mcap_records as rec
from mmsverify.formats.stretch import DisorderError, Stretch

_LATEST = 1 << 62  # ns; times beyond are not counted by the loops
_LONGEST = 0x82  # the first octet of a length, of those that the loops read
_TRIED, _WORTH = 64, 8
"""Where so many were not known, so many must have been passed for each, or the loops are not worth it."""
_AGAIN = 3  # stretches, and then it is tried again


class Kernel:
    """Follows the messages of stretches by the compiled loops, as `Walk` does."""

    def __init__(self, mirror: Mirror) -> None:
        self._mirror = mirror
        mirror.arrays.channels[:, loops.DEVICE] = -1
        self._walk = Walk()
        self._devices: list[Learned[Any]] = []
        self._listeners: dict[int, Listener] = {}
        self._known: object = None
        self._stretch: Stretch | None = None
        self._walking = 0
        self._missed = self._passed = 0

    def start(self, stretch: Stretch) -> None:
        """As `Walk.start`."""
        walked = self._walking > 0
        if self._walking > 0:
            self._walking -= 1
        self._missed = self._passed = 0
        if stretch.known is not self._known or (self._walking > 0) != walked:
            self._begin_anew()
        self._known, self._stretch = stretch.known, stretch
        if not self._walking:
            arrays = self._mirror.room(stretch.size // rec.MESSAGE_HEAD.size + 1)
            arrays.counts[:] = 0, min(stretch.last, _LATEST)
            stretch.places = _Places(arrays)
            for number, learned in enumerate(self._devices):
                learned.trail = KernelTrail(self._mirror, number)

    def _begin_anew(self) -> None:
        for learned in self._devices:
            learned.trail = ListedTrail()
        self._devices.clear()
        self.begin()

    def begin(self) -> None:
        """As `Walk.begin`."""
        self._walk.begin()
        self._mirror.arrays.channels[list(self._listeners), loops.DEVICE] = -1
        self._listeners.clear()

    def route(self, number: int, listener: Listener) -> None:
        """As `Walk.route`."""
        self._walk.route(number, listener)
        if self._walking or self._listeners.get(number) is listener:
            return
        learned = listener.learned
        if learned not in self._devices:
            if len(self._devices) == DEVICES:
                return
            if self._stretch is not None:  # it may have heard of a link already
                learned.catch_up(self._stretch)
            learned.trail = KernelTrail(self._mirror, len(self._devices))
            self._devices.append(learned)
        device, arrays = self._devices.index(learned), self._mirror.arrays
        arrays.channels[number] = device, self._mirror.role(listener)
        arrays.devices[device, loops.WHOLE] = listener.whole
        self._listeners[number] = listener

    def follow(self, stretch: Stretch, at: int) -> int:
        """As `Walk.follow`."""
        if self._walking:
            return self._walk.follow(stretch, at)
        if stretch.last > _LATEST:
            return self._give_up(stretch, at)
        if self._mirror.full or any(self._mirror.stale(each.tables) for each in self._devices):
            self._anew(stretch)
        self._give(stretch)
        while True:
            at, why = self._mirror.follow(stretch.data, at)
            self._take(stretch)
            if why == loops.DISORDER:
                raise DisorderError
            if at >= stretch.size:
                return at
            if not self._teach(stretch, at):
                self._missed += 1
                hopeless = self._missed > _TRIED and self._passed < _WORTH * self._missed
                return self._give_up(stretch, at) if hopeless else at
            self._give(stretch)

    def _give_up(self, stretch: Stretch, at: int) -> int:
        """Go on without the loops, for a while: too often they stop."""
        for learned in self._devices:
            learned.catch_up(stretch)
            learned.trail = ListedTrail()
        self._devices.clear()
        self._mirror.arrays.channels[list(self._listeners), loops.DEVICE] = -1
        self._listeners.clear()
        self._walking = _AGAIN
        return self._walk.follow(stretch, at)

    def _anew(self, stretch: Stretch) -> None:
        """Fill the arrays anew, after all that they led to has been written down."""
        for learned in self._devices:
            learned.catch_up(stretch)
        old = self._mirror.arrays
        self._mirror.clear()
        kept = {"trail": old.trail, "places": old.places, "counts": old.counts}
        self._mirror.arrays = self._mirror.arrays._replace(**kept)
        listeners = dict(self._listeners)
        self._listeners.clear()
        for number, listener in listeners.items():
            self.route(number, listener)

    def _give(self, stretch: Stretch) -> None:
        """Where the devices are."""
        arrays = self._mirror.arrays
        arrays.counts[loops.LAST] = stretch.last
        for own, learned in zip(arrays.devices, self._devices, strict=False):
            own[loops.STATE] = -1 if learned.state is None else self._mirror.state(learned.state)
            own[loops.COUNT] = len(learned.invokes)
            own[loops.LATEST] = -1
            own[loops.INVOKES : loops.INVOKES + len(learned.invokes)] = learned.invokes

    def _take(self, stretch: Stretch) -> None:
        """Where the devices are after the loops."""
        arrays = self._mirror.arrays
        self._passed = int(arrays.counts[loops.PASSED])
        stretch.last = int(arrays.counts[loops.LAST])
        for own, learned in zip(arrays.devices, self._devices, strict=False):
            if own[loops.STATE] >= 0:
                learned.state = self._mirror.states[own[loops.STATE]]
                end = loops.INVOKES + own[loops.COUNT]
                learned.invokes = tuple(own[loops.INVOKES : end].tolist())

    def _teach(self, stretch: Stretch, at: int) -> bool:
        """Enter the step that the tables know for the message at which the loops have stopped."""
        opcode, end = stretch.record(at)
        listener = self._listeners.get(stretch.number(at))
        if opcode != rec.MESSAGE or end > stretch.size or listener is None:
            return False
        parts, learned = listener.split(stretch.data[at + rec.MESSAGE_HEAD.size : end]), listener.learned
        number = None if parts is None else listener.classes.get(parts[0])
        if learned.state is None or parts is None or number is None or self._mirror.full:
            return False
        if not listener.whole and parts[0][0] <= ERROR and parts[0][1] > _LONGEST:
            return False
        happens = event(number, learned.relation(parts[1]))
        step = learned.state.steps.get(happens)
        return step is not None and self._mirror.enter(listener, parts[0], learned.state, happens, step)


class KernelTrail:
    """The trail of one device, in the arrays."""

    def __init__(self, mirror: Mirror, device: int) -> None:
        self._mirror, self._device, self._begin = mirror, device, 0
        self.clear()

    def __bool__(self) -> bool:
        return bool(self._mirror.arrays.devices[self._device, loops.PENDING])

    def append(self, step: Step, at: int) -> None:
        """As `Trail`; the message is the last one passed."""
        arrays, number = self._mirror.arrays, self._end - 1
        assert arrays.places[number] == at
        self._begin = min(self._begin, number)
        arrays.trail[number] = self._mirror.step(step) << 8 | self._device
        arrays.devices[self._device, loops.PENDING] += 1

    def last_written(self, stretch: Stretch) -> Iterable[tuple[Step, int]]:  # noqa: ARG002
        """As `Trail`."""
        steps, a = self._mirror.steps, self._mirror.arrays
        last = np.full(len(steps), -1, "i8")
        self._mirror.code.last_of_each(a.trail, self._begin, self._end, self._device, last)
        found = np.flatnonzero(last >= 0).tolist()
        return [(steps[number], int(last[number])) for number in found if steps[number].wrote]

    def origin(self, place: int, stretch: Stretch) -> Origin:  # noqa: ARG002
        """As `Trail`."""
        a, ends = self._mirror.arrays, (self._begin, self._end)
        passed, place = self._mirror.code.origin(a.trail, a.steps, a.sources, *ends, self._device, place)
        return (None if passed < 0 else int(passed)), int(place)

    def clear(self) -> None:
        """As `Trail`."""
        self._begin = self._end
        self._mirror.arrays.devices[self._device, loops.PENDING] = 0

    @property
    def _end(self) -> int:
        return int(self._mirror.arrays.counts[loops.PASSED])


class _Places:
    """The offsets of the messages of a stretch, in the arrays; one that is added was not followed."""

    def __init__(self, arrays: Arrays) -> None:
        self._arrays = arrays

    def append(self, at: int, /) -> None:
        number = len(self)
        self._arrays.places[number], self._arrays.trail[number] = at, -1
        self._arrays.counts[loops.PASSED] += 1

    def __len__(self) -> int:
        return int(self._arrays.counts[loops.PASSED])

    def __getitem__(self, number: int, /) -> int:
        return int(self._arrays.places[range(len(self))[number]])
