"""Recordings by which an audit tells a changed VR framework from the real one.

They are runs written by hand, right ones and wrong ones, scan by scan and polled, and the sample recordings
of a press: none is made from the rows that it judges.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

from small_score import Small
from vr_by_hand import lawful, wrong
from vr_random import BEGIN, NAME, SCAN, framework
from vr_runs import KINDS
from vr_story import told

from mmsverify.audit.telling import Place
from mmsverify.audit.vr import Controller, Numbering, Scans
from mmsverify.concrete.automaton import Automaton
from mmsverify.concrete.machine import Machine
from mmsverify.concrete.scope import scope_for
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.trace import Channel, TraceMessage
from mmsverify.formats.vr import encode
from mmsverify.model import ModelData
from mmsverify.profiles import from_metadata
from mmsverify.resources import traces_dir

SAMPLES = ("press-day.mcap", "faulty-press.mcap")
Found = list[tuple[int | None, str, str]]


@dataclass(frozen=True)
class Recording:
    """The samples of one controller, and which table of statuses it has."""

    name: str
    messages: tuple[TraceMessage, ...]
    reading: str

    def judged(self, scans: Scans) -> Found:
        """What an audit by these rows finds: where, which rule, how bad; notes apart."""
        numbering = Numbering(framework().options["numbers"], self.reading)
        controller = Controller(Place("told.mcap", NAME), scans, numbering)
        found = (each for message in self.messages for each in controller.sample(message))
        return [(f.index, f.rule, f.severity) for f in found if f.severity != "note"]

    @cached_property
    def found(self) -> Found:
        """What the real model finds."""
        return self.judged(real_scans())


def scans_of(model: ModelData) -> Scans:
    """The rows of a model as the audit sees them."""
    return Scans(Automaton(Machine(model, scope_for(model, {}, {}))))


@cache
def real_scans() -> Scans:
    """Those of the model that is shipped."""
    return scans_of(framework())


@cache
def recordings() -> tuple[Recording, ...]:
    """All of them: samples, right runs, wrong runs."""
    return *map(sample, SAMPLES), *written([*lawful(), *wrong()])


def sample(name: str) -> Recording:
    """A sample recording."""
    trace = read_trace(Path(traces_dir()) / name)
    profile = from_metadata(trace.profile, name)["vr-template"]
    return Recording(name, tuple(trace), str(profile["sub_action_status"]))


def written(stories: Iterable[str]) -> Iterator[Recording]:
    """Each run, scan by scan and polled."""
    for kind in KINDS:
        channel = Channel.vr(NAME, kind)
        for story in stories:
            cells = enumerate(told(story))
            messages = (TraceMessage(n, BEGIN + n * SCAN, channel, encode(c)) for n, c in cells)
            yield Recording(f"{kind}: {story}", tuple(messages), "13-16")


def telling(model: ModelData) -> str:
    """The first recording that a changed model judges otherwise; empty if none does."""
    changed = scans_of(model)
    return next((each.name for each in recordings() if each.judged(changed) != each.found), "")


TEMPLATE = Small("vr-template", untold=frozenset({"cuts_in"}), telling=telling)
"""The framework. ``cuts_in``: whether an action is cut short by way of an inserted mode; no cell says so."""
TASKS = Small("vr-tasks")
"""Its two tasks: what a recording shows is not split into their steps."""
