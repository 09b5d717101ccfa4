"""The words of a robot's PICS: services, parameter CBBs, conformance classes, and what each class demands.

The sets of services stand here once; the keys allow them, the checks of a profile demand them.
"""

from __future__ import annotations

from collections.abc import Mapping

BASE, DOWNLOAD, STORAGE = "base", "upload-download", "secondary-storage"
CLASSES = (BASE, DOWNLOAD, STORAGE)

ROLES = ("server", "client", "both", "")
ADDITIONAL = ("vMDReset", "vMDStop", "select", "alterPI")

# What each statement of clause 9 demands of the base class, and of the two classes of loading.
BASE_SERVICES: Mapping[str, tuple[str, ...]] = {
    "R-9.2.1-1": ("conclude", "identify"),
    "R-9.2.2.2.1-1": ("cancel",),
    "R-9.2.2.2.1-2": ("status", "unsolicitedStatus"),
    "R-9.2.2.2.1-3": ("getDomainAttributes", "deleteDomain"),
    "R-9.2.2.2.1-4": ("createProgramInvocation", "deleteProgramInvocation"),
    "R-9.2.2.2.1-5": ("start", "stop", "resume", "reset"),
    "R-9.2.2.2.1-6": ("getProgramInvocationAttributes",),
    "R-9.2.2.2.1-7": ("read", "write", "informationReport"),
}
DOWNLOAD_SERVICES: Mapping[str, tuple[str, ...]] = {
    "R-9.2.2.2.2.1-1": ("initiateDownloadSequence", "downloadSegment", "terminateDownloadSequence"),
    "R-9.2.2.2.2.1-2": ("initiateUploadSequence", "uploadSegment", "terminateUploadSequence"),
    "R-9.2.2.2.2.1-3": ("requestDomainDownload", "requestDomainUpload"),
}
STORAGE_SERVICES: Mapping[str, tuple[str, ...]] = {
    "R-9.2.2.2.2.2-1": ("loadDomainContent", "storeDomainContent"),
}
SEMAPHORE_SERVICES = ("takeControl", "relinquishControl")

PARAMETERS = ("STR1", "STR2", "VNAM", "VALT", "VADR", "VSCA", "TPY", "VLIS", "REAL", "CEI")
BASE_PARAMETERS = ("STR1", "STR2", "VNAM")

SERVICES = (
    "status", "getNameList", "identify", "rename", "read", "write", "getVariableAccessAttributes",
    "defineNamedVariable", "defineScatteredAccess", "getScatteredAccessAttributes",
    "deleteVariableAccess", "defineNamedVariableList", "getNamedVariableListAttributes",
    "deleteNamedVariableList", "defineNamedType", "getNamedTypeAttributes", "deleteNamedType", "input",
    "output", "takeControl", "relinquishControl", "defineSemaphore", "deleteSemaphore",
    "reportSemaphoreStatus", "reportPoolSemaphoreStatus", "reportSemaphoreEntryStatus",
    "initiateDownloadSequence", "downloadSegment", "terminateDownloadSequence",
    "initiateUploadSequence", "uploadSegment", "terminateUploadSequence", "requestDomainDownload",
    "requestDomainUpload", "loadDomainContent", "storeDomainContent", "deleteDomain",
    "getDomainAttributes", "createProgramInvocation", "deleteProgramInvocation", "start", "stop",
    "resume", "reset", "kill", "getProgramInvocationAttributes", "obtainFile", "defineEventCondition",
    "deleteEventCondition", "getEventConditionAttributes", "reportEventConditionStatus",
    "alterEventConditionMonitoring", "triggerEvent", "defineEventAction", "deleteEventAction",
    "getEventActionAttributes", "reportEventActionStatus", "defineEventEnrollment",
    "deleteEventEnrollment", "alterEventEnrollment", "reportEventEnrollmentStatus",
    "getEventEnrollmentAttributes", "acknowledgeEventNotification", "getAlarmSummary",
    "getAlarmEnrollmentSummary", "readJournal", "writeJournal", "initializeJournal",
    "reportJournalStatus", "createJournal", "deleteJournal", "getCapabilityList", "fileOpen",
    "fileRead", "fileClose", "fileRename", "fileDelete", "fileDirectory", "unsolicitedStatus",
    "informationReport", "eventNotification", "attachToEventCondition", "attachToSemaphore", "conclude",
    "cancel",
)  # fmt: skip
