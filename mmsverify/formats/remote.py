"""Recordings on other machines, by fsspec: folders are listed, and what is read of a file is kept.

The only module that knows fsspec, which is imported when the first URL comes by. A recording is read three
times (surveyed, looked over, judged), and often in small jumps; over a network each octet is fetched once at
most and kept in a temporary file that has no name.
"""

from __future__ import annotations

import io
import re
import threading
import time
import weakref
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import IO, TYPE_CHECKING, Any, BinaryIO
from urllib.parse import urlsplit

from mmsverify.errors import InputError
from mmsverify.formats.locations import WEB, Url
from mmsverify.formats.passing import Passed
from mmsverify.formats.remote_errors import EMPTY, KNOWN, NO_HOST, is_missing, told, words

if TYPE_CHECKING:
    from _typeshed import WriteableBuffer

BLOCK = 1 << 20
"""Octets that are fetched together where a file is read here and there."""
MOST_BLOCKS = 16
"""So many blocks in one request at most, where it is read on and on."""
_BUFFER = 1 << 16
_PATIENCE = 60  # seconds without any octet from a web server; a download as a whole may take hours
_PAUSES = (0.5, 2)  # seconds before the second and the third attempt
_DEPTH = 12  # of folders of a web server: its pages may link in circles
_DRIVERS = {
    "s3": "s3fs", "s3a": "s3fs", "gs": "gcsfs", "gcs": "gcsfs", "http": "aiohttp", "https": "aiohttp",
    "abfs": "adlfs", "abfss": "adlfs", "az": "adlfs", "sftp": "paramiko", "ssh": "paramiko",
}  # fmt: skip


