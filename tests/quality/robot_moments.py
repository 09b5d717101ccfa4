"""Short conversations in which a robot that lives by other rows would act otherwise than a right one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from mutant_recordings import judged
from mutation import Mutant
from robot_acts import Act
from robot_retelling import retold, shrunk
from robot_talk import Taken, Talk, row_name

from mmsverify.concrete.evaluate import step
from mmsverify.model import ModelData

SHORT = 16
"""Conversations of so many acts are not cut down further."""
REQUESTED = ("ask", "perform")


class Hunt:
    """Looks in walks for the moments at which mutants of one model differ from it."""

    def __init__(self, model: ModelData, walks: Sequence[Talk]) -> None:
        self.model = model
        self.walks = walks
        self._steps: dict[str, list[tuple[int, Talk, Taken]]] = {}
        for talk in walks:
            for taken in talk.taken:
                if taken.act < len(talk.done):
                    end = end_of(talk, taken.act)
                    self._steps.setdefault(taken.row.name, []).append((end, talk, taken))
        for found in self._steps.values():
            found.sort(key=lambda step: step[0])

    def moments(self, mutant: Mutant, most: int) -> Iterator[Talk]:
        """Conversations whose last act the mutant would do otherwise, each cut down, one of a walk."""
        differs = self.differing(mutant)
        seen: list[Talk] = []
        names = {self.model.rows[n].name for n in mutant.rows}
        for end, talk, taken in (found for name in names for found in self._steps.get(name, ())):
            if not any(talk is other for other in seen) and differs(taken):
                seen.append(talk)
                short = retold(talk, talk.done[: end + 1])
                yield short if end < SHORT else shrunk(short, lambda t: self._at_last(t, differs))
            if len(seen) == most:
                return

    def _at_last(self, talk: Talk, differs: Callable[[Taken], bool]) -> bool:
        if not talk.done or talk.pending or not talk.open:
            return False
        begin = beginning_of_last(talk)
        return any(taken.act >= begin and differs(taken) for taken in talk.taken)

    def differing(self, mutant: Mutant) -> Callable[[Taken], bool]:
        """Whether the mutant would take another step in the same situation."""
        names = {self.model.rows[n].name for n in mutant.rows}
        changed = mutant.applied(self.model)
        theirs = [row for row in changed.rows if row.name in names]

        def differs(taken: Taken) -> bool:
            if taken.row.name not in names:
                return False
            made = [
                (row.answer, step(row, taken.bindings, taken.before, taken.scope))
                for row in theirs
                if all(p.name in taken.bindings for p in row.parameters)
            ]
            return (taken.row.answer, taken.after) not in made or any(
                after is not None and (answer, after) != (taken.row.answer, taken.after)
                for answer, after in made
            )

        return differs


def end_of(talk: Talk, act: int) -> int:
    """The number of the act that shows what this act does: the answer, where it belongs to a request."""
    if talk.done[act].kind not in REQUESTED:
        return act
    slot = talk.done[act].who
    later = range(act, len(talk.done))
    return next((i for i in later if talk.done[i].kind == "answer" and talk.done[i].who == slot), act)


def beginning_of_last(talk: Talk) -> int:
    """Where the last thing that happens begins: a request, or something unasked."""
    if talk.done[-1].kind == "answer":
        slot = talk.done[-1].who
        return max(i for i, act in enumerate(talk.done) if act.kind == "ask" and act.who == slot)
    return len(talk.done) - 1


def seen(talk: Talk, model: ModelData | None = None) -> Talk:
    """The same with everything shown before the last act and after it.

    With ``model``, the last act is that of a robot that lives by other rows.
    """
    begin = beginning_of_last(talk)
    made = retold(talk, talk.done[:begin])
    if made.open:
        made.look_round(made.open[0])
    if model is not None:
        made.become(model)
    for act in talk.done[begin:]:
        if not made.do(act) and act.kind == "perform":
            _otherwise(made, act)
    if made.open:
        made.look_round(made.open[0])
    return made


def _otherwise(talk: Talk, act: Act) -> None:
    """The robot decides by whichever of its rows it can take."""
    if act.who not in talk.pending:
        return
    request = talk.pending[act.who]
    for row in talk.rows("response", request.service):
        known = {**act.given, **talk.bindings(row, request.asked)}
        free = {p.name: talk.scope.parameter_values(row, p)[0] for p in row.parameters if p.name not in known}
        if talk.do(Act("perform", act.who, row_name(row), {**free, **act.given})):
            return


def found_by_audit(model: ModelData, mutant: Mutant, hunt: Hunt, folder: Path, most: int = 3) -> str:
    """How a recording tells the mutant from the model: what the audit finds; empty if no recording does."""
    changed = mutant.applied(model)
    for talk in hunt.moments(mutant, most):
        right = seen(talk)
        path = right.write(folder / "right.mcap")
        other = seen(talk, changed)
        if other.messages != right.messages:
            accused = judged(other.write(folder / "mutant.mcap"), model)
            if accused:
                return f"its robot is accused: {accused[0][1]}"
        accused = judged(path, changed)
        if accused != judged(path, model):
            return f"a right robot is accused by it: {accused[0][1] if accused else ''}"
    return ""
