"""The log of a transport: a line on standard error for each event, few of each kind."""

from __future__ import annotations

import sys
import threading
from collections import Counter, deque
from collections.abc import Callable

from ..base.terminal import clean_text, escape_to_one_line

MAX_LINES_OF_A_KIND = 5
"""The number of lines of one kind that are printed; the next line states that there are more."""
MAX_KINDS = 1000
"""The number of kinds that are counted; a last line states that there are more."""


def to_standard_error(line: str) -> None:
    """Print a line."""
    print(clean_text(line), file=sys.stderr, flush=True)


class Log:
    """The log lines of one transport; any thread may write.

    Args:
        name: the beginning of each line, as ``ros1``.
        write: the function that prints a line.
    """

    def __init__(self, name: str, write: Callable[[str], None] = to_standard_error) -> None:
        self._name, self._write = name, write
        self._lock = threading.Lock()
        self._counts: Counter[str] = Counter()
        self._listeners: list[Callable[[str], None]] = []
        self.lines: deque[str] = deque(maxlen=200)
        """The newest lines, for display."""

    def report(self, line: str, *, kind: str = "") -> None:
        """Report an event; print only a few of one ``kind`` (default: the line itself).

        Line ends are escaped, so that a peer's text cannot add lines.
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
            if n > MAX_LINES_OF_A_KIND + 1:
                return
            suffix = " (further such lines are not shown)" if n > MAX_LINES_OF_A_KIND else ""
            self.lines.append(line)
            listeners = list(self._listeners)
        self._write(f"uwsim: {self._name}: {line}{suffix}")
        for write in listeners:
            write(line)

    def add_listener(self, write: Callable[[str], None]) -> None:
        """Pass the lines to ``write``, too, from now on, without the name of the log."""
        with self._lock:
            self._listeners.append(write)

    def count(self, kind: str) -> int:
        """Return the number of events of a kind, printed or not."""
        with self._lock:
            return self._counts[kind]
