"""Beliefs: which states a model may be in, given what a recording has shown so far.

They are partial and sound: more than the truth may be thought possible, never less.
"""

from mmsverify.concrete.belief.belief import Belief, Outcome
from mmsverify.concrete.belief.blame import Blame

__all__ = ["Belief", "Blame", "Outcome"]
