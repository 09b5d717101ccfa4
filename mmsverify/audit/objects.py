"""The standardized objects (8.2, 8.3, 8.6 to 8.8): their fixed attributes, a table with one walk over it.

What changes in an object's life belongs to a model; what the standard fixes for good is here.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from mmsverify.audit import variables
from mmsverify.audit.robot import plain_name
from mmsverify.audit.rules import Breach
from mmsverify.audit.shapes import Misfit
from mmsverify.audit.variables import TYPES, VARIABLES
from mmsverify.audit.words import SEMAPHORE
from mmsverify.formats.mms import Pdu
from mmsverify.model.rows import Clause

NORMAL = 64
"""The normal priority, and the normal severity."""
TOKEN, MONITORED = 0, 1
OWNER = 1


@dataclass(frozen=True, slots=True)
class Fixed:
    """One fixed attribute of a standardized object.

    ``service`` shows it in ``field``. ``member``: the attribute is a list that must hold the value.
    ``initial``: a service may have changed it since, so that another value is worth a note only.
    """

    clause: Clause
    kind: str
    name: str
    service: str
    field: str
    value: Any
    member: bool = False
    initial: bool = False

    def fits(self, shown: Any) -> bool:
        """Whether what is shown is what the standard fixes."""
        return self.value in shown if self.member else bool(shown == self.value)

    @property
    def object(self) -> str:
        """The object as a sentence calls it."""
        return f"{self.kind} {self.name}"


def _of(kind: str, service: str, name: str, cites: Iterable[str], **fields: Any) -> Iterator[Fixed]:
    for field, value in fields.items():
        yield Fixed(Clause.of(*cites), kind, name, service, field, value)


def _domain(name: str, *cites: str, **fields: Any) -> Iterator[Fixed]:
    return _of("domain", "getDomainAttributes", name, cites, mmsDeletable=False, **fields)


def _program(name: str, *cites: str) -> Iterator[Fixed]:
    shown = {"listOfDomainNames": [name]}
    return _of("program invocation", "getProgramInvocationAttributes", name, cites, **shown)


def _condition(name: str, *cites: str) -> Iterator[Fixed]:
    kind, attributes = "event condition", "getEventConditionAttributes"
    fixed = {"mmsDeletable": False, "class": MONITORED, "severity": NORMAL}
    yield from _of(kind, attributes, name, cites, **fixed)
    yield from _of(kind, "eventNotification", name, cites, severity=NORMAL)
    clause = Clause.of(*cites)
    yield Fixed(clause, kind, name, attributes, "priority", NORMAL, initial=True)
    yield Fixed(clause, kind, name, attributes, "alarmSummaryReports", value=False, initial=True)
    yield Fixed(clause, kind, name, "reportEventConditionStatus", "enabled", value=True, initial=True)


def _action(name: str, request: tuple[str, Any], *cites: str) -> Iterator[Fixed]:
    fixed = {"mmsDeletable": False, "listOfModifier": [], "confirmedServiceRequest": request}
    return _of("event action", "getEventActionAttributes", name, cites, **fixed)


def _listed() -> Iterator[Fixed]:
    yield from _domain("R_ARM", "R-8.2.1-3", "R-8.2.1-1", sharable=True)
    # A sharable domain may serve other programs, too: the list holds R_ARM, whatever else it holds.
    yield Fixed(
        Clause.of("R-8.2.1-4"), "domain", "R_ARM", "getDomainAttributes", "listOfProgramInvocations", "R_ARM",
        member=True,
    )  # fmt: skip
    yield from _domain("R_CAL", "R-8.2.2-2", "R-8.2.2-1", sharable=False, listOfProgramInvocations=["R_CAL"])
    yield from _domain("R_SAFE", "R-8.2.3-2", "R-8.2.3-1", sharable=False)
    yield from _program("R_ARM", "R-8.3.1-2", "R-8.3.1-1")
    yield from _program("R_CAL", "R-8.3.2-2", "R-8.3.2-1")
    status = "reportSemaphoreStatus"
    yield from _of("semaphore", status, SEMAPHORE, ["R-8.6.1-1"], mmsDeletable=False, **{"class": TOKEN})
    yield from _of("semaphore", status, SEMAPHORE, ["R-8.6.1-2"], numberOfTokens=1)
    yield from _condition("R_RVS", "R-8.7.1-2")
    yield from _condition("R_SIV", "R-8.7.2-2")
    yield from _condition("R_RLC", "R-8.7.3-2")
    yield from _condition("R_ARM", "R-8.7.4-2")
    yield from _action("R_STC", ("status", False), "R-8.8.1-1")
    yield from _action("R_ARM", ("getProgramInvocationAttributes", "R_ARM"), "R-8.8.2-1")
    for name, standard in TYPES.items():
        yield from _of("type", "getNamedTypeAttributes", name, standard.clause.ids, mmsDeletable=False)
    for name, variable in VARIABLES.items():
        cites = variable.clause.ids[:1]
        yield from _of("variable", "getVariableAccessAttributes", name, cites, mmsDeletable=False)


OBJECTS: Mapping[str, Fixed] = {f"{f.object} {f.service} {f.field}": f for f in _listed()}
"""Every fixed attribute, by object, by the service that shows it, and by its field there."""

KINDS = {
    "deleteDomain": "domain",
    "deleteSemaphore": "semaphore",
    "deleteEventCondition": "event condition",
    "deleteEventAction": "event action",
    "deleteNamedType": "type",
    "deleteVariableAccess": "variable",
}
"""What each service deletes. Program invocations are missing: the model knows which of them are deletable."""
LISTS = {"deleteNamedType": "listOfTypeName", "deleteVariableAccess": "listOfName"}
SPECIFIC = 0


def _undeletable() -> Iterator[tuple[tuple[str, str], Fixed]]:
    for fixed in OBJECTS.values():
        if fixed.field == "mmsDeletable":
            yield (fixed.kind, fixed.name), fixed


UNDELETABLE = dict(_undeletable())
ACTIONS = {fixed.name: fixed for fixed in OBJECTS.values() if fixed.field == "confirmedServiceRequest"}


class Objects:
    """The standardized objects of one device."""

    def __init__(self) -> None:
        self._altered: set[str] = set()

    def answered(self, request: Pdu, response: Pdu) -> Iterator[Breach]:
        """The positive answer to a service that shows an object's attributes, or deletes it."""
        service, body = str(request.service), response.body
        if service in KINDS:
            yield from _deleted(service, request.body, body)
        elif service == "alterEventConditionMonitoring":
            self._altered.add(plain_name(request.body["eventConditionName"]))
        elif service == "reportSemaphoreEntryStatus":
            yield from _owners(request.body, body)
        else:
            name = _asked(service, request.body)
            yield from self._shown(service, name, body)
            yield from _described(service, name, body)
            if service == "reportSemaphoreStatus" and name == SEMAPHORE:
                yield from _tokens(body["numberOfOwnedTokens"] + body["numberOfHungTokens"])

    def notified(self, pdu: Pdu) -> Iterator[Breach]:
        """EventNotification: the severity of its condition, the shape of its action's result."""
        yield from self._shown("eventNotification", plain_name(pdu.body["eventConditionName"]), pdu.body)
        result = pdu.body.get("actionResult")
        if result is None or result["eventActionResult"][0] != "success":
            return
        action = ACTIONS.get(plain_name(result["eventActionName"]))
        if action is not None:
            service, shown = result["eventActionResult"][1]["response"]
            wanted, argument = action.value
            if service != wanted:
                words = {"action": action.name, "found": service, "wanted": wanted}
                yield Breach("event.action-result", words, clause=action.clause)
            elif isinstance(argument, str):
                yield from self._shown(service, argument, shown)

    def _shown(self, service: str, name: str, body: Any) -> Iterator[Breach]:
        for fixed in BY_PLACE.get((service, name.rpartition("/")[2]), ()):
            if fixed.kind == "variable" and variables.standard(name) is None:
                continue
            if "/" in name and fixed.kind != "variable":
                continue
            shown = body.get(fixed.field, fixed.value)
            if fixed.fits(shown) or (fixed.initial and name in self._altered):
                continue
            words = {"attribute": fixed.field, "object": fixed.object, "found": shown, "wanted": fixed.value}
            rule = "object.initial" if fixed.initial else "object.attribute"
            yield Breach("object.member" if fixed.member else rule, words, clause=fixed.clause)


