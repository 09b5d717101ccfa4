"""What a built page loads from another host: nothing may be, for plants have no network."""

from __future__ import annotations

import re

_TAG = re.compile(r"<(?:script|img|iframe|source|link)\b[^>]*>", re.IGNORECASE)
_ELSEWHERE = re.compile(r"\b(?:src|srcset|href)\s*=\s*[\"']?((?:https?:)?//[^\"'\s>]+)", re.IGNORECASE)


def loaded_from_elsewhere(html: str) -> list[str]:
    """The addresses on other hosts from which scripts, pictures and styles of a page come."""
    return [address for tag in _TAG.findall(html) for address in _ELSEWHERE.findall(tag)]
