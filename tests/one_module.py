"""The ASN.1 modules as one, for a compiler that types across modules overtax."""

from __future__ import annotations

import re

from mmsverify.resources import asn1_dir

HEADER = "Try DEFINITIONS IMPLICIT TAGS ::= BEGIN\n"


def one_module() -> str:
    """All modules but the forms that are only read."""
    paths = (path for path in sorted(asn1_dir().glob("*.asn")) if path.name != "mms-also-read.asn")
    text = "".join(path.read_text(encoding="utf-8") for path in paths)
    frame = r"--.*|^[\w-]+ (\{[^}]*\} )?DEFINITIONS.*|^mms-robot-syntax.*|IMPORTS [^;]*;|^END$"
    bodies = re.sub(frame, "", text, flags=re.M)
    return f"{HEADER}{re.sub(r'DEFAULT cycleCount : 1', 'OPTIONAL', bodies)}END"
