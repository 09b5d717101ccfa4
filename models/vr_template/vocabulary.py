"""The words of the VR template framework: modes, statuses and flags of the cells VR(0) to VR(15).

The numbers of the text are in ``numbers``; here are names. A mode with "insert" in its name stands in the table of
SetNextMode only: there it leads to the mode that it is named after.
"""

from collections.abc import Mapping

from mmsverify.model import Derived, Enumeration, Model, Relation, Variable, if_
from mmsverify.model.terms import Term


class Mode(Enumeration):
    """The action mode, VR(C_RunMD)."""

    IDLE = "Idle"
    DBG_RDY = "DbgRdy"
    HOME = "Home"
    HOME_RDY = "HomeRdy"
    ORG = "Org"
    ORG_RDY = "OrgRdy"
    RUN = "Run"
    STOP = "Stop"
    ERR_B = "ErrB"
    ERR_S = "ErrS"
    STOP_INSERT = "Stop_Insert"
    ERR_B_INSERT = "ErrB_Insert"
    ERR_S_INSERT = "ErrS_Insert"
    DBG_SUB = "Dbg_SubActions"
    HOME_SUB = "Home_SubActions"
    ORG_SUB = "Org_SubActions"
    RUN_SUB = "Run_SubActions"


class Status(Enumeration):
    """The system status, VR(CS_RunSTA)."""

    IDLE = "Idle"
    DBG_RDY = "DbgRdy"
    HOME = "Home"
    HOME_RDY = "HomeRdy"
    ORG = "Org"
    ORG_RDY = "OrgRdy"
    RUN_AUTO = "RunAuto"
    STOP = "Stop"
    ERR_B_PAUSE = "ErrB_Pause"
    ERR_S_PAUSE = "ErrS_Pause"
    RUN_PAUSE = "RunPause"
    DBG_SUB = "Dbg_SubActions"
    HOME_SUB = "Home_SubActions"
    ORG_SUB = "Org_SubActions"
    RUN_SUB = "Run_SubActions"


STATUS_OF = {
    Mode.DBG_RDY: Status.DBG_RDY, Mode.HOME: Status.HOME, Mode.HOME_RDY: Status.HOME_RDY, Mode.ORG: Status.ORG,
    Mode.ORG_RDY: Status.ORG_RDY, Mode.RUN: Status.RUN_AUTO, Mode.STOP: Status.STOP, Mode.ERR_B: Status.ERR_B_PAUSE,
    Mode.ERR_S: Status.ERR_S_PAUSE, Mode.DBG_SUB: Status.DBG_SUB, Mode.HOME_SUB: Status.HOME_SUB,
    Mode.ORG_SUB: Status.ORG_SUB, Mode.RUN_SUB: Status.RUN_SUB,
}  # fmt: skip
"""What SetPreMode sets the status to; of a mode that is not here it leaves the status alone."""


def looked_up(held: Term, table: Mapping[Mode, Status], otherwise: Term) -> Term:
    """The value that a table gives to what is held."""
    found = otherwise
    for key, value in table.items():
        found = if_(held == key, value, found)
    return found


class Vocabulary(Model):
    """Variables; no rows."""

    homed_at_power_on = Relation(rigid=True, doc="the controller keeps its homing while it is off")

    mode = Variable(Mode, cites=["V-VR-00"])
    status = Variable(Status, cites=["V-VR-01"])
    homed = Relation(doc="VR(CF_Home): the machine has been homed", cites=["V-VR-10"])
    lost = Relation(doc="a serious error has come since the machine was homed last")
    paused = Relation(doc="VR(CF_Pause): the automatic flow waits at a CheckPause", cites=["V-VR-12"])
    auto_org = Relation(doc="VR(CF_AutoOrg): go on to the work origin after homing", cites=["V-VR-15"])
    arrived = Relation(doc="homing has ended just now, and nothing has been commanded since")

    reported = Derived(
        looked_up(mode(), STATUS_OF, otherwise=status()), doc="the status that SetPreMode sets, as printed"
    )

    waits = Derived(
        mode().isin([Mode.DBG_RDY, Mode.HOME_RDY, Mode.ORG_RDY]), doc="one of the three waiting states"
    )
    acts_by_itself = Derived(
        mode().isin([Mode.HOME, Mode.ORG, Mode.RUN, Mode.DBG_SUB, Mode.HOME_SUB, Mode.ORG_SUB, Mode.RUN_SUB])
    )
    failed = Derived(mode().isin([Mode.ERR_B, Mode.ERR_S, Mode.ERR_B_INSERT, Mode.ERR_S_INSERT]))
