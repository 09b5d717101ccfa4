"""One association: requests and their responses, what was negotiated, and breaches of these alone.

Requests pair with responses by the requesting side and the invokeID: a robot asks, too (DownloadSegment).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from mmsverify.audit.rules import Breach
from mmsverify.audit.words import title
from mmsverify.formats.mms import Pdu, bits

OTHER_SIDE = {"client": "server", "server": "client"}
ADDITIONAL = frozenset({"vMDStop", "vMDReset", "select", "alterPI"})
ANSWERS = frozenset({"confirmed-ResponsePDU", "confirmed-ErrorPDU"})


@dataclass(frozen=True, slots=True)
class Asked:
    """A request that waits for its answer; ``slot`` is its name in the model, free again once answered."""

    index: int
    side: str
    pdu: Pdu
    slot: str


@dataclass(slots=True)
class Negotiated:
    """What Initiate agreed.

    ``outstanding`` counts requests by requesting side; ``services`` and ``additional`` are by answering side.
    """

    outstanding: dict[str, int] = field(default_factory=dict)
    services: dict[str, frozenset[str]] = field(default_factory=dict)
    additional: dict[str, frozenset[str]] = field(default_factory=dict)


class Association:
    """The state of one association as its messages show it."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.begun = False
        self.concluded = False
        self.negotiated: Negotiated | None = None
        self.asked: dict[tuple[str, int], Asked] = {}
        self._proposed: Mapping[str, Any] | None = None

    def end(self) -> list[Asked]:
        """The connection is gone: what was asked will not be answered."""
        lost = list(self.asked.values())
        self.asked.clear()
        self.begun, self.concluded, self.negotiated = False, False, None
        return lost

    def gap(self) -> list[Asked]:
        """Messages may be missing: any answer may be to a request that the recording lacks."""
        lost = list(self.asked.values())
        self.asked.clear()
        self.begun = False
        return lost

    def request(self, index: int, side: str, pdu: Pdu) -> tuple[Asked, list[Breach]]:
        """A confirmed request of ``side``."""
        assert pdu.invoke_id is not None
        key = (side, pdu.invoke_id)
        earlier = self.asked.get(key)
        asked = Asked(index, side, pdu, earlier.slot if earlier else self._free_slot())
        self.asked[key] = asked
        if earlier is not None:
            return asked, [
                Breach(
                    "protocol.invoke-id-reused",
                    {"invoke": pdu.invoke_id, "first": earlier.index},
                    (earlier.index,),
                )
            ]
        return asked, list(self._count(side))

    def _count(self, side: str) -> Iterator[Breach]:
        limit = self.negotiated.outstanding.get(side) if self.negotiated else None
        mine = [a for a in self.asked.values() if a.side == side]
        if limit is not None and len(mine) == limit + 1:
            yield Breach(
                "protocol.too-many-outstanding",
                {"count": len(mine), "side": side, "limit": limit},
                tuple(a.index for a in mine[:-1]),
            )

    def _free_slot(self) -> str:
        used = {asked.slot for asked in self.asked.values()}
        return next(slot for n in range(len(used) + 1) if (slot := f"{self.name}#{n}") not in used)

    def answer(self, side: str, pdu: Pdu) -> tuple[Asked | None, list[Breach]]:
        """A response, error or reject of ``side``, with the request that it answers."""
        if pdu.invoke_id is None:
            return None, []
        key = (OTHER_SIDE[side], pdu.invoke_id)
        asked = self.asked.get(key)
        if asked is None:
            unasked = self.begun and pdu.kind in ANSWERS
            return None, [
                Breach("protocol.unasked", {"side": side, "invoke": pdu.invoke_id})
            ] if unasked else []
        if pdu.kind == "confirmed-ResponsePDU" and pdu.service != asked.pdu.service:
            del self.asked[key]
            words = {"asked": title(str(asked.pdu.service)), "answered": title(str(pdu.service))}
            return None, [Breach("protocol.other-service", words, (asked.index,))]
        del self.asked[key]
        return asked, list(self._agreed(side, asked, pdu))

    def _agreed(self, side: str, asked: Asked, pdu: Pdu) -> Iterator[Breach]:
        if self.negotiated is None:
            return
        service = str(asked.pdu.service)
        table = self.negotiated.additional if service in ADDITIONAL else self.negotiated.services
        listed = table.get(side)
        words = {"service": title(service), "side": side}
        if listed is None:
            return
        if pdu.kind == "confirmed-ResponsePDU" and service not in listed:
            yield Breach(
                "negotiation.additional" if service in ADDITIONAL else "negotiation.service",
                words,
                (asked.index,),
            )
        if (
            pdu.kind == "rejectPDU"
            and service in listed
            and pdu.body["rejectReason"] == ("confirmed-request", 1)
        ):
            yield Breach("negotiation.rejected", words, (asked.index,))

    def propose(self, pdu: Pdu) -> None:
        """An Initiate request."""
        self.end()
        self._proposed = pdu.body

    def agree(self, pdu: Pdu) -> list[Breach]:
        """An Initiate response."""
        self.begun, self.concluded = True, False
        self.asked.clear()
        proposed, body = self._proposed, pdu.body
        self._proposed = None
        detail = body.get("initResponseDetail", {})
        self.negotiated = _negotiated(body, detail, (proposed or {}).get("initRequestDetail"))
        return [] if proposed is None else list(_reduced(proposed, body))


def _negotiated(
    body: Mapping[str, Any], called: Mapping[str, Any], calling: Mapping[str, Any] | None
) -> Negotiated:
    found = Negotiated(
        outstanding={
            "client": body["negotiatedMaxServOutstandingCalling"],
            "server": body["negotiatedMaxServOutstandingCalled"],
        }
    )
    for side, detail, suffix in (("server", called, "Called"), ("client", calling or {}, "Calling")):
        if f"servicesSupported{suffix}" in detail:
            found.services[side] = bits("ServiceSupportOptions", detail[f"servicesSupported{suffix}"])
        if f"additionalSupported{suffix}" in detail:
            listed = bits("AdditionalSupportOptions", detail[f"additionalSupported{suffix}"])
            found.additional[side] = frozenset(
                "alterPI" if bit.startswith("alter") else bit for bit in listed
            )
    return found


def _reduced(proposed: Mapping[str, Any], body: Mapping[str, Any]) -> Iterator[Breach]:
    """Negotiation may only reduce what was proposed."""
    for word in ("Calling", "Called"):
        wanted, given = (
            proposed[f"proposedMaxServOutstanding{word}"],
            body[f"negotiatedMaxServOutstanding{word}"],
        )
        if given > wanted:
            yield Breach("negotiation.outstanding", {"negotiated": given, "proposed": wanted})
    asked, agreed = proposed.get("initRequestDetail", {}), body.get("initResponseDetail", {})
    if "additionalSupportedCalled" in agreed and "additionalSupportedCalling" not in asked:
        yield Breach("negotiation.syntax")
    wanted, given = asked.get("proposedVersionNumber"), agreed.get("negotiatedVersionNumber")
    if wanted is not None and given is not None and not 1 <= given <= wanted:
        yield Breach("negotiation.version", {"negotiated": given, "proposed": wanted})
