"""The command line: what it passes on, where it prints, how it ends. Its engines are replaced here."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from report_samples import AUDIT, BROKEN, CHECK, CLEAN, OPEN, REACHED, READ, SELECT, START, UNREADABLE

from mmsverify import __version__
from mmsverify.cli import main
from mmsverify.errors import InputError, ModelError
from mmsverify.results import Audit, ModelCheck

Engine = Callable[..., None]


@pytest.fixture
def engine(monkeypatch: pytest.MonkeyPatch) -> Engine:
    """Replace a module of the composition root by one that holds only the given functions."""

    def replaced(name: str, **functions: Callable[..., Any]) -> None:
        module = ModuleType(f"mmsverify.{name}")
        vars(module).update(functions)
        monkeypatch.setitem(sys.modules, module.__name__, module)

    return replaced


def auditing(engine: Engine, audit: Audit) -> list[dict[str, Any]]:
    """An auditor that always finds ``audit``; returns the list of its calls."""
    calls: list[dict[str, Any]] = []

    def audit_traces(paths: list[Path], **options: Any) -> Audit:
        calls.append({"paths": paths, **options})
        return audit

    engine("auditing", audit_traces=audit_traces)
    return calls


def checking(engine: Engine, *verdicts: Any) -> list[dict[str, Any]]:
    """A checker that always gives ``verdicts``; returns the list of its calls."""
    calls: list[dict[str, Any]] = []

    def check_models(models: list[str], **options: Any) -> list[ModelCheck]:
        calls.append({"models": models, **options})
        return [replace(CHECK, verdicts=list(verdicts))]

    def write_counterexamples(_checks: list[ModelCheck], directory: Path) -> list[Path]:
        return [directory / "selected-is-controlling.mcap"]

    engine("checking", check_models=check_models, write_counterexamples=write_counterexamples)
    return calls


def refusing(error: Exception) -> Callable[..., Any]:
    def refuse(*_: Any, **__: Any) -> Any:
        raise error

    return refuse


def refused(capsys: pytest.CaptureFixture[str]) -> str:
    """The one line on stderr, and nothing on stdout."""
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("mmsverify: ")
    assert err.count("\n") == 1
    return err.removeprefix("mmsverify: ").rstrip("\n")


# --- what is asked for wrongly ---


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ([], "missing command (see mmsverify --help)"),
        (["frobnicate"], "no such command 'frobnicate'"),
        (["audit"], "missing argument 'TRACE"),
        (["audit", "--frobnicate", "x"], "no such option: --frobnicate"),
        (["audit", "x", "--format", "xml"], "--format: no format 'xml' here (one of text, json, sarif,"),
        (["check", "--format", "html"], "--format: no format 'html' here (one of text, json)"),
        (["check", "--depth", "-1"], "invalid value for '--depth'"),
        (["check", "--depth", "many"], "invalid value for '--depth'"),
        (["check", "--timeout", "0"], "--timeout: 0 is not a time limit (give seconds, more than 0)"),
        (["check", "--timeout", "nan"], "--timeout: nan is not a time limit"),
        (["check", "--scope", "PI"], "--scope: cannot read 'PI' (write it like PI=4,Client=2, each once)"),
        (["check", "--scope", "PI=2,PI=3"], "--scope: cannot read 'PI=3'"),
        (["check", "--scope", "PI=²"], "--scope: cannot read 'PI=²'"),
        (["check", "--scope", ""], "--scope: cannot read ''"),
        (["check", "--scope", "PI=2", "--unbounded"], "--scope: a bound, and --unbounded beside it"),
        (["check", "-o", "/nowhere/at/all"], "/nowhere/at/all: its folder does not exist (make /nowhere/at"),
        (["check", "-o", "/"], "/: is a folder (name a file to write to)"),
        (["diagram"], "missing argument 'MODEL'"),
        (["diagram", "mms-robot", "--format", "png"], "--format: no format 'png' here (one of mermaid, dot"),
    ],
)  # fmt: skip
def test_a_bad_request_is_one_line_and_status_2(
    arguments: list[str], line: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(arguments) == 2
    assert refused(capsys).startswith(line)


def test_an_error_of_an_engine_is_one_line_and_status_2(
    engine: Engine, capsys: pytest.CaptureFixture[str]
) -> None:
    engine(
        "checking",
        check_models=refusing(ModelError("no\x1b such\nvariable", place="m.py:3", cure="declare it")),
    )
    assert main(["check", "m.py"]) == 2
    assert refused(capsys) == "m.py:3: no\\x1b such variable (declare it)"


def test_an_error_of_the_operating_system_is_one_line_and_status_2(
    engine: Engine, capsys: pytest.CaptureFixture[str]
) -> None:
    engine("diagrams", draw=refusing(PermissionError(13, "Permission denied", "m.py")))
    assert main(["diagram", "m.py"]) == 2
    assert refused(capsys) == "m.py: Permission denied"


def test_a_bug_is_not_hidden(engine: Engine) -> None:
    engine("diagrams", draw=refusing(ZeroDivisionError("a bug")))
    with pytest.raises(ZeroDivisionError):
        main(["diagram", "mms-robot"])


def test_an_interrupt_ends_quietly_with_130(engine: Engine, capsys: pytest.CaptureFixture[str]) -> None:
    def interrupted(*_: Any, **__: Any) -> Any:
        raise KeyboardInterrupt

    engine("checking", check_models=interrupted)
    assert main(["check"]) == 130
    assert capsys.readouterr().out == ""


# --- check ---


@pytest.mark.parametrize(
    ("verdicts", "expected"),
    [((), 0), ((REACHED,), 0), ((REACHED, OPEN), 3), ((OPEN, BROKEN), 1), ((BROKEN, REACHED, OPEN), 1)],
)
def test_check_ends_with_1_before_3_before_0(
    engine: Engine, verdicts: tuple[Any, ...], expected: int
) -> None:
    checking(engine, *verdicts)
    assert main(["check"]) == expected


def test_check_passes_its_options_on(engine: Engine) -> None:
    calls = checking(engine, REACHED)
    main([
        "check", "mms-robot", "m.py", "--variant", "as-written", "--property", "a", "--property", "b",
        "--scope", "PI=4, Client=2", "--depth", "7", "--timeout", "1.5", "--profile", "p.toml",
    ])  # fmt: skip
    assert calls == [
        {
            "models": ["mms-robot", "m.py"],
            "variant": "as-written",
            "properties": ["a", "b"],
            "scope": {"PI": 4, "Client": 2},
            "unbounded": False,
            "depth": 7,
            "timeout": 1.5,
            "profile": Path("p.toml"),
            "progress": None,
        }
    ]


def test_check_without_options_asks_for_all_models(engine: Engine) -> None:
    calls = checking(engine, REACHED)
    main(["check"])
    assert (calls[0]["models"], calls[0]["variant"], calls[0]["scope"]) == ([], None, None)


def test_check_prints_its_result_on_stdout_and_nothing_else(
    engine: Engine, capsys: pytest.CaptureFixture[str]
) -> None:
    checking(engine, BROKEN)
    main(["check", "--format", "json"])
    out, err = capsys.readouterr()
    assert json.loads(out)["schema"] == "mmsverify.check/1"
    assert err == ""


def test_check_says_where_it_wrote_counterexamples_unless_it_is_to_be_quiet(
    engine: Engine, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    checking(engine, BROKEN)
    main(["check", "--counterexamples", str(tmp_path)])
    assert capsys.readouterr().err == f"wrote {tmp_path / 'selected-is-controlling.mcap'}\n"
    main(["check", "--counterexamples", str(tmp_path), "-q"])
    assert capsys.readouterr().err == ""


# --- audit ---


@pytest.mark.parametrize(
    ("findings", "expected"),
    [([], 0), ([START], 0), ([replace(START, severity="note")], 0), ([START, SELECT], 1)],
)
def test_audit_ends_with_1_only_for_an_error(engine: Engine, findings: list[Any], expected: int) -> None:
    auditing(engine, Audit([READ], findings))
    assert main(["audit", "a.mcap"]) == expected


def test_audit_passes_its_options_on(engine: Engine) -> None:
    calls = auditing(engine, CLEAN)
    options = ["--profile", "p.toml", "--model", "vr-template", "--variant", "as-written"]
    main(["audit", "a.mcap", *options, "--jobs", "3", "--exact", "--no-kernel"])
    main(["audit", "a.mcap"])
    given: dict[str, object] = {"profile": Path("p.toml"), "model": "vr-template", "variant": "as-written"}
    given |= {"progress": None, "jobs": 3, "exact": True, "kernel": False, "scheduler": None, "resume": None}
    default: dict[str, object] = {"profile": None, "model": None, "variant": "repaired"}
    default |= {"progress": None, "jobs": None, "exact": False, "kernel": None}
    default |= {"scheduler": None, "resume": None}
    assert calls == [{"paths": [Path("a.mcap")], **given}, {"paths": [Path("a.mcap")], **default}]


def test_one_unreadable_trace_among_several_is_a_finding(
    engine: Engine, capsys: pytest.CaptureFixture[str]
) -> None:
    auditing(engine, AUDIT)
    assert main(["audit", "a.mcap", "b.mcap", "--format", "json"]) == 1
    out, err = capsys.readouterr()
    assert [v["rule"] for v in json.loads(out)["violations"]][-1] == "input.unreadable"
    assert err == ""


def test_no_readable_trace_at_all_is_one_line_and_status_2(
    engine: Engine, capsys: pytest.CaptureFixture[str]
) -> None:
    auditing(engine, Audit([], [UNREADABLE, replace(UNREADABLE, path="c.mcap")]))
    assert main(["audit", "b.mcap", "c.mcap", "--format", "json"]) == 2
    assert refused(capsys) == "b.mcap: not an MCAP file (and 1 more that cannot be read)"


def test_an_unreadable_trace_that_is_listed_as_an_input_still_counts_as_unread(
    engine: Engine, capsys: pytest.CaptureFixture[str]
) -> None:
    auditing(engine, Audit([replace(READ, path="b.mcap", messages=0)], [UNREADABLE]))
    assert main(["audit", "b.mcap"]) == 2
    assert refused(capsys) == "b.mcap: not an MCAP file"


def test_folders_and_patterns_become_their_traces_in_order(
    engine: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("day/b.mcap", "day/sub/a.MCAP", "day/notes.txt", "x[1].mcap", "y.mcap"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    monkeypatch.chdir(tmp_path)
    calls = auditing(engine, CLEAN)
    main(["audit", "y.mcap", "day", "x[1].mcap", "*.mcap", "**/b.mcap", "missing*.mcap", "gone.mcap"])
    assert [path.as_posix() for path in calls[0]["paths"]] == [
        "y.mcap", "day/b.mcap", "day/sub/a.MCAP", "x[1].mcap", "missing*.mcap", "gone.mcap",
    ]  # fmt: skip


def test_a_folder_without_traces_is_handed_on_to_be_refused(engine: Engine, tmp_path: Path) -> None:
    calls = auditing(engine, CLEAN)
    main(["audit", str(tmp_path)])
    assert calls[0]["paths"] == [tmp_path]


def test_annotate_copies_the_one_trace_with_its_findings(engine: Engine, tmp_path: Path) -> None:
    written: list[Any] = []

    def annotate(path: Path, audit: Audit, out: Path, **manner: Any) -> int:
        written.append((path, audit.findings, manner))
        out.write_text("copied", encoding="utf-8")
        return 0

    auditing(engine, Audit([READ], [START]))
    engine("annotating", annotate=annotate)
    options = ["--annotate", str(tmp_path / "out.mcap"), "--variant", "as-written", "-q"]
    assert main(["audit", "a.mcap", *options]) == 0
    assert written == [(Path("a.mcap"), [START], {"profile": None, "model": None, "variant": "as-written"})]
    assert [path.name for path in tmp_path.iterdir()] == ["out.mcap"]


def test_an_annotation_that_fails_leaves_nothing_behind(
    engine: Engine, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    auditing(engine, CLEAN)
    engine("annotating", annotate=refusing(InputError("is damaged", place="a.mcap")))
    assert main(["audit", "a.mcap", "--annotate", str(tmp_path / "out.mcap")]) == 2
    assert list(tmp_path.iterdir()) == []
    assert "is damaged" in capsys.readouterr().err


def test_annotate_takes_one_trace(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["audit", "a.mcap", "b.mcap", "--annotate", "out.mcap"]) == 2
    assert refused(capsys) == "--annotate: takes one trace, 2 given (annotate them one by one)"


@pytest.mark.parametrize("option", ["-o", "--annotate"])
def test_no_output_overwrites_an_input(
    option: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    trace = tmp_path / "a.mcap"
    trace.write_bytes(b"recorded")
    assert main(["audit", str(trace), option, f"{tmp_path}/../{tmp_path.name}/a.mcap"]) == 2
    assert "would be overwritten (name another file)" in refused(capsys)
    assert trace.read_bytes() == b"recorded"


# --- output ---


def test_a_result_goes_to_the_named_file_and_stdout_stays_empty(
    engine: Engine, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    auditing(engine, AUDIT)
    out = tmp_path / "result.json"
    assert main(["audit", "a.mcap", "--format", "json", "-o", str(out)]) == 1
    assert json.loads(out.read_text(encoding="utf-8"))["summary"]["errors"] == 2
    assert capsys.readouterr().out == ""


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a device that is always full")
def test_a_file_that_cannot_be_written_is_one_line_and_status_2(
    engine: Engine, capsys: pytest.CaptureFixture[str]
) -> None:
    auditing(engine, CLEAN)
    assert main(["audit", "a.mcap", "-o", "/dev/full"]) == 2
    assert refused(capsys) == "/dev/full: cannot be written: No space left on device"


def test_a_name_that_is_not_text_is_printed_escaped(engine: Engine, tmp_path: Path) -> None:
    auditing(engine, Audit([replace(READ, path="\udc80.mcap")], []))
    for format in ("text", "json", "sarif", "junit", "html"):
        assert main(["audit", "a.mcap", "--format", format, "-o", str(tmp_path / format)]) == 0
        assert (tmp_path / format).read_bytes().decode("utf-8")


def test_a_drawing_is_printed_with_a_final_line_feed(
    engine: Engine, capsys: pytest.CaptureFixture[str]
) -> None:
    engine("diagrams", draw=lambda model, *, variant, format: f"{model} {variant} {format}")
    assert main(["diagram", "mms-robot", "--format", "dot"]) == 0
    assert capsys.readouterr().out == "mms-robot None dot\n"


def test_the_version_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"mmsverify {__version__}\n"


@pytest.mark.parametrize(
    "arguments", [["--help"], ["check", "--help"], ["audit", "-h"], ["diagram", "--help"]]
)
def test_every_command_explains_itself(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(arguments) == 0
    assert capsys.readouterr().out.startswith("Usage: mmsverify")


def test_the_error_of_a_missing_engine_input_names_place_cause_and_cure(
    engine: Engine, capsys: pytest.CaptureFixture[str]
) -> None:
    engine(
        "auditing",
        audit_traces=refusing(InputError("no such profile", place="p.toml", cure="check its name")),
    )
    assert main(["audit", "a.mcap", "--profile", "p.toml"]) == 2
    assert refused(capsys) == "p.toml: no such profile (check its name)"
