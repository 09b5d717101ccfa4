"""What goes wrong with a URL is one plain line: what, where, and what mends it."""

from __future__ import annotations

import pickle
import socket
import sys
from collections.abc import Iterator
from typing import Any

import fsspec
import pytest
from remote_server import Web, serving

from mmsverify.cli import main
from mmsverify.formats import remote
from mmsverify.formats.locations import Url
from mmsverify.formats.paths import trace_locations
from mmsverify.formats.remote_errors import words

REFUSED = "the connection is refused (check host and port, and that a server runs there)"
NO_HOST = "names no host that there can be (give one like https://"


@pytest.fixture(autouse=True)
def as_here(monkeypatch: pytest.MonkeyPatch) -> None:
    """No pauses between attempts, and no proxy between this machine and itself."""
    monkeypatch.setattr(remote, "_PAUSES", (0, 0))
    monkeypatch.setenv("no_proxy", "127.0.0.1")


@pytest.fixture
def memory() -> Iterator[Any]:
    system = fsspec.filesystem("memory")
    yield system
    system.store.clear()
    system.pseudo_dirs[:] = [""]


def line(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    """What the command line says of a trace that cannot be read."""
    assert main(["audit", "-q", *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    return err.rstrip("\n")


def test_an_error_that_tells_a_secret_is_told_by_its_kind() -> None:
    url = Url("http://me:gehe%20im@host/x")
    assert words(OSError("login with gehe im failed"), url) == "OSError"
    assert words(OSError("http://me:gehe%20im@host/x: no\nmore"), url) == "http://me:***@host/x: no"


@pytest.mark.parametrize(
    ("web", "said"),
    [
        (Web({}), "the server answers 404 Not Found (check the path; that of a folder ends with /)"),
        (Web({}, refuse=403), "403 Forbidden"),
        (Web({}, refuse=500), "500 Internal Server Error"),
        (Web({"x.mcap": b"no recording"}), "not an MCAP file"),
        (Web({"x.mcap": b""}), "not an MCAP file"),
    ],
)
def test_what_a_server_refuses_is_one_line(capsys: pytest.CaptureFixture[str], web: Web, said: str) -> None:
    with serving(web):
        told = line(capsys, web.url("x.mcap").replace("//", "//me:geheim@") + "?token=geheim")
    assert told.startswith(f"mmsverify: http://me:***@{web.host}/x.mcap?token=***: ")
    assert said in told


@pytest.mark.parametrize(
    ("url", "said"),
    [
        ("http://127.0.0.1:9/x.mcap", REFUSED),
        ("http://127.0.0.1:9/*.mcap", REFUSED),
        ("http://127.0.0.1:9/folder/", REFUSED),
        ("http://[::1]:9/x.mcap", "connection"),
        ("nope://x/y.mcap", "no way to open nope:// (give a path, or a URL with http, https, ftp,"),
        ("zip://x.mcap::nope://y.zip", "no way to open nope://"),
        ("reference://x", "no way to open reference://"),
        ("data://x", "no recording can be read there"),
        ("memory://none/x.mcap", "No such file or directory"),
        ("memory://none/*.mcap", "nothing matches this pattern (check it)"),
        ("memory://none", "No such file or directory"),
        ("http://", NO_HOST),
        ("http:///x.mcap", NO_HOST),
        ("http://h:port/x.mcap", NO_HOST),
        ("http://a b/*.mcap", NO_HOST),
        ("http://[::bad/x.mcap", NO_HOST),
        ("zip://x.mcap::http://127.0.0.1:9/x.zip", REFUSED),
    ],
)
def test_what_cannot_be_opened_is_one_line(capsys: pytest.CaptureFixture[str], url: str, said: str) -> None:
    told = line(capsys, url)
    assert told.startswith(f"mmsverify: {url}: ")
    assert said in told


def test_a_folder_without_recordings_is_told(memory: Any, capsys: pytest.CaptureFixture[str]) -> None:
    memory.pipe("/box/readme.txt", b"")
    cure = "recordings end with .mcap"
    told = line(capsys, "memory://box")
    assert told == f"mmsverify: memory://box: a folder without recordings ({cure})"
    told = line(capsys, "memory://box/*.txt")
    assert told == f"mmsverify: memory://box/*.txt: nothing that it matches is a recording ({cure})"


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("logs", "a web page, not an MCAP file (name the file itself; the URL of a folder ends with /)"),
        ("logs/b*.mcap", "nothing matches this pattern (check it; a web server must list its files)"),
        ("none/*.mcap", "nothing matches this pattern (check it; a web server must list its files)"),
        ("logs/*.txt", "nothing that it matches is a recording (recordings end with .mcap)"),
        ("text/", "a folder without recordings (recordings end with .mcap)"),
        ("none.mcap", "the server answers 404 Not Found (check the path; that of a folder ends with /)"),
    ],
)
def test_what_is_wrong_with_a_folder_of_the_web_is_one_plain_line(
    capsys: pytest.CaptureFixture[str], name: str, said: str
) -> None:
    with serving(Web({"logs/a.mcap": b"", "logs/x.txt": b"", "text/x.txt": b""})) as web:
        assert line(capsys, web.url(name)) == f"mmsverify: {web.url(name)}: {said}"


@pytest.mark.parametrize("name", ["x.mcap", "folder/", "*.mcap"])
def test_a_host_that_is_not_there_is_one_plain_line(
    name: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def unknown(*_: object, **__: object) -> None:
        raise socket.gaierror(socket.EAI_NONAME, "Name or service not known")

    monkeypatch.setattr(socket, "getaddrinfo", unknown)
    monkeypatch.setenv("no_proxy", "*")
    told = line(capsys, f"http://no-such-host.invalid/{name}")
    assert told.startswith(f"mmsverify: http://no-such-host.invalid/{name}: no such host (check its name")


def test_a_server_without_encryption_gives_no_secure_connection(capsys: pytest.CaptureFixture[str]) -> None:
    with serving(Web({})) as web:
        url = web.url("x.mcap").replace("http:", "https:")
        assert line(capsys, url).startswith(f"mmsverify: {url}: no secure connection (check the server's")


@pytest.mark.parametrize("name", ["logs/", "logs/*.mcap"])
def test_why_a_folder_is_not_listed_is_told(capsys: pytest.CaptureFixture[str], name: str) -> None:
    with serving(Web({}, refuse=403)) as web:
        url = web.url(name)
        assert line(capsys, url) == (
            f"mmsverify: {url}: the server answers 403 Forbidden "
            "(check that it may be read: user, password, signature)"
        )
        [found] = trace_locations([url])
        assert pickle.loads(pickle.dumps(found)) == found
        assert isinstance(found, Url)
        assert found.trouble is not None
        assert (found.trouble.__cause__, found.trouble.__context__) == (None, None)


def test_without_the_extra_one_line_says_how_to_get_it(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "fsspec", None)
    told = line(capsys, "s3://bucket/folder")
    assert told == "mmsverify: s3://bucket/folder: a URL needs fsspec (pip install 'mmsverify[remote]')"


@pytest.mark.parametrize(("scheme", "driver"), [("s3", "s3fs"), ("gs", "gcsfs"), ("http", "aiohttp")])
def test_a_driver_that_is_missing_is_named(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, scheme: str, driver: str
) -> None:
    monkeypatch.setitem(sys.modules, driver, None)
    told = line(capsys, f"{scheme}://bucket/x.mcap")
    assert told == f"mmsverify: {scheme}://bucket/x.mcap: {scheme}:// needs {driver} (pip install {driver})"
