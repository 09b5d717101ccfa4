"""A machine's own commands, as its builder lists them: a procedure for each, in the place of the four of ``actions``.

Of a command the table says its number, a name, the sub-mode that DoCmd writes into VR(C_SubMD), the modes in which it
is allowed, and what its action does to homing. Whether that fits the framework is for the properties to tell.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import new_class
from typing import Any, Literal

from mmsverify.model import (
    PLUS,
    Enumeration,
    Initially,
    Model,
    Procedure,
    Sometimes,
    Transition,
    Variable,
    accept,
    answered,
    do,
    internal,
    refuse,
    response,
    service_is,
)
from mmsverify.model.declare import Assign, Declared
from mmsverify.model.terms import Term

from .numbers import COMMANDS
from .vocabulary import Mode, Vocabulary

Entry = Mapping[str, Any]
KEEPS, LOSES = "keeps", "loses"
"""What an action may do to homing; else it homes the machine."""
mode, homed, lost, arrived = Vocabulary.mode, Vocabulary.homed, Vocabulary.lost, Vocabulary.arrived


@dataclass(frozen=True, slots=True)
class Group:
    """What the framework says of a hundred of numbers: where these actions begin, what they are, where they end."""

    name: str
    modes: tuple[Mode, ...]
    acts: Mode
    ends: Mode
    begin: tuple[str, ...]
    forbid: tuple[str, ...]
    end: tuple[str, ...]
    rule: str
    level: Literal["error", "warning"] = "error"


GROUPS = {
    1: Group("debug_action", (Mode.DBG_RDY, Mode.HOME_RDY, Mode.ORG_RDY), Mode.DBG_SUB, Mode.DBG_RDY, ("V-DO-101", "V-CMD-101", "V-SUBD-1"),
             ("V-SUBD-2", "V-CHK-2"), ("V-NEXT-13", "V-SUBD-3"), "debug-action.not-waiting"),
    2: Group("home_action", (Mode.HOME_RDY, Mode.ORG_RDY), Mode.HOME_SUB, Mode.HOME_RDY, ("V-DO-201", "V-CMD-201", "V-SUBH-1"),
             ("V-SUBH-2", "V-CHK-2"), ("V-NEXT-14", "V-SUBH-3"), "home-action.not-homed"),
    3: Group("origin_action", (Mode.ORG_RDY,), Mode.ORG_SUB, Mode.ORG_RDY, ("V-DO-301", "V-CMD-301", "V-SUBO-1"),
             ("V-SUBO-2", "V-CHK-2"), ("V-NEXT-15", "V-SUBO-3"), "origin-action.not-ready"),
    4: Group("run_action", (Mode.RUN,), Mode.RUN_SUB, Mode.RUN, ("V-DO-401", "V-CMD-401"), ("V-CMD-401", "V-CHK-2", "VR-04"),
             ("V-NEXT-16",), "run-action.not-running", "warning"),
}  # fmt: skip
"""By the hundreds of the number."""


def machine(
    parts: tuple[type[Model], ...], options: Mapping[str, Any], profile: Mapping[str, Any]
) -> type[Model] | None:
    """The framework with the commands of a profile; ``None`` where it lists none."""
    entries = profile.get("commands", ())
    if not entries:
        return None
    basic = {number: command for number, command in COMMANDS.items() if number < 100}
    known = basic | {entry["number"]: word(entry) for entry in entries}
    sub_modes = {word(entry): entry["sub_mode"] for entry in entries}
    made = {**options, "numbers": options["numbers"] | {"command": known, "sub_mode": sub_modes}}

    def declare(body: dict[str, Any]) -> None:
        for name, declared in _declared(entries):
            body[name] = declared  # noqa: PERF403 - update() would not tell the declaration its name

    return new_class("Machine", parts, made, declare)


def word(entry: Entry) -> str:
    """What a command is called in the model: its name and its number, which no other command has."""
    return re.sub(r"\W+", "_", f"{entry['name'].strip().lower()}_{entry['number']}")


def _declared(entries: Sequence[Entry]) -> Iterator[tuple[str, Declared]]:
    """What the table declares, by name."""
    going_on = GoingOn([entry for entry in entries if entry["homing"] != KEEPS])
    yield from going_on.declared()
    for entry in entries:
        yield word(entry), _begins(entry, going_on)
    for entry in going_on.changing:
        yield f"{word(entry)}_{entry['homing']}_homing", _changes_homing(entry, going_on)
    for group in GROUPS.values():
        yield f"{group.name}_ends", _ends(group, going_on)
    for entry in entries:
        done = service_is(word(entry)) & answered(PLUS)
        yield f"{word(entry)}_is_possible", Sometimes(_group(entry).begin[0], done)


class GoingOn:
    """Which action goes on, of those that change the homing; no other needs to be told."""

    def __init__(self, changing: Sequence[Entry]) -> None:
        self.changing = changing
        self._sort = Enumeration("Action", {"NONE": "none of these", **{word(e): word(e) for e in changing}})
        self._action = Variable(self._sort, doc="which action goes on, of those that change the homing")
        self._action.bind("action")

    def declared(self) -> Iterator[tuple[str, Declared]]:
        """The variable, if there is any such action."""
        if self.changing:
            yield "action", self._action
            yield "nothing_goes_on", Initially("V-SM-Idle", self._action() == self._sort["NONE"])

    def begins(self, entry: Entry) -> list[Assign]:
        """The action of this command begins."""
        return self._becomes(word(entry) if entry in self.changing else "NONE")

    def ends(self) -> list[Assign]:
        """It has ended."""
        return self._becomes("NONE")

    def is_(self, entry: Entry) -> Term:
        """It is that of this command."""
        return self._action() == self._sort[word(entry)]

    def _becomes(self, name: str) -> list[Assign]:
        return [self._action().becomes(self._sort[name])] if self.changing else []


def _group(entry: Entry) -> Group:
    return GROUPS[entry["number"] // 100]


def _begins(entry: Entry, going_on: GoingOn) -> Procedure:
    """CheckCmd and DoCmd of one command."""
    group, called = _group(entry), f"{entry['name']} ({entry['number']})"
    allowed = [each for each in Mode if str(each) in entry["allowed"]]
    framework = [each for each in Mode if each in group.modes or each in allowed]
    steps = [
        refuse(*group.forbid, unless=mode().isin(framework), rule=group.rule, level=group.level,
               says=f"{called} outside {_listed(framework)}"),
        refuse("V-CHK-2", *group.begin[:1], unless=mode().isin(allowed), rule="own-command.not-allowed",
               says=f"{called}, which the profile allows {f'in {_listed(allowed)} only' if allowed else 'nowhere where the framework does'}"),
        do(group.begin[0], mode().becomes(group.acts), arrived().becomes(False), *going_on.begins(entry)),
        accept(*group.begin),
    ]  # fmt: skip
    narrower = len(allowed) < len(framework)
    steps = steps if narrower else [steps[0], *steps[2:]]
    return Procedure(group.begin[0], on=response(word(entry)), steps=steps)


def _changes_homing(entry: Entry, going_on: GoingOn) -> Transition:
    """What the action does to homing, at any moment while it goes on."""
    group, loses = _group(entry), entry["homing"] == LOSES
    still = homed() if loses else ~homed() | lost()
    then = [homed().becomes(False)] if loses else [homed().becomes(True), lost().becomes(False)]
    going = [mode() == group.acts, going_on.is_(entry), still]
    return Transition(group.begin[-1], "V-VR-10", "VR-21", on=internal("action"), when=going, then=then)


def _ends(group: Group, going_on: GoingOn) -> Transition:
    """SetNextMode after an action, which has done to homing what it does."""
    own = [entry for entry in going_on.changing if _group(entry) is group]
    done = [
        ~going_on.is_(entry) | (~homed() if entry["homing"] == LOSES else homed() & ~lost()) for entry in own
    ]
    then = [mode().becomes(group.ends), *going_on.ends()]
    return Transition(*group.end, on=internal("set_next_mode"), when=[mode() == group.acts, *done], then=then)


def _listed(modes: Sequence[Mode]) -> str:
    *others, last = map(str, modes)
    return f"{', '.join(others)} and {last}" if others else last
