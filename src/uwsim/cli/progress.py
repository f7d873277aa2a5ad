"""How far a command is: a bar in a terminal, a line now and then in a log."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

SAY_EVERY = 10.0
"""Time between two lines of progress where there is no terminal [s]."""


@contextmanager
def progress(title: str, total: int, *, done: int = 0, of: str) -> Iterator[Callable[[], None]]:
    """Show how much is done; gives what is to be called for each piece.

    Args:
        title: what is done.
        total: number of pieces.
        done: pieces that were done before.
        of: what a piece is called, in the plural.
    """
    console = Console(stderr=True)
    if not console.is_terminal:
        yield plain_progress(title, done, total, of)
        return
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn(of),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(title, total=total, completed=done)
        yield lambda: bar.advance(task)


def plain_progress(title: str, done: int, total: int, of: str) -> Callable[[], None]:
    """Say now and then, on lines of their own, how far it is."""
    began = said = time.monotonic()
    first = done

    def on_piece() -> None:
        nonlocal done, said
        done += 1
        now = time.monotonic()
        if now - said >= SAY_EVERY and done < total:
            said = now
            left = (now - began) / (done - first) * (total - done)
            print(f"{title}: {done} of {total} {of}, {left:.0f} s left", file=sys.stderr)

    return on_piece
