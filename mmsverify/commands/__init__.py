"""The commands, one file each: read the options, call the composition root, print, return the exit status.

Nothing is decided here. Engines are imported inside the functions, so that ``mmsverify --help``
answers at once.
"""
