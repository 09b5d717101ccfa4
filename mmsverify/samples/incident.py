"""One cell, three protocols: what happened in it within a minute, by the clocks of all that were listening.

A line controller polls the robot's signals over Modbus/TCP and a cell controller talks MMS with it, while the
press beside it runs its automatic flow. A service panel sets a signal that is assigned to a function of the
robot; a second later the press homes in the middle of a run; the cell controller stops the robot as a whole,
and finds its program running.
"""

from __future__ import annotations

from mmsverify.samples.faults import faulty_vmd_stop
from mmsverify.samples.press import Press
from mmsverify.samples.recording import Recording
from mmsverify.samples.signals import DEDICATED, LINE, PANEL, Talk

SIGNALS = "weld5-signals"


def cell_incident() -> Recording:
    """The messages of the robot, of its signals and of the press, in the order of their times."""
    return Recording.of("cell5", [faulty_vmd_stop(), _signals(), _press()])


def _signals() -> Recording:
    talk = Talk(SIGNALS)
    talk.opens(LINE)
    for second in range(1, 18):
        talk.recording.wait(0.8)
        talk.polls(LINE, second % 8)
        if second == 9:  # the tap was full: nobody knows what was said for a second
            talk.recording.wait(1.1)
            talk.recording.link(LINE, "gap", "modbus")
    talk.opens(PANEL)
    talk.sets(PANEL, DEDICATED[0])
    for second in range(8):
        talk.recording.wait(3)
        talk.polls(LINE, second)
    talk.recording.link(PANEL, "close", "modbus")
    return talk.recording


def _press() -> Recording:
    press = Press()
    press.recording.wait(10)
    press.powered()
    press.home()
    press.to_origin()
    press.batch()
    press.scan(20)
    press.starts()
    press.home()
    press.to_origin()
    press.scan(80)
    return press.recording
