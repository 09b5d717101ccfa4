"""The start of a controller: whether it is homed when it is powered, as a profile says."""

from collections.abc import Iterator, Mapping
from typing import Any

Facts = dict[tuple[str, tuple[str, ...]], Any]


def scenario(_: Mapping[str, int], profile: Mapping[str, Any]) -> tuple[dict[str, tuple[str, ...]], Facts]:
    """No elements, and what the profile fixes."""
    facts: Facts = {}
    if "homed_at_power_on" in profile:
        facts["homed_at_power_on", ()] = bool(profile["homed_at_power_on"])
    return {}, facts


def worlds(profile: Mapping[str, Any] | None) -> Iterator[dict[str, Any]]:
    """There is one machine; without a profile it may be either."""
    yield {"sizes": {}, "profile": profile or {}}
