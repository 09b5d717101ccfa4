"""Network captures to traces: one file per layer, each knowing only what the layer below hands up."""

from mmsverify.formats.capture.conversation import Ports
from mmsverify.formats.capture.importing import ImportedInput, Undecoded, import_captures

__all__ = ["ImportedInput", "Ports", "Undecoded", "import_captures"]
