"""All keys of all tables: the one registry that reading, errors and the page of documentation are made from."""

from __future__ import annotations

from collections.abc import Mapping

from mmsverify.profiles.framework import FRAMEWORK, FRAMEWORK_TABLE
from mmsverify.profiles.keys import Key, integer, number, numbers, span
from mmsverify.profiles.robot import ROBOT

ROBOT_TABLE = "mms-robot"

KEYS: Mapping[str, Mapping[str, Key]] = {
    ROBOT_TABLE: ROBOT,
    FRAMEWORK_TABLE: FRAMEWORK,
    "modbus-signals": {
        "max_clients": number(4, 1, says="how many clients may be connected"),
        "address_offset": integer(0, says="what is added to a PDU address to get the signal number"),
        "outputs": span(1, 960, says="external outputs"),
        "inputs": span(1001, 1960, says="external inputs"),
        "internals": span(2001, 2960, says="internal signals"),
        "dedicated": numbers(says="signals assigned to robot functions, which are never written"),
        "registers": span(0, 1023, says="the word data that function codes 3, 4, 6 and 16 reach"),
    },
}
