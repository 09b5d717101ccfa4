"""What is said in the logs of the benchmarks, batch by batch: conforming, full of new values, or faulty.

The cell is the one of the samples. Where a value is `FRESH` or a time `NOW`, it is another one each time that
the batch is written; the model looks at none of them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rendering import FRESH, NOW

from mmsverify.samples import pdus
from mmsverify.samples.cell import ARM, OFFERED, ROBOT_ADDITIONAL, Cell
from mmsverify.samples.pdus import of_domain, vmd
from mmsverify.samples.shift import (
    DOOR,
    ENROLLED,
    EXECUTING,
    LOADED,
    ROOF,
    calibration,
    cell_variable,
    first_batch,
    loading,
    morning,
    routine,
)

PATCH = "Seam_Patch"
JOURNAL = vmd("Cell_Log")
NEW = {
    "integer": ("integer", int.from_bytes(FRESH)),
    "float": ("floating-point", b"\x08" + FRESH),
    "double": ("floating-point", b"\x0b" + FRESH + FRESH),
    "octets": ("octet-string", 3 * FRESH),
    "image": ("octet-string", 16 * FRESH),
}
"""Values that no standardized variable has."""

BEGINNING = (morning, calibration, loading, first_batch)
"""How an early shift begins."""


class Logger(Cell):
    """A cell whose status has a local detail, and whose robot keeps a journal."""

    def begin(self, outstanding: int = 5) -> None:
        services = (*OFFERED["server"], "readJournal")
        self.open({**OFFERED, "server": services}, ROBOT_ADDITIONAL, outstanding)

    def detailed(self, state: str, selected: str | None = None, *, asked: bool = True) -> None:
        """Status with a local detail that is new, asked for or not."""
        chosen = ("programInvocation", selected) if selected else ("noneSelected", None)
        detail = pdus.robot_status(state, pdus.ALL_WELL, chosen)
        body = {**pdus.status(0, 0), "localDetail": f"{int.from_bytes(FRESH):032b}"}
        if asked:
            self.call("status", False, gives=body, extra=detail)
        else:
            self.tell("unsolicitedStatus", body, detail)

    def writes(self, name: str, value: Any) -> None:
        """A variable of the user's is written."""
        written = {"variableAccessSpecification": cell_variable(name), "listOfData": [value]}
        self.call("write", written, gives=[("success", None)])

    def logged(self) -> None:
        """Two entries of the robot's journal."""
        values = [{"variableTag": "Current", "valueSpecification": NEW["float"]}]
        contents = [("data", {"listOfVariables": values}), ("annotation", "seam sensor cleaned")]
        entries = [
            {
                "entryIdentifier": FRESH,
                "originatingApplication": {},
                "entryContent": {"occurrenceTime": NOW + b"\x3b\xe4", "entryForm": content},
            }
            for content in contents
        ]
        gives = {"listOfJournalEntry": entries, "moreFollows": False}
        self.call("readJournal", {"journalName": JOURNAL}, gives=gives)

    def arm_stood_still(self) -> None:
        """The robot notifies that R_ARM has left RUNNING, and when."""
        answer = ("getProgramInvocationAttributes", pdus.attributes("idle", [ARM], deletable=False))
        body = pdus.notification(ENROLLED, ARM, ARM, answer, pdus.controlled(None))
        body["transitionTime"] = ("timeOfDayT", NOW + b"\x3b\xe4")
        self.tell("eventNotification", body)


def measured(cell: Logger, job: str) -> None:
    """What is watched while a job is welded."""
    cell.detailed(EXECUTING, job)
    cell.report("Seam_Current", NEW["float"])
    cell.report("Wire_Used", NEW["integer"])
    cell.report("Weld_Image", NEW["image"])
    cell.read(("Arc_Voltage", NEW["double"]), ("Part_Id", NEW["octets"]), ("R_VSAFEV", ("boolean", False)))
    cell.read((of_domain(job, "Seam"), ("array", [NEW["float"]] * 6)))
    cell.writes("Part_Id", NEW["octets"])
    cell.writes("Offset", ("structure", [NEW["float"], NEW["integer"]]))


def diverse(cell: Logger) -> None:
    """Batches of which every message is another: measured values, programs, journals, times."""
    for number, job in enumerate((ROOF, DOOR), 1):
        cell.select(job, ARM)
        cell.start(job, cycles=4 + number)
        for _ in range(3):
            cell.recording.wait(13)
            measured(cell, job)
        cell.attributes(job, "running", pdus.controlling([ARM], ("cycleLimited", 3)))
        cell.recording.wait(60)
        cell.detailed(LOADED, asked=False)
        cell.arm_stood_still()
        cell.logged()
    cell.download(PATCH, [8 * FRESH, 8 * FRESH, 5 * FRESH])
    cell.call("initiateUploadSequence", PATCH, gives={"ulsmID": 1, "listOfCapabilities": []})
    for more in (True, False):
        segment = {"loadData": ("non-coded", 8 * FRESH), "moreFollows": more}
        cell.call("uploadSegment", 1, gives=segment)
    cell.call("terminateUploadSequence", 1)
    cell.call("deleteDomain", PATCH)


# Faults: after each the robot is in the state in which it was before.


def _wrong_state(cell: Cell) -> None:
    cell.status(EXECUTING, DOOR)


def _deletes_arm(cell: Cell) -> None:
    asked = cell.ask("deleteDomain", ARM)
    cell.answer(asked, "deleteDomain")


def _wrong_type(cell: Cell) -> None:
    cell.read(("R_VSAFEV", ("integer", 0)))


def _unnamed(cell: Cell) -> None:
    cell.status(LOADED, physical=9)


def _unasked(cell: Cell) -> None:
    cell.answer(99, "stop")


def _other_service(cell: Cell) -> None:
    cell.answer(cell.ask("identify"), "stop")


def _domain_changed(cell: Cell) -> None:
    gives = {
        "listOfCapabilities": [], "state": 3, "mmsDeletable": True, "sharable": False,
        "listOfProgramInvocations": [ARM], "uploadInProgress": 0,
    }  # fmt: skip
    cell.call("getDomainAttributes", ARM, gives=gives)


def _unfounded(cell: Cell) -> None:
    cell.arm_left_running(ENROLLED, "running")


FAULTS: tuple[Callable[[Cell], None], ...] = (
    _wrong_state,
    _deletes_arm,
    _wrong_type,
    _unnamed,
    _unasked,
    _other_service,
    _domain_changed,
    _unfounded,
)


def faulty(fault: Callable[[Cell], None]) -> Callable[[Cell], None]:
    """A routine with a fault at its end."""

    def batch(cell: Cell) -> None:
        routine(cell)
        fault(cell)

    return batch