def _by_place() -> dict[tuple[str, str], tuple[Fixed, ...]]:
    found: dict[tuple[str, str], tuple[Fixed, ...]] = {}
    for fixed in OBJECTS.values():
        place = fixed.service, fixed.name
        found[place] = (*found.get(place, ()), fixed)
    return found


BY_PLACE = _by_place()


def _asked(service: str, body: Any) -> str:
    """The object that a service asks about, with its domain before it; nothing where it names none."""
    if service == "getVariableAccessAttributes":
        kind, named = body
        return plain_name(named) if kind == "name" else ""
    if isinstance(body, tuple) and len(body) == 2 and body[0] in ("vmd-specific", "domain-specific"):
        return plain_name(body)
    return body if isinstance(body, str) else ""


def _described(service: str, name: str, body: Any) -> Iterator[Breach]:
    """The type of a standardized type or variable, where the service shows one."""
    wrong: Iterable[tuple[Clause, Misfit]] = ()
    if service == "getVariableAccessAttributes":
        wrong = variables.described(name, body["typeSpecification"])
    elif service == "getNamedTypeAttributes":
        wrong = variables.described_type(name, body["typeSpecification"])
    for clause, misfit in wrong:
        words = {"object": f"{name}{misfit.part}", "found": misfit.found, "wanted": misfit.wanted}
        yield Breach("object.type", words, clause=clause)


