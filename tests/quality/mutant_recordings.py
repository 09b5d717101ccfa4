"""Recordings by which an audit tells a changed model from the real one.

They are the conversations written by hand and those of the robot that is written from the text alone, with
the faults of its catalogue: none is made from the rows that it judges.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from independent.catalogue import CATALOGUE
from independent.chance import Talk
from independent.tape import write
from mutation import Mutant
from robot_acts import LOOKS
from story import Story, stories

from mmsverify.audit.replay import Replay
from mmsverify.errors import DecodeError
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.mms import decode
from mmsverify.model import ModelData
from mmsverify.profiles import from_metadata, load_profile

BY_HAND = Path(__file__).parent / "by_hand"
FREE, MESSAGES = 12, 40
MOST = 14
ASKED_IN = {shown: service for service, names in LOOKS.items() for shown in names} | {
    "downloadSegmentAsked": "downloadSegment",
    "uploadRefused": "initiateUploadSequence",
    "terminateDownloadSequenceAsked": "terminateDownloadSequence",
    "stateAfterFailure": "start",
}

Found = list[tuple[int | None, str, str]]


def judged(path: Path, model: ModelData) -> Found:
    """What an audit by this model finds in a recording: where, which rule, how bad; notes apart."""
    trace = read_trace(path)
    tables: Mapping[str, Mapping[str, Any]] = {
        **load_profile(None),
        **from_metadata(trace.profile, str(path)),
    }
    replay = Replay(trace, tables, None, model.variant)
    replay.parts.model = model
    return [(f.index, f.rule, f.severity) for f in replay.run() if f.severity != "note"]


@dataclass
class Recording:
    """One recording: the clauses that are broken in it, as its author says, and the services in it."""

    path: Path
    model: ModelData
    clauses: frozenset[str]
    services: frozenset[str]

    @cached_property
    def found(self) -> Found:
        """What the real model finds."""
        return judged(self.path, self.model)


class Shelf:
    """All recordings; each is judged by the real model when it is first needed."""

    def __init__(self, model: ModelData, folder: Path) -> None:
        self.model = model
        self.recordings = [
            Recording(path, model, frozenset(clauses), _services(path)) for path, clauses in _written(folder)
        ]

    def telling(self, mutant: Mutant) -> str:
        """The first of the recordings in question that the mutant judges otherwise; empty if none does."""
        changed = mutant.applied(self.model)
        for recording in self.in_question(mutant):
            if judged(recording.path, changed) != recording.found:
                return recording.path.stem
        return ""

    def in_question(self, mutant: Mutant) -> list[Recording]:
        """Those in which the clause of the change is broken, then those in which the service is asked for.

        Shorter ones come first; of those that ask for a service the ones that were written by hand, and among
        these the ones that keep the rules.
        """
        wanted = {"eventNotification"} if mutant.occurrences else {*map(self.service, mutant.rows)}
        asked = [r for r in self.recordings if wanted & r.services]
        asked.sort(key=lambda r: r.path.stat().st_size)
        broken = [r for r in asked if r.clauses.intersection(mutant.clauses)]
        others = [r for r in asked if r not in broken]
        others.sort(key=lambda r: (not r.path.stem.startswith("by_hand"), bool(r.clauses)))
        return broken[:MOST] + others[: 2 * MOST]

    def service(self, number: int) -> str:
        """The service by which a recording shows the row."""
        on = self.model.rows[number].on
        return ASKED_IN.get(on.service, on.service) if on.phase == "shown" else on.service


def _written(folder: Path) -> Iterator[tuple[Path, Iterable[str]]]:
    """Each recording, and the clauses that are broken in it."""
    for path in stories(BY_HAND):
        story = Story(path.read_text(encoding="utf-8"))
        clauses = {clause for judgement in story.judged for clause in judgement.clauses}
        yield story.write(folder / f"by_hand-{path.stem}.mcap"), clauses
    for name, fault in CATALOGUE.items():
        yield write(folder / f"fault-{name}.mcap", fault.tape().messages, fault.profile), fault.clauses
    for seed in range(FREE):
        talk = Talk(seed)
        tape = talk.hold(MESSAGES)
        yield write(folder / f"free-{seed}.mcap", tape.messages, talk.profile), ()


def _services(path: Path) -> frozenset[str]:
    found = set()
    for message in read_trace(path):
        if message.message_encoding == "mms-ber":
            try:
                pdu = decode(message.data)
            except DecodeError:
                continue  # a fault of the octets is part of some recordings
            found.add(str(pdu.service))
            if "eventNotification" in repr(pdu):
                found.add("eventNotification")
    return frozenset(found)
