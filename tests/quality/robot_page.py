"""The page about the mutation score of the robot model, from the fates of all its mutants."""

from __future__ import annotations

from collections.abc import Sequence

from mutation import CHANGED, DROPPED, EVENT, OBSERVATION
from mutation_fate import Fate
from mutation_page import ALIVE, EQUALS, alive, equal, table


def page(fates: Sequence[Fate]) -> str:
    """The whole page."""
    return HEAD + table(fates) + ALIVE + alive(fates, reason) + EQUALS + equal(fates) + "\n"


def reason(fate: Fate) -> str:
    """Why it lives, as far as it is known."""
    named = REASONS.get((fate.kind, fate.place)) or REASONS.get(("", fate.place))
    return fate.by or named or OF_KIND.get(fate.what, "not known")


OF_KIND = {
    EVENT: "what an event needs may come and go between two messages: the audit tells only a "
    "notification for which no instant can be found, and one that is missing where all instants need it",
    OBSERVATION: "no recording at hand breaks this condition alone: what contradicts it may have changed "
    "unseen, or breaks another condition, too",
}
"""Why mutants live of which nothing more is known."""
UNSEEN = (
    "power, interlocks, calibration and who holds a device may change at any instant, and no message tells "
    "of it (RP-18): what one message shows of them contradicts no other one"
)
REASONS: dict[tuple[str, str], str] = {
    (
        CHANGED,
        "counts_cycles: cycles",
    ): "nobody tells how fast a counter runs: it still "
    "reaches every count but nought while the program runs, and no clause says that nought is reached before",
    (
        CHANGED,
        "counts_steps: steps",
    ): "as with cycles: every count but nought is still "
    "reached while the program runs, and at nought it is STOPPED",
    (
        CHANGED,
        "devices_change: interlocks_violated",
    ): "which interlocks are violated is free, and so "
    "is whether any is: the changed rule allows the same states by other choices, of which Z3 is not asked",
    (
        DROPPED,
        "bound_domains: attributes.domains (2)",
    ): "who shows other domains breaks the condition before it, too, wherever it is known which they are",
    **{
        ("", f"{view}: {rule}"): UNSEEN
        for view, rules in {
            "status": ("status.interlocks", "status.power", "status.calibrated"),
            "power_shown": ("variable.power",),
            "all_calibrated_shown": ("variable.all-calibrated",),
            "interlocks_shown": ("variable.interlocks",),
            "device_power_shown": ("variable.device-power",),
            "device_calibration_shown": ("variable.device-calibration",),
            "device_local_shown": ("variable.device-local (2)",),
        }.items()
        for rule in rules
    },
}
"""Why mutants live, by kind (or any) and place."""

HEAD = """\
# Mutation score of the robot model

Made by `python bench/mutants.py --write`. Each rule of the model (variant `repaired`) is written otherwise,
one at a time: a step is left out, a condition negated, an effect lost, a value changed to another. A change
of a procedure's step changes every row that the step has part in. Then:

- `check` kills a mutant if Z3 finds, under the proved invariants, a step of a changed row that breaks a
  claim; or if what is claimed to happen sometimes can happen by changed rows only, and by none of them any
  more. Every claim is written by hand, from the clause that it cites; none is made from a row.
- A mutant is *equal* if Z3 proves, under the proved invariants, that its rows do what the real ones do; what
  no message tells may be called otherwise (TRUE for FALSE, a number for the next one, a set for what is not
  in it).
- `audit` kills a mutant if some recording gives other findings. The recordings are those written by hand and
  those of the robot written from the text alone, with the faults of its catalogue; then conversations that
  lead to a moment at which the mutant acts otherwise: its robot is accused by the real model, or a right
  robot by the mutant.
- A claim is negated, or has a condition less, so that it says more than the text; what is to happen sometimes
  is claimed never to happen. `check` kills such a mutant if it is not proved any more; if it is proved too,
  it is equal to the real claim in every reachable state.

Where Z3 gives no answer in 5 s, a mutant counts neither as killed nor as equal.

"""
