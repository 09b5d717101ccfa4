"""One association: requests and their responses, its beginning and its end, and breaches of these alone.

Requests pair with responses by the requesting side and the invokeID: a robot asks, too (DownloadSegment).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from mmsverify.audit import negotiation
from mmsverify.audit.cancelling import Cancels
from mmsverify.audit.negotiation import Negotiated, Rejectable
from mmsverify.audit.rules import Breach
from mmsverify.audit.words import title
from mmsverify.formats.mms import Pdu
from mmsverify.formats.trace import TraceMessage

OTHER_SIDE = {"client": "server", "server": "client"}
ANSWERS = frozenset({"confirmed-ResponsePDU", "confirmed-ErrorPDU"})
OF_REQUESTS = frozenset({"confirmed-request", "pdu-error"})
"""What a Reject with an invokeID may be about and so answer a request; the others reject an answer."""


@dataclass(frozen=True, slots=True)
class Asked:
    """A request that waits for its answer; ``slot`` is its name in the model, free again once answered."""

    index: int
    side: str
    pdu: Pdu
    slot: str
    reused: bool = False
    excess: bool = False
    message: TraceMessage | None = None


class Association:
    """The state of one association as its messages show it.

    ``begun``: the recording shows it from its Initiate on, without a gap. ``proposed``: the Initiate that
    waits for its answer. ``_hidden``: requests whose invokeID was used again before their answer, which may
    still come. ``_overdue``: the indices of requests that were told of as outstanding beyond what was agreed;
    they are told of once, for their answers may be lost. ``alarm``: what the last message told that stops the
    robot, if it did.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self.begun = False
        self.negotiated: Negotiated | None = None
        self.asked: dict[tuple[str, int], Asked] = {}
        self._hidden: dict[tuple[str, int], Asked] = {}
        self._overdue: set[int] = set()
        self.proposed: Mapping[str, Any] | None = None
        self.alarm = ""
        self._missing: Breach | None = None
        self._concluding: str | None = None
        self._syntax_told = False
        self._cancels = Cancels()

    # Beginning and end.

    def end(self) -> list[Asked]:
        """The connection is gone: what was asked will not be answered."""
        lost = self.gap()
        self.negotiated = self.proposed = None
        self._syntax_told = False
        return lost

    def gap(self) -> list[Asked]:
        """Messages may be missing: any answer may be to a request that the recording lacks."""
        lost = list(self.asked.values())
        self.asked.clear()
        self._hidden.clear()
        self._overdue.clear()
        self._cancels.clear()
        self.begun, self.alarm = False, ""
        self._missing = self._concluding = None
        return lost

    def propose(self, pdu: Pdu) -> list[Breach]:
        """An Initiate request."""
        self.end()
        self.proposed = pdu.body
        self._missing = Breach("protocol.no-association", {"why": "Initiate has not been answered"})
        return list(negotiation.proposed(pdu.body))

    def agree(self, pdu: Pdu) -> list[Breach]:
        """An Initiate response."""
        proposed = self.proposed
        self.end()
        self.begun = True
        self.negotiated = negotiation.negotiated(pdu.body, (proposed or {}).get("initRequestDetail"))
        return list(negotiation.agreed(proposed, pdu.body))

    def refuse(self) -> None:
        """An Initiate error: there is no association."""
        self.end()
        self._missing = Breach("protocol.no-association", {"why": "Initiate was refused"})

    def admit(self, side: str, pdu: Pdu) -> Iterator[Breach]:
        """Any message but those of Initiate: whether there is an association that carries it."""
        if self._missing is not None:
            yield self._missing
            self._missing = None
        elif self._concluding == side and pdu.kind == "confirmed-RequestPDU":
            yield Breach("protocol.after-conclude-request", {"side": side})
            self._concluding = None

    def conclude(self, side: str, pdu: Pdu) -> Iterator[Breach]:
        """Conclude is asked for, granted or refused by ``side``."""
        if pdu.kind == "conclude-RequestPDU":
            self._concluding = side
            return
        asked = self._concluding == OTHER_SIDE[side]
        if self.begun and not asked:
            yield Breach("protocol.conclude-unasked", {"side": side})
        if pdu.kind == "conclude-ResponsePDU":
            yield from (_unanswered(asked) for asked in self.asked.values())
        self._concluding = None

    def concluded(self) -> list[Asked]:
        """The association is over, as both sides agreed."""
        lost = self.end()
        self._missing = Breach("protocol.after-conclude")
        return lost

    def reopen(self) -> None:
        """A new connection is there: nothing is said on it before Initiate."""
        self._missing = Breach("protocol.no-association", {"why": "the connection begins without Initiate"})

    # Requests and answers.

    def request(
        self, index: int, side: str, pdu: Pdu, message: TraceMessage | None = None
    ) -> tuple[Asked, list[Breach]]:
        """A confirmed request of ``side``."""
        assert pdu.invoke_id is not None
        key = (side, pdu.invoke_id)
        earlier = self.asked.get(key)
        slot = earlier.slot if earlier else self._free_slot()
        waiting = [a for a in self.asked.values() if a.side == side and a is not earlier]
        limit = self.negotiated.outstanding.get(side) if self.negotiated else None
        excess = limit is not None and len(waiting) >= limit
        asked = Asked(index, side, pdu, slot, earlier is not None, excess, message)
        self.asked[key] = asked
        if earlier is not None:
            self._hidden[key] = earlier
            words: dict[str, Any] = {"invoke": pdu.invoke_id, "first": earlier.index}
            return asked, [Breach("protocol.invoke-id-reused", words, (earlier.index,))]
        missed = [a for a in waiting if a.index not in self._overdue]
        if limit is not None and len(missed) >= limit:
            self._overdue.update({index, *(a.index for a in missed)})
            words = {"count": len(waiting) + 1, "side": side, "limit": limit}
            return asked, [Breach("protocol.too-many-outstanding", words, tuple(a.index for a in waiting))]
        return asked, []

    def _free_slot(self) -> str:
        used = {asked.slot for asked in self.asked.values()}
        return next(slot for n in range(len(used) + 1) if (slot := f"{self.name}#{n}") not in used)

    def answer(self, side: str, pdu: Pdu) -> tuple[Asked | None, list[Breach]]:
        """A response, error or reject of ``side``, with the request that it answers."""
        if pdu.kind == "rejectPDU" and pdu.body["rejectReason"][0] not in OF_REQUESTS:
            return None, []
        if pdu.invoke_id is None:
            return None, list(self._unknown_pdu(side, pdu))
        key = (OTHER_SIDE[side], pdu.invoke_id)
        asked = self._question(key, pdu)
        if asked is None:
            unasked = self.begun and pdu.kind in ANSWERS
            words = {"side": side, "invoke": pdu.invoke_id}
            return None, [Breach("protocol.unasked", words)] if unasked else []
        if pdu.kind == "confirmed-ResponsePDU" and pdu.service != asked.pdu.service:
            words = {"asked": title(str(asked.pdu.service)), "answered": title(str(pdu.service))}
            return None, [Breach("protocol.other-service", words, (asked.index,))]
        return asked, [*self._cancels.answered(key, pdu), *self._agreed(side, asked, pdu)]

    def _question(self, key: tuple[str, int], pdu: Pdu) -> Asked | None:
        """The request answered here; of two with one invokeID that of the answer's service, or the later."""
        asked, hidden = self.asked.get(key), self._hidden.get(key)
        if hidden is not None and (asked is None or pdu.service not in (None, asked.pdu.service)):
            return self._hidden.pop(key)
        return self.asked.pop(key, None)

    def _agreed(self, side: str, asked: Asked, pdu: Pdu) -> Iterator[Breach]:
        if self.negotiated is not None:
            known = self.begun
            question = Rejectable(
                asked.pdu, asked.index, asked.reused if known else None, asked.excess if known else None
            )
            yield from negotiation.answered(self.negotiated, side, question, pdu)

    def _unknown_pdu(self, side: str, pdu: Pdu) -> Iterator[Breach]:
        """A Reject that names no request: of a Cancel, where one waits, it says that nobody knows it."""
        cancel = self._cancels.rejected(OTHER_SIDE[side], pdu)
        if cancel is not None and self.negotiated and self.negotiated.listed(side, "cancel"):
            yield Breach("negotiation.rejected", {"service": "Cancel", "side": side}, (cancel,))

    def cancel(self, index: int, side: str, pdu: Pdu) -> Iterator[Breach]:
        """Cancel is asked for, granted or refused by ``side``."""
        assert pdu.invoke_id is not None
        if pdu.kind == "cancel-RequestPDU":
            self._cancels.requested((side, pdu.invoke_id), index, self.asked)
            return
        key = (OTHER_SIDE[side], pdu.invoke_id)
        if pdu.kind == "cancel-ResponsePDU":
            yield from self._cancels.granted(key, self.asked, begun=self.begun)
        else:
            yield from self._cancels.refused(key, pdu, self.asked, begun=self.begun)

    def robot_syntax(self, pdu: Pdu) -> Iterator[Breach]:
        """Whether a message keeps to what was agreed about the robot standard; told once."""
        if self.negotiated is None or self._syntax_told:
            return
        if not self.negotiated.robot and negotiation.uses_robot_syntax(pdu):
            self._syntax_told = True
            yield Breach("negotiation.unagreed", {"service": title(str(pdu.service))})
        elif negotiation.lacks_detail(self.negotiated, pdu):
            self._syntax_told = True
            yield Breach("negotiation.no-detail", {"service": title(str(pdu.service))})


def _unanswered(asked: Asked) -> Breach:
    return Breach("protocol.unanswered", {"service": title(str(asked.pdu.service))}, at=asked.message)
