"""The start of a device: which program invocations a profile predefines, and with what attributes."""

from collections.abc import Mapping, Sequence
from typing import Any

from .vocabulary import Control

ARM, CALIBRATION = "R_ARM", "R_CAL"
STANDARD = (ARM, CALIBRATION, "R_SAFE")
DEFAULT = (
    {"name": "R_ARM", "control": "CONTROLLED", "domains": ["R_ARM"], "deletable": False},
    {"name": "R_CAL", "control": "NORMAL", "domains": ["R_CAL"], "deletable": False},
)


def scenario(
    sizes: Mapping[str, int], profile: Mapping[str, Any]
) -> tuple[dict[str, tuple[str, ...]], dict[tuple[str, tuple[str, ...]], Any]]:
    """Element names for each sort and the facts about them.

    The first program invocations are the predefined ones of the profile, as many as fit; the others are there
    to be created. Where the profile does not say which are predefined, at least half of them are there to be
    created.
    """
    size = sizes.get("PI", 3)
    predefined = list(profile["predefined"])[:size] if "predefined" in profile else list(DEFAULT[: size // 2])
    names = [str(entry["name"]) for entry in predefined]
    others = [f"P{i + 1}" for i in range(size - len(names))]
    elements = {
        "PI": (*names, *others),
        "Client": tuple(f"client{i + 1}" for i in range(sizes.get("Client", 1))),
        "Request": tuple(f"request{i + 1}" for i in range(sizes.get("Request", 1))),
        "Domain": domain_names(predefined, sizes.get("Domain", 0)),
        "Upload": tuple(f"upload{i + 1}" for i in range(sizes.get("Upload", 0))),
        "Device": _devices(_arms(profile), sizes),
        "Joint": tuple(f"joint{i + 1}" for i in range(sizes.get("Joint", 1))),
    }
    facts: dict[tuple[str, tuple[str, ...]], Any] = {
        ("step_limited", ()): bool(profile.get("step_limited", True)),
        ("single_association", ()): profile.get("associations", "single") == "single",
        ("single_task", ()): bool(profile.get("single_task", False)),
    }
    for name in elements["PI"]:
        entry = next((e for e in predefined if e["name"] == name), None)
        facts |= attributes(name, entry, profile)
        listed = () if entry is None else entry.get("controlled", ())
        facts |= {("predefined_controls", (name, each)): each in listed for each in elements["PI"]}
        facts |= _calibrates(name, entry, elements["Device"], _arms(profile))
    for arm in set(_arms(profile)).intersection(elements["Device"]):
        facts |= {("needs_calibration", (arm,)): True, ("jointed", (arm,)): True}
    return elements, facts | domain_facts(elements["Domain"], elements["PI"], predefined)


def named(profile: Mapping[str, Any]) -> dict[str, int]:
    """How many elements of each sort a profile names."""
    predefined = profile.get("predefined", DEFAULT)
    domains = {str(d) for entry in predefined for d in entry.get("domains", ())}
    return {"PI": len(predefined), "Domain": len(domains), "Device": len(_arms(profile))}


def domain_names(predefined: Sequence[Mapping[str, Any]], size: int) -> tuple[str, ...]:
    """The first domains are those of the predefined program invocations, as many as fit."""
    named = dict.fromkeys(str(d) for entry in predefined for d in entry.get("domains", ()))
    first = [*named][:size]
    return (*first, *(f"D{i + 1}" for i in range(size - len(first))))


def domain_facts(
    domains: Sequence[str], programs: Sequence[str], predefined: Sequence[Mapping[str, Any]]
) -> dict[tuple[str, tuple[str, ...]], Any]:
    """What is fixed about the domains: which are predefined, which are standardized ones, who is bound to them."""
    bound = {str(e["name"]): frozenset(map(str, e.get("domains", ()))) for e in predefined}
    facts: dict[tuple[str, tuple[str, ...]], Any] = {}
    for name in domains:
        given = any(name in named for named in bound.values())
        facts |= {
            ("predefined_domain", (name,)): given,
            ("standard_domain", (name,)): given and name in STANDARD,
            ("arm_domain", (name,)): given and name == ARM,
            ("calibration_domain", (name,)): given and name == CALIBRATION,
        }
        facts |= {("predefined_uses", (p, name)): name in bound.get(p, ()) for p in programs}
    return facts


def _arms(profile: Mapping[str, Any]) -> tuple[str, ...]:
    """The domains that represent robot arms (6.2.1): those of the devices that are told, else of the arm programs."""
    told = [device["domain"] for device in profile.get("devices", ()) if device["kind"] == "arm"]
    if told:
        return tuple(dict.fromkeys(told))
    arms = profile.get("arms", ["R_ARM"])
    entries = [entry for entry in profile.get("predefined", DEFAULT) if entry["name"] in arms]
    return tuple(dict.fromkeys(d for entry in entries for d in entry.get("domains", ()))) or ("R_ARM",)


def _devices(arms: tuple[str, ...], sizes: Mapping[str, int]) -> tuple[str, ...]:
    """The arms, as many as fit, then other physical resources."""
    size = sizes.get("Device", len(arms))
    return (*arms[:size], *(f"DEVICE{i + 1}" for i in range(size - len(arms))))


def _calibrates(
    name: str, entry: Mapping[str, Any] | None, devices: tuple[str, ...], arms: tuple[str, ...]
) -> dict[tuple[str, tuple[str, ...]], Any]:
    """What a program invocation calibrates: R_CAL the only arm; which of several, a profile does not say."""
    if name != "R_CAL" or entry is None:
        return {("calibrates_device", (name, device)): False for device in devices}
    return {("calibrates_device", (name, arm)): True for arm in arms if arms == (arm,) and arm in devices}


def attributes(
    name: str, entry: Mapping[str, Any] | None, profile: Mapping[str, Any]
) -> dict[tuple[str, tuple[str, ...]], Any]:
    """What is fixed about one program invocation; ``entry`` is its place among the predefined ones, if it has one."""
    given = entry or {}
    standard_arm = name == "R_ARM" and entry is not None
    return {
        ("predefined", (name,)): entry is not None,
        ("predefined_control", (name,)): Control(given.get("control", "NORMAL")),
        ("predefined_deletable", (name,)): bool(given.get("deletable", True)),
        ("predefined_reusable", (name,)): bool(given.get("reusable", True)),
        ("predefined_arm", (name,)): name in profile.get("arms", ["R_ARM"]) or standard_arm,
        ("selected_at_power_on", (name,)): name == profile.get("selected_at_power_on", ""),
        ("calibrates", (name,)): name == "R_CAL" and entry is not None,
        ("standard_arm", (name,)): standard_arm,
    }
