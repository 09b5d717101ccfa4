"""Auditing recordings: messages are paired, lowered to events of a model, and replayed against a belief.

What a message means lives here; what a model allows lives in its rows.
"""
