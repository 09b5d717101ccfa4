"""What goes wrong with a URL, told in one line of plain words: what, where, and what mends it.

The errors of drivers are known by what they carry and by their names: no driver is imported here.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager

from mmsverify.errors import InputError
from mmsverify.formats.locations import Url, secrets, without_secrets

EMPTY = "a folder without recordings"
KNOWN = "give a path, or a URL with http, https, ftp, sftp, s3, gs or abfs"
NO_HOST = ("names no host that there can be", "give one like https://host:8080/logs/x.mcap")

_NETWORK = "check host and port, and that a server runs there"
_ANSWERS = {
    401: "check user and password",
    403: "check that it may be read: user, password, signature",
    404: "check the path; that of a folder ends with /",
}
_BUSY = "try again later"
_PLAIN: dict[type[BaseException], tuple[str, str]] = {
    FileNotFoundError: ("No such file or directory", "check the path"),
    IsADirectoryError: (EMPTY, "name one that holds .mcap files"),
    PermissionError: ("Permission denied", "check that it may be read"),
    TimeoutError: ("the server does not answer", _NETWORK),
    NotImplementedError: ("no recording can be read there", KNOWN),
}
# Of errors that say what only a programmer understands; the first that is among the kinds of an error counts.
_NAMED = {
    "InvalidURL": NO_HOST,
    "TooManyRedirects": ("the server sends from one address to the next without end", "check the address"),
    "ClientSSLError": ("no secure connection", "check the server's certificate, and whether it is http://"),
    "ConnectionRefusedError": ("the connection is refused", _NETWORK),
    "ClientConnectorError": ("no connection", _NETWORK),
    "ClientConnectionError": ("the connection broke off", _BUSY),
    "ClientPayloadError": ("the connection broke off", _BUSY),
    "ClientError": ("the server's answer cannot be read", "check the address"),
}


@contextmanager
def told(url: Url) -> Iterator[None]:
    """Whatever goes wrong in there is told as an ``InputError`` about the URL."""
    try:
        yield
    except InputError as error:
        raise InputError(error.cause, place=str(url), cure=error.cure) from None
    # Each driver has errors of its own, which cannot be named without importing it.
    except Exception as error:
        cause, cure = _said(error, url)
        raise InputError(cause, place=str(url), cure=cure) from None


def is_missing(error: FileNotFoundError) -> bool:
    """Whether there is no such file; fsspec says "not found" of whatever a web server answers."""
    return error.__cause__ is None or getattr(error.__cause__, "status", None) == 404


def words(error: BaseException, url: Url) -> str:
    """What an error says of itself, unless that would tell a secret."""
    said = without_secrets(str(error))
    if said in ("", str(url)) or any(secret in said for secret in secrets(url.address)):
        return type(error).__name__
    return said.splitlines()[0]


def _said(error: BaseException, url: Url) -> tuple[str, str]:
    """Cause and cure."""
    reason = error.__cause__ if isinstance(error, FileNotFoundError) else None
    reason = reason or error
    status = getattr(reason, "status", None)
    if isinstance(status, int) and status >= 400:
        said = getattr(reason, "message", "")
        cause = f"the server answers {status} {said if isinstance(said, str) else ''}".strip()
        return cause, _ANSWERS.get(status, _BUSY if status >= 500 else "check the address")
    below = getattr(reason, "os_error", reason)  # what the system said of a connection that cannot be made
    names = {kind.__name__ for each in (reason, below) for kind in type(each).__mro__}
    if names & {"gaierror", "ClientConnectorDNSError"}:
        return "no such host", "check its name, and that this machine is in the network"
    for kind, plain in _PLAIN.items():
        if isinstance(reason, kind):
            return plain
    for name, (cause, cure) in _NAMED.items():
        if name in names or (name == "ConnectionRefusedError" and _refused(below)):
            return f"{cause}{_system(below) if cause == 'no connection' else ''}", cure
    return words(reason, url), ""


def _refused(error: BaseException) -> bool:
    return isinstance(error, OSError) and error.errno == errno.ECONNREFUSED


def _system(error: BaseException) -> str:
    number = error.errno if isinstance(error, OSError) else None
    return f": {os.strerror(number)}" if number is not None and number in errno.errorcode else ""
