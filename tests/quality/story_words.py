"""The words of stories: what is asked for, one line each, as requests.

Only words and their places in a PDU stand here: nothing knows a rule, so that anybody can say anything.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Callable, Mapping
from typing import Any

from mmsverify.formats.mms import bit_string
from mmsverify.samples import pdus
from mmsverify.samples.pdus import of_domain, variables, vmd

Asked = tuple[str, Any, Any]
"""Service, body, the robot's part."""

TOKEN = re.compile(r'"[^"]*"|[\[\]()]|[^\s\[\]()"]+')
KINDS = {"normal": None, "controlling": 1, "controlled": 2}


class Words:
    """The words of one line, taken one after the other."""

    def __init__(self, line: str) -> None:
        self._left = TOKEN.findall(line)

    def __bool__(self) -> bool:
        return bool(self._left)

    def next(self) -> str:
        """The next word, without its quotation marks."""
        if not self._left:
            raise ValueError("the line ends too early")
        return str(self._left.pop(0)).strip('"')

    def take(self, word: str) -> bool:
        """Whether the next word is this one; then it is taken."""
        taken = bool(self._left) and self._left[0] == word
        return bool(self._left.pop(0)) if taken else False

    def rest(self) -> list[str]:
        """All words that are left."""
        left, self._left = self._left, []
        return [word.strip('"') for word in left]

    def listed(self) -> list[str]:
        """Words between brackets; none where no bracket is next."""
        found: list[str] = []
        if self.take("["):
            while not self.take("]"):
                found.append(self.next())
        return found

    def value(self) -> tuple[str, Any]:
        """A value as Data: true, 3, 3.0, "text", [an array], (a structure)."""
        for begin, end, kind in (("[", "]", "array"), ("(", ")", "structure")):
            if self.take(begin):
                parts = []
                while not self.take(end):
                    parts.append(self.value())
                return kind, parts
        text = self._left[0] if self._left else ""
        word = self.next()
        if text.startswith('"'):
            return "visible-string", word
        if word in ("true", "false"):
            return "boolean", word == "true"
        if "." in word:
            return "floating-point", b"\x08" + struct.pack(">f", float(word))
        return "integer", int(word)


def named(name: str) -> tuple[str, Any]:
    """A variable's name; the domain that it belongs to stands before a slash."""
    domain, _, item = name.rpartition("/")
    return of_domain(domain, item) if domain else vmd(name)


def limit(words: Words) -> tuple[str, Any] | None:
    """``free``, ``cycles 3`` or ``steps 3``: the running mode with its count."""
    if words.take("free"):
        return "noLimit", None
    for word, kind in (("cycles", "cycleCount"), ("steps", "stepCount")):
        if words.take(word):
            return kind, int(words.next())
    return None


# What is asked for.


def program(service: str) -> Callable[[Words], Asked]:
    """Stop, Reset, Kill: nothing but a name."""
    return lambda words: (service, {"programInvocationName": words.next()}, None)


def plain(service: str, body: Any = None) -> Callable[[Words], Asked]:
    """A service with always the same arguments."""
    return lambda _: (service, body, None)


def of_name(service: str, wrap: Callable[[str], Any] = str) -> Callable[[Words], Asked]:
    """A service whose argument is a name."""
    return lambda words: (service, wrap(words.next()), None)


def create(words: Words) -> Asked:
    """``Create Weld controlling of [Weld R_ARM] once monitored``."""
    name, kind = words.next(), KINDS[words.next()]
    domains = words.listed() if words.take("of") else [name]
    body: dict[str, Any] = {"programInvocationName": name, "listOfDomainNames": domains}
    body["reusable"] = not words.take("once")
    return (
        "createProgramInvocation",
        {**body, **({"monitorType": True} if words.take("monitored") else {})},
        kind,
    )


def start(words: Words) -> Asked:
    """``Start Weld at "20" cycles 3``; neither: a Start without the robot's part."""
    name = words.next()
    location = {"startLocation": words.next()} if words.take("at") else {}
    count = limit(words)
    detail = {**location, "startCount": count or ("cycleCount", 1)}
    return "start", {"programInvocationName": name}, ("controlling", detail) if location or count else None


