"""Where an input is: a path of this machine, or the URL of another one. Nothing is opened here.

A URL may carry a password or a signature. It is shown without them, wherever it is shown.
"""

from __future__ import annotations

import os
import re
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import unquote

from mmsverify.errors import InputError

# Two letters at least, so that a drive of Windows is none.
_SCHEME = re.compile(r"([A-Za-z][A-Za-z0-9+.-]+)://")
_USER = re.compile(r"(?P<scheme>[A-Za-z][A-Za-z0-9+.-]+)://(?P<user>[^/?#\s]*)@")
_QUERY = re.compile(r"(?P<name>[?&;][^=&;#\s]*)=(?P<value>[^&;#\s'\"]+)")
_SECRET = re.compile(r"sig|token|key|secret|pass|auth|credential|session", re.IGNORECASE)
_HIDDEN = "***"
WEB = frozenset({"http", "https"})


@dataclass(frozen=True, slots=True)
class Url:
    """A place that fsspec opens: ``s3://bucket/x.mcap``, ``https://host/x.mcap``.

    ``address`` is the URL as given, with its secrets; ``str()`` gives it without. ``size`` in octets, where a
    listing told it; ``trouble`` is why there is no listing, where that was asked for.
    """

    address: str
    size: int | None = field(default=None, compare=False)
    trouble: InputError | None = field(default=None, compare=False)

    def __str__(self) -> str:
        return without_secrets(self.address)

    def __repr__(self) -> str:
        return f"Url({str(self)!r})"

    @property
    def scheme(self) -> str:
        """``s3``, ``https``, in small letters."""
        return self.address.partition("://")[0].lower()

    @property
    def path(self) -> str:
        """What follows the scheme, without the query of a web address."""
        rest = self.address.partition("://")[2]
        return re.split(r"[?#]", rest, maxsplit=1)[0] if self.scheme in WEB else rest

    @property
    def name(self) -> str:
        """The last part of the path."""
        return self.path.rstrip("/").rpartition("/")[2]

    @property
    def suffix(self) -> str:
        """As of a path: ``.mcap``."""
        return Path(self.name).suffix


Location = Path | Url


def located(path: str | os.PathLike[str] | Url) -> Location:
    """The location that is meant: a string with a scheme is a URL, everything else a path."""
    if isinstance(path, Url):
        return path
    return Url(path) if isinstance(path, str) and is_url(path) else Path(path)


def is_url(text: str) -> bool:
    """Whether a text begins with a scheme and ``://``."""
    return _SCHEME.match(text) is not None


def local(locations: list[Location]) -> list[Path]:
    """Those of this machine."""
    return [each for each in locations if isinstance(each, Path)]


def without_secrets(text: str) -> str:
    """``text`` with the passwords and signatures of the URLs in it left out."""
    return _QUERY.sub(_query, _USER.sub(_user, text))


def secrets(address: str) -> set[str]:
    """The parts of an address that nobody may see, as they stand and with their escapes undone."""
    hidden = {found["value"] for found in _QUERY.finditer(address) if _SECRET.search(found["name"])}
    for found in _USER.finditer(address):
        name, colon, password = found["user"].partition(":")
        hidden.add(password if colon else name if found["scheme"].lower() in WEB else "")
    return {form for part in hidden if part for form in (part, unquote(part))}


def _user(found: re.Match[str]) -> str:
    # Without a colon it is a user's name, or the container of a blob store; of the web it may be a token.
    name, colon, _ = found["user"].partition(":")
    if colon:
        return f"{found['scheme']}://{name}:{_HIDDEN}@"
    return f"{found['scheme']}://{_HIDDEN}@" if found["scheme"].lower() in WEB else found[0]


def _query(found: re.Match[str]) -> str:
    return f"{found['name']}={_HIDDEN}" if _SECRET.search(found["name"]) else found[0]
