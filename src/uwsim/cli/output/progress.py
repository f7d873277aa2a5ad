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

REPORT_INTERVAL = 10.0
"""The time between two lines of progress without a terminal [s]."""


class TimeEstimate:
    r"""An estimate of the remaining time of a task from the pieces finished so far.

    Loading and compiling occur once, before the first piece, and w workers finish their pieces at
    about the same time, in waves. The estimate therefore counts waves, from the time :math:`t_w` at
    which the first one ends. With k of n pieces done at t, the rest takes

    .. math:: \left\lceil\frac{n - k}{w}\right\rceil
        \frac{t - t_w}{\lceil (k - w) / w \rceil}

    Not modelled: later pieces that are longer or shorter than the earlier ones.

    Args:
        total: the number of pieces.
        n_done: the number of pieces that were done before.
        n_parallel: the number of pieces in parallel.
    """

    def __init__(self, total: int, *, n_done: int = 0, n_parallel: int = 1) -> None:
        self._total, self._n_done = total, n_done
        self._wave = min(n_parallel, max(1, (total - n_done) // 2))
        self._n_first_wave = n_done + self._wave
        self._first_wave_time: float | None = None
        self._now = 0.0

    def count_piece(self, now: float) -> None:
        """Count a piece that is done at the time ``now`` [s]."""
        self._n_done += 1
        self._now = now
        if self._n_done == self._n_first_wave:
            self._first_wave_time = now

    @property
    def seconds(self) -> float | None:
        """The estimated remaining time [s]; None while unknown."""
        if self._first_wave_time is None or self._n_done <= self._n_first_wave:
            return None
        waves = math.ceil((self._n_done - self._n_first_wave) / self._wave)
        waves_left = math.ceil((self._total - self._n_done) / self._wave)
        return waves_left * (self._now - self._first_wave_time) / waves


class TimeLeftColumn(ProgressColumn):
    """A column ``0:01:40``, counted down between two pieces; ``-:--:--`` while unknown."""

    def __init__(self, estimate: TimeEstimate) -> None:
        super().__init__()
        self._estimate = estimate
        self._last_estimate: tuple[float, float] | None = None

    def render(self, task: Task) -> Text:
        """Return the text of the remaining time."""
        seconds, now = self._estimate.seconds, time.monotonic()
        if seconds is None:
            return Text("-:--:--", style="progress.remaining")
        if self._last_estimate is None or self._last_estimate[0] != seconds:
            self._last_estimate = seconds, now
        rest = max(0, round(seconds - (now - self._last_estimate[1])))
        text = f"{rest // 3600}:{rest // 60 % 60:02d}:{rest % 60:02d}"
        return Text(text, style="progress.remaining")


@contextmanager
def progress(
    title: str, total: int, *, n_done: int = 0, unit: str, n_parallel: int = 1
) -> Iterator[Callable[[], None]]:
    """Show the progress of a work; yield the function to call after each piece.

    Args:
        title: the name of the work.
        total: the number of pieces.
        n_done: the number of pieces that were done before.
        unit: the name of a piece, in the plural.
        n_parallel: the number of pieces in parallel.
    """
    console = Console(stderr=True)
    estimate = TimeEstimate(total, n_done=n_done, n_parallel=n_parallel)
    if not console.is_terminal:
        yield print_progress(title, n_done, total, unit, estimate)
        return
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn(unit),
        TimeElapsedColumn(),
        TimeLeftColumn(estimate),
    )
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(title, total=total, completed=n_done)

        def on_piece() -> None:
            estimate.count_piece(time.monotonic())
            bar.advance(task)

        yield on_piece


def print_progress(
    title: str, n_done: int, total: int, unit: str, estimate: TimeEstimate
) -> Callable[[], None]:
    """Return a function that counts pieces, and prints a line from time to time."""
    report_time = time.monotonic()

    def on_piece() -> None:
        nonlocal n_done, report_time
        n_done += 1
        now = time.monotonic()
        estimate.count_piece(now)
        if now - report_time >= REPORT_INTERVAL and n_done < total:
            report_time = now
            rest = "" if estimate.seconds is None else f", about {estimate.seconds:.0f} s left"
            print(f"{title}: {n_done} of {total} {unit}{rest}", file=sys.stderr)

    return on_piece
