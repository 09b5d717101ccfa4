"""A proof as files that any SMT solver can check again.

from mmsverify.checking.certificates import write_certificates

write_certificates("mms-robot", Path("proof"))   # then: for f in proof/*.smt2; z3 $f -> unsat
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from mmsverify.checking.proofs import Proofs
from mmsverify.model.load import load
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim
from mmsverify.resources import models_dir
from mmsverify.symbolic.certificate import certificates


def write_certificates(model: str, directory: Path, *, variant: str | None = None) -> list[Path]:
    """Prove what can be proved of the model; write a script for the start and each row: all are ``unsat``.

    The scripts name in their first line what they are about. Together they are the proof of every claim that
    ``check`` reports as proved by induction.
    """
    data = load(model, models_dir(), variant)
    directory.mkdir(parents=True, exist_ok=True)
    written = []
    for certificate in certificates(data, proved_claims(data)):
        about = re.sub(r"[^A-Za-z0-9_.-]+", "-", certificate.about)
        path = directory / f"{data.name}.{data.variant}.{about}.smt2"
        path.write_text(certificate.script, encoding="ascii")
        written.append(path)
    return written


def proved_claims(model: ModelData) -> Sequence[Claim]:
    """The claims that are proved by induction, with the sharper ones that their proofs rest on."""
    proofs = Proofs(model)
    claims = [claim for claim in model.claims if claim.kind != "sometimes"]
    proofs.prove(claims)
    steps = [c for c in claims if c.kind == "step" and c.name in proofs.proved]
    return [*proofs.invariants, *steps]
