"""The ASN.1 modules as texts: they import what they use, agree, and another tool reads them alike."""

from __future__ import annotations

from typing import Any

import asn1tools
import pytest
from one_module import HEADER, one_module

from mmsverify.formats.asn1_text import parsed, table
from mmsverify.formats.codec import Choice
from mmsverify.formats.mms import decode, encode
from mmsverify.formats.schema import ALSO_READ, TABLE, Schema, SchemaError
from mmsverify.resources import asn1_dir
from mmsverify.samples import annex_a

PATHS = sorted(asn1_dir().glob("*.asn"))
TEXTS = {path.name: path.read_text(encoding="utf-8") for path in PATHS}
MODULES: dict[str, Any] = asn1tools.parse_files([str(path) for path in PATHS])
SCHEMA = Schema.of_folder(asn1_dir())


def test_the_table_is_that_of_the_present_modules() -> None:
    """``python -m mmsverify.formats.asn1_text`` makes it anew."""
    assert (asn1_dir() / TABLE).read_text(encoding="utf-8") == table(asn1_dir())


def references(tree: Any) -> set[str]:
    """The type names in a parse tree that asn1tools does not know as built in."""
    if isinstance(tree, dict):
        own = {tree["type"]} if isinstance(tree.get("type"), str) else set()
        return own.union(*map(references, tree.values()))
    if isinstance(tree, list):
        return set().union(*map(references, tree))
    return set()


@pytest.mark.parametrize("name", MODULES)
def test_a_module_imports_what_it_uses_and_nothing_else(name: str) -> None:
    module = MODULES[name]
    imported = {one for names in module["imports"].values() for one in names}
    known = {one for other in MODULES.values() for one in other["types"]}
    assert references(module["types"]) & known - module["types"].keys() == imported
    for home, names in module["imports"].items():
        assert set(names) <= MODULES[home]["types"].keys()


def test_every_type_is_used() -> None:
    used = set().union(*(references(module["types"]) for module in MODULES.values()))
    defined = {name for module in MODULES.values() for name in module["types"]}
    assert defined - used == {"MMSpdu"}


def test_every_form_that_is_only_read_stands_beside_a_type() -> None:
    main = {name for home, module in MODULES.items() if home != ALSO_READ for name in module["types"]}
    assert MODULES[ALSO_READ]["types"].keys() <= main


def test_the_tags_of_the_services_are_the_bits_of_the_support_options() -> None:
    bits = SCHEMA.names("ServiceSupportOptions")
    for sort in ("Request", "Response"):
        kind = SCHEMA.type(f"ConfirmedService{sort}")
        assert isinstance(kind, Choice)
        tags = {number(head): name for name, one in kind.alternatives.items() for head in one.readers}
        assert tags == {bit: bits[bit] for bit in range(78)} | {78: "additionalService"}


def number(head: int) -> int:
    """The tag number in identifier octets."""
    return head & 0x7F if head > 0xFF else head & 0x1F


@pytest.mark.parametrize("detail", ["CS-Request-Detail", "CS-Response-Detail"])
def test_a_detail_has_the_tag_of_its_service(detail: str) -> None:
    kind = SCHEMA.type(detail)
    services = SCHEMA.type(detail.replace("CS-", "ConfirmedService").removesuffix("-Detail"))
    assert isinstance(kind, Choice)
    assert isinstance(services, Choice)
    for name, one in kind.alternatives.items():
        assert {*map(number, one.readers)} == {*map(number, services.alternatives[name].readers)}


def test_another_decoder_reads_annex_a_as_this_one_does() -> None:
    other = asn1tools.compile_string(one_module(), "ber")
    for _, pdu in annex_a.conversation():
        kind, content = other.decode("MMSpdu", encode(pdu))
        assert kind == pdu.kind
        assert decode(bytes(other.encode("MMSpdu", (kind, content)))) == pdu


@pytest.mark.parametrize(
    ("body", "cause"),
    [
        ("A ::= [0] B B ::= CHOICE { x [0] NULL, y [1] NULL }", "implicit tag over a CHOICE"),
        ("A ::= CHOICE { x [0] NULL, y [0] BOOLEAN }", "x and y have the same tag"),
        ("A ::= SEQUENCE { x [0] Missing }", "no module defines"),
        ("A ::= SEQUENCE { x [0] INTEGER DEFAULT five }", "cannot be parsed: .*five"),
    ],
)
def test_a_module_that_cannot_be_right_is_refused(body: str, cause: str) -> None:
    with pytest.raises(SchemaError, match=cause):
        Schema(parsed([f"{HEADER}{body}\nEND"])).type("A")


def test_modules_must_agree_on_tags_and_names() -> None:
    with pytest.raises(SchemaError, match="IMPLICIT TAGS"):
        Schema(parsed(["Try DEFINITIONS ::= BEGIN A ::= NULL END"]))
    with pytest.raises(SchemaError, match="second type"):
        Schema(parsed([HEADER + "A ::= NULL END", HEADER.replace("Try", "Again") + "A ::= NULL END"]))
