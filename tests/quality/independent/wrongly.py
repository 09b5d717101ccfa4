"""What the faults of services share: a robot is brought somewhere, and then answers wrongly."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from independent import views
from independent.desk import Desk
from mmsverify.samples import pdus

Ask = tuple[str, Any, Any]
SEVERAL = {"several": True}
CTRL = {"semaphoreName": pdus.vmd("R_CTRL")}


def wrongly(
    come: Callable[[Desk], None],
    service: str,
    body: Any,
    detail: Any = None,
    why: str = "",
    gives: Any = None,
) -> Any:
    def run(d: Desk) -> None:
        come(d)
        shown = views.status(d.robot)[0] if service == "vMDReset" else gives
        d.accepts(service, body, detail, why=why, gives=shown)

    return run


def refusing(
    come: Callable[[Desk], None], cause: tuple[str, str], service: str, body: Any, detail: Any = None
) -> Any:
    def run(d: Desk) -> None:
        come(d)
        d.refuses(service, body, detail, cause=cause)

    return run
