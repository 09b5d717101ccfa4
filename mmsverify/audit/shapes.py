"""Shapes of MMS data: what a value or a type specification must look like, and where one does not.

Nothing of a robot is here; the robot's own types and variables are tables of ``variables``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

NUMBERS = frozenset({"integer", "unsigned"})
INTEGER8, SINGLE = 8, (32, 8)
Value = tuple[str, Any]


@dataclass(frozen=True, slots=True)
class Scalar:
    """One value of that kind of Data.

    ``among`` are the integers allowed; ``size`` is the width of an integer in bits, the longest length of a
    string, or the (format width, exponent width) of a floating-point value. An absent one is not prescribed.
    """

    kind: str
    among: tuple[int, ...] = ()
    size: Any = None


@dataclass(frozen=True, slots=True)
class Array:
    """As many elements as ``count`` says; ``None``: how many depends on something else."""

    of: Shape
    count: int | None = None


@dataclass(frozen=True, slots=True)
class Structure:
    """Components in their order, with their meanings."""

    components: tuple[tuple[str, Shape], ...]


@dataclass(frozen=True, slots=True)
class Named:
    """A shape that has a standardized type name."""

    name: str
    of: Shape


Shape = Scalar | Array | Structure | Named


@dataclass(frozen=True, slots=True)
class Misfit:
    """Where something has another shape: ``part`` of the whole, what it is and what it had to be.

    ``value``: the kind is right and only the value is not; ``types``: the standardized types that the part
    belongs to, the nearest first.
    """

    part: str
    found: str
    wanted: str
    value: bool = False
    types: tuple[str, ...] = ()


BOOLEAN = Scalar("boolean")
FLOAT = Scalar("floating-point")
SINGLE_FLOAT = Scalar("floating-point", size=SINGLE)


def integer8(*among: int) -> Scalar:
    """An Integer8, where only some of its values have a meaning."""
    return Scalar("integer", among, INTEGER8)


# Values.


def misfits(shape: Shape, value: Value, part: str = "") -> Iterator[Misfit]:
    """Where a value has another shape."""
    match shape:
        case Named():
            yield from (_within(shape, misfit) for misfit in misfits(shape.of, value, part))
        case Scalar():
            yield from _scalar(shape, value, part)
        case Array():
            yield from _array(shape, value, part)
        case Structure():
            yield from _structure(shape, value, part)


def _within(shape: Named, misfit: Misfit) -> Misfit:
    return replace(misfit, types=(*misfit.types, shape.name))


def _same(kind: str, wanted: str) -> bool:
    """Whether both are one kind; signed or not makes no difference to what an integer means."""
    return kind == wanted or {kind, wanted} <= NUMBERS


def _scalar(shape: Scalar, value: Value, part: str) -> Iterator[Misfit]:
    kind, content = value
    if not _same(kind, shape.kind):
        yield Misfit(part, kind, shape.kind)
    elif shape.among and content not in shape.among:
        yield Misfit(part, str(content), ", ".join(map(str, shape.among)), value=True)
    elif shape.size is not None:
        yield from _size(shape, content, part)


def _size(shape: Scalar, content: Any, part: str) -> Iterator[Misfit]:
    match shape.kind:
        case "integer":
            limit: int = 1 << shape.size - 1
            if not -limit <= content < limit:
                yield Misfit(part, str(content), f"{-limit} to {limit - 1}", value=True)
        case "visible-string":
            if len(content) > shape.size:
                yield Misfit(part, f"{len(content)} characters long", f"at most {shape.size}", value=True)
        case "floating-point":
            found = (8 * (len(content) - 1), content[0] if content else 0)
            if found != shape.size:
                yield Misfit(part, _float(found), _float(shape.size))


def _float(size: tuple[int, int]) -> str:
    return f"floating-point of format width {size[0]} and exponent width {size[1]}"


def _array(shape: Array, value: Value, part: str) -> Iterator[Misfit]:
    kind, content = value
    if kind != "array":
        yield Misfit(part, kind, "array")
        return
    if shape.count is not None and len(content) != shape.count:
        yield Misfit(part, f"array of {len(content)}", f"array of {shape.count}")
    for place, item in enumerate(content):
        yield from misfits(shape.of, item, f"{part}[{place}]")


def _structure(shape: Structure, value: Value, part: str) -> Iterator[Misfit]:
    kind, content = value
    if kind != "structure":
        yield Misfit(part, kind, "structure")
    elif len(content) != len(shape.components):
        yield Misfit(part, f"structure of {len(content)}", f"structure of {len(shape.components)}")
    else:
        for (name, inner), item in zip(shape.components, content, strict=True):
            yield from misfits(inner, item, f"{part}.{name}")


# Type specifications.


def misdescribed(shape: Shape, described: Value, part: str = "") -> Iterator[Misfit]:
    """Where a TypeSpecification describes another shape; a type's name stands for what it is known to be."""
    kind, content = described
    if kind == "typeName":
        if isinstance(shape, Named) and _other_standard(content, shape.name):
            yield Misfit(part, str(content[1]), shape.name)
        return
    match shape:
        case Named():
            yield from (_within(shape, misfit) for misfit in misdescribed(shape.of, described, part))
        case Scalar():
            yield from _described_scalar(shape, kind, content, part)
        case Array():
            yield from _described_array(shape, kind, content, part)
        case Structure():
            yield from _described_structure(shape, kind, content, part)


def _other_standard(named: tuple[str, Any], name: str) -> bool:
    """Whether it is the name of a standardized type, but of another one."""
    scope, found = named
    return scope == "vmd-specific" and found.startswith("R_") and found != name


def _described_scalar(shape: Scalar, kind: str, content: Any, part: str) -> Iterator[Misfit]:
    if not _same(kind, shape.kind):
        yield Misfit(part, kind, shape.kind)
        return
    found: Any = content
    if kind == "floating-point":
        found = content["format-width"], content["exponent-width"]
    elif kind == "visible-string":
        found = abs(content)  # A negative length says that shorter ones fit, too.
    if shape.size is not None and found != shape.size:
        yield Misfit(part, f"{kind} {found}", f"{shape.kind} {shape.size}")


def _described_array(shape: Array, kind: str, content: Any, part: str) -> Iterator[Misfit]:
    if kind != "array":
        yield Misfit(part, kind, "array")
        return
    if shape.count is not None and content["numberOfElements"] != shape.count:
        yield Misfit(part, f"array of {content['numberOfElements']}", f"array of {shape.count}")
    yield from misdescribed(shape.of, content["elementType"], f"{part}[]")


def _described_structure(shape: Structure, kind: str, content: Any, part: str) -> Iterator[Misfit]:
    if kind != "structure":
        yield Misfit(part, kind, "structure")
        return
    parts = content["components"]
    if len(parts) != len(shape.components):
        yield Misfit(part, f"structure of {len(parts)}", f"structure of {len(shape.components)}")
        return
    for (name, inner), component in zip(shape.components, parts, strict=True):
        yield from misdescribed(inner, component["componentType"], f"{part}.{name}")
