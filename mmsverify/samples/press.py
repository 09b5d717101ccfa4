"""A press whose controller runs the VR template framework: a short shift without a fault, and one with two.

Each scan Control02 first sets the status from the mode that it finds; then the mode may change, by a command
that Cmd02 takes from C_Cmd or because an action has ended. So the status is one scan behind.
"""

from __future__ import annotations

from mmsverify.formats.vr import CELLS
from mmsverify.samples.recording import Recording

SCAN = 0.05
IDLE, DBG_RDY, HOME, HOME_RDY, ORG, ORG_RDY, RUN, STOP, ERR_B, ERR_S = range(10)
SUB_STATUS = {13: 11, 14: 12, 15: 13, 16: 14}
"""The status while an action of the user's goes on, by the table of VR(CS_RunSTA)."""
RUN_PAUSE = 10
JOG_RAM, CHANGE_DIE, TEST_STROKE, EJECT = 101, 203, 305, 402
"""This press's own commands, one of each kind."""


class Press:
    """The cells of one press; each scan is a sample."""

    def __init__(self) -> None:
        self.recording = Recording("press3")
        self._cells: dict[str, int] = {cell.name: 0 for cell in CELLS if not cell.reserved}

    def scan(self, times: int = 1) -> None:
        """So many scans, in which no mode changes."""
        for _ in range(times):
            self._scan()

    def command(self, number: int, mode: int | None = None, *, sub: int = 0, **flags: int) -> None:
        """The panel writes a command; in the same scan the mode is set, and a flag or two."""
        self._scan(mode, C_Cmd=number, **({"C_SubMD": sub} if sub else {}), **flags)
        self._cells["C_Cmd"] = 0

    def ends(self, mode: int, **flags: int) -> None:
        """What went on has ended, and SetNextMode sets the mode that comes next."""
        self._scan(mode, **flags)

    def _scan(self, mode: int | None = None, **cells: int) -> None:
        self._cells["CS_RunSTA"] = self._status()
        self._cells |= cells
        if mode is not None:
            self._cells["C_RunMD"] = mode
        self.recording.wait(SCAN)
        self.recording.show("scan", self._cells)

    def _status(self) -> int:
        mode = self._cells["C_RunMD"]
        if mode == RUN and self._cells["CF_Pause"]:
            return RUN_PAUSE
        return SUB_STATUS.get(mode, mode)

    # What an operator does.

    def home(self) -> None:
        """Home, and homing ends."""
        self.command(1, HOME)
        self.scan(30)
        self.ends(HOME_RDY, CF_Home=1)
        self.scan(10)

    def to_origin(self) -> None:
        """Org, and the press is at its work origin."""
        self.command(2, ORG)
        self.arrives()

    def arrives(self) -> None:
        """The way to the work origin ends."""
        self.scan(15)
        self.ends(ORG_RDY)
        self.scan(5)

    def own(self, number: int, mode: int, ends: int) -> None:
        """An action of the user's, from the beginning to the mode in which it ends."""
        self.command(number, mode, sub=number % 100)
        self.scan(12)
        self.ends(ends)
        self.scan(5)

    def starts(self) -> None:
        """Run, and some strokes are made."""
        self.command(3, RUN, CS_RunStepCount=1)
        self.strokes(2, 4)

    def strokes(self, first: int, last: int) -> None:
        """Steps of the automatic flow, counted."""
        for count in range(first, last + 1):
            self._scan(CS_RunStepCount=count)
            self.scan(8)

    def batch(self) -> None:
        """A whole run; from its end the press goes back to the work origin by itself."""
        self.starts()
        self.ends(ORG, CS_RunStepCount=0)
        self.arrives()

    def powered(self) -> None:
        """Power comes on, and initialisation ends."""
        self.scan(4)
        self.ends(DBG_RDY)
        self.scan(20)

    def fails(self, number: int, mode: int, error: int, **flags: int) -> None:
        """The program reports an error, and the press waits for somebody to look."""
        self.command(number, mode, CF_Err=1, CS_ErrId=error, **flags)
        self.scan(40)


def day() -> Recording:
    """Everything that the framework has happens once at least, and as the text has it."""
    press = Press()
    press.powered()
    press.own(JOG_RAM, 13, DBG_RDY)
    press.home()
    press.own(CHANGE_DIE, 14, HOME_RDY)
    press.to_origin()
    press.own(TEST_STROKE, 15, ORG_RDY)
    for _ in range(3):
        press.batch()
    _interrupted(press)
    _stopped(press)
    _general_error(press)
    _serious_error(press)
    press.to_origin()
    press.batch()
    return press.recording


def _interrupted(press: Press) -> None:
    """A run that is paused, goes on by one step, is resumed, and ejects a part."""
    press.starts()
    press.command(5, CF_Pause=1)
    press.scan(20)
    press.command(6, CF_Step=1, CF_Pause=0)
    press.scan(3)
    press.ends(RUN, CF_Step=0, CF_Pause=1)
    press.scan(10)
    press.command(7, CF_Pause=0)
    press.strokes(5, 6)
    press.own(EJECT, 16, RUN)
    press.ends(ORG, CS_RunStepCount=0)
    press.arrives()


def _stopped(press: Press) -> None:
    """A run is stopped; the press was homed, so it waits in HomeRdy."""
    press.starts()
    press.command(4, STOP, CF_Stop=1, CS_RunStepCount=0)
    press.scan(10)
    press.ends(HOME_RDY, CF_Stop=0)
    press.scan(10)
    press.to_origin()


def _general_error(press: Press) -> None:
    """A general error in a run, which keeps the homing."""
    press.starts()
    press.fails(9, ERR_S, 12, CS_RunStepCount=0)
    press.command(10, HOME_RDY, CF_Err=0, CS_ErrId=0)
    press.scan(10)
    press.to_origin()


def _serious_error(press: Press, *, homes: bool = True) -> None:
    """A serious error in a run, which costs the homing."""
    press.starts()
    press.fails(8, ERR_B, 31, CS_RunStepCount=0, CF_Home=0)
    press.command(10, DBG_RDY, CF_Err=0, CS_ErrId=0)
    press.scan(10)
    if homes:
        press.home()


def faulty_press() -> Recording:
    """Home is obeyed during a run; later Org is, after a serious error and without a new homing."""
    press = Press()
    press.powered()
    press.home()
    press.to_origin()
    press.starts()
    press.home()
    press.to_origin()
    press.batch()
    _serious_error(press, homes=False)
    press.to_origin()
    return press.recording
