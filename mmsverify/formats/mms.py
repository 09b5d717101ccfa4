"""MMS PDUs: octets to `Pdu` and back. The only door to the MMS decoder; see ``asn1/`` for the types.

Values are plain Python: SEQUENCE a dict (an absent OPTIONAL member is left out, a DEFAULT filled in), CHOICE
a pair (alternative, value), SEQUENCE OF a list, INTEGER an int (`named` tells its name), BIT STRING a string
of ``0`` and ``1`` (`bits` tells the names), OCTET STRING bytes, NULL None. Whatever the octets are, `decode`
returns a `Pdu` or raises `DecodeError`. What a message means is not decided here.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple

from mmsverify.errors import DecodeError
from mmsverify.formats import cited, companion, compiled
from mmsverify.formats.ber import EncodeError, Fault, header, long_length, shown
from mmsverify.formats.codec import Cover, Misfit, Type, Walk
from mmsverify.formats.schema import Schema
from mmsverify.resources import asn1_dir

__all__ = [
    "EncodeError",
    "ErrorCause",
    "Pdu",
    "bit_string",
    "bits",
    "decode",
    "encode",
    "encoded_statements",
    "error_class_code",
    "fields",
    "locate",
    "named",
    "number",
    "robot_syntax",
]

_WITH_SERVICE = frozenset({"confirmed-RequestPDU", "confirmed-ResponsePDU", "unconfirmed-PDU"})
_INVOKE_FIELD = {
    "confirmed-RequestPDU": "invokeID",
    "confirmed-ResponsePDU": "invokeID",
    "confirmed-ErrorPDU": "invokeID",
    "cancel-ErrorPDU": "originalInvokeID",
    "rejectPDU": "originalInvokeID",
}
_ONLY_INVOKE = frozenset({"cancel-RequestPDU", "cancel-ResponsePDU"})
_ITEM = re.compile(r"\[\d+\]")


@dataclass(frozen=True, slots=True)
class Pdu:
    """One MMS PDU.

    ``kind`` is the alternative of MMSpdu; ``invoke_id`` the invoke id it carries (of the original request for
    reject and cancel); ``service`` the service's name, for an additional service the robot's own
    (``select``); ``body`` its argument or result, or for PDUs without a service their content without the
    invoke id; ``detail`` what the robot standard adds under [79], without its wrapping; ``modifiers`` the
    list of modifiers of a request; ``remarks`` what is wrong with the octets and yet read.
    """

    kind: str
    invoke_id: int | None = None
    service: str | None = None
    body: Any = None
    detail: Any = None
    modifiers: tuple[Any, ...] = ()
    remarks: tuple[str, ...] = ()


class _Open:
    """A `Pdu` in the making. What `dataclass` writes to make a frozen object takes five times as long."""

    __slots__ = ("body", "detail", "invoke_id", "kind", "modifiers", "remarks", "service")


class ErrorCause(NamedTuple):
    """Why a service failed: error class, code, and the service specific information, if any."""

    class_name: str
    code: int
    info: tuple[str, Any] | None


@cache
def _schema() -> Schema:
    return Schema.of_folder(asn1_dir())


@cache
def _statements() -> dict[str, tuple[str, ...]]:
    return cited.statements(path.read_text(encoding="utf-8") for path in sorted(asn1_dir().glob("*.asn")))


@cache
def _names(type_name: str) -> dict[int, str]:
    return _schema().names(type_name)


@cache
def _root() -> Type:
    return _schema().type("MMSpdu")


@cache
def _functions() -> dict[int, compiled.Read]:
    return compiled.root_table(_root())


def decode(octets: bytes, cover: Cover | None = None) -> Pdu:
    """Read one whole PDU of ISO 9506-2 with GB/T 16720.3 clause 7; anything else is a `DecodeError`.

    ``cover`` gives what is to stand in place of values of which the octets could be any.
    """
    if cover is not None:
        return _opened(octets, *_read_any(octets, cover))
    if type(octets) is not bytes:
        octets = bytes(octets)
    remarks: tuple[str, ...] = ()
    try:  # the short way, for octets without a fault and with nothing to remark
        begin, size, end = 2, octets[1], len(octets)
        if size > 0x7F:
            size, begin = long_length(octets, begin, end)
        if begin + size != end:
            raise compiled.Irregular
        kind, content = _functions()[octets[0]](octets, begin, end, 1)
    except compiled.GIVES_UP:
        kind, content, remarks = _read_any(octets)
    return _opened(octets, kind, content, remarks)


def _opened(octets: bytes, kind: str, content: Any, remarks: tuple[str, ...]) -> Pdu:
    try:
        return _pdu(kind, content, remarks)
    except companion.Misplaced as misplaced:
        place = locate(octets, ("detail",)) or (0, 0)
        raise DecodeError(str(misplaced), offset=place[0], path=f"{kind}.detail") from None


def _read_any(octets: bytes, cover: Cover | None = None) -> tuple[str, Any, tuple[str, ...]]:
    """The long way, which knows what is wrong."""
    walk = Walk(octets, cover=cover)
    try:
        kind, content = _read(walk)
        return kind, content, tuple(walk.remarks)
    except Fault as fault:
        raise _decode_error(fault) from None


def encode(pdu: Pdu) -> bytes:
    """Write a PDU: shortest lengths, members at their default left out, the 2003 forms, [79] explicit.

    A value that does not fit its type is an `EncodeError` that names the field.
    """
    try:
        return _root().write((pdu.kind, _content(pdu)), 0)
    except Misfit as misfit:
        raise EncodeError(misfit.cause, place=_dotted(misfit.path)) from None


def locate(octets: bytes, path: Sequence[str]) -> tuple[int, int] | None:
    """Where a field's contents stand in a PDU, as (first octet, octet after the last); None if it is absent.

    ``path`` names fields and alternatives from the outside in, list items as ``[0]``; names in between may be
    left out, so ``("programInvocationName",)`` will do. Of several fields the first counts. Octets that do
    not decode are a `DecodeError`.
    """
    spans: list[tuple[str, int, int]] = []
    try:
        _read(Walk(octets, spans))
    except Fault as fault:
        raise _decode_error(fault) from None
    found = None
    for trail in _trails(spans):
        if trail[-1][0] == path[-1] and _leads(trail, path):
            found = trail[-1][1:]
    return found


def fields(octets: bytes) -> list[tuple[tuple[str, ...], int, int]]:
    """All fields of a PDU: the names that lead to each, from the outside in, begin and end of its contents.

    Items of lists have no names. Octets that do not decode have no fields.
    """
    spans: list[tuple[str, int, int]] = []
    try:
        _read(Walk(octets, spans))
    except Fault:
        return []
    return [
        (tuple(name for name, _, _ in trail if name[0] != "["), *trail[-1][1:]) for trail in _trails(spans)
    ]


def named(type_name: str, value: int) -> str:
    """The name of a number (``ProgramInvocationState``, 3: ``running``); its digits where it has none."""
    return _names(type_name).get(value, str(value))


def number(type_name: str, name: str) -> int:
    """The number of a name in ``type_name``; a `KeyError` where the type does not have it."""
    return {label: value for value, label in _names(type_name).items()}[name]


def bits(type_name: str, value: str) -> frozenset[str]:
    """The names of the bits that are set in a bit string of ``type_name``; unnamed bits by their number."""
    return frozenset(named(type_name, index) for index, bit in enumerate(value) if bit == "1")


def bit_string(type_name: str, names: Iterable[str], size: int = 0) -> str:
    """The bit string of ``type_name`` with the named bits set, at least ``size`` bits long."""
    places = {number(type_name, name) for name in names}
    return "".join("01"[index in places] for index in range(max(size, *(place + 1 for place in places), 0)))


def error_class_code(body: Mapping[str, Any]) -> ErrorCause:
    """The cause in the body of any error PDU, of a failed event action, or in a ServiceError itself."""
    error = body.get("serviceError", body)
    class_name, code = error["errorClass"]
    return ErrorCause(class_name, code, error.get("serviceSpecificInformation"))


def robot_syntax() -> str:
    """The object identifier of the robot standard's abstract syntax (7.2), as Identify lists it."""
    return _schema().object_identifier("mms-robot-syntax")


