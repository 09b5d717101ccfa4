"""Conversations told again: with fewer acts, and as short as possible."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from robot_acts import Act
from robot_talk import Talk


def retold(talk: Talk, acts: Sequence[Act]) -> Talk:
    """The conversation in which these acts happen, as far as they can."""
    made = Talk(talk.model, talk.scope, talk._start)
    for act in acts:
        made.do(act)
    made.settle()
    return made


def shrunk(talk: Talk, fails: Callable[[Talk], bool]) -> Talk:
    """A shorter conversation that still fails: stretches of acts are left out as long as it does."""
    acts, size = list(talk.done), max(1, len(talk.done) // 2)
    while size:
        begin, left = 0, False
        while begin < len(acts):
            shorter = acts[:begin] + acts[begin + size :]
            if fails(retold(talk, shorter)):
                acts, left = shorter, True
            else:
                begin += size
        size = size if left and size == 1 else size // 2
    return retold(talk, acts)
