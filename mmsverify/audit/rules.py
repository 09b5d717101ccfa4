"""Rules that no state of a model expresses: what the standards say of messages, values and objects.

Each rule is data; the code that applies one names it by its id.
"""

from __future__ import annotations

from collections.abc import Mapping

from mmsverify.audit.protocol_rules import PROTOCOL
from mmsverify.audit.rule import Breach, Rule, rule

__all__ = ["RULES", "Breach", "Rule"]

CONTENTS = (
    rule(
        "value.unnamed",
        "{service} has {field} {found}, a number to which the standard gives no meaning",
        "R-7.3.1-2",
        shown=True,
    ),
    rule(
        "status.bits",
        "{service} has {size} bits of {field}, not 4: the others are not shown",
        "R-7.3.1-2",
        severity="warning",
        shown=True,
    ),
    rule("detail.foreign", "{service} has a detail that the robot standard does not define", "R-7.3.4-1"),
    rule(
        "error.additional",
        "the failure of {service} tells more than the robot standard lets an additional service tell",
        "R-7.4.1.4-1",
    ),
    rule(
        "identify.syntax",
        "the abstract syntaxes {listed} do not include that of the robot standard, {wanted}",
        "R-7.2-1",
        severity="note",
        shown=True,
    ),
    rule(
        "select.controlled-alone",
        "a list of controlled program invocations without a controlling one",
        "R-7.4.4.3-2",
        "R-7.4.4.1.1.2-1",
        expects=("none",),
    ),
    rule(
        "program.never-shown",
        "{service} answered result(+), but {pi} is not predefined, "
        "and since its first connection, when the robot was ROBOT-IDLE, nothing has created or shown it",
        "R-5.3.1.3.2.1-1",
        "R-7.3.3.9-1",
        "RP-14",
        "RP-21",
        expects=("result(-)",),
        observed="result(+)",
    ),
    rule(
        "program.not-shown-yet",
        "{service} answered result(+), but {pi} is not predefined, and since the robot was ROBOT-IDLE "
        "nothing has created or shown it: it is no task program and older than the recording, or not there",
        "R-5.3.1.3.2.1-1",
        "RP-14",
        "RP-21",
        severity="note",
        expects=("result(-)",),
        observed="result(+)",
    ),
    rule(
        "variable.type",
        "{variable} is {found}, not {wanted}",
        "R-8.1-1",
        shown=True,
        expects=("{variable}={wanted}",),
        observed="{found}",
    ),
    rule(
        "variable.value",
        "{variable} is {found}, not among {wanted}",
        "R-8.1-1",
        shown=True,
        expects=("{variable}={wanted}",),
        observed="{found}",
    ),
    rule(
        "variable.written",
        "{variable} was written as {found}, but it is {wanted}",
        "R-8.1-1",
        expects=("result(-)",),
        observed="result(+)",
    ),
    rule(
        "variable.joints",
        "{variable} tells of {count} joints, {other} of {joints}",
        "R-8.5.5.1-1",
        shown=True,
    ),
    rule(
        "variable.bounds",
        "{variable} has the upper bound {upper} below the lower bound {lower}",
        "R-6.2.2.8.2.4-1",
        "R-8.5.5.5-1",
        shown=True,
    ),
    # A joint may stand a little beyond its bounds, as after an overrun: worth knowing, forbidden to nobody.
    rule(
        "variable.beyond-bounds",
        "{variable} is {value}, beyond the bounds {lower} and {upper}",
        "R-6.2.2.8.2.4-1",
        "R-8.5.5.6-2",
        severity="note",
        shown=True,
    ),
    # That the values of one message were taken at one instant is not in the text.
    rule(
        "variable.calibration",
        "{variable} is {value}, but {joints} joints are calibrated",
        "R-6.2.2.4-1",
        "R-8.5.4.2-1",
        "R-8.5.5.3-1",
        "RP-22",
        severity="warning",
        shown=True,
    ),
    rule(
        "object.attribute",
        "{attribute} of {object} is {found}, not {wanted}",
        "R-8.1-1",
        shown=True,
        expects=("{attribute}={wanted}",),
        observed="{found}",
    ),
    rule(
        "object.member",
        "{attribute} of {object} is {found}, without {wanted}",
        "R-8.1-1",
        shown=True,
        expects=("{attribute}={wanted}",),
        observed="{found}",
    ),
    # AlterEventConditionMonitoring may have changed it before the recording began.
    rule(
        "object.initial",
        "{attribute} of {object} is {found}, where the standard sets {wanted}",
        "R-8.1-1",
        severity="note",
        shown=True,
        expects=("{attribute}={wanted}",),
        observed="{found}",
    ),
    rule(
        "object.type",
        "{object} is described as {found}, not {wanted}",
        "R-8.1-1",
        shown=True,
        expects=("{object}={wanted}",),
        observed="{found}",
    ),
    rule(
        "object.deleted",
        "{object} was deleted, but is not deletable",
        "R-8.1-1",
        expects=("result(-)",),
        observed="result(+)",
    ),
    rule(
        "semaphore.tokens",
        "R_CTRL has {count} owners, but only one token",
        "R-8.6.1-2",
        "R-8.6.1-3",
        "B-SEMAPHORE",
        shown=True,
        expects=("numberOfOwnedTokens=1",),
        observed="{count}",
    ),
    rule(
        "event.action-result", "event action {action} gives a result of {found}, not of {wanted}", "R-8.1-1"
    ),
    rule(
        "event.arm-running",
        "event condition R_ARM is notified, but the action result says that R_ARM is RUNNING",
        "R-8.7.4-1",
        "R-8.8.2-1",
        expects=("none",),
    ),
    rule(
        "event.unfounded",
        "{condition} is notified, but its cause cannot have occurred",
        "R-6.3.9-1",
        "B-EVENT",
        expects=("none",),
    ),
    rule(
        "event.missing",
        "the cause of {condition} has occurred, but it is not notified to the enrollment {enrollment}",
        "R-6.3.9-1",
        "B-EVENT",
    ),
    rule(
        "event.deleted",
        "{enrollment} is notified, but it has been deleted",
        "R-6.3.9-1",
        "B-EVENT",
        expects=("none",),
    ),
)

RULES: Mapping[str, Rule] = {listed.id: listed for listed in (*PROTOCOL, *CONTENTS)}
