"""The worked octets have teeth: a change of what a statement is cited for is seen in one of them.

A mutant that the schema itself refuses (two alternatives with one tag, an implicit tag over a CHOICE) counts
as caught, too: it could not have been shipped.
"""

from __future__ import annotations

import json
from typing import Any

import asn1tools
import pytest
from asn1_mutants import Mutant, mutants
from worked_additions import ADDITION_PDUS
from worked_pdus import NAMES, check_names
from worked_programs import PROGRAM_PDUS

from mmsverify.formats import asn1_text, compiled, mms, schema
from mmsverify.formats.cited import cited_productions
from mmsverify.formats.schema import Schema, SchemaError
from mmsverify.resources import asn1_dir

PATHS = sorted(asn1_dir().glob("*.asn"))
TEXTS = {path.name: path.read_text(encoding="utf-8") for path in PATHS}
MODULES: dict[str, Any] = asn1tools.parse_files([str(path) for path in PATHS])
HOMES = {name: home for home in MODULES if home != schema.ALSO_READ for name in MODULES[home]["types"]}
PLACES = [place for places in cited_productions(asn1_dir()).values() for place in places]
ROBOTS = {
    "CS-Request-Detail": {"createProgramInvocation", "start", "resume"},
    "CS-Response-Detail": {"status", "getProgramInvocationAttributes"},
    "Confirmed-RequestPDU": {"detail"},
    "Confirmed-ResponsePDU": {"detail"},
    "Unconfirmed-PDU": {"detail"},
    "CS-Unconfirmed-Detail": {"unsolicitedStatus"},
    "UnconfirmedService": {"additionalUnconfirmedService"},
    "ServiceSpecificInformation": {"additionalService"},
    "ActionResult": {"eventActionResult"},
    "InitRequestDetail": {place.partition(".")[2] for place in PLACES if place.startswith("InitRequest")}
    - {""},
    "InitResponseDetail": {"negotiatedVersionNumber"}
    | {place.partition(".")[2] for place in PLACES if place.startswith("InitResponse")} - {""},
    **{
        sort: {place.partition(".")[2] for place in PLACES if place.startswith(f"{sort}.")}
        for sort in ("ConfirmedServiceRequest", "ConfirmedServiceResponse")
    },
}
"""Of productions that are not the robot standard's alone: the members that are."""

PRODUCTIONS = sorted(({place.partition(".")[0] for place in PLACES} & HOMES.keys()) | ROBOTS.keys())
EQUAL: dict[str, str] = {}
"""Mutants that nothing can tell from the original, with the reason."""


@pytest.fixture
def spoken(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    """A place in which the decoder speaks another schema, until the test ends."""
    return monkeypatch


def speak(spoken: pytest.MonkeyPatch, modules: dict[str, Any], texts: list[str]) -> None:
    """Let the decoder speak the ASN.1 of these parse trees; `SchemaError` where they make no sense."""
    tree = json.loads(json.dumps(modules))
    made = Schema({"modules": tree, "choice defaults": asn1_text.choice_defaults("\n".join(texts))})
    root = made.type("MMSpdu")
    functions = compiled.root_table(root)
    spoken.setattr(mms, "_schema", lambda: made)
    spoken.setattr(mms, "_root", lambda: root)
    spoken.setattr(mms, "_functions", lambda: functions)
    spoken.setattr(mms, "_names", made.names)


def caught(spoken: pytest.MonkeyPatch, modules: dict[str, Any], texts: list[str]) -> bool:
    try:
        speak(spoken, modules, texts)
    except (SchemaError, KeyError):
        return True
    try:
        for kind in NAMES:
            check_names(kind)
        for worked in (*PROGRAM_PDUS, *ADDITION_PDUS):
            worked.check()
    except (Exception, pytest.fail.Exception):
        return True
    return False


def made(production: str) -> list[Mutant]:
    fields = frozenset(ROBOTS.get(production, ()))
    return mutants(MODULES, HOMES[production], production, fields)


def test_the_original_is_not_caught(spoken: pytest.MonkeyPatch) -> None:
    assert not caught(spoken, MODULES, list(TEXTS.values()))


@pytest.mark.slow
@pytest.mark.exercises(every="decode rule")
@pytest.mark.parametrize("production", PRODUCTIONS)
def test_a_change_of_what_a_statement_is_cited_for_is_seen(
    production: str, spoken: pytest.MonkeyPatch
) -> None:
    survivors = [
        mutant.name
        for mutant in made(production)
        if not caught(spoken, mutant.applied(MODULES), list(TEXTS.values()))
    ]
    assert set(survivors) - EQUAL.keys() == set()


@pytest.mark.slow
@pytest.mark.parametrize("place", range(2))
def test_another_number_in_a_default_is_seen(place: int, spoken: pytest.MonkeyPatch) -> None:
    """The parser keeps no number of a default that is an alternative: these mutants change the text."""
    written = "DEFAULT cycleCount : 1"
    before, *after = TEXTS["mms-robot.asn"].split(written)
    seams = [written] * len(after)
    seams[place] = "DEFAULT cycleCount : 2"
    text = before + "".join(seam + part for seam, part in zip(seams, after, strict=True))
    assert caught(spoken, MODULES, [*(t for n, t in TEXTS.items() if n != "mms-robot.asn"), text])


def test_every_production_of_the_robot_standard_is_tried() -> None:
    assert sum(len(made(production)) for production in PRODUCTIONS) > 300
    assert MODULES["MMS-Robot"]["types"].keys() - set(PRODUCTIONS) == {"StatusDetail"}
