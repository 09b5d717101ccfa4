"""Pictures that show themselves in a notebook, and can be written to files.

In JupyterLab and its kin a chart can be moved and enlarged; where a notebook is only read, as on a code host
or in a PDF, its static picture is shown. The notebook keeps both, and nothing is fetched from elsewhere.
"""

from __future__ import annotations

import base64
import io
import json
import re
from pathlib import Path
from typing import Any, Literal, get_args

import altair as alt

from mmsverify.errors import UsageError

Format = Literal["svg", "png", "pdf", "json"]
FORMATS: tuple[Format, ...] = get_args(Format)
SCALE = 1.25
"""Points of a stored picture for each point of the chart."""
KINDS = {6: "application/vnd.vegalite.v6+json", 5: "application/vnd.vegalite.v5+json"}
"""Under both names, as some viewers know only one: what is drawn here is the same in both versions."""
SCHEMA = "https://vega.github.io/schema/vega-lite/v{}.json"


class Picture:
    """A chart. ``chart`` is the Altair chart, for who wants to change it."""

    def __init__(self, chart: alt.TopLevelMixin, title: str) -> None:
        self.chart = chart
        self.title = title

    def svg(self) -> str:
        """The static picture as SVG; the same chart gives the same characters."""
        return self._drawn("svg").decode()

    def save(self, path: str | Path) -> Path:
        """Write the picture: SVG, PNG, PDF, or the chart's description as JSON, by the name's ending.

        Raises ``UsageError`` for another ending.
        """
        place = Path(path)
        for kind in FORMATS:
            if place.suffix.lower() == f".{kind}":
                place.write_bytes(self._drawn(kind))
                return place
        raise UsageError(f"no pictures end in {place.suffix!r}", cure=f"use one of {', '.join(FORMATS)}")

    def _drawn(self, kind: Format) -> bytes:
        if kind == "json":
            return json.dumps(self._described(), indent=1).encode()
        file = io.StringIO() if kind == "svg" else io.BytesIO()
        self.chart.save(file, format=kind, scale_factor=SCALE if kind == "png" else 1)
        drawn = file.getvalue()
        return _numbered(drawn).encode() if isinstance(drawn, str) else drawn

    def _described(self) -> dict[str, Any]:
        described: dict[str, Any] = self.chart.to_dict()
        return described

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, Any]:  # noqa: ARG002
        described = self._described()
        return {
            "text/plain": repr(self),
            "image/png": base64.b64encode(self._drawn("png")).decode("ascii"),
            **{kind: {**described, "$schema": SCHEMA.format(version)} for version, kind in KINDS.items()},
        }

    def __repr__(self) -> str:
        return f"<{self.title}>"


def _numbered(svg: str) -> str:
    """The clipping paths counted from 0: they go on counting from one picture of a process to the next."""
    names: dict[str, str] = {}
    return re.sub(
        r'(?:(?<=id=")|(?<=url\(#))clip\d+',
        lambda found: names.setdefault(found[0], f"clip{len(names)}"),
        svg,
    )
