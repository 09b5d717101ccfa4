"""Many recordings on a Dask cluster: the same results, and one line where there is no cluster."""

from __future__ import annotations

import logging
import os
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from fleets import SAMPLES, always_killed, once_killed, refuses, timeless

from mmsverify.auditing import audit_each, audit_traces
from mmsverify.cli import main
from mmsverify.errors import UsageError
from mmsverify.fleet import cluster


@pytest.fixture(scope="module")
def client() -> Iterator[Any]:
    with cluster.connected("local", 2) as connected:
        yield connected


def test_a_killed_worker_takes_nothing_with_it(client: Any, tmp_path: Path) -> None:
    paths = [tmp_path / str(number) for number in range(12)]
    done = [*cluster.shared(once_killed, paths, client=client)]
    assert sorted(number for number, _ in done) == [*range(12)]
    assert {number: each.path for number, (each, _) in done if each} == dict(enumerate(map(str, paths)))


@pytest.mark.slow
def test_a_recording_that_kills_its_worker_is_told(client: Any, tmp_path: Path) -> None:
    paths = [tmp_path / str(number) for number in range(6)]
    done = dict(cluster.shared(always_killed, paths, client=client))
    assert [done[number][0] is None for number in range(6)] == [number == 3 for number in range(6)]
    [finding] = done[3][1]
    assert finding.rule == "input.unreadable"
    assert "was killed" in finding.message


def test_an_error_of_a_task_is_an_error(client: Any, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="0"):
        [*cluster.shared(refuses, [tmp_path / "0"], client=client)]


def test_a_cluster_finds_what_one_process_finds(
    client: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    broken = tmp_path / "broken.mcap"
    broken.write_bytes(b"no recording")
    monkeypatch.chdir(tmp_path)  # workers are in another folder, and paths are told as they were given
    paths = [Path(os.path.relpath(path, tmp_path)) for path in (*SAMPLES[:3], broken)]
    alone, shared = (audit_traces(paths, profile=None, model=None, client=each) for each in (None, client))
    assert shared.findings == alone.findings
    assert [each.path for each in shared.inputs] == [each.path for each in alone.inputs]


def test_results_come_one_by_one(client: Any) -> None:
    audits = [*audit_each(SAMPLES[:3], profile=None, model=None, client=client)]
    assert sorted(audit.inputs[0].path for audit in audits) == [str(path) for path in SAMPLES[:3]]


def test_workers_of_another_version_are_told(
    client: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cluster, "__version__", "9.9")
    with pytest.raises(UsageError, match=r"a worker has mmsverify .* \(install mmsverify 9\.9 where"):
        [*cluster.shared(refuses, [tmp_path / "0"], client=client)]


def test_workers_without_mmsverify_are_told() -> None:
    lacking = SimpleNamespace(
        asynchronous=False,
        scheduler=SimpleNamespace(address="tcp://a:1"),
        run=lambda *_, **__: {"tcp://b:2": ModuleNotFoundError("No module named 'mmsverify'")},
    )
    with pytest.raises(UsageError, match=r"^tcp://a:1: the cluster cannot import .* \(install mmsverify"):
        [*cluster.shared(refuses, [Path("a")], client=lacking)]


def test_an_asynchronous_client_is_refused() -> None:
    with pytest.raises(UsageError, match="client: is asynchronous"):
        [*cluster.shared(refuses, [Path("a")], client=SimpleNamespace(asynchronous=True))]


def test_the_command_line_takes_a_cluster_by_its_address(
    client: Any, capfd: pytest.CaptureFixture[str]
) -> None:
    command = ["audit", *map(str, SAMPLES[:2]), "--format", "json"]
    assert main(command) == 1
    alone, _ = capfd.readouterr()
    assert main([*command, "--engine", "dask", "--scheduler", client.scheduler.address]) == 1
    out, err = capfd.readouterr()
    assert err == ""
    assert timeless(out) == timeless(alone)


@pytest.mark.parametrize("quiet", [False, True])
def test_that_there_are_no_workers_is_told_once(
    quiet: bool, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    import distributed

    monkeypatch.setattr(cluster, "LONG", 0.2)
    monkeypatch.setattr(logging.getLogger("mmsverify"), "propagate", False)  # as outside of pytest
    with distributed.LocalCluster(n_workers=0, processes=False, dashboard_address="127.0.0.1:0") as empty:
        address = empty.scheduler_address
        late = threading.Timer(2, empty.scale, [1])
        late.start()
        quietly = ["-q"] if quiet else []
        command = ["audit", str(SAMPLES[0]), "--engine", "dask", "--scheduler", address, *quietly]
        assert main(command) in (0, 1)
    assert capsys.readouterr().err == ("" if quiet else f"waiting for workers of {address}\n")


@pytest.mark.parametrize(
    ("address", "told"),
    [
        ("tcp://127.0.0.1:9", "tcp://127.0.0.1:9: no scheduler answers there within 0.2 s (start one"),
        ("nonsense", "--scheduler: 'nonsense' is no address of a scheduler: missing port number"),
        ("tcp://h:port", "--scheduler: 'tcp://h:port' is no address of a scheduler: invalid literal"),
        ("http://h:1", "--scheduler: 'http://h:1' is no address of a scheduler: unknown address scheme"),
        ("tls://h:1", "--scheduler: 'tls://h:1' is no address of a scheduler: TLS expects"),
    ],
)
def test_a_scheduler_that_is_none_is_one_line(
    address: str, told: str, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(cluster, "PATIENCE", 0.2)
    assert main(["audit", str(SAMPLES[0]), "--engine", "dask", "--scheduler", address]) == 2
    out, err = capfd.readouterr()
    assert out == ""
    assert err.startswith(f"mmsverify: {told}")
    assert err.count("\n") == 1


def test_a_worker_is_no_scheduler(client: Any) -> None:
    [address, *_] = client.nthreads()
    with pytest.raises(UsageError, match="is a Worker"), cluster.connected(address, 1):
        pass


def test_without_distributed_one_line_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert main(["audit", str(SAMPLES[0]), "--engine", "dask"]) == 2
    assert capsys.readouterr().err == "mmsverify: Dask needs distributed (pip install 'mmsverify[dask]')\n"


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--engine", "spark"], "--engine: no engine 'spark' (one of processes, dask)"),
        (["--scheduler", "local"], "--scheduler: is for dask (add --engine dask)"),
        (
            ["--engine", "dask", "--scheduler", "tcp://h:1", "--jobs", "2"],
            "--jobs: a cluster has the workers that it has (leave it out, or use --scheduler local)",
        ),
    ],
)
def test_options_that_do_not_go_together_are_refused(
    options: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["audit", str(SAMPLES[0]), *options]) == 2
    assert capsys.readouterr().err == f"mmsverify: {told}\n"
