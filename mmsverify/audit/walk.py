"""From message to message of a stretch by what was learned, as long as it is known: the quick way.

Nearly all that is done in a long audit is done here, so one function does it all, with what it looks up at
hand. It takes the usual form of a PDU only; whatever is otherwise is left to who called.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping

from mmsverify.audit.classes import ERROR
from mmsverify.audit.learned import Listener
from mmsverify.audit.tables import NEW, PRESENT
from mmsverify.formats import mcap_records as rec
from mmsverify.formats.stretch import DisorderError, Stretch

# The head of a message record, and of a PDU: its first octet, its length, then of the invokeID the first
# octet, the length and the first octet of its number.
_HEAD = struct.Struct("<BQHIQQBBBBB")
_DATA = rec.MESSAGE_HEAD.size
_SHORT = 0x80  # from here on the octet of a length says how many octets hold it


def follow(stretch: Stretch, at: int, listeners: Mapping[int, Listener | None]) -> int:
    """Pass the messages from ``at`` on that the tables know; the offset of the first that they do not.

    ``listeners`` by number of the channel.
    """
    data, size, last = stretch.data, stretch.size, stretch.last
    head, passed = _HEAD.unpack_from, stretch.places.append
    current = -1
    learned = state = None
    while at < size:
        opcode, length, number, _, time, _, kind, short, _, width, first = head(data, at)
        if number != current or learned is None:
            if learned is not None:
                learned.state, learned.invokes = state, invokes
            listener = listeners.get(number)
            learned = None
            if listener is None:
                break
            learned, classes, whole, current = listener.learned, listener.classes, listener.whole, number
            state, invokes = learned.state, learned.invokes
            step_taken, placed = learned.trail.append, learned.places.append
        begin, end = at + _DATA, at + rec.HEAD.size + length
        if state is None or opcode != rec.MESSAGE or end > size:
            break
        relation = NEW
        if whole or kind > ERROR:
            rest = data[begin:end]
        else:
            body = begin + 4 + width
            # A number that is negative or longer than it need be is not what the others of its class are.
            if (
                short >= _SHORT
                or body > end
                or first >= _SHORT
                or (not first and width > 1 and data[begin + 5] < _SHORT)
            ):
                break
            rest = data[begin : begin + 4] + data[body:end]
            if invokes:
                invoke = first if width == 1 else int.from_bytes(data[begin + 4 : body])
                if invoke in invokes:
                    # The last of them, should two sides use the same.
                    relation = len(invokes) - 1 - invokes[::-1].index(invoke)
        known = classes.get(rest)
        step = state.steps.get(known << 4 | relation + 1) if known is not None else None
        if step is None:
            break
        if time < last:
            raise DisorderError
        last = time
        moves = step.moves
        if moves is not None:
            if not moves:
                invokes = ()
            else:
                invoke = first if width == 1 else int.from_bytes(data[begin + 4 : begin + 4 + width])
                invokes = tuple([invoke if m == PRESENT else invokes[m] for m in moves])
        state = step.target
        step_taken(step)
        placed(at)
        passed(at)
        at = end
    if learned is not None:
        learned.state, learned.invokes = state, invokes
    stretch.last = last
    return at
