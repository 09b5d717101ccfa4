"""From message to message of a stretch by what was learned, as long as it is known: the quick way.

Nearly all that is done in a long audit is done here, so one function does it all, with what it looks up at
hand. It takes the usual forms of a PDU only; whatever is otherwise is left to who called.
"""

from __future__ import annotations

import struct
from typing import Any

from mmsverify.audit.learning.classes import ERROR, Classes, split
from mmsverify.audit.learning.learned import Learned, Listener
from mmsverify.audit.learning.tables import NEW, PRESENT
from mmsverify.audit.learning.trail import ListedTrail
from mmsverify.formats import mcap_records as rec
from mmsverify.formats.stretch import DisorderError, Stretch

# Of a message record: opcode, length, channel, log time; of the PDU in it: its first octet, its length; of
# the invokeID that stands first in it: its length and its first octet.
_HEAD = struct.Struct("<BQH4xQ8xBBxBB")
_DATA = rec.MESSAGE_HEAD.size
_NUMBER = _DATA + 4  # where the number of a usual invokeID begins
_LONG = 0x80  # from here on the octet of a length says how many octets hold it
_NEGATIVE = 0x80
_NONE = -1  # where there is no invokeID


class Walk:
    """Follows the messages of stretches by the tables."""

    def __init__(self) -> None:
        self._known: object = None
        self._routes: dict[int, tuple[Listener, dict[int, Classes]]] = {}
        self._of: dict[int, dict[int, Classes]] = {}

    def start(self, stretch: Stretch) -> None:
        """A stretch begins; where the channels are those of the one before, whose they are is still known."""
        if stretch.known is not self._known:
            self.begin()
        self._known = stretch.known

    def begin(self) -> None:
        """Forget whose the channels are: their numbers may mean others from here on."""
        self._routes.clear()
        self._of.clear()

    def route(self, number: int, listener: Listener) -> None:
        """The messages on the channel of that number are the listener's."""
        of = self._of.setdefault(id(listener.learned), {})
        of[number] = listener.classes
        self._routes[number] = listener, of

    def follow(self, stretch: Stretch, at: int) -> int:
        """Pass the messages from ``at`` on that the tables know; the offset of the first that they do not.

        Raises ``DisorderError`` where one is older than the one before.
        """
        before = -1
        while before < at < stretch.size:
            before = at
            route = self._routes.get(stretch.number(at))
            if route is not None:
                listener, classes = route
                at = _follow(stretch, at, listener.learned, classes, whole=listener.whole)
        return at


def _follow(
    stretch: Stretch, at: int, learned: Learned[Any], routes: dict[int, Classes], *, whole: bool
) -> int:
    """Pass the messages of one device, until there is another's."""
    state, invokes, trail = learned.state, learned.invokes, learned.trail
    if state is None:
        return at
    assert isinstance(trail, ListedTrail)
    data, size, last, head = stretch.data, stretch.size, stretch.last, _HEAD.unpack_from
    step_taken, placed, passed = trail.steps.append, trail.places.append, stretch.places.append
    while at + _HEAD.size <= size:
        opcode, length, number, time, kind, short, width, first = head(data, at)
        end = at + rec.HEAD.size + length
        classes = routes.get(number)
        if classes is None or opcode != rec.MESSAGE or end > size:
            break
        body, relation = at + _NUMBER + width, NEW
        if whole or kind > ERROR:
            rest, invoke = data[at + _DATA : end], _NONE
        elif 0 < first < _NEGATIVE and short < _LONG and body <= end:
            invoke = first if width == 1 else int.from_bytes(data[at + _NUMBER : body])
            rest = data[at + _DATA : at + _NUMBER] + data[body:end]
        elif (parts := split(data[at + _DATA : end])) is not None:
            rest, invoke = parts[0], _NONE if parts[1] is None else parts[1]
        else:
            break
        if invoke in invokes:  # the last of them, should two sides use the same
            relation = len(invokes) - 1 - invokes[::-1].index(invoke)
        known = classes.get(rest) or classes.find(rest)
        step = None if known is None else state.steps.get(known << 4 | relation + 1)
        if step is None:
            break
        if time < last:
            raise DisorderError
        if step.moves is not None:
            invokes = tuple([invoke if move == PRESENT else invokes[move] for move in step.moves])
        state, last = step.target, time
        step_taken(step)
        placed(at)
        passed(at)
        at = end
    learned.state, learned.invokes, stretch.last = state, invokes, last
    return at
