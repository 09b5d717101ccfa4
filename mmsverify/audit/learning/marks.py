"""Numbers that an audit only passes on: it holds them, compares them and prints them, and never reckons.

Told apart by their types from all other numbers, they can be left out of what is compared of two states of a
device: see `snapshots`.
"""

from __future__ import annotations

from dataclasses import replace

from mmsverify.formats.mms import Pdu


class Index(int):
    """The place of a message in its recording."""

    __slots__ = ()


class InvokeId(int):
    """The invokeID of a request and of its answer."""

    __slots__ = ()


def marked(pdu: Pdu) -> Pdu:
    """The PDU with its invokeID marked as one."""
    return pdu if pdu.invoke_id is None else replace(pdu, invoke_id=InvokeId(pdu.invoke_id))
