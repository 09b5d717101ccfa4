"""One robot: its associations and the belief about its state. Messages go in, findings come out.

Only the way of a message is here. What it does is told in ``performing``, what it shows in ``showing``, what
it announces in ``notifications``; how a finding is made in ``telling``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import ClassVar

from mmsverify.audit import contents
from mmsverify.audit.acquaintance import Acquaintance
from mmsverify.audit.conformance import Conformance
from mmsverify.audit.exchange import Asked, Association
from mmsverify.audit.learning.marks import marked
from mmsverify.audit.notifications import Notifications
from mmsverify.audit.objects import Objects
from mmsverify.audit.performing import Performing
from mmsverify.audit.rules import Breach
from mmsverify.audit.showing import Showing
from mmsverify.audit.suspicion import alarming, of_caller, undecodable
from mmsverify.audit.telling import History, Place, Telling
from mmsverify.audit.transfers import UPLOADING, Transfers
from mmsverify.concrete.belief import Belief, attributes
from mmsverify.concrete.belief.constraints import Constraints
from mmsverify.concrete.belief.coverage import Coverage
from mmsverify.concrete.belief.ground import Ground
from mmsverify.concrete.belief.internal import Unseen
from mmsverify.concrete.belief.partial import OTHER, Growth, World
from mmsverify.concrete.belief.ready import Rows
from mmsverify.errors import DecodeError
from mmsverify.formats import mms
from mmsverify.formats.mms import Pdu
from mmsverify.formats.trace import TraceMessage
from mmsverify.model.rows import PLUS, Clause
from mmsverify.results import Finding

Told = Iterator[Finding | Breach]

PROGRAM = "ProgramInvocation"
LANES = {
    "robot state": "robot_state", "logical status": "logical", "physical status": "physical",
    "local control": "local_control",
}  # fmt: skip
"""What a timeline shows of a robot as a whole, with the model's names for it."""
SELECTED, PROGRAM_LANE = "selected", "program"


