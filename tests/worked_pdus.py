"""PDUs worked out octet by octet from clause 7 of the robot standard: what they mean, or why they are none.

The octets are put together with `e` alone, an identifier and its contents: nothing of the decoder's makes
them. Shared by the tests of the decoder and by those that ask whether a change of the ASN.1 would be seen.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import pytest

from mmsverify.errors import DecodeError
from mmsverify.formats import mms
from mmsverify.formats.mms import Pdu


def e(identifier: str, *contents: str) -> str:
    """An element in hexadecimal: identifier octets, length, contents."""
    inside = "".join(contents).replace(" ", "")
    size = len(inside) // 2
    return f"{identifier}{size:02X}{inside}" if size < 128 else f"{identifier}81{size:02X}{inside}"


@dataclass(frozen=True)
class Worked:
    """Octets with what they mean; ``written``: they are also what an encoder writes."""

    ids: tuple[str, ...]
    octets: str
    pdu: Pdu
    written: bool = True

    def check(self) -> None:
        octets = bytes.fromhex(self.octets)
        assert mms.decode(octets) == self.pdu
        assert mms.decode(mms.encode(self.pdu)) == self.pdu or not self.written
        assert (mms.encode(self.pdu) == octets) is self.written


@dataclass(frozen=True)
class Refused:
    """Octets that are no PDU, with the field in which that shows and what the cause tells."""

    ids: tuple[str, ...]
    octets: str
    path: str
    cause: str

    def check(self) -> None:
        with pytest.raises(DecodeError, match=re.escape(self.cause)) as caught:
            mms.decode(bytes.fromhex(self.octets))
        assert caught.value.path == self.path


PI1 = e("80", "504931")
NAMED = {"programInvocationName": "PI1"}
WELL = e("A0", "800100", "810100")
STATUS = {"vmdLogicalStatus": 0, "vmdPhysicalStatus": 0}


def ask(*parts: str) -> str:
    """A confirmed request with invokeID 5."""
    return e("A0", "020105", *parts)


def tell(*parts: str) -> str:
    """A confirmed response with invokeID 5."""
    return e("A1", "020105", *parts)


def under79(*parts: str) -> str:
    return e("BF4F", *parts)


def asked(service: str, body: Any = None, detail: Any = None) -> Pdu:
    return Pdu("confirmed-RequestPDU", 5, service, body, detail)


def told(service: str, body: Any = None, detail: Any = None) -> Pdu:
    return Pdu("confirmed-ResponsePDU", 5, service, body, detail)


def counted(kind: str, number: int | None = None) -> tuple[str, int | None]:
    """A StartCount."""
    return kind, number


def robot(state: int, bits: str, selected: tuple[str, str | None], mask: str = "1111") -> dict[str, Any]:
    return {
        "robotVMDState": state,
        "robotSpecificStatus": bits,
        "robotSpecificStatusMask": mask,
        "selectedProgramInvocation": selected,
    }


# The status detail: state, four bits, their mask, the selected program invocation.
EXECUTING = "800103 81020460" + e("83", "504931")
MASKED = "800104 81020410 820204D0" + "8400"
SELECTED = ("programInvocation", "PI1")
NONE = ("noneSelected", None)
STATUS_IDS = ("R-7.3.2.1-3", "R-7.3.2.1.2-1", "R-7.3.2.1.2-2")
UNSOLICITED = e("A1", "800100", "810100")


def unconfirmed(service: str, body: Any, detail: Any = None) -> Pdu:
    return Pdu("unconfirmed-PDU", None, service, body, detail)


ONE_CYCLE = counted("cycleCount", 1)
PLAIN = e("BF2D", "800103", e("A1", e("1A", "44")), "8201FF 830100 8401FF 8500")
ATTRIBUTES = {
    "state": 3,
    "listOfDomainNames": ["D"],
    "mmsDeletable": True,
    "reusable": False,
    "monitor": True,
    "executionArgument": ("simpleString", ""),
}

NAMES = {
    "RobotVMDState": (
        "R-7.3.2.1.2-3",
        "robot-idle robot-loaded robot-ready robot-executing robot-motion-paused manualInterventionRequired",
    ),
    "RobotSpecificStatus": (
        "R-7.3.2.1.2-4",
        "safetyInterlocksViolated anyPhysicalResourcePowerOn allPhysicalResourcesCalibrated localControl",
    ),
    "CS-CreateProgramInvocation-Request": ("R-7.3.3.2.4-1", "normal controlling controlled"),
    "AdditionalSupportOptions": (
        "R-7.5.3-3",
        "vMDStop vMDReset select alterProgramInvocationAttributes "
        "initiateUnitControlLoad unitControlLoadSegment unitControlUpload startUnitControl stopUnitControl "
        "createUnitControl addToUnitControl removeFromUnitControl getUnitControlAttributes "
        "loadUnitControlFromFile storeUnitControlToFile deleteUnitControl defineEventConditionList "
        "deleteEventConditionList addEventConditionListReference removeEventConditionListReference "
        "getEventConditionListAttributes reportEventConditionListStatus alterEventConditionListMonitoring",
    ),
}
"""The names of numbers and bits, from 0 on, with the statement that gives them."""


def check_names(kind: str) -> None:
    """Every number has its name, and the name its number."""
    names = NAMES[kind][1].split()
    assert [mms.named(kind, number) for number in range(len(names))] == names
    assert [mms.number(kind, name) for name in names] == [*range(len(names))]
