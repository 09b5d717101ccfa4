"""ACSE (ISO 8650-1, X.227): the values that an association's begin and end carry for MMS."""

from __future__ import annotations

from mmsverify.formats.capture.faults import UnreadableError
from mmsverify.formats.capture.presentation import Value, pdv
from mmsverify.formats.capture.tlv import elements, only

APDUS = {0x60: "AARQ", 0x61: "AARE", 0x62: "RLRQ", 0x63: "RLRE", 0x64: "ABRT"}
_LAYER = "acse"
_USER_INFORMATION, _EXTERNAL = 0xBE, 0x28


def user_information(apdu: bytes) -> list[Value]:
    """What an APDU carries for the layer above, often nothing. Raises ``UnreadableError``."""
    element = only(apdu, _LAYER)
    if element.tag not in APDUS:
        raise UnreadableError(_LAYER, f"{element.tag:02X} begins no ACSE APDU")
    found: list[Value] = []
    for field in elements(element.contents, _LAYER):
        if field.tag == _USER_INFORMATION:
            found += [
                pdv(item.contents) for item in elements(field.contents, _LAYER) if item.tag == _EXTERNAL
            ]
    return found
