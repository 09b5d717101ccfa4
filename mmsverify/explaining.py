"""The composition root of explanations: why a finding stands, how a sample follows from the one before.

A recording and a finding in, an account out; a recording and a sample in, the shortest legal way out.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

from mmsverify.audit.causes.gathering import Stretch, gather
from mmsverify.audit.causes.retelling import Setting
from mmsverify.audit.causes.robots import Robots
from mmsverify.audit.causes.samples import Samples
from mmsverify.audit.causes.signals import Signals
from mmsverify.audit.learning.lasting import of_thread
from mmsverify.audit.lookahead import Lookahead
from mmsverify.audit.parts import FRAMEWORK, SIGNALS, Parts
from mmsverify.audit.replay import Replay
from mmsverify.audit.telling import Place
from mmsverify.audit.vr import SCAN, Controller, Stage
from mmsverify.audit.whose import SAMPLES
from mmsverify.errors import InputError, MmsverifyError, UsageError
from mmsverify.formats.locations import Location, located
from mmsverify.formats.mcap import McapTrace, read_trace
from mmsverify.formats.stretch import DisorderError
from mmsverify.formats.trace import TraceMessage
from mmsverify.profiles import for_recording, within_framework
from mmsverify.register.readings import read_readings
from mmsverify.register.statements import read_statements
from mmsverify.resources import models_dir
from mmsverify.results import Account, Explanation, Finding, PathStep, Statement

__all__ = ["explain_finding", "explain_findings", "explain_sample", "findings_at", "shows_cells"]

WINDOWS = (120, 1000)
"""So many messages of the robot before a finding are looked at; where they do not do, the second many."""
BEYOND = (
    f"it does not come of the {WINDOWS[-1]} messages before it alone: what excludes it was not looked for"
)
OF_THE_FILE = "it is about the whole file"


def explain_sample(
    path: Path, index: int, *, profile: Path | None = None, variant: str = "repaired"
) -> Explanation:
    """How the message ``index`` of a recording, a sample of VR cells, follows from the sample before it.

    ``index`` counts from 0 over all messages in event order, as findings do. Raises ``UsageError`` where no
    such message stands there, or none that shows VR cells.
    """
    trace = read_trace(path)
    tables = for_recording(profile, trace.profile, str(path))
    replay = Replay(trace, within_framework(tables), FRAMEWORK, variant)
    messages = iter(trace)
    last, findings = -1, []
    for message in messages:
        last = message.index
        if message.schema_name == SAMPLES:
            controller = replay.controller(message.channel)
            findings = list(controller.sample(message))
        if last == index:
            break
    else:
        raise _no_such(trace.path, index, last)
    if message.schema_name != SAMPLES:
        raise UsageError(
            f"message {index} shows no VR cells", place="INDEX", cure="give the index of a sample"
        )
    way, first = controller.way(), controller.at_first
    findings += _told_later(replay, controller, messages)
    found = tuple(finding for finding in findings if finding.index == index)
    wrong = any(finding.severity == "error" for finding in found)
    steps = None if wrong or way is None else tuple(map(_step, way))
    scan, name = message.metadata.get("sampling") == SCAN, message.metadata.get("controller", "")
    return Explanation(trace.path, index, name, scan, steps, found, first)


def _told_later(
    replay: Replay, controller: Controller, messages: Iterator[TraceMessage]
) -> Iterator[Finding]:
    """What the controller's next sample shows to be wrong."""
    for message in messages:
        if message.schema_name == SAMPLES and replay.controller(message.channel) is controller:
            yield from controller.sample(message)
            return


def _no_such(path: str, index: int, last: int) -> MmsverifyError:
    if last < 0:
        return InputError("holds no messages", place=path)
    return UsageError(f"there is no message {index}", place="INDEX", cure=f"give one of 0 to {last}")


def _step(stage: Stage) -> PathStep:
    name = stage.row.on.service if stage.row.answer else stage.row.name
    cited = stage.clause.ids + stage.clause.readings
    return PathStep(name, {}, cited, {"mode": stage.mode, "status": stage.status})


def _looked_ahead(trace: McapTrace) -> Lookahead:
    """What the recording shows later, whatever the order of the file."""
    try:
        return Lookahead(trace)
    except DisorderError:
        return Lookahead(trace, merged=True)


def explain_finding(
    path: str | Path | Location, finding: Finding, *, profile: Path | None = None, variant: str = "repaired"
) -> Account:
    """Why one finding of an audit of this recording stands, and what would have been legal."""
    return explain_findings(path, [finding], profile=profile, variant=variant)[0]


