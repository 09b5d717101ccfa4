"""Beliefs: which states a model may be in, given what a recording has shown so far. Partial, sound, never less than the truth."""

from mmsverify.concrete.belief.belief import Belief, Outcome
from mmsverify.concrete.belief.blame import Blame

__all__ = ["Belief", "Blame", "Outcome"]
