"""What a transport reports: a line on standard error for each event, few of each kind."""

from __future__ import annotations

import sys
import threading
from collections import Counter, deque
from collections.abc import Callable

from ..base.terminal import clean_text, escape_to_one_line

MAX_OF_A_KIND = 5
"""Lines of one kind that are printed; the next says that there are more."""
MAX_KINDS = 1000
"""Kinds that are counted; that there are more is printed once."""


def to_standard_error(line: str) -> None:
    """Print a line."""
    print(clean_text(line), file=sys.stderr, flush=True)


class Log:
    """Lines of one transport. Any thread may write.

    Args:
        name: what each line begins with, as ``ros1``.
        write: where lines go.
    """

    def __init__(self, name: str, write: Callable[[str], None] = to_standard_error) -> None:
        self._name, self._write = name, write
        self._lock = threading.Lock()
        self._counts: Counter[str] = Counter()
        self._others: list[Callable[[str], None]] = []
        self.lines: deque[str] = deque(maxlen=200)
        """The newest lines, for whoever shows them."""

    def say(self, line: str, *, kind: str = "") -> None:
        """Report an event; of one ``kind`` (default: the line itself) only a few.

        Line ends in what a peer has sent are escaped: it writes no lines of its own.
        """
        line = escape_to_one_line(line)
        key = kind or line
        with self._lock:
            if key not in self._counts and len(self._counts) >= MAX_KINDS:
                line = key = f"more than {MAX_KINDS} kinds of events; others are not shown"
                if key in self._counts:
                    return
            self._counts[key] += 1
            n = self._counts[key]
            if n > MAX_OF_A_KIND + 1:
                return
            more = " (further such lines are not shown)" if n > MAX_OF_A_KIND else ""
            self.lines.append(line)
            others = list(self._others)
        self._write(f"uwsim: {self._name}: {line}{more}")
        for write in others:
            write(line)

    def also(self, write: Callable[[str], None]) -> None:
        """Give the lines to ``write``, too, from now on; without the name in front."""
        with self._lock:
            self._others.append(write)

    def count(self, kind: str) -> int:
        """How many events of a kind there were, shown or not."""
        with self._lock:
            return self._counts[kind]
