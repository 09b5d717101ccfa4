"""The benchmark core, programmed by hand from its description: no rows, no library. For counting only."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import chain, combinations

ARM = 0
NONE = -1
CAN_RUN = ("IDLE", "STOPPED", "RUNNING")


@dataclass(frozen=True)
class Core:
    """One state: of each program invocation state, control, reference and list; the selected one; motion."""

    state: tuple[str, ...]
    control: tuple[str, ...]
    ref: tuple[int, ...]
    lists: tuple[frozenset[int], ...]
    selected: int = NONE
    motion: bool = False

    @staticmethod
    def first(count: int) -> Core:
        others = count - 1
        return Core(
            ("IDLE", *["NONEXISTENT"] * others), ("CONTROLLED", *["NORMAL"] * others),
            (NONE,) * count, (frozenset[int](),) * count,
        )  # fmt: skip

    def put(self, p: int, **fields: object) -> Core:
        """This state with fields of one program invocation changed; ``list`` is its entry in ``lists``."""
        changed: dict[str, object] = {}
        for name, value in fields.items():
            whole = list(getattr(self, "lists" if name == "list" else name))
            whole[p] = value
            changed["lists" if name == "list" else name] = tuple(whole)
        return replace(self, **changed)  # type: ignore[arg-type]

    def unlinked(self, a: int) -> Core:
        """Without the list of ``a`` and the references of those on it."""
        made = self
        for c in self.lists[a]:
            made = made.put(c, ref=NONE)
        return made.put(a, list=frozenset())


def reached(count: int, repaired: bool, end_stops_motion: bool = False) -> set[Core]:
    """All reachable states with ``count`` program invocations."""
    found = {Core.first(count)}
    waiting = list(found)
    while waiting:
        for after in steps(waiting.pop(), repaired, end_stops_motion):
            if after not in found:
                found.add(after)
                waiting.append(after)
    return found


def steps(s: Core, repaired: bool, end_stops_motion: bool) -> Iterator[Core]:
    """Every successor of a state."""
    if s.selected == NONE or s.state[s.selected] == "IDLE":
        freed = s.unlinked(s.selected) if s.selected != NONE else s
        yield replace(freed, selected=NONE)
    for p in range(len(s.state)):
        if s.state[p] == "NONEXISTENT":
            if p != ARM:
                for kind in ("NORMAL", "CONTROLLING", "CONTROLLED"):
                    yield s.put(p, state="IDLE", control=kind, ref=NONE, list=frozenset())
        else:
            yield from life(s, p, end_stops_motion)
            yield from deleted(s, p, repaired)
            yield from selections(s, p)


def life(s: Core, p: int, end_stops_motion: bool) -> Iterator[Core]:
    """Start, stop, resume, reset, kill and end."""
    state = s.state[p]
    if state in ("IDLE", "STOPPED") and may_run(s, p):
        made = s.put(p, state="RUNNING")
        for c in s.lists[p]:
            made = made.put(c, state="RUNNING")
        yield replace(made, motion=s.motion or ARM in s.lists[p] | {p})
    still = replace(s, motion=False) if p == ARM else s
    if state == "RUNNING":
        yield still.put(p, state="STOPPED")
        yield ended(still if end_stops_motion else s, p)
    if state == "STOPPED":
        yield s.put(p, state="IDLE")
    if state in CAN_RUN:
        yield still.put(p, state="UNRUNNABLE")


def may_run(s: Core, p: int) -> bool:
    if s.control[p] != "CONTROLLING":
        return True
    return s.selected == p and all(s.state[c] in CAN_RUN for c in s.lists[p])


def ended(s: Core, p: int) -> Core:
    if s.control[p] == "CONTROLLING" and s.selected == p:
        s = replace(s.unlinked(p), selected=NONE)
    return s.put(p, state="IDLE")


def deleted(s: Core, p: int, repaired: bool) -> Iterator[Core]:
    owner = s.ref[p] if s.control[p] == "CONTROLLED" else NONE
    if p == ARM or s.state[p] == "RUNNING" or (owner != NONE and s.state[owner] != "IDLE"):
        return
    made = s.put(owner, list=s.lists[owner] - {p}) if owner != NONE else s
    if s.control[p] == "CONTROLLING":
        made = made.unlinked(p)
    made = made.put(p, list=frozenset(), state="NONEXISTENT", ref=NONE, control="NORMAL")
    yield replace(made, selected=NONE) if repaired and s.selected == p else made


def selections(s: Core, p: int) -> Iterator[Core]:
    if s.control[p] != "CONTROLLING" or s.state[p] != "IDLE":
        return
    if s.selected != NONE and s.state[s.selected] != "IDLE":
        return
    free = [
        c for c in range(len(s.state))
        if s.state[c] != "NONEXISTENT" and s.control[c] == "CONTROLLED" and s.ref[c] in (NONE, s.selected)
    ]  # fmt: skip
    freed = s.unlinked(s.selected) if s.selected != NONE else s
    for chosen in chain.from_iterable(combinations(free, size) for size in range(len(free) + 1)):
        made = replace(freed, selected=p).put(p, list=frozenset(chosen))
        for c in chosen:
            made = made.put(c, ref=p)
        yield made
