"""mmsverify in a notebook: results as data frames, charts, and objects that show themselves.

    import mmsverify as mv

    audit = mv.audit(mv.sample("faulty-select"))
    audit.findings
    audit.timeline()
    mv.check("mms-robot", properties=["one-controller"])
    mv.model("mms-robot").diagram()

The composition root of the API; charts need the extra ``viz``. Whatever a name in a recording holds, none is
shown but as text.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from mmsverify.auditing import audit_traces
from mmsverify.errors import UsageError
from mmsverify.formats.paths import Given
from mmsverify.notebook.audits import NotebookAudit
from mmsverify.notebook.checks import NotebookCheck, checked
from mmsverify.notebook.models import NotebookModel
from mmsverify.resources import traces_dir

__all__ = ["NotebookAudit", "NotebookCheck", "NotebookModel", "audit", "check", "model", "sample"]


def audit(
    paths: Given | Iterable[Given],
    *,
    profile: str | Path | None = None,
    model: str | None = None,
    variant: str = "repaired",
    jobs: int | None = None,
) -> NotebookAudit:
    """Replay recordings against their models, and hold what was found.

    ``paths``: one input or several: files, folders (all recordings in them), glob patterns, URLs of these.
    ``profile``: a TOML file, or the name of a shipped one; ``None``: what each recording says of itself.
    ``model``: a model's name, whatever a recording says; ``None``: the one for what is in it.
    ``jobs``: so many processes share the work.

    A recording that cannot be read is a finding, and the others are audited. Raises ``ProfileError`` for a
    bad profile, ``UsageError`` for an unknown model or variant, ``ValueError`` for ``jobs`` below one.
    """
    result = audit_traces(paths, profile=profile, model=model, variant=variant, jobs=jobs)
    return NotebookAudit(result, profile=profile, model=model, variant=variant)


def check(
    name: str | Path,
    *,
    properties: Sequence[str] = (),
    variant: str | None = None,
    scope: Mapping[str, int] | None = None,
    unbounded: bool = False,
    depth: int | None = None,
    timeout: float | None = None,
    profile: str | Path | None = None,
) -> NotebookCheck:
    """Prove or refute the properties of a model: all of them, or those that are named.

    ``name``: a shipped model, or the path of a model file. ``variant``: ``repaired`` where the model has it,
    if none is given. ``scope``: only up to so many elements of each sort, such as ``{"PI": 3}``;
    ``unbounded``: only proofs for any number of each. ``depth``: at most so many steps of a search;
    ``timeout``: seconds for each property, which is unknown then. ``profile`` as for `audit`.

    Raises ``UsageError`` for a name, variant or property that does not exist, ``ModelError`` for a file that
    is no model.
    """
    return checked(
        name,
        properties=properties,
        variant=variant,
        scope=scope,
        unbounded=unbounded,
        depth=depth,
        timeout=timeout,
        profile=profile,
    )


def model(name: str | Path, *, variant: str | None = None) -> NotebookModel:
    """A model by name, or by the path of its file; ``repaired`` where it has that variant, if none is given.

    Raises ``UsageError`` for a name or variant that does not exist, ``ModelError`` for a file that is none.
    """
    return NotebookModel(str(name), variant)


def sample(name: str) -> Path:
    """The path of a recording that comes with mmsverify: ``sample("faulty-select")``.

    Raises ``UsageError`` for a name that none has.
    """
    path = traces_dir() / f"{name.removesuffix('.mcap')}.mcap"
    if not path.is_file():
        known = ", ".join(sorted(each.stem for each in traces_dir().glob("*.mcap")))
        raise UsageError(f"no sample {name!r}", cure=f"one of {known}")
    return path
