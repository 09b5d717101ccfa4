"""Findings of one device: from what a belief or a rule says to what the results hold.

Who wrote a cell of the belief is kept here, so that a finding can point to it; what was told is not told
again with every poll.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from mmsverify.audit.rules import RULES, Breach, Rule
from mmsverify.audit.words import title
from mmsverify.concrete.belief import Blame, Outcome
from mmsverify.concrete.belief.partial import Key
from mmsverify.formats.trace import TraceMessage
from mmsverify.results import Finding

WINDOW = 200


@dataclass(frozen=True, slots=True)
class Place:
    """Where a finding belongs."""

    path: str
    vmd: str


def of_rule(place: Place, message: TraceMessage, rule: Rule, breach: Breach) -> Finding:
    """The breach of a rule by a message, as a finding."""
    cited = breach.clause + rule.clause if breach.clause is not None else rule.clause
    return Finding(
        path=place.path, vmd=place.vmd,
        index=message.index, time=message.time, topic=message.topic,
        severity=rule.severity, rule=rule.id, clauses=cited.ids, readings=cited.readings,
        message=rule.says.format(**breach.words),
        expected=breach.expects or tuple(each.format(**breach.words) for each in rule.expects),
        observed=rule.observed.format(**breach.words),
        related=breach.related,
    )  # fmt: skip


class History:
    """Who wrote each cell of a device's belief last, and what was told of it lately."""

    def __init__(self) -> None:
        self.writers: dict[Key, tuple[int, tuple[str, ...]]] = {}
        self.recent: dict[Any, int] = {}
        self._own: dict[Key, tuple[str, ...]] = {}

    def write(self, key: Key, index: int, own: tuple[str, ...]) -> None:
        """The message at ``index`` wrote a cell, by these clauses; by none: those of before still hold."""
        at, made = self.writers.get(key, (-1, ()))
        self._own[key] = own or (self._own[key] if at == index else ())
        self.writers[key] = index, own or made

    def written_at(self, index: int) -> dict[Key, tuple[str, ...]]:
        """The cells that the message at ``index`` wrote, each with the clauses of its own."""
        return {key: self._own[key] for key, (at, _) in self.writers.items() if at == index}

    def told_at(self, index: int) -> bool:
        """Whether something was told of the message at ``index``, or would have been if it were not known."""
        return any(at == index for at in self.recent.values())

    def write_down(self, steps: Iterable[tuple[Mapping[Key, tuple[str, ...]], int]]) -> None:
        """What earlier messages wrote: the cells, and the index of each message.

        Of messages that did the same the last one is enough: where clauses of before still hold, they are
        those of the last one that had any.
        """
        for wrote, index in sorted(steps, key=lambda step: step[1]):
            for key, own in wrote.items():
                if self.writers.get(key, (-1, ()))[0] < index:
                    self.write(key, index, own)


class Telling:
    """What is told of one device, and what has been told of it."""

    def __init__(self, place: Place, history: History | None = None) -> None:
        self.place = place
        self.history = history or History()

    def outcome(
        self,
        message: TraceMessage,
        service: str,
        answer: str,
        outcome: Outcome,
        related: tuple[int, ...] = (),
    ) -> Iterator[Finding]:
        """What the belief says of ``service`` with ``answer``; without an answer, of what a message shows."""
        blame = outcome.blame
        shown = service if not answer else None
        if blame is not None and not self._repeated(
            message, (blame.rule, blame.says, blame.clause, shown), told_again=shown is None
        ):
            yield self._finding(message, service, answer, blame, related)
        for key in outcome.written:
            self.history.write(key, message.index, outcome.clauses.get(key[0], ()))

    def _repeated(self, message: TraceMessage, key: Any, *, told_again: bool) -> bool:
        """Whether it was told shortly before: a contradiction that every poll repeats is one finding."""
        last = self.history.recent.get(key)
        self.history.recent[key] = message.index
        return not told_again and last is not None and message.index - last <= WINDOW

    def _finding(
        self, message: TraceMessage, service: str, answer: str, blame: Blame, related: tuple[int, ...]
    ) -> Finding:
        wrote = [self.history.writers[key] for key in sorted(blame.reads) if key in self.history.writers]
        writers = {index for index, _ in wrote}
        # What a message contradicts was established by the step that last wrote it: that step is cited, too.
        made = () if answer else tuple(clause for _, clauses in wrote for clause in clauses)
        observed = f"{title(service)} answered {answer}" if answer else f"{title(service)} shows"
        says = f"{observed}, but {blame.says}" if answer else f"{title(service)}: {blame.says}"
        return Finding(
            path=self.place.path, vmd=self.place.vmd,
            index=message.index, time=message.time, topic=message.topic,
            severity="error" if blame.level == "error" else "warning", rule=blame.rule,
            clauses=tuple(dict.fromkeys((*blame.clause.ids, *made))), message=says,
            expected=blame.expected, observed=answer or blame.observed or "shown", before=blame.before,
            related=tuple(sorted(({*related, *writers}) - {message.index})), readings=blame.clause.readings,
        )  # fmt: skip

    def withhold(self, message: TraceMessage, breaches: Iterable[Breach]) -> tuple[Breach, ...]:
        """Nothing: the model has told of the message already, and the next poll need not add to it."""
        for breach in breaches:
            rule = RULES[breach.rule]
            self._repeated(message, (rule.id, rule.says.format(**breach.words)), told_again=False)
        return ()

    def breach(self, message: TraceMessage, breach: Breach) -> Iterator[Finding]:
        """The breach of a rule, as a finding; none where it has just been told."""
        rule = RULES[breach.rule]
        said = rule.says.format(**breach.words)
        if self._repeated(message, (rule.id, said), told_again=not rule.shown):
            return
        yield of_rule(self.place, breach.at or message, rule, breach)
