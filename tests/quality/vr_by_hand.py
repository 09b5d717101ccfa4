"""Runs of controllers written by hand, in the shorthand of ``vr_story``: right ones and wrong ones."""

from __future__ import annotations

import test_vr_refusals as refusals
from vr_story import READY, RUNNING

HOMED = "0 1 1! 2 3"

LAWFUL = f"""
{RUNNING} 4 5 3! 6 4 5
{RUNNING} 5! 6 6:10 6:10 7! 6:10 6 4 5
{RUNNING} 5! 6 6:10 6! 6:10 6 6:10 7! 6:10 6 4 5
{RUNNING} 5! 6 6:10 4! 7 3 2! 4 5
{RUNNING} 5! 6 6:10 9! 9 10! 3
{RUNNING} 4! 10 10 7 7 3 1! 2 3
{RUNNING} 4! 7 3 101! 13 1
{RUNNING} 401! 16 16 6 4 5
{RUNNING} 401! 16 4! 7 3
{RUNNING} 8! 11 11 8 8 10! 1 1! 2 3
{RUNNING} 8! 8 10! 1 101! 13 1
{RUNNING} 9! 12 12 9 9 10! 3 2! 4 5
{RUNNING} 9! 9 8! 8 10! 1
0 1 A 1! 2 3 4 5
0 1 A 1! 2 3 4 5 5 3! 6 4! 7 3 3 1! 2 3 4 5
{HOMED} 3 A 201! 14 3 3
0 1 1! 2 4! 7 1 1! 2 3
0 1 1! 2 8! 8 10! 1
0 1 9! 9 10! 1
0 8! 8 10! 1
0 1 101! 13 13 1
0 1 199! 13 4! 7 1
{HOMED} 1! 2 3
{HOMED} 2! 4 4! 7 3
{HOMED} 101! 13 1 1! 2 3
{HOMED} 201! 14 14 3 299! 14 9! 9 10! 3
{READY} 1! 2 3
{READY} 2! 4 5
{READY} 101! 13 1 201! 1
{READY} 201! 14 3 2! 4 5
{READY} 301! 15 15 5 399! 15 5 3! 6
{READY} 10! 5 5! 5 7! 5 401! 5 4! 5
0 1 2! 1 3! 1 301! 1
"""
"""What the rules allow; at the end, commands that are refused and that nothing follows."""

UNASKED = """
0 1 A 1! 2 3 4 5 3! 6 4! 7 3 4* 5
0 1 A 1! 2 3 4 5 201! 14 3 4* 5
0 1 A 1! 2 3 5* 5
"""
"""CF_AutoOrg leads on from homing only, and to Org (VR-10)."""

REFUSED = (
    (refusals.OBEYED, 2),
    (refusals.POLLED, 2),
    (refusals.NEXT, 1),
    (refusals.LEFT, 1),
    (refusals.STATUS, 1),
)
"""The tables of wrong runs that the audit has to blame, each with the words before a run."""


def lawful() -> list[str]:
    """The right runs."""
    return LAWFUL.strip().splitlines()


def wrong() -> list[str]:
    """The wrong runs."""
    told = (line[-1] for table, words in REFUSED for line in refusals.told(table, words))
    return list(dict.fromkeys((*UNASKED.strip().splitlines(), *told)))
