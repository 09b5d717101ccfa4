"""What a report shows of a recording beside its findings, as data: who said what, and what was known when.

Readers of recordings make these; renderers and notebooks read them, and compute nothing.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from mmsverify.results import Account

GAP = "gap"
CLIENT, SERVER = "client", "server"


@dataclass(frozen=True, slots=True)
class Change:
    """From the message ``index`` on, at ``time`` (ns since 1970), other ``words`` hold; empty: unknown."""

    index: int
    time: int
    words: str


@dataclass(frozen=True, slots=True)
class Lane:
    """One attribute of a device over time: its changes in event order."""

    name: str
    changes: Sequence[Change]


@dataclass(frozen=True, slots=True)
class DeviceLine:
    """What is known of one device while a recording goes by; from message to message, by its ``model``.

    The model is empty where none was asked to judge the device.

    ``begin`` and ``end`` (ns) are those of its messages, ``messages`` how many they are. ``links`` are the
    connections' events: words such as ``open cell-controller``; of a ``gap`` messages may be missing.
    """

    device: str
    model: str
    begin: int
    end: int
    messages: int
    lanes: Sequence[Lane]
    links: Sequence[Change] = ()

    @property
    def gaps(self) -> list[Change]:
        """The events after which messages are missing."""
        return [link for link in self.links if link.words.startswith(GAP)]


@dataclass(frozen=True, slots=True)
class Saying:
    """One message in words: who said it to whom, what it is, what it is ``about``, and what it carries.

    ``sender`` is ``client`` or ``server``, or empty where nobody sends it (a sample, a link event).
    ``partner`` is the association or connection. ``answers`` is the index of the request, where it answers
    one that is known. ``fields`` are the decoded values, by their dotted path; ``fault`` says why octets
    could not be read. ``number`` is the message's among those of its device, from 1 (0: not known).
    """

    index: int
    time: int
    device: str
    partner: str
    sender: str
    title: str
    octets: bytes
    about: str = ""
    answers: int | None = None
    fields: Sequence[tuple[str, str]] = ()
    fault: str = ""
    number: int = 0


@dataclass(frozen=True, slots=True)
class Origin:
    """Which recording it was: its path, its size and SHA-256, and what it says of its making."""

    path: str
    octets: int
    sha256: str
    library: str = ""


@dataclass(frozen=True, slots=True)
class Incident:
    """One recording: its devices over time, and the messages around its findings.

    ``windows`` are the indices of the messages around the message of a finding, by its index; ``sayings`` the
    messages that stand in some window, by index. Of more findings than are shown in full there is no window.
    """

    origin: Origin
    devices: Sequence[DeviceLine]
    sayings: Mapping[int, Saying] = field(default_factory=dict)
    windows: Mapping[int, Sequence[int]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Dossier:
    """What a report shows beside an audit: its incidents by path, what the cited statements say, by whom.

    ``statements`` are in the project's words, by id. ``judged`` are name and value of what the result rests
    on: model, variant, profile, version. ``accounts`` tell why findings stand, by path, index and rule: of
    the first findings only, for each takes a second or more.
    """

    incidents: Mapping[str, Incident] = field(default_factory=dict)
    statements: Mapping[str, str] = field(default_factory=dict)
    judged: Sequence[tuple[str, str]] = ()
    accounts: Mapping[tuple[str, int | None, str], Account] = field(default_factory=dict)
