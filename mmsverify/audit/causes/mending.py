"""The nearest legal conversation: one message changed, one service put in or left out.

Each candidate is told, together with what was said after it: it is legal if the event then goes without a
finding, what was said otherwise has none itself, and none comes with the messages that follow.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain

from mmsverify.audit.causes.edits import (
    Edit,
    agreed,
    answered,
    asked_for,
    changed,
    dropped,
    inserted,
    programs,
    statuses,
)
from mmsverify.audit.causes.retelling import SpentError
from mmsverify.audit.causes.robot_case import Case

AFTER = 30
"""So many messages after the event must go without a new finding, or until all is as it was."""


@dataclass(frozen=True, slots=True)
class Mended:
    """``right`` is what would have been legal at the event, ``then`` the later messages that contradict it.

    ``edits`` make the whole legal: of each kind the first that does. ``spent``: not all could be tried.
    """

    right: Edit | None
    then: tuple[int, ...]
    edits: tuple[Edit, ...]
    spent: bool


def mend(case: Case, turns: Iterable[int], arms: Sequence[str]) -> Mended:
    """What would have been legal; ``turns`` exclude the event, ``arms`` are as for ``inserted``."""
    talk, event = case.talk, case.event
    search = _Search(case)
    earlier = (edit for turn in sorted(turns, reverse=True) for edit in _earlier(case, turn))
    kinds: list[Iterator[Edit]] = [
        changed(talk, event, case.finding.expected),
        chain(
            asked_for(talk, event),
            answered(talk, event),
            inserted(talk, event, programs(talk, case.finding), arms),
            statuses(talk, event),
        ),
        earlier,
        dropped(talk, event),
    ]
    edits = [edit for kind in kinds if (edit := search.first(kind)) is not None]
    right, then = search.right or (None, ())
    return Mended(right, then, tuple(edits), search.spent)


def _earlier(case: Case, turn: int) -> Iterator[Edit]:
    """What a turn that excludes the event might have said instead."""
    talk = case.talk
    yield from changed(talk, talk.turns[turn].at, ())
    pdu, request = talk.pdus[case.event], talk.request(case.event)
    asked = talk.pdus[request] if request is not None else pdu
    if asked is not None and asked.service:
        yield from agreed(talk, turn, asked.service)


@dataclass(slots=True)
class _Search:
    case: Case
    right: tuple[Edit, tuple[int, ...]] | None = None
    spent: bool = False

    def first(self, candidates: Iterable[Edit]) -> Edit | None:
        """The first candidate that makes the conversation legal."""
        try:
            for edit in candidates:
                legal, later = self.case.instead(edit, AFTER)
                if legal and edit.at == self.case.event and edit.kind == "change" and self.right is None:
                    self.right = edit, tuple(later)
                if legal and not later:
                    return edit
        except SpentError:
            self.spent = True
        return None
