"""The modelling language: expression rows in a class body. Imports the standard library only.

from mmsverify.model import *

class Lamp(Model, name="lamp"):
    lit = Relation()
    press = Transition("L-1", on=internal("press"), when=[~lit()], then=[lit().becomes(True)])
    dark_at_first = Initially("L-0", ~lit())
    can_be_lit = Sometimes("L-2", lit())
"""

from mmsverify.model.claims import Always, Assume, Initially, Removed, Sometimes, Step, Unspecified
from mmsverify.model.declare import (
    Derived,
    Each,
    On,
    Relation,
    Variable,
    indication,
    internal,
    optional,
    parameter,
    response,
    shown,
    unchanged,
)
from mmsverify.model.load import load, load_variants
from mmsverify.model.model import Model, ModelData, assemble
from mmsverify.model.occurrences import Occurrence, Occurs
from mmsverify.model.procedure import Observation, Procedure, Transition, needs, repaired
from mmsverify.model.rows import MINUS, PLUS, Claim, Clause, Conjunct, Row
from mmsverify.model.sorts import BOOL, Enumeration, integer
from mmsverify.model.steps import accept, do, for_each, may, refuse
from mmsverify.model.terms import all_of, answered, any_of, for_all, for_some, if_, service_is

__all__ = [
    "BOOL", "MINUS", "PLUS", "Always", "Assume", "Claim", "Clause", "Conjunct", "Derived", "Each",
    "Enumeration", "Initially", "Model", "ModelData", "Observation", "Occurrence", "Occurs", "On",
    "Procedure", "Relation", "Removed", "Row", "Sometimes", "Step", "Transition", "Unspecified",
    "Variable", "accept", "all_of", "answered", "any_of", "assemble", "do", "for_all", "for_each",
    "for_some", "if_", "indication", "integer", "internal", "load", "load_variants", "may", "needs",
    "optional", "parameter", "refuse", "repaired", "response", "service_is", "shown", "unchanged",
]  # fmt: skip
