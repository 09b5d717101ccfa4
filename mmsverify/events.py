"""One MMS message as flat data, for people and their tools: who said what, and what it shows.

Names only, no judgement; what reads messages makes these, what prints them reads these.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class MmsEvent:
    """One message of a recording.

    ``index`` and ``time`` (ns) are those of the recording; ``answers`` is the index of the request that an
    answer belongs to. ``programs`` are the program invocations that the message names, or its request.
    ``robot_state``, ``selected``, ``local_control``, ``logical`` and ``physical`` are what a robot's status
    shows (GB/T 16720.3, 7.3.2.1): empty or ``None`` where the message shows none.
    ``fault`` says why octets are no PDU.
    """

    index: int
    time: int
    vmd: str
    association: str
    sender: str
    kind: str
    service: str = ""
    invoke_id: int | None = None
    answers: int | None = None
    answer: str = ""
    programs: tuple[str, ...] = ()
    robot_state: str = ""
    selected: str = ""
    local_control: bool | None = None
    logical: str = ""
    physical: str = ""
    fault: str = ""
