"""ASN.1 modules as text to the tree that `schema` compiles: the only file that knows asn1tools.

    python -m mmsverify.formats.asn1_text [FOLDER]

writes the tree of the modules of FOLDER (those of the project) beside them, for parsing takes half a second.
One thing of the text is completed here: the value of a CHOICE default, which that parser drops.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import asn1tools

from mmsverify.formats.schema import TABLE, SchemaError
from mmsverify.resources import asn1_dir

_CHOICE_DEFAULT = re.compile(r"\bDEFAULT\s+([a-z][\w-]*)\s*:\s*(-?\d+)")


def parsed(texts: Iterable[str]) -> Mapping[str, Any]:
    """The tree of some modules, of nothing but dicts, lists, strings, numbers and truth values."""
    text = "\n".join(texts)
    try:
        modules = asn1tools.parse_string(text)
    except (asn1tools.ParseError, ValueError) as bad:
        raise SchemaError(f"the ASN.1 text cannot be parsed: {bad}") from None
    tree: Mapping[str, Any] = json.loads(json.dumps(modules))  # tuples are lists, as in the table
    return {"modules": tree, "choice defaults": choice_defaults(text)}


def table(folder: Path) -> str:
    """The table of the modules of ``folder``, as it stands beside them."""
    texts = (path.read_text(encoding="utf-8") for path in sorted(folder.glob("*.asn")))
    return json.dumps(parsed(texts), indent=1) + "\n"


def choice_defaults(text: str) -> dict[str, int]:
    """The defaults that are an alternative with a number, by what the parser leaves of them: the name."""
    found: dict[str, int] = {}
    for name, value in _CHOICE_DEFAULT.findall(text):
        if found.setdefault(name, int(value)) != int(value):
            raise SchemaError(f"two defaults for the alternative {name}", place=name, cure="use one value")
    return found


def main() -> None:
    """Write the table."""
    folder = Path(sys.argv[1]) if sys.argv[1:] else asn1_dir()
    (folder / TABLE).write_text(table(folder), encoding="utf-8")


if __name__ == "__main__":
    main()
