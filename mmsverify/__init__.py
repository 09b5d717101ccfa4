"""mmsverify: a formal model checker and event-log analyzer for industrial robot controllers."""

from importlib.metadata import PackageNotFoundError, version

try:
    __version__ = version("mmsverify")
except PackageNotFoundError:  # a source tree that was never installed
    __version__ = "0.0.0"
