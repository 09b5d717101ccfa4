"""The two ways of reading a PDU: by functions that are written from the ASN.1 types, and by the types."""

from __future__ import annotations

from functools import cache
from typing import Any

from mmsverify.formats import compiled
from mmsverify.formats.ber import header
from mmsverify.formats.codec import Choice, Walk
from mmsverify.formats.schema import Schema
from mmsverify.resources import asn1_dir

GAVE_UP = "gave up"


@cache
def root() -> Choice:
    found = Schema.of_folder(asn1_dir()).type("MMSpdu")
    assert isinstance(found, Choice)
    return found


@cache
def functions() -> dict[int, compiled.Read]:
    return compiled.root_table(root(), often=1)


def short_way(octets: bytes) -> Any:
    """What the functions make of the octets."""
    try:
        head, begin, end = header(octets, 0, len(octets))
        return functions()[head](octets, begin, end, 1)
    except compiled.GIVES_UP:
        return GAVE_UP


def long_way(octets: bytes) -> Any:
    """What the types make of them, and what is to be remarked."""
    walk = Walk(octets)
    head, begin, end = header(octets, 0, len(octets))
    return root().readers[head](walk, begin, end, 1), walk.remarks


def agree(octets: bytes) -> bool:
    """Whether the short way is as the long one, down to the order of members; false where it gives up."""
    found = short_way(octets)
    if found == GAVE_UP:
        return False
    value, remarks = long_way(octets)
    assert repr(found) == repr(value)
    assert not remarks
    return True
