"""Whether a profile is a complete PICS of a conforming robot: the checks of clause 9, one for each statement."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from mmsverify.profiles import words
from mmsverify.profiles.checks import Check, Table, check


@check("base-class", "R-9.1-1", "R-9.2.2.1-1", "R-9.2.3.1-1")
def base_class(table: Table) -> Iterator[str]:
    """Every conformance class includes the base class."""
    if words.BASE not in table["classes"]:
        yield 'classes lacks "base", the kernel of all classes'


@check("loading-class", "R-9.2.2.2.1-9", "R-9.1-1")
def loading_class(table: Table) -> Iterator[str]:
    """A robot loads programs over the network, or from a file library of its own."""
    if not {words.DOWNLOAD, words.STORAGE} & set(table["classes"]):
        yield f'classes has neither "{words.DOWNLOAD}" nor "{words.STORAGE}"'


def _services(clause: str, wanted: tuple[str, ...], of: str) -> Check:
    def find(table: Table) -> Iterator[str]:
        lacking = [service for service in wanted if service not in table["services"]]
        if table["services"] and of in table["classes"] and lacking:
            yield f"services lacks {', '.join(lacking)}, which the class {of} demands"

    find.__doc__ = f"The class {of} has {', '.join(wanted)}, where services are listed."
    return check("services", clause)(find)


def _demanded(sets: Mapping[str, tuple[str, ...]], of: str) -> tuple[Check, ...]:
    return tuple(_services(clause, wanted, of) for clause, wanted in sets.items())


SERVICES = (
    *_demanded(words.BASE_SERVICES, words.BASE),
    *_demanded(words.DOWNLOAD_SERVICES, words.DOWNLOAD),
    *_demanded(words.STORAGE_SERVICES, words.STORAGE),
)


@check("select", "R-9.2.2.2.1-8")
def select_supported(table: Table) -> Iterator[str]:
    """The base class performs Select."""
    if table["additional_services"]["select"] not in ("server", "both"):
        yield 'additional_services.select must be "server" or "both"'


@check("semaphore-services", "R-5.1.3-1", "R-5.1.3-2", "R-9.2.2.1-4", "R-9.2.2.1-5")
def semaphore_services(table: Table) -> Iterator[str]:
    """Where several clients may be associated, R_CTRL is taken and given by services; one client needs none."""
    lacking = [service for service in words.SEMAPHORE_SERVICES if service not in table["services"]]
    if table["services"] and table["associations"] == "multiple" and lacking:
        yield f"services lacks {', '.join(lacking)}, without which several clients cannot share control"


@check("parameters", "R-9.2.2.3-1")
def parameters(table: Table) -> Iterator[str]:
    """The base class has STR1, STR2, VNAM and a nesting of 2."""
    lacking = [parameter for parameter in words.BASE_PARAMETERS if parameter not in table["parameters"]]
    if lacking:
        yield f"parameters lacks {', '.join(lacking)}, which the class base demands"
    if table["nest"] < 2:
        yield f"nest = {table['nest']} is less than the 2 that the class base demands"


@check("third-party", "R-9.2.2.2.2.2-2", level="warning")
def third_party(table: Table) -> Iterator[str]:
    """Secondary storage should have the parameter CBB TPY."""
    if words.STORAGE in table["classes"] and "TPY" not in table["parameters"]:
        yield f"parameters lacks TPY, which the class {words.STORAGE} should have"


def _told(key: str, *clauses: str) -> Check:
    def find(table: Table) -> Iterator[str]:
        if not table[key]:
            yield f"{key} is not told, which the PICS has to describe"

    find.__doc__ = f"The PICS tells {key}."
    return check("not-told", *clauses, level="note")(find)


@check("not-told", "R-T15-3", level="note")
def first_step(table: Table) -> Iterator[str]:
    """Where STEP-LIMITED is supported, the PICS tells what the first step is."""
    if table["step_limited"] and not table["first_step"]:
        yield "first_step is not told, which the PICS has to describe where STEP-LIMITED is supported"


TOLD = (
    first_step,
    _told("orientation", "R-T15-4", "R-8.4.2-1"),
    _told("program_location", "R-T15-5", "R-6.3.2.4-1"),
)

CONFORMANCE = (
    base_class, loading_class, *SERVICES, select_supported, semaphore_services, parameters, third_party, *TOLD,
)  # fmt: skip
