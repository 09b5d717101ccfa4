"""mmsverify: a formal model checker and event-log analyzer for industrial robot controllers.

In a notebook:

    import mmsverify as mv
    audit = mv.audit("x.mcap")

What stands behind these names is loaded when one of them is first used.
"""

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mmsverify.notebook import audit, check, model, sample

    __version__: str

__all__ = ["__version__", "audit", "check", "model", "sample"]

_SPOKEN = {"audit", "check", "model", "sample"}
_FOLDERS = {"audit", "model"}
"""Names of the API that are those of folders too: the folder, as a module, is what is called."""


class _Root(ModuleType):
    """The package itself. A folder that becomes part of it under a name of the API can be called by it."""

    def __setattr__(self, name: str, value: Any) -> None:
        if name in _FOLDERS and type(value) is ModuleType:
            value.__class__ = _Folder
        super().__setattr__(name, value)

    def __getattr__(self, name: str) -> Any:
        if name in _FOLDERS:
            return import_module(f"{__name__}.{name}")
        if name in _SPOKEN:
            return getattr(import_module(f"{__name__}.notebook"), name)
        if name == "__version__":
            return _version()
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *__all__})

    def __reduce__(self) -> tuple[Any, ...]:  # a module of a class of its own is pickled by its name
        return import_module, (self.__name__,)


class _Folder(ModuleType):
    """A folder of the package that can be called: ``mmsverify.audit("x.mcap")``."""

    def __call__(self, *given: Any, **named: Any) -> Any:
        return self._spoken(*given, **named)

    @property
    def _spoken(self) -> Any:
        return getattr(import_module(f"{__name__}.notebook"), self.__name__.rpartition(".")[2])

    @property
    def __signature__(self) -> Any:
        from inspect import signature

        return signature(self._spoken)

    def __reduce__(self) -> tuple[Any, ...]:
        return import_module, (self.__name__,)


def _version() -> str:
    # Looking for it takes as long as a tenth of all that is imported: most commands need not know.
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("mmsverify")
    except PackageNotFoundError:  # a source tree that was never installed
        return "0.0.0"


def _become(kind: type[ModuleType]) -> None:
    import sys

    sys.modules[__name__].__class__ = kind


_become(_Root)