class Device:
    """The replay of one robot's messages.

    ``arms`` are the domains of its arms; to associations in ``base_only`` the robot standard does not apply.
    In the spans of indices ``blind``, what the recording does not show may still be performed. ``history``
    is where it is written down what was written and told.
    """

    def __init__(
        self,
        place: Place,
        belief: Belief,
        arms: frozenset[str],
        *,
        base_only: frozenset[str] = frozenset(),
        blind: Sequence[tuple[int, int]] = (),
        history: History | None = None,
    ) -> None:
        self.belief = belief
        self.base_only = base_only
        self.blind = tuple(blind)
        self._associations: dict[str, Association] = {}
        self._acquaintance = Acquaintance(belief.world.names["ProgramInvocation"])
        self._telling = Telling(place, history)
        self._performing = Performing(belief, self._telling, self._acquaintance, arms)
        self._showing = Showing(belief, self._telling, self._acquaintance, arms)
        self._transfers = Transfers(belief, self._telling)
        self._notifications = Notifications(belief, self._showing)
        self._conformance = Conformance()
        self._objects = Objects()

    SHARED: ClassVar[tuple[type, ...]] = (World, Ground, Rows, Constraints, Unseen, Coverage, History, Place)
    """The types of what all its states share."""

    @property
    def history(self) -> History:
        """What was written and told so far."""
        return self._telling.history

    @property
    def grown(self) -> Sequence[Growth]:
        """The names and facts that were met so far: what its states mean rests on them, in this order."""
        return self.belief.world.grown

    def grow(self, grown: Iterable[Growth]) -> None:
        """Take in what another robot's device has met, before one of its states is put in place of this."""
        for each in grown:
            if len(each) == 2:
                self.belief.world.add(*each)
                self.belief.unseen.forget()
            else:
                self.belief.ground.fact(each)

    def shows(self) -> dict[str, str]:
        """What is known of the robot now, in words, by lane: the attributes of clause 6.1, then its programs.

        Empty words where nothing is known; alternatives where it is one of a few.
        """
        ground, states = self.belief.ground, self.belief.states
        programs = [name for name in self.belief.world.names[PROGRAM] if name != OTHER]
        shown = {lane: attributes.attribute(ground, states, name) for lane, name in LANES.items()}
        shown[SELECTED] = attributes.the_one(states, "selected", programs)
        held = attributes.of_each(ground, states, "state", programs)
        return shown | {f"{PROGRAM_LANE} {name}": state for name, state in held.items()}

    def settle(self) -> None:
        """What the last message showed is forgotten when the next one comes: forget it now."""
        self.belief.listen()

    # Links.

    def link(self, connection: str, event: str, message: TraceMessage) -> Iterator[Finding]:
        """A connection opens, closes, is reset, or has a gap: messages may be missing before this point."""
        association = self._association(connection)
        self._acquaintance.begin(opening=event == "open")
        if event == "gap":
            lost = association.gap()
            if connection not in self.base_only:
                self._lose_sight()
        elif event in ("close", "reset"):
            if association.alarm:
                lost_after = Breach("association.lost-after-stop", {"cause": association.alarm})
                yield from self._telling.breach(message, lost_after)
            lost = association.end()
            self._notifications.ended(connection)
            self._release(connection)
        else:
            association.reopen()
            return
        self._drop(lost)

    def _lose_sight(self) -> None:
        """Something that the recording does not show may have happened."""
        self.belief.lose_sight()
        self._acquaintance.lose()
        self._notifications.lose()

    def _drop(self, lost: list[Asked]) -> None:
        for asked in lost:
            self.belief.drop(asked.slot)

    def _release(self, name: str) -> None:
        if name not in self.base_only:
            self.belief.respond(name, "release", {"user": name}, "")

    def _association(self, name: str) -> Association:
        return self._associations.setdefault(name, Association(name))

    def _is_robot(self, association: Association) -> bool:
        return association.name not in self.base_only

    # Messages.

    def message(
        self, message: TraceMessage, read: Callable[[TraceMessage], Pdu] | None = None
    ) -> Iterator[Finding]:
        """The findings of one MMS message. ``read`` decodes it, where that is not done as usual."""
        name, side = message.metadata.get("association", ""), message.metadata.get("sender", "client")
        self.belief.listen()
        try:
            pdu = marked(mms.decode(message.data) if read is None else read(message))
        except DecodeError as error:
            clause = Clause.of(*mms.encoded_statements(error.path))
            yield from self._telling.breach(message, undecodable(message.data, error, clause))
            return
        for found in self._judge(self._association(name), side, pdu, message):
            if isinstance(found, Breach):
                yield from self._telling.breach(message, found)
            else:
                yield found
        for late in self._notifications.note(name, message):
            yield from self._telling.breach(message, late)
        if any(first <= message.index <= last for first, last in self.blind):
            self._lose_sight()

    def _judge(self, association: Association, side: str, pdu: Pdu, message: TraceMessage) -> Told:
        robot = self._is_robot(association)
        self._acquaintance.begin(opening=pdu.kind == "initiate-RequestPDU")
        if not pdu.kind.startswith("initiate"):
            yield from association.admit(side, pdu)
        if robot:
            yield from association.robot_syntax(pdu)
        alarm, association.alarm = association.alarm, alarming(pdu) if robot else ""
        match pdu.kind:
            case "initiate-RequestPDU":
                self._drop(list(association.asked.values()))
                self._release(association.name)
                yield from association.propose(pdu)
            case "initiate-ResponsePDU":
                yield from self._initiated(association, pdu, message)
            case "initiate-ErrorPDU":
                association.refuse()
            case "confirmed-RequestPDU":
                asked, breaches = association.request(message.index, side, pdu, message)
                yield from breaches
                yield from self._requested(association, asked, message)
            case "confirmed-ResponsePDU" | "confirmed-ErrorPDU" | "rejectPDU":
                asked_for, breaches = association.answer(side, pdu)
                yield from breaches
                if asked_for is not None:
                    yield from self._answered(association, asked_for, pdu, message)
            case "unconfirmed-PDU":
                yield from self._unconfirmed(association, side, pdu, message)
            case "cancel-RequestPDU" | "cancel-ResponsePDU" | "cancel-ErrorPDU":
                yield from association.cancel(message.index, side, pdu)
            case "conclude-RequestPDU" | "conclude-ResponsePDU" | "conclude-ErrorPDU":
                yield from association.conclude(side, pdu)
                yield from self._concluded(association, side, pdu, alarm, message)

    def _initiated(self, association: Association, pdu: Pdu, message: TraceMessage) -> Told:
        proposed = association.proposed
        self._drop(list(association.asked.values()))
        yield from association.agree(pdu)
        self._notifications.ended(association.name)
        if self._is_robot(association):
            yield from self._conformance.initiated(proposed, pdu.body)
            bindings = {"user": association.name}
            outcome = self.belief.respond(association.name, "initiate", bindings, PLUS)
            yield from self._telling.outcome(message, "initiate", PLUS, outcome)

    def _concluded(
        self, association: Association, side: str, pdu: Pdu, alarm: str, message: TraceMessage
    ) -> Told:
        if pdu.kind == "conclude-RequestPDU" and side == "server" and alarm:
            yield Breach("association.concluded-after-stop", {"cause": alarm})
        elif pdu.kind == "conclude-ResponsePDU":
            self._drop(association.concluded())
            yield from self._notifications.concluded(association.name, message)
            self._release(association.name)

    def _requested(self, association: Association, asked: Asked, message: TraceMessage) -> Told:
        if not self._is_robot(association):
            return
        yield from contents.judge(asked.pdu)
        if asked.side == "client":
            self._transfers.requested(association.name, asked)
            yield from self._performing.requested(association.name, asked)
            self._notifications.requested(association.name, asked)
        else:
            yield from self._transfers.asked_by_robot(association.name, asked, message)

    def _answered(self, association: Association, asked: Asked, pdu: Pdu, message: TraceMessage) -> Told:
        if not self._is_robot(association):
            return
        if asked.side != "client":
            self._transfers.answered_by_client(association.name, asked, pdu)
            return
        agreed = association.negotiated is not None and association.negotiated.robot
        yield from contents.judge(pdu, asked.pdu, agreed=agreed)
        yield from self._conformance.rejected(association.negotiated, asked.pdu, pdu)
        told = list(self._replayed(association, asked, pdu, message))
        yield from told
        if pdu.kind == "confirmed-ResponsePDU":
            fixed = self._objects.answered(asked.pdu, pdu)
            yield from self._telling.withhold(message, fixed) if told else fixed
        # A state that comes with the answer of a service is that of its decision, which may be long ago.
        undisturbed = self.belief.undisturbed(asked.slot)
        if undisturbed and pdu.kind == "confirmed-ResponsePDU" and asked.pdu.service == "vMDReset":
            yield from self._showing.status(pdu.body, pdu.detail, message)
        agreed_on = association.negotiated
        listens = agreed_on is None or agreed_on.listed("client", "eventNotification") is not False
        self._notifications.answered(association.name, asked, pdu, listens=listens, disturbed=not undisturbed)

    def _replayed(self, association: Association, asked: Asked, pdu: Pdu, message: TraceMessage) -> Told:
        """What the answer does or shows in the model."""
        call = self._performing.call(asked)
        if asked.pdu.service in UPLOADING:
            yield from self._transfers.uploaded(association.name, asked, pdu, message)
        elif asked.pdu.service == "getDomainAttributes":
            yield from self._transfers.attributes(asked, pdu, message)
        elif call is not None:
            yield from self._performing.answered(association.name, asked, call, pdu, message)
        elif pdu.kind == "confirmed-ResponsePDU":
            yield from self._showing.answered(asked, pdu, message)
        else:
            yield from self._showing.refused(asked, pdu, message)

    def _unconfirmed(self, association: Association, side: str, pdu: Pdu, message: TraceMessage) -> Told:
        if not self._is_robot(association):
            return
        if side != "server":
            yield from of_caller(pdu)
            return
        yield from contents.judge(pdu)
        match pdu.service:
            case "unsolicitedStatus":
                yield from self._showing.status(pdu.body, pdu.detail, message)
            case "informationReport":
                yield from self._showing.values(pdu, pdu, message)
            case "eventNotification":
                yield from self._objects.notified(pdu)
                yield from self._notifications.notified(association.name, pdu, message)
