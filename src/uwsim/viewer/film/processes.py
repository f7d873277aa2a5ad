"""Drawing the images of a film in several processes, each with its own graphics context."""

from __future__ import annotations

import multiprocessing
import os
import pickle
import queue
import threading
from collections.abc import Iterator, Sequence
from contextlib import suppress
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnProcess

from ...base.environment import set_environment
from ...errors import RunFailed
from ...runs.executors.executor import ENVIRONMENT
from ...runs.executors.parent_watch import exit_with_parent, start_ignoring_interrupts
from ...runs.executors.worker import picklable
from ...runs.own_process.process import how
from ..recorded import RecordedTrial
from .encoder import Chapter, Packing
from .film import FilmSpec, Reel, chapters_of, n_frames_of

MOST = 16
"""The most processes that draw one film: they feed one encoder."""
FEWEST_IMAGES = 60
"""Images that make up for the start of a process."""
BLOCK = 6
"""Consecutive images of one process: those with the same image of the inset are drawn by one."""
AHEAD = BLOCK + 2
"""Images that a process draws before they are taken; fewer than a block would make it wait."""
FAILED = b"uwsim: failed\0"
"""Begins a message that is no image but an error."""
PATIENCE = 10.0
"""How long a process may take to leave, before it is made to [s]."""


def processes_for(n_frames: int) -> int:
    """Return how many processes draw a film of so many images: one a core, 1 for a short film."""
    return max(1, min(len(os.sched_getaffinity(0)), n_frames // FEWEST_IMAGES, MOST))


class DrawingProcesses:
    """Processes that draw the images of a film, process k of n the blocks k, k + n, k + 2 n, ...

    They are started with ``spawn``, so the main module of a program that uses them is guarded by
    ``if __name__ == "__main__"``.

    Args:
        trials: as of `Reel`.
        spec: as of `Reel`.
        n: how many processes.
    """

    def __init__(self, trials: Sequence[RecordedTrial], spec: FilmSpec, n: int) -> None:
        self._trials, self.spec = tuple(trials), spec
        """What they show."""
        self._n = n
        self._pipes: list[Connection] = []
        self._parents: list[Connection] = []
        self._processes: list[SpawnProcess] = []

    def _start(self, pack: Packing) -> None:
        context = multiprocessing.get_context("spawn")
        with set_environment(ENVIRONMENT):
            for k in range(self._n):
                pipe, theirs = context.Pipe(duplex=False)
                watched, parent = context.Pipe(duplex=False)
                what = self._trials, self.spec, pack
                process = context.Process(
                    target=draw_blocks, args=(what, k, self._n, theirs, watched)
                )
                self._pipes.append(pipe)
                self._parents.append(parent)
                start_ignoring_interrupts(process)
                self._processes.append(process)
                for end in (theirs, watched):
                    end.close()  # so that a pipe ends when the process at its other end does

    def chapters(self) -> list[Chapter]:
        """Return the chapters of all."""
        return chapters_of(self._trials, self.spec)

    def frames(self, pack: Packing) -> Iterator[bytes]:
        """Start the processes; return the images in order, each packed.

        Raises:
            RunFailed: a process has died.
            UwsimError: what a process could not draw.
        """
        self._start(pack)
        for number in range(sum(n_frames_of(trial, self.spec) for trial in self._trials)):
            at = number // BLOCK % self._n
            try:
                received = self._pipes[at].recv_bytes()
            except (EOFError, OSError):
                self._processes[at].join(PATIENCE)
                reason = how(self._processes[at].exitcode)
                raise RunFailed(f"A process that draws the film has ended: {reason}.") from None
            if received.startswith(FAILED):
                raise pickle.loads(received.removeprefix(FAILED))
            yield received

    def close(self) -> None:
        """End the processes."""
        for end in (*self._pipes, *self._parents):
            end.close()
        for process in self._processes:
            process.kill()
            process.join()
            process.close()


def draw_blocks(
    what: tuple[Sequence[RecordedTrial], FilmSpec, Packing],
    first: int,
    n: int,
    pipe: Connection,
    parent: Connection,
) -> None:
    """Draw every n-th block from ``first`` on, and send each image; ends with the parent."""
    exit_with_parent(parent)
    trials, spec, pack = what
    drawn: queue.Queue[bytes | None] = queue.Queue(AHEAD)
    sender = threading.Thread(target=_send, args=(drawn, pipe))
    sender.start()
    try:
        reel = Reel(trials, spec)
        try:
            for number in range(reel.n_frames):
                if number // BLOCK % n == first:
                    drawn.put(pack(reel.draw(number)))
        finally:
            reel.close()
    except Exception as error:
        drawn.put(FAILED + pickle.dumps(picklable(error)))
    finally:
        drawn.put(None)
        sender.join()


def _send(drawn: queue.Queue[bytes | None], pipe: Connection) -> None:
    """Send what is drawn while the next image is drawn."""
    with suppress(OSError):  # the parent has gone
        while (one := drawn.get()) is not None:
            pipe.send_bytes(one)
