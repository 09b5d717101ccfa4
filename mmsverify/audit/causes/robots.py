"""The account of findings of one robot: grounds and edits, out of its conversation."""

from __future__ import annotations

from collections.abc import Sequence

from mmsverify.audit.causes import edits
from mmsverify.audit.causes.brief import brief
from mmsverify.audit.causes.conversation import conversation, recorded, spread_out
from mmsverify.audit.causes.mending import Mended, mend
from mmsverify.audit.causes.retelling import Retelling, Setting, names_of
from mmsverify.audit.causes.robot_case import Case
from mmsverify.audit.parts import Parts
from mmsverify.formats.trace import TraceMessage
from mmsverify.results import Account, Edit, Evidence, Finding, Ground, Statement

MOST_SETS = 5
"""So many sets that exclude the event are looked for."""
LARGEST_OTHER = 2
"""A further set is told only if it is no larger: of a heap of messages nobody learns anything."""
FOR_EDITS = 300
"""Steps that are worked out at most."""
TOO_LONG = "the search for what excludes it was broken off: fewer messages might do"
NOT_ALL_TRIED = "not all edits could be tried"
NO_EDIT = "no single message, changed, put in or left out, would make this conversation legal"


class Robots:
    """Tells of the findings in one stretch of a robot's conversation.

    ``arms`` are the predefined program invocations of arms; ``whole``: nothing of it was said before.
    """

    def __init__(
        self,
        parts: Parts,
        setting: Setting,
        messages: Sequence[TraceMessage],
        arms: Sequence[str],
        *,
        whole: bool,
    ) -> None:
        self._talk = conversation(messages)
        self._arms = arms
        said = (message.metadata.get("association") for message in messages)
        self._associations = {name for name in said if name is not None}
        blind = [(spread_out(first), spread_out(last)) for first, last in setting.blind]
        spaced = Setting(setting.place, setting.base_only, (*blind, *(() if whole else self._unheard())))
        names = names_of(parts, spaced, self._talk.messages)
        self._retelling = Retelling(parts, spaced, names)

    def _unheard(self) -> list[tuple[int, int]]:
        """Where the stretch begins with answers to requests that came before it."""
        begin = self._talk.messages[0].index
        answers = [
            self._talk.messages[turn.at].index
            for turn in self._talk.turns
            if len(turn.positions) == 1 and self._talk.answers_nothing(turn.at)
        ]
        return [(begin, max(answers))] if answers else []

    def account(self, finding: Finding, statements: tuple[Statement, ...]) -> Account | None:
        """Why the finding stands; ``None`` where it does not come of this stretch alone."""
        case = Case(finding, self._talk, self._retelling)
        self._retelling.allow(None)
        if not case.listen():
            return None
        sets = case.evidence(MOST_SETS)
        sets = sorted(
            sets[:1] + [s for s in sets[1:] if len(s.turns) <= LARGEST_OTHER], key=lambda s: len(s.turns)
        )
        self._retelling.allow(FOR_EDITS)
        mended = mend(case, [turn for each in sets for turn in each.turns], self._arms)
        request = self._talk.request(case.event)
        return Account(
            finding=finding,
            event=self._words(case.event),
            asked=None if request is None else self._index(request),
            statements=statements,
            grounds=tuple(Ground(tuple(map(self._evidence, s.turns)), s.irreducible) for s in sets),
            right=None if mended.right is None else self._edit(mended.right),
            later=mended.then,
            edits=tuple(map(self._edit, mended.edits)),
            remarks=tuple(_remarks([s.irreducible for s in sets], mended)),
        )

    def _index(self, position: int) -> int:
        return recorded(self._talk.messages[position].index)

    def _words(self, position: int) -> str:
        """The message, with the association where there are several."""
        request = self._talk.request(position)
        asked = None if request is None else self._talk.pdus[request]
        told = brief(self._talk.pdus[position], asked)
        name = self._talk.messages[position].metadata.get("association", "")
        return f"{told} ({name})" if len(self._associations) > 1 else told

    def _evidence(self, turn: int) -> Evidence:
        at = self._talk.turns[turn].at
        request = self._talk.request(at)
        return Evidence(self._index(at), self._words(at), None if request is None else self._index(request))

    def _edit(self, edit: edits.Edit) -> Edit:
        said = () if edit.kind == "drop" else tuple((each.topic, each.data) for each in edit.said)
        with_request = edit.kind == "change" or (edit.kind == "drop" and edit.begin < edit.at)
        request = self._talk.request(edit.at) if with_request else None
        asked = None if request is None else self._index(request)
        return Edit(edit.kind, self._index(edit.at), edit.words, said, asked)


def _remarks(irreducible: Sequence[bool], mended: Mended) -> list[str]:
    found = [] if all(irreducible) else [TOO_LONG]
    if mended.spent:
        found.append(NOT_ALL_TRIED)
    elif not mended.edits:
        found.append(NO_EDIT)
    return found
