"""A drawing in SVG that shows itself in a notebook."""

from __future__ import annotations

from pathlib import Path


class Drawing:
    """An SVG drawing, such as a state diagram."""

    def __init__(self, svg: str, title: str) -> None:
        self._svg = svg
        self.title = title

    def svg(self) -> str:
        """The drawing as SVG."""
        return self._svg

    def save(self, path: str | Path) -> Path:
        """Write the drawing as an SVG file."""
        place = Path(path)
        place.write_text(self._svg, encoding="utf-8")
        return place

    def _repr_svg_(self) -> str:
        return self._svg

    def __repr__(self) -> str:
        return f"<{self.title}>"
