"""Pages about the mutation scores of small models, from the fates of all their mutants."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from mutation_fate import EQUAL, Fate
from mutation_page import alive, equal, line, rules, share, table


@dataclass(frozen=True)
class Page:
    """What a page says of its models beside what all such pages say.

    ``file``: its name in docs; ``title``: whose models; ``rules``: of which models the rules are; ``states``:
    which are searched; ``unseen``: what is not to be seen of equal mutants; ``shelf``: what ``audit`` does,
    with which recordings; ``untold``: of what no recording tells.
    """

    file: str
    models: tuple[str, ...]
    title: str
    rules: str
    states: str
    unseen: str
    shelf: str
    untold: str

    def text(self, fates: Mapping[str, Sequence[Fate]]) -> str:
        """The whole page, from the fates by model."""
        head = HEAD.format(
            title=self.title, models=" ".join(self.models), rules=self.rules,
            states=self.states, unseen=self.unseen, shelf=self.shelf,
        )  # fmt: skip
        return head + "\n".join(self.section(name, fates[name]) for name in self.models)

    def section(self, name: str, fates: Sequence[Fate]) -> str:
        """What became of the mutants of one model."""
        parts = [
            f"## {name}", table(fates), told(fates),
            "### Alive", alive(fates, reason) or "None.",
            "### Equal rules", equal(fates) or "None.",
            self._untold(fates),
        ]  # fmt: skip
        return "\n\n".join(part for part in parts if part) + "\n"

    def _untold(self, fates: Sequence[Fate]) -> str:
        """The changed rules that no recording tells, where that was asked."""
        if not any(fate.told for fate in fates):
            return ""
        left = [fate for fate in rules(fates) if fate.fate != EQUAL and not fate.told]
        return "### Told by no recording\n\n" + self.untold + "\n" + "\n".join(map(line, left))


def told(fates: Sequence[Fate]) -> str:
    """How many changed rules the recordings alone tell, where that was asked."""
    others = [fate for fate in rules(fates) if fate.fate != EQUAL]
    noticed = sum(bool(fate.told) for fate in others)
    score = f"{noticed} of {len(others)} rules that are not equal, {share(noticed, len(others))}"
    return f"An audit of the recordings, without `check`, tells {score}." if noticed else ""


def reason(fate: Fate) -> str:
    """Why it lives, as far as it is known."""
    return fate.by or REASONS.get((fate.kind, fate.place), "not known")


REASONS: dict[tuple[str, str], str] = {}
"""Why mutants live, by kind and place."""

HEAD = """\
# Mutation score of {title}

Made by `python bench/mutants.py --model {models} --write`. Each rule of {rules} (variant
`repaired`) is written otherwise, one at a time: a step is left out, a condition negated, an effect lost, a
value changed to another; where a rule looks a value up in a table, so is each entry. A change of a
procedure's step changes every row that the step has part in. Then:

- `check` kills a mutant if the search of its reachable states, {states}, finds a
  run that breaks a claim, or nothing any more of what is claimed to happen sometimes. Every claim is written
  by hand, from the clause that it cites; none is made from a row.
- A mutant is *equal* if Z3 proves, under the proved invariants, that its rows do what the real ones do.
  {unseen}
- {shelf}
- A claim is negated, or has a condition less, so that it says more than the text; what is to happen sometimes
  is claimed never to happen. `check` kills such a mutant if some run breaks it; it is equal if Z3 proves it,
  too.

"""

VR = Page(
    file="mutation-vr.md",
    models=("vr-template", "vr-tasks"),
    title="the VR models",
    rules="the two models",
    states="all of them",
    unseen="""\
Which of two conditions refuses is not to be seen, nor whether a mode is entered by way of an inserted one
  before it is.""",
    shelf="""\
`audit` kills a mutant of vr-template if some recording gives other findings: the runs written by hand,
  right and wrong ones, scan by scan and polled, and the sample recordings of the press. No recording shows
  the single steps of the two tasks, so that vr-tasks is for `check` alone.""",
    untold="""\
`check` kills these alone. Most are of what no cell shows: `arrived` (homing has ended just now), `paused` (a
flow is held, before the status says so, and until a Resume that need not be seen), `lost` (beside CF_Home,
which tells the same); or of errors, which come from within, with no command that a sample could lack.
""",
)
MODBUS = Page(
    file="mutation-modbus.md",
    models=("modbus-signals",),
    title="the model of signals over Modbus/TCP",
    rules="the model",
    states="all those of two sockets and two clients",
    unseen="Which of two conditions refuses is not to be seen.",
    shelf="""\
`audit` kills a mutant if some recording gives other findings: the requests written by hand, each answered
  as it may be and as it may not, random conversations with a server written from the text alone, and the
  sample recording.""",
    untold="""\
`check` kills these alone. Nearly all are of calls upon sockets, which no message shows: an audit holds
connections against rules of its own. A plan of signals sorts the numbers of 0x03, 0x04, 0x06 and 0x10 as
registers or as beyond them, never as signals, and what a forbidden write would do shows in no answer.
""",
)
PAGES = (VR, MODBUS)
