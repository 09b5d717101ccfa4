"""Beliefs: which states a model may be in, given what a recording has shown so far.

They are partial and sound: more than the truth may be thought possible, never less.
"""

from mmsverify.concrete.belief.belief import Belief
from mmsverify.concrete.belief.blame import Blame, Outcome

__all__ = ["Belief", "Blame", "Outcome"]
