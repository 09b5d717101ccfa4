"""Recordings by which an audit tells a changed model from the real one.

They are the conversations written by hand and those of the robot that is written from the text alone, with
the faults of its catalogue: none is made from the rows that it judges.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from independent.catalogue import CATALOGUE
from independent.chance import Talk
from independent.tape import write
from robot_acts import LOOKS
from robot_mutation import Mutant
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
    replay.model = model
    return [(f.index, f.rule, f.severity) for f in replay.run() if f.severity != "note"]


@dataclass
class Recording:
    """One recording, the services in it, and what the real model finds."""

    path: Path
    services: frozenset[str]
    found: Found


@dataclass
class Shelf:
    """All recordings, judged by the real model."""

    model: ModelData
    folder: Path
    recordings: list[Recording] = field(default_factory=list)

    def __post_init__(self) -> None:
        for path in _written(self.folder):
            self.recordings.append(Recording(path, _services(path), judged(path, self.model)))

    def telling(self, mutant: Mutant) -> str:
        """The first of the recordings in question that the mutant judges otherwise; empty if none does."""
        changed = mutant.applied(self.model)
        for recording in self.in_question(mutant):
            found = judged(recording.path, changed)
            if found != recording.found:
                return recording.path.stem
        return ""

    def in_question(self, mutant: Mutant) -> list[Recording]:
        """Those in which the changed rule is broken, then those in which the changed service is asked for."""
        services = {self.service(number) for number in mutant.rows}
        events = bool(mutant.occurrences)
        rules = {r.path: {rule for _, rule, _ in r.found} for r in self.recordings}
        broken = [r for r in self.recordings if mutant.rule and mutant.rule in rules[r.path]]
        wanted = {"eventNotification"} if events else services
        asked = [r for r in self.recordings if r not in broken and (wanted & r.services)]
        size = {r.path: r.path.stat().st_size for r in asked}
        asked.sort(key=lambda r: (bool(r.found) is not bool(mutant.rule), size[r.path]))
        return broken[:3] + asked[: MOST if not events else len(asked)]

    def service(self, number: int) -> str:
        """The service by which a recording shows the row."""
        on = self.model.rows[number].on
        return ASKED_IN.get(on.service, on.service) if on.phase == "shown" else on.service


def _written(folder: Path) -> Iterator[Path]:
    for path in stories(BY_HAND):
        yield Story(path.read_text(encoding="utf-8")).write(folder / f"by_hand-{path.stem}.mcap")
    for name, fault in CATALOGUE.items():
        yield write(folder / f"fault-{name}.mcap", fault.tape().messages, fault.profile)
    for seed in range(FREE):
        talk = Talk(seed)
        tape = talk.hold(MESSAGES)
        yield write(folder / f"free-{seed}.mcap", tape.messages, talk.profile)


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
