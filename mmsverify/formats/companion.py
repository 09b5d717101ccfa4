"""Where a companion standard's part stands in a PDU: details under [79], services under [78].

What lives here turns the decoded tree of a PDU into the shapes that `mms` hands out, and back: the detail of
a service without the wrapping that only the encoding needs, a robot's service by its own name, the 1990 forms
in the shape of 2003. A detail that belongs to another service than the PDU's own is `Misplaced`; nothing here
reads octets.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

ADDITIONAL_SERVICES = frozenset({"vMDStop", "vMDReset", "select", "alterPI"})
"""The services under [78], GB/T 16720.3, 7.4.1.2."""

RENAMED = frozenset({"additionalService"})
"""Services that `plain_service` gives another name."""
RESHAPED = frozenset({"eventNotification", "takeControl", "defineEventAction", "getEventActionAttributes"})
"""Services whose body `plain_body` looks into."""

_STATUS = frozenset({"status", "unsolicitedStatus"})
_DETAIL_OF = {"vMDReset": "status"}
_MAY_BE_NORMAL = frozenset({"start", "resume"})

Named = tuple[str, Any]


class Misplaced(Exception):  # noqa: N818 - never leaves this folder
    """A detail that belongs to another service than the one it came with."""


def plain_service(service: Named) -> Named:
    """A service by its own name: ``additionalService`` is only the tag that the robot's services share."""
    name, value = service
    if name == "additionalService":
        name, value = value
    return name, value


def wrapped_service(service: Named) -> Named:
    """The inverse of `plain_service`."""
    return ("additionalService", service) if service[0] in ADDITIONAL_SERVICES else service


def plain_detail(service: str, detail: Named | None) -> Any:
    """The detail of ``service`` without its alternative's name, that of a status without its choice."""
    if detail is None:
        return None
    name, value = detail
    if name != _DETAIL_OF.get(service, service):
        raise Misplaced(f"a detail of {name} in a PDU of {service}")
    if name in _STATUS and isinstance(value, tuple):
        return value[1]
    return value


def wrapped_detail(service: str, detail: Any) -> Named | None:
    """The inverse of `plain_detail`; None, and so no [79], where the detail would be a mere NULL."""
    if detail is None or (service in _MAY_BE_NORMAL and detail == ("normal", None)):
        return None
    name = _DETAIL_OF.get(service, service)
    return name, ("fullResponse", detail) if name in _STATUS else detail


def plain_body(service: str, body: Any) -> Any:
    """The body of a service with the nested service of an event action in the shapes of this module."""
    if service == "eventNotification":
        return _plain_notification(body)
    if service == "takeControl" and body == {}:
        return "noResult", None
    if isinstance(body, dict) and "confirmedServiceRequest" in body:
        _check_action(body)
    return body


def wrapped_body(service: str, body: Any) -> Any:
    """The inverse of `plain_body`."""
    if service != "eventNotification" or not isinstance(body, Mapping):
        return body
    result: Any = body.get("actionResult")
    match result:
        case {"eventActionResult": ("success", {"response": (str(name), _)} as success)}:
            wrapped = {**success, "response": wrapped_service(success["response"])}
            detail = wrapped_detail(name, wrapped.pop("detail", None))
            if detail is not None:
                wrapped["detail"] = detail
            return {**body, "actionResult": {**result, "eventActionResult": ("success", wrapped)}}
    return body


def _check_action(body: Mapping[str, Any]) -> None:
    """An event action stays as it was defined; only that its detail is its own is checked."""
    plain_detail(plain_service(body["confirmedServiceRequest"])[0], body.get("detail"))


def _plain_notification(body: dict[str, Any]) -> dict[str, Any]:
    """1990 wraps the event condition once more and a failure once less; both get the shape of 2003."""
    name, value = body["eventConditionName"]
    if name == "eventCondition":
        body["eventConditionName"] = value
    if "actionResult" in body:
        outcome, result = body["actionResult"]["eventActionResult"]
        plain = _plain_success(result) if outcome == "success" else _plain_failure(result)
        body["actionResult"]["eventActionResult"] = outcome, plain
    return body


def _plain_success(result: dict[str, Any]) -> dict[str, Any]:
    response = plain_service(result["response"])
    result["response"] = response
    if "detail" in result:
        result["detail"] = plain_detail(response[0], result["detail"])
    return result


def _plain_failure(result: dict[str, Any]) -> dict[str, Any]:
    return {"serviceError": result} if "errorClass" in result else result
