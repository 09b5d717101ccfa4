"""Bytes to events and back: one file per format, nothing that judges what the bytes say."""
