"""Rules that no state of a model expresses: what the base standard and the negotiation say of messages.

Each rule is data; the code that applies one names it by its id.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from mmsverify.model.rows import Clause
from mmsverify.results import Severity


@dataclass(frozen=True, slots=True)
class Rule:
    """One rule: its id in findings, what it rests on, how bad a breach is, the sentence about it.

    ``shown``: it is about something that every poll shows again.
    """

    id: str
    clause: Clause
    severity: Severity
    says: str
    shown: bool = False


@dataclass(frozen=True, slots=True)
class Breach:
    """A rule that a message breaks, with the words for its sentence, and the other messages that show it.

    ``clause`` is what the thing concerned rests on, where a rule is about many: cited before the rule's own.
    """

    rule: str
    words: Mapping[str, Any] = field(default_factory=dict)
    related: tuple[int, ...] = ()
    clause: Clause | None = None


def _rule(name: str, says: str, *cites: str, severity: Severity = "error", shown: bool = False) -> Rule:
    return Rule(name, Clause.of(*cites), severity, says, shown)


_LISTED = (
    _rule(
        "protocol.undecodable",
        "these octets are not an MMS PDU: {cause}",
        "R-7.3.1-2",
        "R-7.3.4-3",
        "B-SYNTAX",
    ),
    _rule(
        "protocol.invoke-id-reused",
        "invokeID {invoke} is used again while the request #{first} with it is outstanding",
        "R-7.3.4-3",
        "B-INVOKE-ID",
    ),
    _rule(
        "protocol.too-many-outstanding",
        "{count} requests of the {side} are outstanding where {limit} was negotiated",
        "R-7.3.4-3",
        "B-OUTSTANDING",
    ),
    _rule(
        "protocol.unasked",
        "the {side} answers invokeID {invoke}, which nobody asked",
        "R-7.3.4-3",
        "B-RESPONSE",
    ),
    _rule(
        "protocol.other-service",
        "the request was {asked}, the answer is for {answered}",
        "R-7.3.4-3",
        "B-RESPONSE",
    ),
    _rule("protocol.after-conclude", "the association has been concluded", "R-9.2.2.4-1", "B-ASSOCIATION"),
    _rule(
        "negotiation.service",
        "{service} is answered positively, but the {side} did not list it in servicesSupported",
        "R-7.5.2.4-2",
        "R-7.5.1.4-5",
        "B-NEGOTIATION",
    ),
    _rule(
        "negotiation.additional",
        "{service} is answered positively, but the {side} did not list it in additionalSupported",
        "R-7.5.2.4-1",
        "R-7.5.2.4-2",
        "R-7.5.3-3",
    ),
    _rule(
        "negotiation.rejected",
        "{service} is rejected as unrecognized, but the {side} listed it as supported",
        "R-7.5.2.4-2",
        "R-7.5.1.4-4",
    ),
    _rule(
        "negotiation.version",
        "the negotiated version number {negotiated} is not between 1 and the proposed {proposed}",
        "R-7.5.2.1-1",
    ),
    _rule(
        "negotiation.outstanding",
        "{negotiated} outstanding requests are negotiated where {proposed} were proposed",
        "R-7.3.4-3",
        "B-NEGOTIATION",
    ),
    _rule(
        "negotiation.syntax",
        "the answer has the robot's form of the detail, which the request did not propose",
        "R-7.5.2-1",
        "R-7.5.1-1",
        "R-7.3.1-2",
    ),
    _rule(
        "value.unnamed",
        "{service} has {field} {found}, a number to which the standard gives no meaning",
        "R-7.3.1-2",
        shown=True,
    ),
    _rule(
        "status.bits",
        "{service} has {size} bits of {field}, not 4: the others are not shown",
        "R-7.3.1-2",
        severity="warning",
        shown=True,
    ),
    _rule("detail.foreign", "{service} has a detail that the robot standard does not define", "R-7.3.4-1"),
    _rule(
        "error.additional",
        "the failure of {service} tells more than the robot standard lets an additional service tell",
        "R-7.4.1.4-1",
    ),
    _rule(
        "identify.syntax",
        "the abstract syntaxes {listed} do not include that of the robot standard, {wanted}",
        "R-7.2-1",
        severity="note",
        shown=True,
    ),
    _rule(
        "select.controlled-alone",
        "a list of controlled program invocations without a controlling one",
        "R-7.4.4.3-2",
        "R-7.4.4.1.1.2-1",
    ),
    _rule(
        "program.never-shown",
        "{service} answered result(+), but {pi} is not predefined, "
        "and since the robot was ROBOT-IDLE nothing has created or shown it",
        "R-5.3.1.3.2.1-1",
        "R-7.3.3.9-1",
        "RP-14",
        "RP-21",
    ),
    _rule("variable.type", "{variable} is {found}, not {wanted}", "R-8.1-1", shown=True),
    _rule("variable.value", "{variable} is {found}, not among {wanted}", "R-8.1-1", shown=True),
    _rule("variable.written", "{variable} was written as {found}, but it is {wanted}", "R-8.1-1"),
    _rule(
        "variable.joints",
        "{variable} tells of {count} joints, {other} of {joints}",
        "R-8.5.5.1-1",
        shown=True,
    ),
    _rule(
        "variable.bounds",
        "{variable} has the upper bound {upper} below the lower bound {lower}",
        "R-6.2.2.8.2.4-1",
        "R-8.5.5.5-1",
        shown=True,
    ),
    # A joint may stand a little beyond its bounds, as after an overrun: worth knowing, forbidden to nobody.
    _rule(
        "variable.beyond-bounds",
        "{variable} is {value}, beyond the bounds {lower} and {upper}",
        "R-6.2.2.8.2.4-1",
        "R-8.5.5.6-2",
        severity="note",
        shown=True,
    ),
    # That the values of one message were taken at one instant is not in the text.
    _rule(
        "variable.calibration",
        "{variable} is {value}, but {joints} joints are calibrated",
        "R-6.2.2.4-1",
        "R-8.5.4.2-1",
        "R-8.5.5.3-1",
        "RP-22",
        severity="warning",
        shown=True,
    ),
    _rule("object.attribute", "{attribute} of {object} is {found}, not {wanted}", "R-8.1-1", shown=True),
    _rule("object.member", "{attribute} of {object} is {found}, without {wanted}", "R-8.1-1", shown=True),
    # AlterEventConditionMonitoring may have changed it before the recording began.
    _rule(
        "object.initial",
        "{attribute} of {object} is {found}, where the standard sets {wanted}",
        "R-8.1-1",
        severity="note",
        shown=True,
    ),
    _rule("object.type", "{object} is described as {found}, not {wanted}", "R-8.1-1", shown=True),
    _rule("object.deleted", "{object} was deleted, but is not deletable", "R-8.1-1"),
    _rule(
        "semaphore.tokens",
        "R_CTRL has {count} owners, but only one token",
        "R-8.6.1-2",
        "R-8.6.1-3",
        "B-SEMAPHORE",
        shown=True,
    ),
    _rule(
        "event.action-result", "event action {action} gives a result of {found}, not of {wanted}", "R-8.1-1"
    ),
    _rule(
        "event.arm-running",
        "event condition R_ARM is notified, but the action result says that R_ARM is RUNNING",
        "R-8.7.4-1",
        "R-8.8.2-1",
    ),
    _rule("event.unfounded", "{condition} is notified, but its cause cannot have occurred", "R-8.7.1-1"),
)

RULES: Mapping[str, Rule] = {rule.id: rule for rule in _LISTED}
