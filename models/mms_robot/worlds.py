"""The small worlds in which runs are looked for, the smaller ones first.

Claims speak of every profile, so a run in any of these refutes them. Without a profile of the user's own: a
robot with its arm program, one domain that programs may be made of, one whose task program cannot be deleted,
one where nothing is predefined; then a second client, a second controlled program, a third program of any
kind, a task program that has a list and is not selected, more about domains; one that holds a single task
program and knows no steps.
"""

from collections.abc import Iterator, Mapping
from typing import Any

from .scenario import named

ARM = {"name": "R_ARM", "control": "CONTROLLED", "domains": ["R_ARM"], "deletable": False}
TOOL = {"name": "R_TOOL", "control": "CONTROLLED", "domains": ["R_TOOL"], "deletable": False}
CALIBRATION = {"name": "R_CAL", "control": "NORMAL", "domains": ["R_CAL"], "deletable": False}
TASK = {"name": "TASK", "control": "CONTROLLING", "domains": ["TASK"], "deletable": False}
HANDS = {"name": "HANDS", "control": "CONTROLLED", "domains": ["HANDS"], "deletable": True}
LISTING = {**TASK, "controlled": ["HANDS"]}
SHARING = {"name": "OTHER", "control": "NORMAL", "domains": ["TASK"], "deletable": False}


def worlds(profile: Mapping[str, Any] | None) -> Iterator[dict[str, Any]]:
    """Sizes and profile of each world; a user's profile keeps all that it predefines, without and with more."""
    if profile is not None:
        given = named(profile)
        if given["PI"]:
            yield {"sizes": {"PI": given["PI"]}, "profile": profile}
        yield {"sizes": {"PI": given["PI"] + 1}, "profile": profile}
        yield {
            "sizes": {"PI": given["PI"] + 1, "Domain": given["Domain"] + 1, "Upload": 1},
            "profile": profile,
        }
        yield {"sizes": {"PI": given["PI"], "Client": 2}, "profile": profile}
        yield {"sizes": {"PI": given["PI"] + 2}, "profile": profile}
        return
    yield {"sizes": {"PI": 2}, "profile": {"predefined": [ARM]}}
    yield {"sizes": {"PI": 1, "Domain": 1, "Upload": 1}, "profile": {"predefined": []}}
    yield {"sizes": {"PI": 2}, "profile": {"predefined": [ARM, TASK]}}
    yield {"sizes": {"PI": 2}, "profile": {"predefined": []}}
    yield {"sizes": {"PI": 1}, "profile": {"predefined": [CALIBRATION]}}
    yield {"sizes": {"PI": 1, "Client": 2}, "profile": {"predefined": [ARM]}}
    yield {"sizes": {"PI": 2, "Client": 2}, "profile": {"predefined": [ARM], "associations": "multiple"}}
    yield {"sizes": {"PI": 3}, "profile": {"predefined": [ARM, TOOL, TASK]}}
    yield {"sizes": {"PI": 3}, "profile": {"predefined": [ARM]}}
    yield {"sizes": {"PI": 3}, "profile": {"predefined": [HANDS, LISTING]}}
    yield {"sizes": {"PI": 2, "Domain": 1}, "profile": {"predefined": [TASK, SHARING]}}
    yield {
        "sizes": {"PI": 1, "Domain": 1, "Client": 2},
        "profile": {"predefined": [], "associations": "multiple"},
    }
    yield {"sizes": {"PI": 3}, "profile": {"predefined": [ARM], "single_task": True, "step_limited": False}}
