"""Which statements of the standard an ASN.1 module encodes: the ids in its comments.

A comment's ids belong to what starts on the comment's own line, else to what starts on the next line that is
not a comment: a module, a production (``Select-Request``) or a field, with the fields around it
(``CS-Start-Request.controlling.startLocation``). Ids that belong to nothing are an error.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from mmsverify.formats.schema import SchemaError

_ID = re.compile(r"(?<![\w-])R-[0-9A-Z][\w.]*-\w+")
_TOKEN = re.compile(r"--(?:(?!--).)*(?:--|$)|::=|[{},;]|'[01]*'B|[A-Za-z](?:-?\w)*|[^\s]", re.M)


def cited_productions(folder: Path) -> dict[str, list[str]]:
    """Every id cited in the modules of ``folder``, with the modules, productions and fields that cite it."""
    found: dict[str, list[str]] = {}
    for path in sorted(folder.glob("*.asn")):
        for name, ids in citations(path.read_text(encoding="utf-8"), path.name):
            for cited in ids:
                found.setdefault(cited, []).append(name)
    return found


def statements(texts: Iterable[str]) -> dict[str, tuple[str, ...]]:
    """The inverse: every production and field that cites, with its ids in order."""
    found: dict[str, tuple[str, ...]] = {}
    for text in texts:
        for name, ids in citations(text, ""):
            found[name] = tuple(dict.fromkeys((*found.get(name, ()), *ids)))
    return found


def innermost(places: Sequence[str], known: Mapping[str, tuple[str, ...]]) -> tuple[str, ...]:
    """The statements of the innermost production among ``places`` that encodes any, and of what leads to it.

    ``places`` are productions and fields from the outside in, as `Schema.places` tells them.
    """
    cited = [place for place in places if place in known]
    if not cited:
        return ()
    production = cited[-1].partition(".")[0]
    first = next(at for at, place in enumerate(places) if place.partition(".")[0] == production)
    chain = [place for place in (*places[max(first - 1, 0) :],) if place in known]
    return tuple(dict.fromkeys(one for place in reversed(chain) for one in known[place]))


def citations(text: str, file: str) -> Iterator[tuple[str, tuple[str, ...]]]:
    """What a module's comments cite, each time with the name of what cites it."""
    starts: dict[int, str] = {}
    for line, name in _starts(text):
        starts.setdefault(line, name)
    code = {line for line, token in _tokens(text) if not token.startswith("--")}
    last = text.count("\n") + 1
    for line, token in _tokens(text):
        ids = tuple(_ID.findall(token)) if token.startswith("--") else ()
        if not ids:
            continue
        home = line
        while home not in code and home < last and _is_comment(text, home):
            home += 1
        if home not in starts:
            raise SchemaError(f"{ids[0]} belongs to no production or field", place=f"{file}:{line}")
        yield starts[home], ids


def _is_comment(text: str, line: int) -> bool:
    return text.split("\n")[line - 1].lstrip().startswith("--")


def _tokens(text: str) -> Iterator[tuple[int, str]]:
    line, at = 1, 0
    for match in _TOKEN.finditer(text):
        line += text.count("\n", at, match.start())
        at = match.start()
        yield line, match.group()


def _starts(text: str) -> Iterator[tuple[int, str]]:
    """Each module, production and field, with the line on which it starts."""
    tokens = [pair for pair in _tokens(text) if not pair[1].startswith("--")]
    words = [token for _, token in tokens] + [""]
    trail: list[str] = []
    inside, fresh, skipping = False, False, False
    for at, (line, token) in enumerate(tokens):
        after = words[at + 1]
        if token == "BEGIN":
            inside = True
        elif token == "END":
            inside, trail = False, []
        elif not inside:
            if not trail:
                trail = [token]
                yield line, token
        elif token in ("IMPORTS", ";"):
            skipping = token == "IMPORTS"
        elif skipping:
            continue
        elif token == "{":
            trail, fresh = [*trail, ""], True
        elif token == "}":
            trail.pop()
        elif token == ",":
            fresh = True
        elif after == "::=" or words[at + 1 : at + 4] == ["OBJECT", "IDENTIFIER", "::="]:
            trail = [token]
            yield line, token
        elif fresh and len(trail) > 1:
            trail, fresh = [*trail[:-1], token], False
            yield line, ".".join(trail)
