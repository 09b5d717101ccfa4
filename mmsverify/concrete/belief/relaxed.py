"""Whether moves can bring an event about if no move takes away what another has given.

This is the delete relaxation of planning (Bonet and Geffner, "Planning as heuristic search", 2001): cells
only gain values. What cannot be with it cannot be without it, and it needs as many rounds as moves build upon
each other, not as many states as there are orders of them.
"""

from __future__ import annotations

from collections.abc import Callable

from mmsverify.concrete.belief.field import Field, Move
from mmsverify.concrete.belief.goal import Goal
from mmsverify.concrete.belief.horizon import Reach
from mmsverify.concrete.belief.partial import Partial


def hopeless(
    state: Partial,
    moves: Field,
    goal: Goal,
    may: Callable[[Move, Partial], bool],
    gives: Callable[[Move], Reach],
) -> bool:
    """Whether the event certainly cannot be, whatever may happen before it.

    ``may``: whether a move may be made in some state that a partial one allows; ``gives``: the values that a
    move may give to cells.
    """
    left = list(moves.moves)
    while goal.impossible(state):
        able = [each for each in left if may(each, state)]
        if not able:
            return True
        left = [each for each in left if each not in able]
        for each in able:
            state = gives(each).drifted(state)
    return False