def _tokens(count: int) -> Iterator[Breach]:
    if count > 1:
        yield Breach("semaphore.tokens", {"count": count})


def _owners(request: Mapping[str, Any], response: Mapping[str, Any]) -> Iterator[Breach]:
    if plain_name(request["semaphoreName"]) == SEMAPHORE and request["state"] == OWNER:
        yield from _tokens(len(response["listOfSemaphoreEntry"]))


# Deleting.


def _deleted(service: str, body: Any, answer: Any) -> Iterator[Breach]:
    """Standardized objects that are not deletable, and of which one at least has been deleted."""
    named = set(_named(service, body))
    fixed = [UNDELETABLE[key] for name in sorted(named) if (key := _key(service, name)) in UNDELETABLE]
    spared = _spared(service, len(named), answer)
    if fixed and spared < len(fixed):
        first, which = fixed[0], " or ".join(f.object for f in fixed)
        yield Breach("object.deleted", {"object": which}, clause=first.clause)


def _key(service: str, name: str) -> tuple[str, str]:
    variable = KINDS[service] == "variable" and variables.standard(name) is not None
    return KINDS[service], name.rpartition("/")[2] if variable else name


def _named(service: str, body: Any) -> Iterator[str]:
    """The names that are to be deleted one by one; a whole scope names none."""
    if service == "deleteDomain":
        yield body
    elif service == "deleteSemaphore":
        yield plain_name(body)
    elif service in LISTS:
        yield from map(plain_name, body.get(LISTS[service], ()) if body["scopeOfDelete"] == SPECIFIC else ())
    elif body[0] == "specific":
        yield from map(plain_name, body[1])


def _spared(service: str, named: int, answer: Any) -> int:
    """How many of those named the answer says that it has not deleted."""
    if service in LISTS:
        return named - int(answer["numberDeleted"])
    return int(answer) if isinstance(answer, int) else 0
