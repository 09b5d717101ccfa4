"""Recordings on other machines: the same as on this one, and each octet fetched once."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import IO, Any

import fsspec
import pytest
from remote_server import Web, serving

from mmsverify.auditing import audit_traces, read_events
from mmsverify.cli import main
from mmsverify.errors import InputError
from mmsverify.formats import mcap, remote
from mmsverify.formats.locations import Url, located
from mmsverify.formats.mcap import TraceWriter, read_trace
from mmsverify.formats.paths import trace_locations
from mmsverify.formats.remote import BLOCK, Store
from mmsverify.formats.trace import Channel
from mmsverify.resources import traces_dir

SAMPLE = traces_dir() / "two-clients.mcap"
CLEAN = traces_dir() / "production-run.mcap"
CHANNEL = Channel("/x", "who-knows", None)


@pytest.fixture(scope="module")
def large(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """A recording of many blocks, in chunks that do not shrink."""
    path = tmp_path_factory.mktemp("large") / "large.mcap"
    with TraceWriter(path) as writer:
        for number in range(600):
            writer.add(number, CHANNEL, number.to_bytes(2, "big") + os.urandom(30_000))
    return path.read_bytes()


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


# --- what is shown of a URL ---


@pytest.mark.parametrize(
    ("address", "shown"),
    [
        ("s3://bucket/x.mcap", "s3://bucket/x.mcap"),
        ("http://me:pa@ss@host/x.mcap", "http://me:***@host/x.mcap"),
        ("https://ghp_1234@host/x.mcap", "https://***@host/x.mcap"),
        ("sftp://me@host/x.mcap", "sftp://me@host/x.mcap"),
        ("abfs://box@account.example/x.mcap", "abfs://box@account.example/x.mcap"),
        (
            "https://h/x.mcap?run=7&X-Amz-Signature=ab&sig=c",
            "https://h/x.mcap?run=7&X-Amz-Signature=***&sig=***",
        ),
        ("zip://a.mcap::ftp://me:pass@host/a.zip", "zip://a.mcap::ftp://me:***@host/a.zip"),
    ],
)
def test_a_url_is_shown_without_its_secrets(address: str, shown: str) -> None:
    url = located(address)
    assert isinstance(url, Url)
    assert str(url) == shown
    assert repr(url) == f"Url({shown!r})"


@pytest.mark.parametrize("path", ["a.mcap", "/a/b.mcap", r"C:\a.mcap", "C://a.mcap", "a:b.mcap", "a/b://c"])
def test_what_has_no_scheme_is_a_path(path: str) -> None:
    assert located(path) == Path(path)


# --- reading ---


def test_a_recording_in_memory_is_read_like_a_file(memory: Any) -> None:
    memory.pipe("/box/x.mcap", SAMPLE.read_bytes())
    trace = read_trace("memory://box/x.mcap")
    assert trace.path == "memory://box/x.mcap"
    assert list(trace) == list(trace) == list(read_trace(SAMPLE))
    assert list(read_events("memory://box/x.mcap")) == list(read_events(SAMPLE))


@pytest.mark.parametrize("sized", [True, False])
@pytest.mark.parametrize("ranges", [True, False])
def test_a_web_server_may_give_parts_or_the_whole(large: bytes, ranges: bool, sized: bool) -> None:
    with serving(Web({"x.mcap": large}, ranges=ranges, sized=sized)) as web:
        found = [message.data[:2] for message in read_trace(web.url("x.mcap"))]
    assert found == [number.to_bytes(2, "big") for number in range(600)]


def test_no_octet_is_fetched_twice_and_requests_grow(large: bytes) -> None:
    with serving(Web({"x.mcap": large})) as web:
        trace = read_trace(web.url("x.mcap"))
        for _ in range(3):
            assert len(list(trace)) == 600
        assert web.fetched() == len(large) > 16 * BLOCK
        assert len(web.asked) < 10


@pytest.mark.parametrize("ranges", [True, False])
def test_what_has_come_is_told(large: bytes, ranges: bool) -> None:
    heard: list[int] = []
    with serving(Web({"x.mcap": large}, ranges=ranges)) as web:
        trace = read_trace(web.url("x.mcap"), fetched=lambda octets, _: heard.append(octets))
        assert len(list(trace)) == 600
    assert heard[-1] == len(large)


def test_without_parts_the_whole_is_fetched_once(large: bytes) -> None:
    with serving(Web({"x.mcap": large}, ranges=False)) as web:
        trace = read_trace(web.url("x.mcap"))
        for _ in range(3):
            assert len(list(trace)) == 600
        assert [part for way, _, part in web.asked if way == "GET"].count(None) == 1
        assert len(web.asked) < 7


def test_what_is_passed_over_is_not_fetched() -> None:
    body = b"\x89MCAP0\r\n" + b"\x09" + (40 << 20).to_bytes(8, "little")
    with serving(Web({"x.mcap": body + bytes((40 << 20) + 8)})) as web:
        assert read_trace(web.url("x.mcap")).truncated
        assert web.fetched() <= 3 * BLOCK


def test_a_connection_that_breaks_is_tried_again(large: bytes) -> None:
    with serving(Web({"x.mcap": large}, break_at=5 << 20, breaks=2)) as web:
        assert len(list(read_trace(web.url("x.mcap")))) == 600


def test_a_store_can_be_sent_to_another_process(large: bytes) -> None:
    with serving(Web({"x.mcap": large})) as web:
        trace = read_trace(web.url("x.mcap"))
        again = pickle.loads(pickle.dumps(trace))
        assert sum(1 for _ in again) == 600


def test_a_file_that_failed_once_stays_so(large: bytes) -> None:
    with serving(Web({"x.mcap": large}, break_at=5 << 20, breaks=3)) as web:
        store = Store(Url(web.url("x.mcap")))
        with store.open() as file:
            for _ in range(2):
                file.seek(6 << 20)
                with pytest.raises(InputError):
                    file.read(1)
        with pytest.raises(InputError):
            store.open()


# --- the audit ---


def test_the_findings_are_those_of_the_local_file(memory: Any) -> None:
    memory.pipe("/box/x.mcap", SAMPLE.read_bytes())
    there = audit_traces(["memory://box/x.mcap"], profile=None, model=None)
    here = audit_traces([SAMPLE], profile=None, model=None)
    assert there.findings == [replace(each, path="memory://box/x.mcap") for each in here.findings]
    assert here.findings


def test_several_processes_read_from_the_web(capsys: pytest.CaptureFixture[str]) -> None:
    names = [path.name for path in sorted(traces_dir().glob("*.mcap"))[:3]]
    with serving(Web({name: (traces_dir() / name).read_bytes() for name in names})) as web:
        urls = [web.url(name).replace("//", "//me:geheim@") for name in [*names, "none.mcap"]]
        main(["audit", *urls, "--jobs", "2", "--format", "json"])
        told = capsys.readouterr().out
        assert web.url("none.mcap").replace("//", "//me:***@") in told
        assert "geheim" not in told


def test_a_remote_recording_is_annotated(memory: Any, tmp_path: Path) -> None:
    memory.pipe("/box/x.mcap", SAMPLE.read_bytes())
    out = tmp_path / "out.mcap"
    assert main(["audit", "-q", "memory://box/x.mcap", "--annotate", str(out)]) == 1
    assert any(message.topic == "/mmsverify/findings" for message in read_trace(out))


def test_sarif_names_the_url(memory: Any, capsys: pytest.CaptureFixture[str]) -> None:
    memory.pipe("/box/x y.mcap", SAMPLE.read_bytes())
    main(["audit", "-q", "memory://box/x y.mcap", "--format", "sarif"])
    assert '"uri": "memory://box/x%20y.mcap"' in capsys.readouterr().out


# --- errors ---


def test_a_file_whose_name_is_a_pattern_is_that_file(memory: Any) -> None:
    memory.pipe("/box/x[7].mcap", SAMPLE.read_bytes())
    assert trace_locations(["memory://box/x[7].mcap"]) == [Url("memory://box/x[7].mcap")]


def test_a_recording_may_have_any_name(memory: Any) -> None:
    memory.pipe("/box/recording", SAMPLE.read_bytes())
    [found] = trace_locations(["memory://box/recording"])
    assert sum(1 for _ in read_trace(found)) == 58


@pytest.mark.parametrize("ranges", [True, False])
def test_a_stream_that_breaks_off_is_one_line(
    capsys: pytest.CaptureFixture[str], large: bytes, ranges: bool
) -> None:
    with serving(Web({"x.mcap": large}, ranges=ranges, break_at=5 << 20)) as web:
        assert main(["audit", "-q", web.url("x.mcap")]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert "x.mcap: " in err


def test_an_answer_that_is_too_short_is_told(memory: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    memory.pipe("/x.mcap", SAMPLE.read_bytes())
    monkeypatch.setattr(remote, "_measured", lambda source: source.size + 10)
    with pytest.raises(InputError, match=r"breaks off at octet \d+ of \d+"):
        read_trace("memory://x.mcap")


def test_what_breaks_while_it_is_judged_is_a_finding(memory: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    memory.pipe("/x.mcap", SAMPLE.read_bytes())
    trace = read_trace("memory://x.mcap")
    monkeypatch.setattr(mcap, "survey", lambda _: trace._survey)
    monkeypatch.setattr(Store, "_fetch", lambda *_: (_ for _ in ()).throw(OSError("the line is cut")))
    result = audit_traces(["memory://x.mcap"], profile=None, model=None)
    assert [each.rule for each in result.findings] == ["input.unreadable"]
    assert result.findings[0].message == "memory://x.mcap: octet 171: the line is cut"
    assert result.inputs[0].messages == 0


def test_a_full_disk_is_told(memory: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_kept: IO[bytes], _position: int, data: bytes) -> None:
        with open("/dev/full", "wb", buffering=0) as file:
            keep(file, 0, data)

    if not Path("/dev/full").exists():
        pytest.skip("needs a device that is full")
    keep = remote._write
    monkeypatch.setattr(remote, "_write", full)
    memory.pipe("/x.mcap", SAMPLE.read_bytes())
    with pytest.raises(InputError, match="no room for what is fetched: No space left on device"):
        read_trace("memory://x.mcap")


def test_local_paths_do_not_import_fsspec() -> None:
    code = (
        "import sys; from mmsverify.cli import main; "
        f"main(['audit', '-q', {str(CLEAN)!r}]); "
        "print(sorted({'fsspec', 'aiohttp'} & sys.modules.keys()))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"


# --- folders and patterns ---


def test_folders_and_patterns_of_urls_are_listed(memory: Any) -> None:
    for name in ("b.mcap", "a.MCAP", "deep/c.mcap", "readme.txt"):
        memory.pipe(f"/box/{name}", b"1234")
    wanted = ["memory://box/a.MCAP", "memory://box/b.mcap", "memory://box/deep/c.mcap"]
    for folder in ("memory://box", "memory://box/"):
        assert [str(each) for each in trace_locations([folder, "memory://box/b.mcap"])] == wanted
    assert [str(each) for each in trace_locations(["memory://box/?.mcap"])] == wanted[1:2]
    assert [str(each) for each in trace_locations(["memory://b*"])] == wanted
    assert [each.size for each in trace_locations(["memory://box"]) if isinstance(each, Url)] == [4, 4, 4]


def test_pages_of_a_web_server_are_folders() -> None:
    with serving(
        Web({"logs/b.mcap": b"", "logs/2026/a.mcap": b"", "logs/readme": b"", "c.mcap": b""})
    ) as web:
        wanted = [web.url("logs/2026/a.mcap"), web.url("logs/b.mcap")]
        assert [str(each) for each in trace_locations([web.url("logs/")])] == wanted
        assert [str(each) for each in trace_locations([web.url("logs/*.mcap")])] == wanted[1:]
        web.asked.clear()
        single = [web.url("c.mcap"), web.url("download?id=7")]
        assert [str(each) for each in trace_locations(single)] == single
        assert web.asked == []


def test_local_and_remote_places_keep_their_order(memory: Any, tmp_path: Path) -> None:
    memory.pipe("/box/a.mcap", b"")
    (tmp_path / "z.mcap").touch()
    assert trace_locations(["memory://box", str(tmp_path)]) == [
        Url("memory://box/a.mcap"), tmp_path / "z.mcap",
    ]  # fmt: skip
