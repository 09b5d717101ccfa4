"""Each statement of the robot standard about syntax: octets that keep it are read, others are refused."""

from __future__ import annotations

import re
from typing import Any

import pytest
from worked_additions import ADDITION_PDUS
from worked_pdus import NAMES, Refused, Worked, check_names
from worked_programs import PROGRAM_PDUS

from mmsverify.errors import DecodeError
from mmsverify.formats import mms
from mmsverify.formats.builtin import Primitive
from mmsverify.formats.cited import cited_productions
from mmsverify.formats.codec import Choice, ListOf, Struct
from mmsverify.formats.mms import decode
from mmsverify.formats.schema import Schema
from mmsverify.formats.tagging import EitherForm, Explicit
from mmsverify.resources import asn1_dir

ALL = [*PROGRAM_PDUS, *ADDITION_PDUS]
SCHEMA = Schema.of_folder(asn1_dir())
CITED = cited_productions(asn1_dir())
ROOT = SCHEMA.type("MMSpdu")


def marked(one: Worked | Refused) -> object:
    return pytest.param(one, marks=pytest.mark.exercises(*one.ids), id=f"{one.ids[0]}-{one.octets[:24]}")


@pytest.mark.parametrize("worked", [marked(one) for one in ALL])
def test_worked_octets_mean_what_the_statement_says(worked: Worked | Refused) -> None:
    worked.check()


@pytest.mark.parametrize(
    "kind", [pytest.param(kind, marks=pytest.mark.exercises(one)) for kind, (one, _) in NAMES.items()]
)
def test_numbers_and_bits_have_the_names_of_the_text(kind: str) -> None:
    check_names(kind)


@pytest.mark.exercises("R-7.2-1", "R-7.3.1-1")
def test_the_abstract_syntax_has_its_name() -> None:
    assert mms.robot_syntax() == "1.0.9506.3.1"


def test_every_statement_that_a_type_encodes_is_exercised_by_worked_octets() -> None:
    exercised = {one for worked in ALL for one in worked.ids} | {one for one, _ in NAMES.values()}
    assert set(CITED) - exercised == {"R-7.2-1", "R-7.3.1-1", "R-7.3.4-1"}


def used() -> set[str]:
    """Every production that the type of a PDU refers to."""
    text = "\n".join(path.read_text(encoding="utf-8") for path in asn1_dir().glob("*.asn"))
    bodies = dict(re.findall(r"^([A-Z][\w-]*) ::= (.*?)(?=^\S|\Z)", re.sub(r"--.*", "", text), re.M | re.S))
    found, fresh = set(), {"MMSpdu"}
    while fresh:
        found |= fresh
        named = {name for kind in fresh for name in re.findall(r"[A-Z][\w-]*", bodies.get(kind, ""))}
        fresh = named - found
    return found


@pytest.mark.parametrize("one", CITED)
def test_what_cites_a_statement_is_used_when_a_pdu_is_decoded(one: str) -> None:
    reached = used() | {"MMS-Robot", "mms-robot-syntax"}
    for place in CITED[one]:
        production, _, field = place.partition(".")
        assert production in reached
        assert not field or place in SCHEMA.places(production, field.split("."))


# 7.3.4: of the services of the general module only these have a detail of the robot standard; 47 to 59 have
# one of the 2003 edition, which is not the robot's (the audit tells of it).
DETAILS = {
    "Request": {"createProgramInvocation": "9F260101", "start": "BF28020500", "resume": "BF2A020500"},
    "Response": {"status": "A0020500", "getProgramInvocationAttributes": "BF2D07800100A1028200"},
}


def smallest(kind: Any) -> Any:
    """The value of a type with the fewest members."""
    match kind:
        case Primitive():
            size = min((low for low, _ in kind.bounds), default=0)
            return {"BOOLEAN": False, "INTEGER": 0, "NULL": None, "OCTET STRING": bytes(max(size, 0))}.get(
                kind.kind, ""
            )
        case Struct():
            return {member.name: smallest(member.type) for member in kind.members if member.needed}
        case ListOf():
            return []
        case Choice():
            name = next(iter(kind.alternatives))
            return name, smallest(kind.alternatives[name])
        case Explicit():
            return smallest(kind.inner)
        case EitherForm():
            return smallest(kind.usual)
    return smallest(kind.target)


def services(sort: str) -> list[tuple[str, Any]]:
    """Each confirmed service with a small argument or result."""
    kind = SCHEMA.type(f"ConfirmedService{sort}")
    assert isinstance(kind, Choice)
    return [(name, smallest(one)) for name, one in kind.alternatives.items() if name != "additionalService"]


def with_detail(sort: str, service: tuple[str, Any], detail: str) -> bytes:
    """A PDU of ``service`` with ``detail`` put under its [79]."""
    octets = ROOT.write((f"confirmed-{sort}PDU", {"invokeID": 1, "service": service}), 0)
    inside = octets[2:] + bytes.fromhex(f"BF4F{len(detail) // 2:02X}{detail}")
    return bytes((octets[0], len(inside))) + inside


@pytest.mark.exercises("R-7.3.4-1")
@pytest.mark.parametrize(
    ("sort", "service"),
    [pytest.param(sort, one, id=f"{one[0]}-{sort}") for sort in DETAILS for one in services(sort)],
)
def test_a_service_has_the_detail_that_the_standard_gives_it_and_no_other(
    sort: str, service: tuple[str, Any]
) -> None:
    assert decode(ROOT.write((f"confirmed-{sort}PDU", {"invokeID": 1, "service": service}), 0)).detail is None
    for name, detail in {**DETAILS[sort], "none": "0500"}.items():
        octets = with_detail(sort, service, detail)
        if name == service[0]:
            assert decode(octets).service == name
            continue
        with pytest.raises(DecodeError) as caught:
            decode(octets)
        assert caught.value.path == f"confirmed-{sort}PDU.detail"
