"""One event enrollment: whether the cause of its condition may have occurred, or certainly has.

A cause *may* have occurred once some run that agrees with the messages shows it: then a notification is
founded. It *certainly* has where every run shows it: a message brought about, or showed, that it was still to
come, and a later one that it had come. In between, nothing is said.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from mmsverify.concrete.belief import Belief
from mmsverify.concrete.belief.partial import Partial
from mmsverify.concrete.belief.values import EITHER, NO, YES
from mmsverify.formats.trace import TraceMessage
from mmsverify.model import Occurrence, Row

LARGEST_WATCH = 30
"""So many instants are kept that an action's result may show; after more, it is not judged."""


@dataclass(slots=True)
class Cause:
    """One occurrence as it comes about, from message to message.

    ``just_now``: it has certainly occurred by what the last message brought about, and cannot have before.
    """

    occurrence: Occurrence
    to_come: bool = False
    come: bool = False
    surely_to_come: bool = False
    just_now: bool = False
    _earlier: int = EITHER
    _states: list[Partial] = field(default_factory=list)

    def begin(self, belief: Belief) -> None:
        """From now on it counts."""
        self._earlier = belief.says(self.occurrence.before)
        self.to_come, self.come, self.surely_to_come = bool(self._earlier & YES), False, False

    def doubt(self) -> None:
        """Messages may be missing: it may have occurred, but not certainly."""
        self.to_come, self.come, self.surely_to_come, self._earlier = True, True, False, EITHER

    def note(self, belief: Belief) -> bool:
        """After a message: whether it shows that the cause has certainly occurred."""
        if belief.states is self._states:
            return False
        self._states = belief.states
        now, then = belief.says(self.occurrence.before), belief.says(self.occurrence.after)
        self.come = self.come or (self.to_come and bool(then & YES))
        # What somebody at the panel may have begun counts, though no state of the belief says so yet.
        self.to_come = self.to_come or bool(now & YES) or belief.attains(self._side(before=True))
        if now == YES and (self._earlier == NO or belief.shown_alone(self.occurrence.before)):
            self.surely_to_come = True
        self._earlier = now
        occurred = self.surely_to_come and now == NO and then == YES
        self.surely_to_come = self.surely_to_come and not occurred
        self.just_now = occurred and not belief.shown and not belief.preceded(self._side(before=False))
        return occurred

    def founded(self, belief: Belief) -> bool:
        """Whether it may have occurred by now."""
        return self.to_come and (self.come or belief.attains(self._side(before=False)))

    def _side(self, *, before: bool) -> Row:
        return self.occurrence.row(self.occurrence.before if before else self.occurrence.after)


@dataclass(slots=True)
class Enrollment:
    """Who wants to be told of what.

    ``due`` is the message by which a cause has certainly occurred that no notification has told of yet;
    ``waited`` counts the messages of its association since.
    """

    name: str
    association: str
    condition: str
    transitions: frozenset[str]
    told_elsewhere: bool
    causes: list[Cause]
    due: TraceMessage | None = None
    waited: int = 0

    @property
    def slot(self) -> str:
        """Under this name the belief keeps the instants that an action's result may show."""
        return f"event {self.name}"

    @property
    def about_causes_only(self) -> bool:
        """Whether the transitions wanted are those of the causes: then nothing else is notified."""
        return all(self.transitions <= cause.occurrence.transitions for cause in self.causes)

    @property
    def must_be_told(self) -> bool:
        """Whether each cause is to be notified to the client that enrolled."""
        wanted = all(cause.occurrence.transitions <= self.transitions for cause in self.causes)
        return wanted and not self.told_elsewhere

    def begin(self, belief: Belief) -> None:
        """It has been enrolled, altered or notified: what counts begins anew."""
        self.due, self.waited = None, 0
        belief.watch(self.slot)
        for cause in self.causes:
            cause.begin(belief)

    def doubt(self) -> None:
        """Messages may be missing."""
        self.due = None
        for cause in self.causes:
            cause.doubt()

    def note(self, belief: Belief, message: TraceMessage) -> bool:
        """After a message: whether a cause has certainly occurred, and the one before was not notified."""
        self._keep_watch(belief)
        occurred = [cause for cause in self.causes if cause.note(belief)]
        if not occurred:
            return False
        if all(cause.just_now for cause in occurred):
            belief.watch(self.slot)  # what the action shows is no older
        if self.due is not None:
            return True
        self.due, self.waited = message, 0
        return False

    def _keep_watch(self, belief: Belief) -> None:
        """What is shown of an event is not older than the last instant at which it certainly was to come."""
        if all(belief.says(cause.occurrence.before) == YES for cause in self.causes):
            belief.watch(self.slot)
        elif (belief.watched(self.slot) or 0) > LARGEST_WATCH:
            belief.unwatch(self.slot)

    def founded(self, belief: Belief) -> bool:
        """Whether the cause of a notification may have occurred."""
        return any(cause.founded(belief) for cause in self.causes)
