"""Messages about domains for steps of the robot model: downloads, uploads, storage, attributes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mmsverify.formats.mms import Pdu, number

Arguments = Mapping[str, Any]
State = Mapping[str, Any]

FROM_ROBOT = frozenset({"downloadSegment", "terminateDownloadSequence"})
"""The services that the robot requests and the client answers (A5.1)."""

FILE = {"fileName": ["domains"]}
DISCARDED = {"errorClass": ("resource", 1)}


def asked(service: str, given: Arguments) -> Any:
    """The body of a request about a domain."""
    match service:
        case "initiateDownloadSequence":
            return {"domainName": given["domain"], "listOfCapabilities": [], "sharable": given["shares"]}
        case "loadDomainContent":
            return {"domainName": given["domain"], "sharable": given["shares"], **FILE}
        case "storeDomainContent":
            return {"domainName": given["domain"], **FILE}
        case "terminateDownloadSequence":
            discarded = {"discard": DISCARDED} if given.get("discard") else {}
            return {"domainName": given["domain"], **discarded}
        case "uploadSegment" | "terminateUploadSequence":
            return upload_number(given["upload"])
        case "deleteDomain" | "getDomainAttributes" | "downloadSegment" | "initiateUploadSequence":
            return given["domain"]
    return None


def answered(service: str, given: Arguments) -> Any:
    """The body of a positive answer."""
    match service:
        case "initiateUploadSequence":
            return {"ulsmID": upload_number(given["upload"]), "listOfCapabilities": []}
        case "downloadSegment" | "uploadSegment":
            return {"loadData": ("non-coded", b"JOB"), "moreFollows": given["more"]}
    return None


def upload_number(upload: str) -> int:
    """The ulsmID of an upload state machine, which its name ends with."""
    return int("".join(c for c in upload[-3:] if c.isdigit()) or "0")


def domains(state: State) -> list[str]:
    """Names of the domains that a state speaks of."""
    return [cell[len("domain_state[") : -1] for cell in state if cell.startswith("domain_state[")]


def names(given: Arguments) -> list[str]:
    """The domains that Create names: where the step says none, one of the program invocation's own name."""
    named = sorted(given.get("domains") or ())
    if given["binds_arm"] and "R_ARM" not in named:
        named.append("R_ARM")
    return named or [given["pi"]]


def bound(program: str, state: State, uses: str = "uses", arm: str = "arm") -> list[str]:
    """The domains that a program invocation is bound to, by the same rule."""
    named = [d for d in domains(state) if state[f"{uses}[{program}, {d}]"]]
    return names({"pi": program, "domains": named, "binds_arm": state[f"{arm}[{program}]"]})


def attributes(invoke_id: int, domain: str, state: State, programs: list[str]) -> Pdu:
    """What GetDomainAttributes answers for a domain in this state."""
    kept = str(state[f"domain_state[{domain}]"])
    if kept == "NON-EXISTENT":
        error = {"errorClass": ("access", number("AccessError", "object-non-existent"))}
        return Pdu("confirmed-ErrorPDU", invoke_id, body={"serviceError": error})
    users = [p for p in programs if state[f"uses[{p}, {domain}]"] and state[f"state[{p}]"] != "NON-EXISTENT"]
    reading = [cell for cell, held in state.items() if cell.startswith("source[") and held]
    body = {
        "listOfCapabilities": [],
        "state": number("DomainState", "in-use" if users and kept == "READY" else kept.lower()),
        "mmsDeletable": state[f"domain_deletable[{domain}]"],
        "sharable": state[f"sharable[{domain}]"],
        "listOfProgramInvocations": users,
        "uploadInProgress": sum(cell.endswith(f", {domain}]") for cell in reading),
    }
    return Pdu("confirmed-ResponsePDU", invoke_id, "getDomainAttributes", body)
