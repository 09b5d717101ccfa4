"""Puts this folder on the import path, so that tests of every kind can share what lies here."""
