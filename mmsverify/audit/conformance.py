"""The base class of robots (9.2): what every one of them must list at Initiate, and must not reject.

Services that the robot itself asks for (DownloadSegment, TerminateDownloadSequence, RequestDomainDownload and
-Upload) and those that need no answer (UnsolicitedStatus, InformationReport) are not asked of its list: a bit
of it says that its sender performs a service for others.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import reduce
from typing import Any

from mmsverify.audit.negotiation import Negotiated
from mmsverify.audit.rules import Breach
from mmsverify.audit.words import title
from mmsverify.formats.mms import Pdu, bits
from mmsverify.model.rows import Clause

Listed = frozenset[str]
UNRECOGNIZED = ("confirmed-request", 1)
NEST = 2
THIRD_PARTY = "tpy"


@dataclass(frozen=True, slots=True)
class Requirement:
    """What the base class requires: all services of one of the alternatives."""

    clause: Clause
    alternatives: tuple[Listed, ...]

    def met(self, listed: Listed) -> bool:
        """Whether what a robot lists is enough."""
        return any(wanted <= listed for wanted in self.alternatives)


def _services(clause: str, *names: str) -> Requirement:
    return Requirement(Clause.of(clause), (frozenset(names),))


DOWNLOAD = frozenset({"initiateDownloadSequence"})
UPLOAD = frozenset({"initiateUploadSequence", "uploadSegment", "terminateUploadSequence"})
SECONDARY_STORAGE = frozenset({"loadDomainContent", "storeDomainContent"})

BASE_CLASS: Mapping[str, Requirement] = {
    "Identify and Conclude": _services("R-9.2.1-1", "identify", "conclude"),
    "Cancel": _services("R-9.2.2.2.1-1", "cancel"),
    "Status": _services("R-9.2.2.2.1-2", "status"),
    "the domain services": _services("R-9.2.2.2.1-3", "getDomainAttributes", "deleteDomain"),
    "Create and DeleteProgramInvocation": _services(
        "R-9.2.2.2.1-4", "createProgramInvocation", "deleteProgramInvocation"
    ),
    "Start, Stop, Resume and Reset": _services("R-9.2.2.2.1-5", "start", "stop", "resume", "reset"),
    "GetProgramInvocationAttributes": _services("R-9.2.2.2.1-6", "getProgramInvocationAttributes"),
    "Read and Write": _services("R-9.2.2.2.1-7", "read", "write"),
    "Select": _services("R-9.2.2.2.1-8", "select"),
    "download or loading from secondary storage": Requirement(
        Clause.of("R-9.2.2.2.1-9", "R-9.1-1", "R-9.2.2.2.2.1-1", "R-9.2.2.2.2.2-1"),
        (DOWNLOAD, SECONDARY_STORAGE),
    ),
    "upload or storing in secondary storage": Requirement(
        Clause.of("R-9.2.2.2.1-9", "R-9.1-1", "R-9.2.2.2.2.1-2", "R-9.2.2.2.2.2-1"),
        (UPLOAD, SECONDARY_STORAGE),
    ),
}
"""What a robot must list, by what a sentence calls it."""

PARAMETERS = frozenset({"str1", "str2", "vnam"})
REQUIRED = frozenset[str]().union(
    *(next(iter(r.alternatives)) for r in BASE_CLASS.values() if len(r.alternatives) == 1)
)
"""Services that no robot may do without."""


class Conformance:
    """One robot; what it lacks is told once."""

    def __init__(self) -> None:
        self._told: set[tuple[str, str]] = set()

    def initiated(self, request: Mapping[str, Any] | None, body: Mapping[str, Any]) -> Iterator[Breach]:
        """The robot's answer to Initiate."""
        detail = body.get("initResponseDetail", {})
        if "additionalSupportedCalled" not in detail:
            return
        for breach in (*_missing(detail), *_parameters(request, body), *_third_party(request, body)):
            key = breach.rule, breach.words["missing"]
            if key not in self._told:
                self._told.add(key)
                yield breach

    def rejected(self, agreed: Negotiated | None, asked: Pdu, pdu: Pdu) -> Iterator[Breach]:
        """The robot rejects a service, and the recording does not show what it has listed."""
        if pdu.kind != "rejectPDU" or pdu.body["rejectReason"] != UNRECOGNIZED:
            return
        if agreed is None and asked.service in REQUIRED:
            clause = _clause(r for r in BASE_CLASS.values() if asked.service in r.alternatives[0])
            yield Breach("conformance.rejected", {"service": title(asked.service)}, clause=clause)


def _missing(detail: Mapping[str, Any]) -> Iterator[Breach]:
    listed = bits("ServiceSupportOptions", detail["servicesSupportedCalled"])
    listed |= bits("AdditionalSupportOptions", detail["additionalSupportedCalled"])
    lacking = {name: wanted for name, wanted in BASE_CLASS.items() if not wanted.met(listed)}
    if lacking:
        yield Breach(
            "conformance.services", {"missing": ", ".join(lacking)}, clause=_clause(lacking.values())
        )


def _parameters(request: Mapping[str, Any] | None, body: Mapping[str, Any]) -> Iterator[Breach]:
    """Parameter CBBs and nesting level are negotiated: a robot can only agree to what was proposed."""
    if request is None:
        return
    wanted = PARAMETERS & _bits(request, "initRequestDetail", "proposedParameterCBB")
    missing = sorted(wanted - _bits(body, "initResponseDetail", "negotiatedParameterCBB"))
    proposed = request.get("proposedDataStructureNestingLevel", 0)
    if body.get("negotiatedDataStructureNestingLevel", NEST) < NEST <= proposed:
        missing.append(f"NEST = {NEST}")
    if missing:
        yield Breach("conformance.parameters", {"missing": ", ".join(missing)})


def _third_party(request: Mapping[str, Any] | None, body: Mapping[str, Any]) -> Iterator[Breach]:
    """With secondary storage a robot should agree to TPY, where that was proposed."""
    listed = bits("ServiceSupportOptions", body["initResponseDetail"]["servicesSupportedCalled"])
    if request is None or not listed >= SECONDARY_STORAGE:
        return
    proposed = _bits(request, "initRequestDetail", "proposedParameterCBB")
    if THIRD_PARTY in proposed - _bits(body, "initResponseDetail", "negotiatedParameterCBB"):
        yield Breach("conformance.third-party", {"missing": THIRD_PARTY})


def _bits(body: Mapping[str, Any], detail: str, name: str) -> Listed:
    return bits("ParameterSupportOptions", body.get(detail, {}).get(name, ""))


def _clause(requirements: Iterable[Requirement]) -> Clause:
    return reduce(Clause.__add__, (r.clause for r in requirements))
