"""Ids in the comments of ASN.1 modules: what cites them, and what an undecodable PDU is told with."""

from __future__ import annotations

import pytest

from mmsverify.formats import mms
from mmsverify.formats.cited import citations, innermost, statements
from mmsverify.formats.schema import Schema, SchemaError
from mmsverify.resources import asn1_dir

MODULE = """\
-- R-1-1
Try { iso standard 1 try(2) } DEFINITIONS IMPLICIT TAGS ::= BEGIN
IMPORTS Other FROM Elsewhere;
syntax OBJECT IDENTIFIER ::= { iso standard 3 } -- R-7.2-1
-- Words, then an id: R-2-1 and another R-T2-3.
A ::= SEQUENCE {                                -- R-3-1
    first  [0] INTEGER DEFAULT 1,
    -- Told over
    -- two lines: R-4-a0 R-7.3.3.3.4-N
    second [1] EXPLICIT CHOICE {
        -- R-5-1
        inner Other,
        last  NULL                              -- R-6-1
    } OPTIONAL
}
Small ::= SEQUENCE { only [0] NULL } -- R-7-1
END
"""


def test_an_id_belongs_to_what_starts_on_its_line_or_directly_below() -> None:
    assert list(citations(MODULE, "try.asn")) == [
        ("Try", ("R-1-1",)),
        ("syntax", ("R-7.2-1",)),
        ("A", ("R-2-1", "R-T2-3")),
        ("A", ("R-3-1",)),
        ("A.second", ("R-4-a0", "R-7.3.3.3.4-N")),
        ("A.second.inner", ("R-5-1",)),
        ("A.second.last", ("R-6-1",)),
        ("Small", ("R-7-1",)),
    ]
    assert statements([MODULE])["A"] == ("R-2-1", "R-T2-3", "R-3-1")


@pytest.mark.parametrize(
    "text",
    [
        "A ::= NULL\n-- R-1-1\n\nB ::= NULL\n",
        "A ::= SEQUENCE {\n    one NULL\n} -- R-1-1\n",
        "A ::= NULL\n-- R-1-1\nEND\n",
    ],
)
def test_an_id_that_belongs_to_nothing_is_refused(text: str) -> None:
    with pytest.raises(SchemaError, match=r"R-1-1 belongs to no production"):
        list(citations(f"Try DEFINITIONS IMPLICIT TAGS ::= BEGIN\n{text}", "try.asn"))


def test_field_names_lead_through_productions() -> None:
    names = ["confirmed-RequestPDU", "detail", "start", "controlling", "startCount"]
    assert Schema.of_folder(asn1_dir()).places("MMSpdu", names) == [
        "MMSpdu",
        "MMSpdu.confirmed-RequestPDU",
        "Confirmed-RequestPDU",
        "Confirmed-RequestPDU.detail",
        "CS-Request-Detail",
        "CS-Request-Detail.start",
        "CS-Start-Request",
        "CS-Start-Request.controlling",
        "CS-Start-Request.controlling.startCount",
        "StartCount",
    ]


def test_the_innermost_production_with_a_statement_counts_and_the_field_that_holds_it() -> None:
    known = {"A": ("1",), "A.x": ("2",), "B.y": ("3",)}
    assert innermost(["A", "A.x", "B", "B.y", "C"], known) == ("3", "2")
    assert innermost(["A", "A.x", "B"], known) == ("2", "1")
    assert innermost(["B", "C"], known) == ()


@pytest.mark.parametrize(
    ("path", "cited"),
    [
        ("confirmed-RequestPDU.detail.start.controlling.startLocation", "R-7.3.3.3.1.1-1"),
        ("confirmed-ResponsePDU.detail.status.fullResponse.robotSpecificStatus", "R-7.3.2.1.2-4"),
        ("confirmed-RequestPDU.service.additionalService.select.controlled[3]", "R-7.4.4.1.1.2-1"),
        ("initiate-RequestPDU.initRequestDetail.additionalSupportedCalling", "R-7.5.3-3"),
        ("confirmed-RequestPDU.service.stop.programInvocationName", "R-7.3.3.4-1"),
    ],
)
def test_a_place_in_a_pdu_has_the_statements_that_its_type_encodes(path: str, cited: str) -> None:
    assert cited in mms.encoded_statements(path)


def test_a_place_of_the_base_standard_has_none() -> None:
    assert mms.encoded_statements("confirmed-RequestPDU.service.getNameList.objectScope") == ()
    assert mms.encoded_statements("") == ()
