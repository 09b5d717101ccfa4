"""What goes wrong on the user's side, told in one line: place, cause, cure.

Everybody may import this module; it imports nothing of the project. An error of this family never becomes a
traceback on the command line: it becomes one line on stderr and exit status 2.
"""

from __future__ import annotations


class MmsverifyError(Exception):
    """A bad model, profile, trace, capture, option or path.

    ``place`` says where (file, line, octet, option), ``cause`` what is wrong there, ``cure`` what mends it.
    """

    code = "error"

    def __init__(self, cause: str, *, place: str = "", cure: str = "") -> None:
        super().__init__(cause)
        self.cause = cause
        self.place = place
        self.cure = cure

    def __str__(self) -> str:
        where = f"{self.place}: " if self.place else ""
        mend = f" ({self.cure})" if self.cure else ""
        return " ".join(f"{where}{self.cause}{mend}".split())


class ModelError(MmsverifyError):
    """A model file that cannot be read as a model; ``place`` is ``file:line``."""

    code = "model"


class ProfileError(MmsverifyError):
    """A profile (TOML or trace metadata) with an unknown key or a value that is not allowed."""

    code = "profile"


class InputError(MmsverifyError):
    """A trace, capture or path that cannot be read at all."""

    code = "input"


class UsageError(MmsverifyError):
    """An option or argument of the command line that cannot be honoured."""

    code = "usage"


class DecodeError(MmsverifyError):
    """Octets that are not what their channel says.

    ``offset`` counts octets from the start of the message; ``path`` is the chain of names leading there.
    """

    code = "decode"

    def __init__(self, cause: str, *, offset: int, path: str = "") -> None:
        place = f"octet {offset}" + (f", {path}" if path else "")
        super().__init__(cause, place=place)
        self.offset = offset
        self.path = path