def encoded_statements(path: str) -> tuple[str, ...]:
    """The statements that the ASN.1 type at ``path`` encodes: those of the innermost production with any.

    ``path`` is a `DecodeError`'s.
    """
    names = _ITEM.sub("", path).split(".")
    return cited.innermost(_schema().places("MMSpdu", names), _statements())


def _read(walk: Walk) -> tuple[str, Any]:
    octets = walk.octets
    if not octets:
        raise Fault("an empty message", 0)
    head, begin, end = header(octets, 0, len(octets))
    reader = _root().readers.get(head)
    if reader is None:
        raise Fault(f"{shown(head)} is no PDU of MMS", 0)
    if end != len(octets):
        raise Fault(f"{len(octets) - end} octets after the end of the PDU", end)
    pair: tuple[str, Any] = reader(walk, begin, end, 1)
    return pair


def _pdu(kind: str, content: Any, remarks: tuple[str, ...]) -> Pdu:
    if kind in _WITH_SERVICE:
        named = content["service"]
        service, body = named if named[0] not in companion.RENAMED else companion.plain_service(named)
        if not body and body == {} and kind == "confirmed-ResponsePDU":
            remarks = (*remarks, f"{service}: an empty element stands where a result must")
        if service in companion.RESHAPED:
            body = companion.plain_body(service, body)
        detail = content.get("detail")
        if detail is not None:
            detail = companion.plain_detail(service, detail)
        pdu: Any = _Open()
        pdu.kind, pdu.service, pdu.body, pdu.detail, pdu.remarks = kind, service, body, detail, remarks
        pdu.invoke_id = content.get("invokeID")
        pdu.modifiers = tuple(content["listOfModifier"]) if "listOfModifier" in content else ()
        pdu.__class__ = Pdu
        done: Pdu = pdu
        return done
    if kind in _ONLY_INVOKE:
        return Pdu(kind, content, remarks=remarks)
    field = _INVOKE_FIELD.get(kind)
    invoke_id = content.pop(field, None) if field else None
    return Pdu(kind, invoke_id, body=content, remarks=remarks)


