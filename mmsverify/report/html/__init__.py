"""An audit as one HTML page that needs nothing but itself: no font, no picture, no script from elsewhere.

Whatever is to be read is there without scripts; the page's own script filters, zooms and unfolds. Every text
that comes from a recording is escaped, and a content security policy forbids what might slip by: it names the
page's script and its style by their hashes, so nothing else can run.
"""

from __future__ import annotations

from mmsverify.incident import Dossier
from mmsverify.report.html.page import page
from mmsverify.results import Audit

__all__ = ["render"]


def render(audit: Audit, dossier: Dossier | None = None) -> str:
    """The report; without a ``dossier``, the findings alone. All its characters are of ASCII."""
    return page(audit, dossier or Dossier()).encode("ascii", "xmlcharrefreplace").decode("ascii")
