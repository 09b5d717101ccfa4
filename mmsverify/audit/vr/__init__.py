"""Audits of VR recordings: samples of a controller that runs the template framework."""

from mmsverify.audit.vr.controller import SCAN, Controller, Numbering
from mmsverify.audit.vr.rules import VR_RULES
from mmsverify.audit.vr.scans import Scans
from mmsverify.audit.vr.ways import Stage

__all__ = ["SCAN", "VR_RULES", "Controller", "Numbering", "Scans", "Stage"]
