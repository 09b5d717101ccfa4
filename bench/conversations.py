"""Random conversations with a robot that keeps the rules, audited: each finding would be a false alarm.

    python bench/conversations.py [CONVERSATIONS [MESSAGES [FIRST_SEED]]]

They are made from the model's own rows, with what happens inside hidden, as in the tests of quality: several
requests at a time, gaps, recordings that begin in mid-operation. One line is printed for each conversation
that is blamed, and a last one for all; the exit code tells whether any was. Times are CPU seconds.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

TESTS = Path(__file__).parent.parent / "tests"
sys.path[:0] = [str(TESTS), str(TESTS / "quality")]

from robot_conversations import blamed, conversation  # noqa: E402


def main() -> int:
    """Hold them, one after the other; how many were blamed."""
    given = [int(word) for word in sys.argv[1:4]]
    count, length, first = (*given, *(200, 500, 3000)[len(given) :])
    accused = messages = 0
    making = auditing = slowest = 0.0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + count):
            begin = time.process_time()
            talk = conversation(seed, length)
            made = time.process_time()
            findings = blamed(talk, Path(folder) / "made.mcap")
            took = time.process_time() - made
            making, auditing, slowest = making + made - begin, auditing + took, max(slowest, took)
            messages += len(talk.messages)
            accused += bool(findings)
            for found in findings:
                print(f"seed {seed}, message {found.index}: {found.rule}: {found.message}", flush=True)
    print(
        f"{count} conversations, {messages} messages, seeds {first} to {first + count - 1}: {accused} blamed;"
        f" made in {making:.0f} s, audited in {auditing:.0f} s ({messages / auditing:.0f} messages a second),"
        f" the slowest in {slowest:.1f} s"
    )
    return accused


if __name__ == "__main__":
    sys.exit(min(1, main()))
