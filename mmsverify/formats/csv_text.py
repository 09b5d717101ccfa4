"""The text of an exported table: its encoding found out, its lines read one by one."""

from __future__ import annotations

import codecs
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TextIO

from mmsverify.errors import InputError

LONGEST = 1 << 17
"""Characters of one line; what is longer is no table of samples."""

_PIECE = 1 << 16
_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
# Nearly all UTF-8 is valid in the others too, so the strictest comes first; Latin-1 takes everything.
_CANDIDATES = ("utf-8", "gb18030", "latin-1")
_CHINESE = re.compile(rb"[\x81-\xfe]{2}")


@contextmanager
def opened(path: str | os.PathLike[str]) -> Iterator[Iterator[str]]:
    """The lines of a text file. Raises ``InputError``, with the line, where it cannot be read on."""
    place = os.fspath(path)
    try:
        with open(path, encoding=encoding_of(path), newline="") as file:
            yield _lines(file, place)
    except OSError as error:
        raise InputError(error.strerror or str(error), place=place) from None


def _lines(file: TextIO, place: str) -> Iterator[str]:
    number = 1
    try:
        while line := file.readline(LONGEST + 1):
            if len(line) > LONGEST:
                raise InputError("the line is too long for a table of samples", place=f"{place}:{number}")
            yield line
            number += 1
    except UnicodeError:
        cure = "save the file as UTF-8 once more"
        raise InputError("the text is damaged near here", place=f"{place}:{number}", cure=cure) from None


def encoding_of(path: str | os.PathLike[str]) -> str:
    """The encoding: by the byte order mark, by the zero octets of UTF-16, else the first that fits."""
    with open(path, "rb") as file:
        begin = file.read(256)
    for mark, name in _MARKS:
        if begin.startswith(mark):
            return name
    # Digits and delimiters are ASCII: in UTF-16 every other octet of them is zero.
    low, high = begin[1::2].count(0), begin[0::2].count(0)
    if max(low, high) > len(begin) // 4:
        return "utf-16-le" if low > high else "utf-16-be"
    return next(name for name in _CANDIDATES if _fits(path, name))


def _fits(path: str | os.PathLike[str], name: str) -> bool:
    """Whether a file is text in this encoding. A micro or degree sign alone between ASCII is no Chinese."""
    decoder = codecs.getincrementaldecoder(name)()
    chinese = False
    with open(path, "rb") as file:
        try:
            while piece := file.read(_PIECE):
                decoder.decode(piece)
                chinese = chinese or bool(_CHINESE.search(piece))
            decoder.decode(b"", final=True)
        except UnicodeDecodeError:
            return False
    return chinese or name != "gb18030"
