"""What Python says of a model file that it cannot run, in the language's words: where, what, the cure."""

from __future__ import annotations

import difflib
import re
import traceback
from pathlib import Path
from types import FrameType

from mmsverify.errors import ModelError

_MISSING = re.compile(r"(\w+)(?:\.__init__)?\(\) missing \d+ required .*?: (.*)")
_UNEXPECTED = re.compile(r"(\w+)(?:\.__init__)?\(\) got an unexpected keyword argument '(\w+)'")


def told(error: Exception, path: Path) -> ModelError:
    """The error of a model file for what running it raised."""
    if isinstance(error, SyntaxError):
        return _not_python(error, path)
    frame, place = _guilty(error, path)
    if isinstance(error, NameError):
        return _undeclared(error, frame, place)
    if isinstance(error, TypeError):
        return _wrongly_called(error, place)
    return _other(error, place)


def _not_python(error: SyntaxError, path: Path) -> ModelError:
    if "null bytes" in str(error):  # Python tells no place of them
        return ModelError("a null byte, which no text has", place=_null(path), cure="save it as UTF-8 text")
    place = f"{error.filename or path}" + (f":{error.lineno}" if error.lineno else "")
    return ModelError(f"not valid Python: {error.msg}", place=place, cure="mend the syntax")


def _null(path: Path) -> str:
    """Where the first null byte of a file stands; the file alone where it is another one that has it."""
    before, null, _ = path.read_bytes().partition(b"\0")
    line = before.count(b"\n") + 1
    return f"{path}:{line}" if null else str(path)


def _guilty(error: Exception, path: Path) -> tuple[FrameType | None, str]:
    """The innermost frame in the folder of the model file, and where it stood."""
    found = [
        (frame, f"{frame.f_code.co_filename}:{line}")
        for frame, line in traceback.walk_tb(error.__traceback__)
        if frame.f_code.co_filename.startswith(str(path.parent))
    ]
    return found[-1] if found else (None, str(path))


def _undeclared(error: NameError, frame: FrameType | None, place: str) -> ModelError:
    name = str(error.name)
    known = [] if frame is None else [n for n in (*frame.f_locals, *frame.f_globals) if not n.startswith("_")]
    near = difflib.get_close_matches(name, known, n=1)
    hint = f"did you mean {near[0]}? else declare" if near else "declare"
    return ModelError(
        f"{name} is not declared", place=place, cure=f"{hint} it above this line: {name} = Variable(...)"
    )


def _wrongly_called(error: TypeError, place: str) -> ModelError:
    missing, unexpected = _MISSING.search(str(error)), _UNEXPECTED.search(str(error))
    if missing:
        what, names = missing[1], missing[2].replace("'", "")
        return ModelError(f"{what} lacks {names}", place=place, cure=f"write {what}(...) with {names}")
    if unexpected:
        cause = f"{unexpected[1]} knows no {unexpected[2]}="
        return ModelError(cause, place=place, cure="leave it out, or mend the spelling")
    return _other(error, place)


def _other(error: Exception, place: str) -> ModelError:
    cause = f"{type(error).__name__}: {error}"
    return ModelError(cause, place=place, cure="mend this line of the model file")
