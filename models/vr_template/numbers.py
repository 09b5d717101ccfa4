"""The numbers that the text gives to modes, statuses and commands (sections on VR(C_Cmd), VR(CS_RunSTA), SetPreMode, SetNextMode)."""

from collections.abc import Iterable
from dataclasses import dataclass

from mmsverify.model import Clause

from .vocabulary import Mode, Status


@dataclass(frozen=True, slots=True)
class Meaning:
    """What each of some numbers means, and the statement that says so; ``None`` asks for nothing."""

    name: str
    numbers: range
    word: Status | str | None
    clause: Clause


MODES = dict(enumerate(Mode))
"""VR(C_RunMD); 0 to 16, as the tables of SetPreMode and SetNextMode print them."""


def _status(number: int, status: Status, *cites: str) -> Meaning:
    return Meaning(f"{number} {status}", range(number, number + 1), status, Clause.of(*cites))


STATUSES = tuple(
    _status(number, status, f"V-STA-{number:02}") for number, status in enumerate(Status) if number <= 10
)
SUB_ACTIONS = (Status.DBG_SUB, Status.HOME_SUB, Status.ORG_SUB, Status.RUN_SUB)
AS_LISTED = tuple(_status(number, status, f"V-STA-{number}") for number, status in enumerate(SUB_ACTIONS, 11))
"""The sub-actions in the table of VR(CS_RunSTA)."""
AS_SET = tuple(_status(number, status, f"V-PRE-{number}") for number, status in enumerate(SUB_ACTIONS, 13))
"""The sub-actions in the table of SetPreMode, which contradicts the other one (VR-12)."""


def statuses(reading: str) -> dict[int, list[Status | str | None]]:
    """What each number of VR(CS_RunSTA) may mean, by the profile's ``sub_action_status``."""
    tables = {"11-14": (AS_LISTED,), "13-16": (AS_SET,)}.get(reading, (AS_LISTED, AS_SET))
    found: dict[int, list[Status | str | None]] = {}
    for meaning in (*STATUSES, *(each for table in tables for each in table)):
        for number in meaning.numbers:
            found.setdefault(number, []).append(meaning.word)
    return found


def _basic(number: int, word: str | None) -> Meaning:
    cites = [f"V-CMD-{number:02}", "V-ACT-2", "V-CHK-T"]
    return Meaning(word or "no command", range(number, number + 1), word, Clause.of(*cites))


def _own(first: int, word: str) -> Meaning:
    return Meaning(word, range(first, first + 99), word, Clause.of(f"V-CMD-{first}", "V-CHK-T"))


BASIC = (None, "home", "org", "run", "stop", "pause", "step", "resume", "onErrB", "onErrS", "resetErr")
OWN = {101: "dbgSub", 201: "homeSub", 301: "orgSub", 401: "runSub"}
COMMAND_NUMBERS = (
    *(_basic(number, word) for number, word in enumerate(BASIC)),
    *(_own(first, word) for first, word in OWN.items()),
)


def _commands(table: Iterable[Meaning]) -> dict[int, str]:
    return {number: str(each.word) for each in table for number in each.numbers if each.word is not None}


SUB_MODES: dict[str, int | None] = dict.fromkeys(OWN.values())
"""What DoCmd sets VR(C_SubMD) to with each command of the user's: where no table says so, any number."""

COMMANDS = _commands(COMMAND_NUMBERS)
"""VR(C_Cmd): the command that each number is; 0 is none, any other number is unknown."""

TABLES = {
    "status number": STATUSES + AS_LISTED + AS_SET,
    "command number": COMMAND_NUMBERS,
}
"""What the register reads of them: the number tables, by what their entries are."""
