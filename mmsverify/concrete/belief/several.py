"""Several partial states: without those that others cover, joined where little is lost, compared."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from mmsverify.concrete.belief.partial import DECIDED, MARKS, Key, Partial
from mmsverify.concrete.belief.values import join


def distinct(states: Iterable[Partial]) -> list[Partial]:
    """The states without those that another one covers, in order; two that differ in one cell become one."""
    listed = list(dict.fromkeys(states))
    if len(listed) < 2:
        return listed
    kept: list[Partial] = []
    for state in _merged(listed):
        if not any(other.covers(state) for other in kept):
            kept = [other for other in kept if not state.covers(other)]
            kept.append(state)
    return kept


def _merged(states: list[Partial]) -> list[Partial]:
    """The same states, fewer: where one cell is all that tells two apart, it is joined; nothing is lost."""
    merging = True
    while merging and len(states) > 1:
        merging = False
        first = states[0]
        bits = 0
        for state in states:
            bits |= first.bits ^ state.bits
        for place in first.world.changed(bits):
            states, fewer = _merged_at(~place.bits, states)
            merging = merging or fewer
        for key in _differing(states):
            states, fewer = _merged_beside(key, states)
            merging = merging or fewer
    return states


def _merged_at(others: int, states: list[Partial]) -> tuple[list[Partial], bool]:
    groups: dict[Any, Partial] = {}
    for state in states:
        rest = (state.bits & others, frozenset(state.beside.items()))
        found = groups.get(rest)
        groups[rest] = state if found is None else found.with_bits(found.bits | state.bits)
    return list(groups.values()), len(groups) < len(states)


def _differing(states: Sequence[Partial]) -> list[Key]:
    """The integers in which the states are not all alike, in a fixed order."""
    first = states[0].beside
    apart = {
        key
        for state in states[1:]
        if state.beside != first
        for key in {*first, *state.beside}
        if key[0] not in MARKS and first.get(key) != state.beside.get(key)
    }
    return sorted(apart)


def _merged_beside(key: Key, states: list[Partial]) -> tuple[list[Partial], bool]:
    groups: dict[Any, Partial] = {}
    for state in states:
        rest = (state.bits, frozenset(item for item in state.beside.items() if item[0] != key))
        found = groups.get(rest)
        groups[rest] = state if found is None else found.put(key, join(found.get(key), state.get(key)))
    return list(groups.values()), len(groups) < len(states)


def widened(states: list[Partial], most: int) -> list[Partial]:
    """Neighbours joined until about ``most`` are left: more is allowed than before, never less.

    States in which other answers are decided are not joined: an answer must equal the decision.
    """
    groups: dict[Any, list[Partial]] = {}
    for state in states:
        marks = frozenset((k, v) for k, v in state.beside.items() if k[0] == DECIDED)
        groups.setdefault(marks, []).append(state)
    share = max(1, most // len(groups))
    return [state for group in groups.values() for state in _fewer(group, share)]


def _fewer(states: list[Partial], most: int) -> list[Partial]:
    while len(states) > most:
        states = distinct(
            a if b is a else a.joined(b)
            for a, b in zip(states[::2], [*states[1::2], states[-1]], strict=False)
        )
    return states


def written(before: Sequence[Partial], after: Sequence[Partial]) -> frozenset[Key]:
    """The cells in which the first states of two beliefs differ."""
    if not before or not after:
        return frozenset(
            key for states in (before, after) for key, _ in (states[0].cells() if states else ())
        )
    return frozenset(changed(before[0], after[0]))


def changed(before: Partial, after: Partial) -> list[Key]:
    """The cells in which the states differ, free choices and marks apart."""
    found = [place.key for place in before.world.changed(before.bits ^ after.bits)]
    if before.beside is not after.beside:
        old, new = before.beside, after.beside
        found += [k for k in {**old, **new} if old.get(k) != new.get(k) and k[0][0] != "$"]
    return found