class Store:
    """One remote file, and what was read of it so far.

    Errors are ``InputError`` with the URL as place. A file that could not be read on stays so: whoever reads
    it again must not see more than who read it before. Whoever unpickles one begins with nothing. ``fetched``
    is told the octets so far after each request.
    """

    def __init__(self, url: Url, fetched: Passed | None = None) -> None:
        self._url = url
        self._fetched, self._octets = fetched, 0
        self._lock = threading.Lock()
        self._source: Any = None
        self._kept: IO[bytes] | None = None
        self._have: set[int] = set()
        self._failed: InputError | None = None
        self._ahead = 1
        self._size = 0

    def __reduce__(self) -> tuple[type[Store], tuple[Url]]:
        return Store, (self._url,)

    def open(self) -> BinaryIO:
        """A seekable file; any number may be open at a time."""
        with self._telling():
            if self._kept is None:
                self._begin()
        return io.BufferedReader(_View(self), _BUFFER)

    @property
    def size(self) -> int:
        """The octets of the file, true once it was opened."""
        return self._size

    def read_into(self, position: int, buffer: memoryview) -> int:
        """Copy octets from there; gives how many, 0 at the end."""
        count = max(min(len(buffer), self._size - position), 0)
        if not count:
            return 0
        with self._telling():
            for block in range(position // BLOCK, (position + count - 1) // BLOCK + 1):
                if block not in self._have:
                    self._fetch(block)
            assert self._kept is not None
            self._kept.seek(position)
            buffer[:count] = self._kept.read(count)
        return count

    @contextmanager
    def _telling(self) -> Iterator[None]:
        """One at a time, and every error as one of this file, now and for ever."""
        with self._lock:
            if self._failed is not None:
                raise self._failed
            try:
                with told(self._url):
                    yield
            except InputError as error:
                self._failed = error
                raise

    def _begin(self) -> None:
        from tempfile import TemporaryFile

        if self._url.trouble is not None:
            raise self._url.trouble
        system, path = _system(self._url)
        self._source = system.open(path, "rb", cache_type="none")
        kept = TemporaryFile(prefix="mmsverify-")  # noqa: SIM115 (closed when the store goes)
        weakref.finalize(self, kept.close)
        size = _measured(self._source)
        if size is None:
            self._take_all(self._source, kept)
        else:
            self._size = size
        self._kept = kept

    def _fetch(self, block: int) -> None:
        """Fetch a block, and more with it the longer the file has been read on and on."""
        assert self._kept is not None
        self._ahead = min(2 * self._ahead, MOST_BLOCKS) if block - 1 in self._have else 1
        end = block + 1
        while end < block + self._ahead and end not in self._have:
            end += 1
        begin, stop = block * BLOCK, min(end * BLOCK, self._size)
        try:
            data = self._read(begin, stop - begin)
        except ValueError:  # so fsspec tells of a web server that only knows whole files
            system, path = _system(self._url)
            self._take_all(system.open(path, "rb", block_size=0), self._kept)
            return
        if len(data) < stop - begin:
            raise InputError(f"breaks off at octet {begin + len(data)} of {self._size}")
        if len(data) > stop - begin:
            raise InputError(f"octet {begin}: more than was asked for")
        self._keep(self._kept, begin, data)
        self._have.update(range(block, end))

    def _read(self, begin: int, count: int) -> bytes:
        """Read from there; a connection that breaks is tried again."""
        for pause in _PAUSES:
            try:
                return self._read_once(begin, count)
            except (ValueError, FileNotFoundError, PermissionError):
                raise
            except Exception:  # each driver has its own
                time.sleep(pause)
        return self._read_once(begin, count)

    def _read_once(self, begin: int, count: int) -> bytes:
        self._source.seek(begin)
        data: bytes = self._source.read(count)
        return data

    def _keep(self, kept: IO[bytes], position: int, data: bytes) -> None:
        _write(kept, position, data)
        self._octets += len(data)
        if self._fetched is not None:
            self._fetched(self._octets, 0)

    def _take_all(self, stream: Any, kept: IO[bytes]) -> None:
        """Read a file from its begin to its end that cannot be read otherwise."""
        position = self._octets = 0
        with stream:
            while data := stream.read(BLOCK):
                self._keep(kept, position, data)
                position += len(data)
        if position < self._size:
            raise InputError(f"breaks off at octet {position} of {self._size}")
        self._size = position
        self._have = set(range(position // BLOCK + 1))


class _View(io.RawIOBase):
    """A store as a file with a position of its own."""

    def __init__(self, store: Store) -> None:
        self._store, self._position = store, 0

    def readable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        begin = {io.SEEK_SET: 0, io.SEEK_CUR: self._position, io.SEEK_END: self._store.size}[whence]
        self._position = max(begin + offset, 0)
        return self._position

    def tell(self) -> int:
        return self._position

    def readinto(self, buffer: WriteableBuffer) -> int:
        count = self._store.read_into(self._position, memoryview(buffer).cast("B"))
        self._position += count
        return count


def listed(url: Url, suffixes: tuple[str, ...]) -> list[Url]:
    """The files that a URL means, in alphabetical order: itself, those of a folder or of a pattern.

    Of a folder, those with one of ``suffixes``; a folder of a web server ends with ``/``. A URL that leads to
    nothing stays as it is, and so does one that cannot be listed: whoever opens it is told what is wrong.
    """
    patterned = _mark(url) is not None
    if not patterned and (url.suffix.lower() in suffixes or not _may_be_folder(url)):
        return [url]
    try:
        with told(url):
            found = list(_matches(url) if patterned else _below(url))
            if patterned and not found:
                _require_there(url)
    except InputError as error:
        # Without what it came from: where Dask is loaded, that would be sent to other processes, too.
        error.__cause__ = error.__context__ = error.__traceback__ = None
        return [replace(url, trouble=error)]
    files = [each for each in found if each.suffix.lower() in suffixes]
    itself = {each.address.rstrip("/") for each in found} == {url.address.rstrip("/")}
    if found and not files and not itself:
        cause = "nothing that it matches is a recording" if patterned else EMPTY
        trouble = InputError(cause, place=str(url), cure=f"recordings end with {' or '.join(suffixes)}")
        return [replace(url, trouble=trouble)]
    return sorted(files, key=lambda each: each.address) or [url]


def size_of(url: Url) -> int | None:
    """The octets of a remote file, where its machine tells them."""
    try:
        with told(url):
            system, path = _system(url)
            size = system.info(path).get("size")
    except InputError:
        return None
    return size if isinstance(size, int) else None


def _may_be_folder(url: Url) -> bool:
    return url.scheme not in WEB or url.address.endswith("/")


def _mark(url: Url) -> int | None:
    """Where a pattern begins; on the web ``?`` begins a query, and hosts may have brackets."""
    web = url.scheme in WEB
    found = re.search(r"://[^/]*/[^?#]*?([*[])" if web else r"://.*?([*?[])", url.address)
    return found.start(1) if found else None


def _matches(url: Url) -> Iterator[Url]:
    system, path = _system(url)
    mark = _mark(url) or 0
    for name, about in system.glob(path, detail=True).items():
        child = _child(url.address[: url.address.rindex("/", 0, mark) + 1], name, about, system)
        if about.get("type") == "directory":
            yield from _below(Url(child.address.rstrip("/") + "/"))
        else:
            yield child


def _require_there(url: Url) -> None:
    """A pattern without a match may still be the very name of a file."""
    system, path = _system(url)
    try:
        system.info(path)
    except FileNotFoundError as error:
        if not is_missing(error):
            raise
        cure = "check it; a web server must list its files" if url.scheme in WEB else "check it"
        raise InputError("nothing matches this pattern", cure=cure) from None


def _below(url: Url) -> Iterator[Url]:
    system, path = _system(url)
    depth = _DEPTH if url.scheme in WEB else None
    for name, about in system.find(path, maxdepth=depth, detail=True).items():
        yield _child(url.address, name, about, system)


def _child(folder: str, name: str, about: Any, system: Any) -> Url:
    """A listing tells names without scheme, host and user: what was given goes before."""
    begin = folder if folder.endswith("/") else f"{folder}/"
    rest = name[len(system._strip_protocol(begin).rstrip("/")) :]
    return Url(begin + rest.lstrip("/"), about.get("size"))


def _system(url: Url) -> tuple[Any, str]:
    """The file system of a URL, and the path there."""
    try:
        import fsspec
    except ImportError:
        raise InputError("a URL needs fsspec", cure="pip install 'mmsverify[remote]'") from None
    try:
        if url.scheme in WEB:  # where "::" stands in an address and begins no second URL
            _require_host(url)
            return fsspec.filesystem(url.scheme, **_web_options()), url.address
        found: tuple[Any, str] = fsspec.core.url_to_fs(url.address)
    except ImportError as error:
        driver = _DRIVERS.get(url.scheme)
        cause = f"{url.scheme}:// needs {driver or 'a package that is not there'}"
        raise InputError(cause, cure=f"pip install {driver}" if driver else words(error, url)) from None
    except (ValueError, TypeError) as error:  # no such scheme, or one that needs more than an address
        unknown = re.search(r"not known: ([\w+.-]+)", str(error))
        scheme = unknown[1] if unknown else url.scheme
        raise InputError(f"no way to open {scheme}://", cure=KNOWN) from None
    return found


def _require_host(url: Url) -> None:
    try:
        parts = urlsplit(url.address)
        valid = bool(parts.hostname) and parts.port != 0 and not re.search(r"\s", parts.netloc)
    except ValueError:  # of its port, or of its brackets
        valid = False
    if not valid:
        cause, cure = NO_HOST
        raise InputError(cause, cure=cure)


def _web_options() -> dict[str, Any]:
    from aiohttp import ClientTimeout

    timeout = ClientTimeout(total=None, sock_connect=_PATIENCE, sock_read=_PATIENCE)
    return {"client_kwargs": {"timeout": timeout, "trust_env": True}}


def _measured(source: Any) -> int | None:
    """The size of an open file; ``None`` of one that can only be read from its begin to its end."""
    size = getattr(source, "size", None)
    if isinstance(size, int):
        return size
    try:
        return int(source.seek(0, io.SEEK_END))
    except (ValueError, OSError):
        return None


def _write(kept: IO[bytes], position: int, data: bytes) -> None:
    try:
        kept.seek(position)
        kept.write(data)
        kept.flush()
    except OSError as error:
        cause = f"no room for what is fetched: {error.strerror}"
        raise InputError(cause, cure="let TMPDIR name a folder with more room") from None
