"""mmsverify: a formal model checker and event-log analyzer for industrial robot controllers."""

__version__: str


def __getattr__(name: str) -> str:
    # Looking for it takes as long as a tenth of all that is imported: most commands need not know.
    if name != "__version__":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("mmsverify")
    except PackageNotFoundError:  # a source tree that was never installed
        return "0.0.0"
