"""All keys of all tables: the one registry that reading, errors and the page of documentation are made from."""

from __future__ import annotations

from collections.abc import Mapping

from mmsverify.profiles.framework import FRAMEWORK, FRAMEWORK_TABLE
from mmsverify.profiles.keys import Key, integer, number, numbers, span
from mmsverify.profiles.robot import ROBOT

ROBOT_TABLE, SIGNALS_TABLE = "mms-robot", "modbus-signals"
POINTS = 960
"""How many signals of a class a controller can have."""
WORDS = 65536
"""How many registers an address can tell apart."""

SIGNALS: Mapping[str, Key] = {
    "max_clients": number(4, 1, says="how many clients may be connected",
                          clauses=("M-2.1-11",)),
    "address_offset": integer(0, says="what is added to a PDU address to get the signal number",
                              clauses=("M-2.3-7",)),
    "outputs": span(1, 960, POINTS, says="external outputs",
                    clauses=("M-2.3-2", "M-2.3-3", "M-2.3.1-4", "M-2.3.2-1")),
    "inputs": span(1001, 1960, POINTS, says="external inputs",
                   clauses=("M-2.3-2", "M-2.3-3", "M-2.3.1-1", "M-2.3.2-1")),
    "internals": span(2001, 2960, POINTS, says="internal signals",
                      clauses=("M-2.3-2", "M-2.3-3", "M-2.3.1-4", "M-2.3.2-1")),
    "dedicated": numbers(says="signals assigned to robot functions, which are never written",
                         clauses=("M-2.3.2-2", "M-2.3.2-4")),
    "registers": span(0, 1023, WORDS, says="the word data that function codes 3, 4, 6 and 16 reach",
                      clauses=("M-2.3-7",)),
}  # fmt: skip
"""The plan of signals of a server, as the robot is set up."""

KEYS: Mapping[str, Mapping[str, Key]] = {
    ROBOT_TABLE: ROBOT,
    FRAMEWORK_TABLE: FRAMEWORK,
    SIGNALS_TABLE: SIGNALS,
}
