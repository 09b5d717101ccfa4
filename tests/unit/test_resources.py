"""The folders of data are found where the package is."""

from __future__ import annotations

from pathlib import Path

import pytest

from mmsverify import resources
from mmsverify.errors import InputError


def test_the_folders_lie_beside_the_package_or_inside_it() -> None:
    assert (resources.asn1_dir() / "mms-pdus.asn").is_file()
    assert (resources.models_dir().name, resources.traces_dir().name) == ("models", "traces")


def test_an_installed_package_prefers_what_it_carries(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "mmsverify"
    (package / "data" / "asn1").mkdir(parents=True)
    (tmp_path / "asn1").mkdir()
    monkeypatch.setattr(resources, "_PACKAGE", package)
    assert resources.asn1_dir() == package / "data" / "asn1"


def test_a_missing_folder_is_told_with_its_cure(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resources, "_PACKAGE", tmp_path / "mmsverify")
    with pytest.raises(InputError, match="install mmsverify again"):
        resources.traces_dir()
