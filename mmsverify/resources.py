"""Where the project's own data lies: models, ASN.1 modules, sample traces.

In an installed wheel the folders travel inside the package; in a source checkout they stand beside it.
Nothing is read here.
"""

from __future__ import annotations

from pathlib import Path

from mmsverify.errors import InputError

_PACKAGE = Path(__file__).resolve().parent


def models_dir() -> Path:
    """The folder of the model files and profiles that come with mmsverify."""
    return _folder("models")


def asn1_dir() -> Path:
    """The folder of the ASN.1 modules."""
    return _folder("asn1")


def traces_dir() -> Path:
    """The folder of the sample recordings."""
    return _folder("traces")


def readings_page() -> Path:
    """The page on which the project's readings and assumptions are written down."""
    return _folder("docs") / "readings.md"


def _folder(name: str) -> Path:
    for place in (_PACKAGE / "data" / name, _PACKAGE.parent / name):
        if place.is_dir():
            return place
    raise InputError(
        f"the folder {name} is missing",
        place=str(_PACKAGE),
        cure="install mmsverify again, or run it from a full checkout",
    )
