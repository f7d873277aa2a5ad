"""Progress of a command: a bar in a terminal, lines in a log."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    Task,
    TextColumn,
    TimeElapsedColumn,
)
from rich.text import Text

SAY_EVERY = 10.0
"""Time between two lines of progress where there is no terminal [s]."""


class TimeLeft:
    r"""Estimates the time left from the pieces done so far.

    What comes before the first piece, loading and compiling, comes once; and pieces of w workers
    are done at about one time, in waves. So waves are counted, and from the moment :math:`t_w` at
    which the first one was over: of n pieces k are done at t, and the rest takes

    .. math:: \left\lceil\frac{n - k}{w}\right\rceil
        \frac{t - t_w}{\lceil (k - w) / w \rceil}

    Not modelled: that later pieces are longer or shorter than the earlier ones.

    Args:
        total: number of pieces.
        done: pieces that were done before.
        at_once: how many are worked on at one time.
    """

    def __init__(self, total: int, *, done: int = 0, at_once: int = 1) -> None:
        self._total, self._done = total, done
        self._wave = min(at_once, max(1, (total - done) // 2))
        self._first = done + self._wave
        self._began: float | None = None
        self._now = 0.0

    def piece(self, now: float) -> None:
        """One more was done, at the time ``now`` [s]."""
        self._done += 1
        self._now = now
        if self._done == self._first:
            self._began = now

    @property
    def seconds(self) -> float | None:
        """Estimated time left [s]; None while unknown."""
        if self._began is None or self._done <= self._first:
            return None
        waves = math.ceil((self._done - self._first) / self._wave)
        to_come = math.ceil((self._total - self._done) / self._wave)
        return to_come * (self._now - self._began) / waves


class TimeLeftColumn(ProgressColumn):
    """``0:01:40``, counted down between two pieces; ``-:--:--`` while unknown."""

    def __init__(self, left: TimeLeft) -> None:
        super().__init__()
        self._left = left
        self._reported: tuple[float, float] | None = None

    def render(self, task: Task) -> Text:
        """Return it."""
        seconds, now = self._left.seconds, time.monotonic()
        if seconds is None:
            return Text("-:--:--", style="progress.remaining")
        if self._reported is None or self._reported[0] != seconds:
            self._reported = seconds, now
        rest = max(0, round(seconds - (now - self._reported[1])))
        text = f"{rest // 3600}:{rest // 60 % 60:02d}:{rest % 60:02d}"
        return Text(text, style="progress.remaining")


@contextmanager
def progress(
    title: str, total: int, *, done: int = 0, of: str, at_once: int = 1
) -> Iterator[Callable[[], None]]:
    """Show how much is done; gives what is to be called for each piece.

    Args:
        title: what is done.
        total: number of pieces.
        done: pieces that were done before.
        of: what a piece is called, in the plural.
        at_once: how many are worked on at one time.
    """
    console = Console(stderr=True)
    left = TimeLeft(total, done=done, at_once=at_once)
    if not console.is_terminal:
        yield plain_progress(title, done, total, of, left)
        return
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn(of),
        TimeElapsedColumn(),
        TimeLeftColumn(left),
    )
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(title, total=total, completed=done)

        def on_piece() -> None:
            left.piece(time.monotonic())
            bar.advance(task)

        yield on_piece


def plain_progress(
    title: str, done: int, total: int, of: str, left: TimeLeft
) -> Callable[[], None]:
    """Say now and then, on lines of their own, how far it is."""
    reported = time.monotonic()

    def on_piece() -> None:
        nonlocal done, reported
        done += 1
        now = time.monotonic()
        left.piece(now)
        if now - reported >= SAY_EVERY and done < total:
            reported = now
            rest = "" if left.seconds is None else f", about {left.seconds:.0f} s left"
            print(f"{title}: {done} of {total} {of}{rest}", file=sys.stderr)

    return on_piece
