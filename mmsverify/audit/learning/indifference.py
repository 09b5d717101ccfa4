"""Whether a step depends on values that are left out: the device takes it once more, and knows none of them.

The second time it has a history of its own. All else that its states share it may use: nothing in it is kept
by a value that nobody may look at.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

from mmsverify.audit.learning.leaves import Opaque, Span, read
from mmsverify.audit.learning.part import Judge, P
from mmsverify.audit.learning.snapshots import Mark, Own, Snapshot
from mmsverify.audit.learning.tables import State, Tables
from mmsverify.audit.telling import History
from mmsverify.formats.trace import TraceMessage


def attempt(
    tables: Tables, own: Own, state: State, marks: Sequence[Mark], message: TraceMessage,
    spans: Mapping[Span, str], judge: Judge[P],
) -> P:  # fmt: skip
    """The device after the message, whatever the values in ``spans`` are, and those left out of the state.

    Raises `TouchedError` for one of them that matters. Nothing that is told is given back.
    """
    part: P = tables.snapshots.put_back(state.octets, marks, {**own, History: History()}, Opaque)
    for _ in judge(part, message, partial(read, spans=spans, make=Opaque)):
        pass
    part.settle()
    return part


def compared(tables: Tables, part: P, own: Own) -> tuple[bytes, tuple[int, ...]]:
    """What two devices must have in common, if one has done without values what the other did with them."""
    taken: Snapshot = tables.snapshots.compare(part, {**own, History: part.history})
    return taken.octets, taken.order
