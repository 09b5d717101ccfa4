"""Audits of VR recordings: samples of a controller that runs the template framework."""

from mmsverify.audit.vr.controller import Controller, Numbering
from mmsverify.audit.vr.rules import VR_RULES
from mmsverify.audit.vr.scans import Scans

__all__ = ["VR_RULES", "Controller", "Numbering", "Scans"]
