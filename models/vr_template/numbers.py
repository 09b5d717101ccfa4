"""The numbers that the text gives to cells, modes, statuses and commands (VR section; DoCmd, SetPreMode, SetNextMode)."""

from .vocabulary import Mode, Status

MODES = dict(enumerate(Mode))
"""VR(C_RunMD); 0 to 16, as the tables of SetPreMode and SetNextMode print them."""

STATUSES = {number: [status] for number, status in enumerate(Status) if number <= 10}
SUB_ACTIONS = (Status.DBG_SUB, Status.HOME_SUB, Status.ORG_SUB, Status.RUN_SUB)
AS_LISTED = {11 + place: [status] for place, status in enumerate(SUB_ACTIONS)}
"""The sub-actions in the table of VR(CS_RunSTA)."""
AS_SET = {13 + place: [status] for place, status in enumerate(SUB_ACTIONS)}
"""The sub-actions in the table of SetPreMode, which contradicts the other one."""


def statuses(reading: str) -> dict[int, list[Status]]:
    """What each number of VR(CS_RunSTA) may mean, by the profile's ``sub_action_status``."""
    tables = {"11-14": (AS_LISTED,), "13-16": (AS_SET,)}.get(reading, (AS_LISTED, AS_SET))
    found = dict(STATUSES)
    for table in tables:
        for number, meant in table.items():
            found[number] = [*found.get(number, []), *meant]
    return found


COMMANDS = {
    1: "home", 2: "org", 3: "run", 4: "stop", 5: "pause", 6: "step", 7: "resume", 8: "onErrB", 9: "onErrS", 10: "resetErr",
    **dict.fromkeys(range(101, 200), "dbgSub"),
    **dict.fromkeys(range(201, 300), "homeSub"),
    **dict.fromkeys(range(301, 400), "orgSub"),
    **dict.fromkeys(range(401, 500), "runSub"),
}  # fmt: skip
"""VR(C_Cmd): the command that each number is; 0 is none, any other number is unknown."""
