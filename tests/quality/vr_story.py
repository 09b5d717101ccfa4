"""Runs of a controller in shorthand, and what an audit makes of them.

``0 1 1! 2 3``: a number is a sample with this mode and its status, ``1!`` one in which the operator has
written command 1 and the mode is as before; with the next sample the command is gone. ``6:10`` is mode 6 with
status 10. CF_Home is set when Home ends, and cleared by a serious error. ``A`` is a sample in which
CF_AutoOrg has been set.
A ``*`` behind a number marks the sample that is to be blamed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache

from vr_random import BEGIN, NAME, SCAN, automaton, framework
from vr_runs import Sampling

from mmsverify.audit.telling import Place
from mmsverify.audit.vr import Controller, Numbering, Scans
from mmsverify.formats.trace import Channel, TraceMessage
from mmsverify.formats.vr import encode
from mmsverify.results import Finding

READY = "0 1 1! 2 3 2! 4 5"
"""From power-on to OrgRdy."""
RUNNING = f"{READY} 3! 6"
INSERTS = {10, 11, 12}
"""Modes for which SetPreMode has no row."""


def told(story: str) -> Iterator[dict[str, int]]:
    """The samples of a story."""
    cells = {"C_RunMD": 0, "CS_RunSTA": 0, "C_Cmd": 0, "CF_Home": 0}
    for word in story.replace("*", "").split():
        if word == "A":
            cells = cells | {"CF_AutoOrg": 1}
        elif word.endswith("!"):
            cells = cells | {"C_Cmd": int(word[:-1])}
        else:
            shown, _, beside = word.partition(":")
            mode, before = int(shown), cells["C_RunMD"]
            status = int(beside) if beside else cells["CS_RunSTA"] if mode in INSERTS else mode
            homed = 1 if (before, mode) == (2, 3) else 0 if mode in (8, 11) else cells["CF_Home"]
            cells = {"C_RunMD": mode, "CS_RunSTA": status, "C_Cmd": 0, "CF_Home": homed}
        yield cells


@cache
def scans() -> Scans:
    """The automaton as the audit sees it; what it remembers of one story serves the next."""
    return Scans(automaton())


def findings(story: str, kind: Sampling, reading: str = "13-16") -> list[Finding]:
    """What an audit finds, notes apart."""
    found = audited([encode(cells) for cells in told(story)], kind, reading)
    return [each for each in found if each.severity != "note"]


def audited(samples: Iterable[bytes], kind: Sampling, reading: str = "either") -> list[Finding]:
    """What an audit finds in samples as they are written."""
    numbering = Numbering(framework().options["numbers"], reading)
    controller = Controller(Place("told.mcap", NAME), scans(), numbering)
    channel = Channel.vr(NAME, kind)
    messages = (TraceMessage(n, BEGIN + n * SCAN, channel, data) for n, data in enumerate(samples))
    return [found for message in messages for found in controller.sample(message)]


def marked(story: str) -> list[int]:
    """The samples that are to be blamed."""
    return [place for place, word in enumerate(story.split()) if word.endswith("*")]