def explain_findings(
    path: str | Path | Location,
    findings: Sequence[Finding],
    *,
    profile: Path | None = None,
    variant: str = "repaired",
) -> list[Account]:
    """The same of several, in one pass over the recording; the accounts come in the order of the findings.

    Each takes about a second. Of a finding about the whole file, or one that is not found again, the account
    has no grounds, and its ``remarks`` say why. ``profile`` and ``variant`` must be those of the audit.
    Raises ``InputError`` where the recording cannot be read, ``ProfileError`` for a bad profile.
    """
    trace = read_trace(located(path))
    explaining = _Explaining(trace, profile, variant)
    told: dict[int, Account] = {}
    left = [(number, each) for number, each in enumerate(findings) if each.index is not None]
    for before in WINDOWS:
        if left:
            told |= explaining.accounts(left, before)
            left = [(number, each) for number, each in left if number not in told]
    accounts = [told.get(n) or explaining.without(each) for n, each in enumerate(findings)]
    return [replace(each, readings=readings_of(each.finding)) for each in accounts]


def findings_at(
    path: Path, index: int, *, profile: Path | None = None, variant: str = "repaired"
) -> list[Finding]:
    """The findings of one message of a recording; see `explain_sample` for ``index`` and errors."""
    trace = read_trace(path)
    tables = within_framework(for_recording(profile, trace.profile, str(path)))
    replay = Replay(trace, tables, None, variant)
    found = [finding for finding in replay.run() if finding.index == index]
    if not 0 <= index < replay.messages:
        raise _no_such(trace.path, index, replay.messages - 1)
    return found


class _Explaining:
    """What all accounts of one recording share."""

    def __init__(self, trace: McapTrace, profile: Path | None, variant: str) -> None:
        self._trace = trace
        tables = within_framework(for_recording(profile, trace.profile, trace.path))
        self._parts = Parts(tables, variant, of_thread(), trace.path)
        self._ahead = _looked_ahead(trace)

    def accounts(self, findings: Sequence[tuple[int, Finding]], before: int) -> dict[int, Account]:
        """The accounts of those findings that come of so many messages before them."""
        told: dict[int, Account] = {}
        for stretch in gather(self._messages(), [each for _, each in findings], before):
            teller = self._teller(stretch)
            for number, finding in findings:
                if any(finding is each for each in stretch.findings) and number not in told:
                    account = teller.account(finding, statements_of(finding))
                    if account is not None:
                        told[number] = account
        return told

    def _messages(self) -> Iterator[TraceMessage]:
        """The messages up to where the recording is damaged: the audit has told of that already."""
        try:
            yield from self._trace
        except InputError:
            return

    def _teller(self, stretch: Stretch) -> Robots | Signals | Samples:
        place = Place(self._trace.path, stretch.device)
        if stretch.model == SIGNALS:
            return Signals(self._parts, place, stretch.messages)
        if stretch.model == FRAMEWORK:
            return Samples(self._parts, place, stretch.messages)
        base_only = frozenset(name for device, name in self._ahead.base_only if device == stretch.device)
        blind = tuple(self._ahead.blind(stretch.device))
        arms = list(self._parts.profile.get("arms", ()))
        setting = Setting(place, base_only, blind)
        return Robots(self._parts, setting, stretch.messages, arms, whole=stretch.whole)

    def without(self, finding: Finding) -> Account:
        """The account of a finding that did not come again."""
        why = OF_THE_FILE if finding.index is None else BEYOND
        return Account(finding, "", None, statements_of(finding), remarks=(why,))


def shows_cells(path: Path, index: int) -> bool:
    """Whether a message of a recording is a sample of VR cells, as `explain_sample` explains."""
    return any(m.index == index and m.schema_name == SAMPLES for m in read_trace(path))


def statements_of(finding: Finding) -> tuple[Statement, ...]:
    """The statements of a finding's clauses, in our words, in its order; those that the registers have."""
    known = _statements()
    return tuple(known[clause] for clause in finding.clauses if clause in known)


def readings_of(finding: Finding) -> dict[str, str]:
    """What the readings that a finding cites say."""
    known = read_readings()
    return {cited: known[cited] for cited in finding.readings if cited in known}


@cache
def _statements() -> dict[str, Statement]:
    """The statements of all models of ours."""
    found: dict[str, Statement] = {}
    for model in sorted(models_dir().iterdir()):
        if model.suffix == ".py" or model.joinpath("__init__.py").is_file():
            found |= read_statements(model if model.suffix else model / "__init__.py")
    return found