def resume(words: Words) -> Asked:
    """``Resume Weld unchanged``, ``Resume Weld steps 1``; neither: a Resume without the robot's part."""
    name = words.next()
    mode: Any = ("continueMode", None) if words.take("unchanged") else None
    count = limit(words)
    mode = ("changeMode", count) if count else mode
    return "resume", {"programInvocationName": name}, ("controlling", {"modeType": mode}) if mode else None


def select(words: Words) -> Asked:
    """``Select Weld [R_ARM]``, ``Select none``."""
    name = words.next()
    return "select", {} if name == "none" else {"controlling": name, "controlled": words.listed()}, None


def alter(words: Words) -> Asked:
    """``Alter Weld cycles 3``."""
    return "alterPI", {"programInvocation": words.next(), "startCount": limit(words)}, None


def write(words: Words) -> Asked:
    """``Write Part_Count 3``."""
    specification = variables(named(words.next()))
    return "write", {"variableAccessSpecification": specification, "listOfData": [words.value()]}, None


def download(words: Words) -> Asked:
    """``Download Weld``: the sequence begins."""
    body = {"domainName": words.next(), "listOfCapabilities": [], "sharable": words.take("sharable")}
    return "initiateDownloadSequence", body, None


def load(words: Words) -> Asked:
    """``Load Weld from weld.job``: from a file of the robot's own."""
    body = {"domainName": words.next(), "listOfCapabilities": [], "sharable": False}
    words.take("from")
    return "loadDomainContent", {**body, "fileName": [words.next()]}, None


def store(words: Words) -> Asked:
    """``Store Weld to weld.job``."""
    name = words.next()
    words.take("to")
    return "storeDomainContent", {"domainName": name, "fileName": [words.next()]}, None


def enroll(words: Words) -> Asked:
    """``Enroll Halt on R_ARM leaving doing R_ARM``: active-to-idle; ``entering`` for idle-to-active."""
    name, _, condition = words.next(), words.take("on"), words.next()
    passed = "active-to-idle" if words.take("leaving") else "idle-to-active"
    words.take("entering")
    body = {
        "eventEnrollmentName": vmd(name), "eventConditionName": vmd(condition),
        "eventConditionTransitions": bit_string("Transitions", [passed], 7), "alarmAcknowledgmentRule": 0,
    }  # fmt: skip
    action = {"eventActionName": vmd(words.next())} if words.take("doing") else {}
    return "defineEventEnrollment", {**body, **action}, None


REQUESTS: Mapping[str, Callable[[Words], Asked]] = {
    "Status": plain("status", False),
    "Identify": plain("identify"),
    "Attributes": of_name("getProgramInvocationAttributes"),
    "Create": create,
    "Delete": of_name("deleteProgramInvocation"),
    "Start": start,
    "Stop": program("stop"),
    "Resume": resume,
    "Reset": program("reset"),
    "Kill": program("kill"),
    "Select": select,
    "Alter": alter,
    "VmdStop": plain("vMDStop"),
    "VmdReset": plain("vMDReset", False),
    "TakeControl": plain("takeControl", {"semaphoreName": vmd("R_CTRL"), "priority": 64}),
    "RelinquishControl": plain("relinquishControl", {"semaphoreName": vmd("R_CTRL")}),
    "Semaphore": plain("reportSemaphoreStatus", vmd("R_CTRL")),
    "Read": lambda words: ("read", pdus.reading(*map(named, words.rest())), None),
    "Write": write,
    "Download": download,
    "DownloadSegment": of_name("downloadSegment"),
    "EndDownload": of_name("terminateDownloadSequence", lambda name: {"domainName": name}),
    "Upload": of_name("initiateUploadSequence"),
    "UploadSegment": of_name("uploadSegment", int),
    "EndUpload": of_name("terminateUploadSequence", int),
    "Load": load,
    "Store": store,
    "Domain": of_name("getDomainAttributes"),
    "DeleteDomain": of_name("deleteDomain"),
    "Enroll": enroll,
    "Condition": of_name("getEventConditionAttributes", vmd),
}
"""What can be asked for, by the first word of a line."""
