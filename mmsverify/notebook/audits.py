"""An audit in a notebook: findings and messages as data frames, and what led to a finding."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import datetime
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from mmsverify.errors import UsageError
from mmsverify.incident import DeviceLine, Saying
from mmsverify.incidents import BEFORE, reconstruct, timeline
from mmsverify.notebook.explaining import Explained, explained
from mmsverify.notebook.messages import messages, narrowed
from mmsverify.report.audit_text import summary
from mmsverify.report.frame import findings_by_time, inputs_frame, messages_by_time
from mmsverify.report.markup import Markup, code, element, joined, table, word
from mmsverify.report.order import by_input, ordered
from mmsverify.report.wording import counted, instant
from mmsverify.results import Audit, Finding

if TYPE_CHECKING:
    from mmsverify.report.picture import Picture

MOST_SHOWN = 25
"""Findings that an audit shows of itself."""
Instant = str | int | datetime | pd.Timestamp
"""An instant: ISO 8601 (UTC where it says nothing else), ns since 1970, or a timestamp."""
Which = Finding | pd.Series | int
"""A finding: itself, a row of ``findings``, or the number of that row."""


@dataclass(frozen=True, slots=True)
class _Manner:
    """How the recordings were audited."""

    profile: Path | None
    model: str | None
    variant: str


class NotebookAudit:
    """What an audit found, and the recordings that it was found in. Made by ``mmsverify.audit``.

    ``result`` is the plain result. Data frames are built when they are first asked for.
    """

    def __init__(
        self,
        result: Audit,
        *,
        profile: str | Path | None = None,
        model: str | None = None,
        variant: str = "repaired",
    ) -> None:
        self.result = result
        self._manner = _Manner(None if profile is None else Path(profile), model, variant)
        self._found = ordered(result.findings)
        self._lines: dict[str, list[DeviceLine]] = {}

    # Frames.

    @cached_property
    def findings(self) -> pd.DataFrame:
        """One row for each finding, by capture time (UTC, ns); columns as in the JSON results.

        ``severity`` is ordered, ``error`` the greatest. A finding about a file as a whole has no time.
        """
        return findings_by_time(self.result)

    @cached_property
    def events(self) -> pd.DataFrame:
        """One row for each message of the recordings, by capture time (UTC, ns), whatever its kind.

        All of them are read; of long recordings `events_between` takes what is asked for.
        """
        return messages_by_time(self._messages(None, None, None))

    def events_between(
        self, begin: Instant | None = None, end: Instant | None = None, *, device: str | None = None
    ) -> pd.DataFrame:
        """The messages from ``begin`` to ``end`` (both included), of one ``device`` or of all.

        No other message is held in memory. The request of an answer is known if it came at most a minute
        before ``begin``.
        """
        return messages_by_time(self._messages(_ns(begin), _ns(end), device))

    @cached_property
    def inputs(self) -> pd.DataFrame:
        """One row for each recording that could be read: messages, events, skipped, truncated, seconds."""
        return inputs_frame(self.result.inputs)

    def compare(self, later: NotebookAudit) -> pd.DataFrame:
        """By rule: how often it was broken here, and in a ``later`` audit; what is new, and what is gone."""
        before, after = self._counts(), later._counts()
        rows = [(rule, before[rule], after[rule]) for rule in sorted(before | after)]
        frame = pd.DataFrame(rows, columns=["rule", "before", "after"]).set_index("rule")
        frame["change"] = [_change(row[1], row[2]) for row in rows]
        return frame

    def _counts(self) -> Counter[str]:
        counts: Counter[str] = Counter()
        for found in self._found:
            counts[found.rule] += found.count
        return counts

    # Pictures and words.

    def devices(self, path: str | Path | None = None) -> list[DeviceLine]:
        """What was known of each device from message to message: of one recording, or of all."""
        lines: list[DeviceLine] = []
        for entry in self._read(path):
            if entry not in self._lines:
                manner = self._manner
                self._lines[entry] = timeline(
                    entry, profile=manner.profile, model=manner.model, variant=manner.variant
                )
            lines += self._lines[entry]
        return lines

    def timeline(
        self,
        *,
        path: str | Path | None = None,
        device: str | None = None,
        begin: Instant | None = None,
        end: Instant | None = None,
    ) -> Picture:
        """A panel for each device on one axis of time: what it was known to be, with its findings and gaps.

        Of one recording (``path``) or of all, of one ``device`` or of all, from ``begin`` to ``end``. Raises
        ``UsageError`` without the extra ``viz``, and for a path or device that is not there.
        """
        with _altair():
            from mmsverify.report.charts import timeline as drawn
        lines = [line for line in self.devices(path) if device in (None, line.device)]
        if device is not None and not lines:
            raise UsageError(f"no device {device!r}", cure=f"one of {_listed(self.devices(path))}")
        lines = [narrowed(line, _ns(begin), _ns(end)) for line in lines]
        own = {str(path)} if path is not None else {entry.path for entry in self.result.inputs}
        found = [each for each in self._found if each.path in own and _within(each, _ns(begin), _ns(end))]
        return drawn(lines, found, f"timeline of {counted(len(lines), 'device')}")

    def sequence(self, around: Which) -> Picture:
        """The messages around a finding, client and robot, requests joined with their answers.

        Raises ``UsageError`` without the extra ``viz``, and for a finding that belongs to no message.
        """
        with _altair():
            from mmsverify.report.sequence import sequence as drawn
        found = self.finding(around)
        sayings = self.surroundings(found)
        beside = [each for each in self._found if each.path == found.path]
        apart = [said.index for said in sayings].index(found.index or 0) - BEFORE
        return drawn(sayings, beside, f"messages around #{found.index}", apart=max(0, apart))

    def surroundings(self, around: Which) -> list[Saying]:
        """The messages around a finding, and those that it refers to, in words."""
        found = self.finding(around)
        if found.index is None:
            raise UsageError(f"{found.rule} is about the file as a whole", cure="name another finding")
        manner = self._manner
        incident = reconstruct(
            found.path, [found], profile=manner.profile, model=manner.model, variant=manner.variant
        )
        return [incident.sayings[index] for index in incident.windows[found.index]]

    def explain(self, finding: Which) -> Explained:
        """A finding in words: what, which clause, what was known, what was expected, what led to it."""
        found = self.finding(finding)
        sayings = self.surroundings(found) if found.index is not None else []
        return explained(found, sayings, self._manner.profile, self._manner.variant)

    def finding(self, which: Which) -> Finding:
        """A finding as data: of a row of ``findings``, or of its number.

        Raises ``UsageError`` for a row that is none of this audit, ``IndexError`` for a number too large.
        """
        if isinstance(which, Finding):
            return which
        if not isinstance(which, pd.Series):
            return self._found[which]
        for found in self._found:
            if _is_row(which, found):
                return found
        raise UsageError("not a finding of this audit", cure="give a row of audit.findings, or its number")

    # What is behind them.

    def _messages(
        self, begin: int | None, end: int | None, device: str | None
    ) -> Iterator[tuple[str, Saying]]:
        for entry in self.result.inputs:
            for said in messages(entry.path, begin, end, device):
                yield entry.path, said

    def _read(self, path: str | Path | None) -> Sequence[str]:
        paths = [entry.path for entry in self.result.inputs]
        if path is None:
            return paths
        if str(path) not in paths:
            raise UsageError(f"{path} is no recording of this audit", cure="see audit.inputs")
        return [str(path)]

    def __repr__(self) -> str:
        return f"<audit: {summary(self.result)}>"

    def _repr_html_(self) -> str:
        read = element("p", summary(self.result))
        names = _short([path for path, _, _ in by_input(self.result)])
        rows = [_shown(found, names[found.path]) for found in self._found[:MOST_SHOWN]]
        head = ("recording", "#", "time", "device", "", "rule", "what")
        more = len(self._found) - MOST_SHOWN
        rest = element("p", f"and {more} more: see audit.findings") if more > 0 else Markup()
        return str(element("div", read, table(head, rows) if rows else Markup(), rest))


def _shown(found: Finding, name: str) -> Sequence[Any]:
    time = "" if found.time is None else instant(found.time)[11:23]
    times = f" ({found.count} times)" if found.count > 1 else ""
    clauses = element("small", " ".join(found.clauses))
    what = joined([found.message + times, clauses], "<br>")
    index = "" if found.index is None else found.index
    return name, index, time, found.vmd or "", word(found.severity), code(found.rule), what


def _short(paths: Sequence[str]) -> dict[str, str]:
    """Names of recordings without their folders, where that tells them apart."""
    names = Counter(Path(path).name for path in paths)
    return {path: Path(path).name if names[Path(path).name] == 1 else path for path in paths}


def _change(before: int, after: int) -> str:
    if not before or not after:
        return "new" if after else "gone"
    return "as before" if before == after else "more" if after > before else "less"


def _within(found: Finding, begin: int | None, end: int | None) -> bool:
    if found.time is None:
        return False
    return (begin is None or found.time >= begin) and (end is None or found.time <= end)


def _is_row(row: pd.Series, found: Finding) -> bool:
    index = row.get("index")
    same = found.index is None if index is None or pd.isna(index) else found.index == int(index)
    return same and all(row.get(name) == getattr(found, name) for name in ("path", "rule", "message"))


def _ns(instant: Instant | None) -> int | None:
    """An instant in ns since 1970; one without a time zone is UTC."""
    if instant is None or isinstance(instant, int):
        return instant
    stamp = pd.Timestamp(instant)
    stamp = stamp.tz_localize("UTC") if stamp.tzinfo is None else stamp
    return int(stamp.as_unit("ns").value)


def _listed(lines: Sequence[DeviceLine]) -> str:
    return ", ".join(dict.fromkeys(line.device for line in lines)) or "none at all"


@contextmanager
def _altair() -> Iterator[None]:
    """What draws is imported here: it needs a library that not everybody has."""
    try:
        yield
    except ImportError as error:
        raise UsageError("charts need Altair", cure="pip install 'mmsverify[viz]'") from error