def _content(pdu: Pdu) -> Any:
    if pdu.kind in _ONLY_INVOKE:
        return pdu.invoke_id
    field = _INVOKE_FIELD.get(pdu.kind)
    invoke = {field: pdu.invoke_id} if field and pdu.invoke_id is not None else {}
    if pdu.kind not in _WITH_SERVICE:
        return {**invoke, **pdu.body} if isinstance(pdu.body, Mapping) else pdu.body
    if pdu.service is None:
        raise Misfit("a PDU of this kind needs a service")
    content = {
        **invoke,
        "listOfModifier": list(pdu.modifiers) or None,
        "detail": companion.wrapped_detail(pdu.service, pdu.detail),
    }
    body = companion.wrapped_body(pdu.service, pdu.body)
    service = companion.wrapped_service((pdu.service, body))
    return {"service": service, **{name: value for name, value in content.items() if value is not None}}


def _decode_error(fault: Fault) -> DecodeError:
    return DecodeError(fault.cause, offset=fault.offset, path=_dotted(fault.path))


def _dotted(path: Sequence[str]) -> str:
    return ".".join(reversed(path)).replace(".[", "[")


def _trails(spans: Sequence[tuple[str, int, int]]) -> Iterator[list[tuple[str, int, int]]]:
    """Each field with those around it, from the outside in; the list is the same one, changed, every time."""
    trail: list[tuple[str, int, int]] = []
    for span in reversed(spans):
        while trail and not (trail[-1][1] <= span[1] and span[2] <= trail[-1][2]):
            trail.pop()
        trail.append(span)
        yield trail


def _leads(trail: Sequence[tuple[str, int, int]], path: Sequence[str]) -> bool:
    names = iter(span[0] for span in trail)
    return all(name in names for name in path)
