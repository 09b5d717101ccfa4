"""The samples by name: how each is made, and what it says of its robot where that is not the usual."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from mmsverify.samples import annex_a, faults, firmware, incident, press, shift, signals
from mmsverify.samples.recording import Recording


@dataclass(frozen=True, slots=True)
class Sample:
    """One sample recording: how it is made, and the profile that it carries."""

    make: Callable[[], Recording]
    profile: Mapping[str, str] = field(default_factory=dict)


def example_of_the_standard() -> Recording:
    """Annex A, word for word."""
    recording = Recording("robot")
    for sender, pdu in annex_a.conversation():
        recording.say("unit-controller", sender, pdu)
    return recording


PRESS = {"model": "vr-template", "sub_action_status": "11-14"}
SERVER = {"model": "modbus-signals", "dedicated": "[9, 10]"}

SAMPLES: Mapping[str, Sample] = {
    "annex-a.mcap": Sample(example_of_the_standard),
    "production-run.mcap": Sample(shift.production_run),
    "faulty-select.mcap": Sample(faults.faulty_select),
    "faulty-vmd-stop.mcap": Sample(faults.faulty_vmd_stop),
    "two-clients.mcap": Sample(faults.two_clients, {"model": "mms-robot", "associations": "multiple"}),
    "press-day.mcap": Sample(press.day, PRESS),
    "faulty-press.mcap": Sample(press.faulty_press, PRESS),
    "faulty-signals.mcap": Sample(signals.faulty_signals, SERVER),
    "cell-incident.mcap": Sample(incident.cell_incident, SERVER),
    "firmware-4.2.1.mcap": Sample(firmware.before),
    "firmware-4.3.0.mcap": Sample(firmware.after),
}


def write_samples(folder: Path) -> list[Path]:
    """Write every sample into the folder, which must be there; the paths in order."""
    for name, sample in SAMPLES.items():
        sample.make().write(folder / name, sample.profile)
    return [folder / name for name in SAMPLES]
