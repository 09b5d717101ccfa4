"""Stories: conversations written by hand from the text of the clauses, with their author's judgement.

One message a line: who speaks, and what. Names of associations stand for their clients.

    # The arm is stopped, the robot goes on.
    given associations single
    client opens
    client Initiate
    robot  +
    client Stop R_ARM
    robot  +
    client Status
    robot  + EXECUTING selected Weld
    !! error R-6.3.5.9-1 or R-7.3.3.4.1-c: motion is not enabled once R_ARM is stopped

``robot`` answers on the association that spoke last; ``robot to b`` on another, and ``robot Start +`` answers
that service where several wait. ``robot asks`` is a request of its own, which the client then answers.
``opens``, ``closes``, ``resets`` and ``gap`` are events of the connection. A line with ``!!`` judges the
message before it; any one of the clauses must be cited. A story without such a line is one of a robot that
keeps the rules. ``waits`` says why a story is not judged right yet.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, cast

import story_answers
from story_words import REQUESTS, Words

from mmsverify.formats.mms import Pdu, number
from mmsverify.formats.trace import LinkEvent, Sender
from mmsverify.samples import pdus
from mmsverify.samples.cell import OFFERED, ROBOT_ADDITIONAL
from mmsverify.samples.recording import Recording

LINKS = ("opens", "closes", "resets", "gap")
MORE = ("loadDomainContent", "storeDomainContent", "getEventConditionAttributes")


@dataclass(frozen=True, slots=True)
class Judged:
    """What the author finds wrong: at which message, how bad, against which of these statements, and why."""

    index: int
    severity: str
    clauses: tuple[str, ...]
    because: str


@dataclass(slots=True)
class Waiting:
    """A request that waits for its answer; of Initiate and Conclude the service is the word for the PDU."""

    service: str
    invoke_id: int
    body: Any = None


@dataclass(slots=True)
class Side:
    """What one side of an association has asked, and what of it waits."""

    asked: int = 0
    waiting: list[Waiting] = field(default_factory=list)

    def answered(self, service: str) -> Waiting:
        """The request that an answer belongs to: the last one of that service, or of any."""
        found = next(w for w in reversed(self.waiting) if service in ("", w.service))
        self.waiting.remove(found)
        return found


class Story:
    """A story as it is read: its recording, what is given about the robot, what its author finds wrong."""

    def __init__(self, text: str) -> None:
        self.recording = Recording("robot")
        self.given: dict[str, str] = {}
        self.judged: list[Judged] = []
        self.waits = ""
        self._sides: dict[tuple[str, Sender], Side] = {}
        self._last = ""
        self._count = 0
        for number_, line in enumerate(text.splitlines(), 1):
            try:
                self._line(line.strip())
            except (ValueError, KeyError, StopIteration) as error:
                raise ValueError(f"line {number_}: {line!r}: {error!r}") from error

    def write(self, path: Path) -> Path:
        """The story as a trace file."""
        self.recording.write(path, {"model": "mms-robot", **self.given} if self.given else None)
        return path

    def _line(self, line: str) -> None:
        if not line or line.startswith("#"):
            return
        if line.startswith("!!"):
            self.judged.append(_judgement(line, self._count - 1))
            return
        speaker, _, said = line.partition(" ")
        if speaker == "given":
            name, _, value = said.strip().partition(" ")
            self.given[name] = value
            return
        if speaker == "waits":
            self.waits = said.strip()
            return
        self._count += 1
        if speaker == "robot":
            self._robot(Words(said))
        elif said.strip() in LINKS:
            self._linked(speaker, said.strip())
        else:
            self._client(speaker, Words(said))

    def _linked(self, name: str, word: str) -> None:
        self.recording.link(name, cast(LinkEvent, word.removesuffix("s")))
        if word != "opens":
            self._sides = {key: side for key, side in self._sides.items() if key[0] != name}

    def _client(self, name: str, words: Words) -> None:
        self._last = name
        if words.take("+"):
            self._say(name, "client", self._positive(self._side(name, "server").answered(""), words))
        elif words.take("-"):
            self._say(name, "client", _negative(self._side(name, "server").answered(""), words))
        else:
            self._ask(name, "client", words)

    def _robot(self, words: Words) -> None:
        name = words.next() if words.take("to") else self._last
        told = story_answers.unasked(words)
        if told is not None:
            self._say(name, "server", told)
        elif words.take("asks"):
            self._ask(name, "server", words)
        else:
            self._answer(name, words)

    def _answer(self, name: str, words: Words) -> None:
        word = words.next()
        service = "" if word in ("+", "-", "reject") else _service(word)
        sign = words.next() if service else word
        asked = self._side(name, "client").answered(service)
        made = {"+": self._positive, "-": _negative, "reject": _rejection}[sign]
        self._say(name, "server", made(asked, words))

    def _ask(self, name: str, sender: Sender, words: Words) -> None:
        word, side = words.next(), self._side(name, sender)
        if word == "Cancel":
            cancelled = next(w for w in side.waiting if w.service == _service(words.next()))
            side.waiting.append(Waiting("cancel", cancelled.invoke_id))
            self._say(name, sender, Pdu("cancel-RequestPDU", cancelled.invoke_id))
        elif word in ("Initiate", "Conclude"):
            side.waiting.append(Waiting(word.lower(), 0))
            body = _initiation("Request", words) if word == "Initiate" else Pdu("conclude-RequestPDU")
            self._say(name, sender, body)
        else:
            side.asked += 1
            service, asked, detail = REQUESTS[word](words)
            side.waiting.append(Waiting(service, side.asked, asked))
            self._say(name, sender, pdus.request(side.asked, service, asked, detail))

    def _positive(self, asked: Waiting, words: Words) -> Pdu:
        match asked.service:
            case "initiate":
                return _initiation("Response", words)
            case "conclude":
                return Pdu("conclude-ResponsePDU")
            case "cancel":
                return Pdu("cancel-ResponsePDU", asked.invoke_id)
        body, detail = story_answers.answer(asked.service, asked.body, words)
        return pdus.response(asked.invoke_id, asked.service, body, detail)

    def _side(self, name: str, sender: Sender) -> Side:
        return self._sides.setdefault((name, sender), Side())

    def _say(self, name: str, sender: Sender, pdu: Pdu) -> None:
        self.recording.say(name, sender, pdu)


def _service(word: str) -> str:
    """The service that a word names: its name with a capital letter."""
    return word[0].lower() + word[1:]


def _negative(asked: Waiting, words: Words) -> Pdu:
    if asked.service == "conclude":
        return Pdu("conclude-ErrorPDU", body=story_answers.failure(words, "")["serviceError"])
    return Pdu("confirmed-ErrorPDU", asked.invoke_id, body=story_answers.failure(words, asked.service))


def _rejection(asked: Waiting, words: Words) -> Pdu:
    reason = number("RejectConfirmedRequest", words.next())
    return Pdu("rejectPDU", asked.invoke_id, body={"rejectReason": ("confirmed-request", reason)})


def _initiation(sort: str, words: Words) -> Pdu:
    """``version 2 outstanding 3 lacking kill select``: Initiate with what is not as usual."""
    version = int(words.next()) if words.take("version") else 1
    outstanding = int(words.next()) if words.take("outstanding") else 5
    lacking = set(words.rest()[1:]) if words else set()
    side: Sender = "client" if sort == "Request" else "server"
    services = [s for s in (*OFFERED[side], *(MORE if side == "server" else ())) if s not in lacking]
    additional = [s for s in ROBOT_ADDITIONAL if side == "server" and s not in lacking]
    made = pdus.initiation(sort, services, additional, outstanding)
    detail = made.body[f"init{sort}Detail"]
    detail["proposedVersionNumber" if sort == "Request" else "negotiatedVersionNumber"] = version
    return made


def _judgement(line: str, index: int) -> Judged:
    head, _, because = line.removeprefix("!!").partition(":")
    severity, *clauses = head.replace(" or ", " ").split()
    return Judged(index, severity, tuple(clauses), because.strip())


def stories(folder: Path) -> Iterator[Path]:
    """The files of all stories."""
    yield from sorted(folder.glob("*.txt"))
