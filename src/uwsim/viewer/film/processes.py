"""Processes that draw the images of a film, each with its own graphics context."""

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
from ...runs.executors.worker import make_picklable
from ...runs.own_process.process import describe_exit
from ..recorded import RecordedTrial
from .encoder import Chapter, ImageConversion
from .film import FilmSpec, TrialSequenceFilm, chapters_of, n_frames_of

MAX_PROCESSES = 16
"""The greatest number of processes that draw one film; more would wait for the encoder."""
MIN_IMAGES = 60
"""The minimum number of images for each process."""
BLOCK_SIZE = 6
"""The number of consecutive images that one process draws, so that it reuses images of the
inset."""
QUEUE_SIZE = BLOCK_SIZE + 2
"""The greatest number of images that wait in a process until they are sent.

If it were smaller than a block, a process would wait until all earlier blocks are encoded.
"""
ERROR_PREFIX = b"uwsim: failed\0"
"""The prefix of a message with an error instead of an image."""
EXIT_TIMEOUT = 10.0
"""The longest wait for the exit status of a process that has ended [s]."""


def count_processes(n_frames: int) -> int:
    """Return the number of processes for a film: one per core, but 1 for a short film."""
    return max(1, min(len(os.sched_getaffinity(0)), n_frames // MIN_IMAGES, MAX_PROCESSES))


class DrawingProcesses:
    """Processes that draw the images of a film: process k of n draws blocks k, k + n, k + 2 n, ...

    They are started with ``spawn``, so the main module of a program that uses them is guarded by
    ``if __name__ == "__main__"``.

    Args:
        trials: the trials of the film (`TrialSequenceFilm`).
        spec: the settings of the film.
        n: the number of processes.
    """

    def __init__(self, trials: Sequence[RecordedTrial], spec: FilmSpec, n: int) -> None:
        self._trials, self.spec = tuple(trials), spec
        """The settings of the film."""
        self._n = n
        self._pipes: list[Connection] = []
        self._parent_ends: list[Connection] = []  # a child ends when its pipe is closed
        self._processes: list[SpawnProcess] = []

    def _start(self, to_bytes: ImageConversion) -> None:
        context = multiprocessing.get_context("spawn")
        with set_environment(ENVIRONMENT):
            for k in range(self._n):
                pipe, child_pipe = context.Pipe(duplex=False)
                child_end, parent = context.Pipe(duplex=False)
                job = self._trials, self.spec, to_bytes
                process = context.Process(
                    target=draw_blocks, args=(job, k, self._n, child_pipe, child_end)
                )
                self._pipes.append(pipe)
                self._parent_ends.append(parent)
                start_ignoring_interrupts(process)
                self._processes.append(process)
                for end in (child_pipe, child_end):
                    end.close()  # so that a pipe ends when the process at its other end does

    def chapters(self) -> list[Chapter]:
        """Return the chapters of all trials."""
        return chapters_of(self._trials, self.spec)

    def frames(self, to_bytes: ImageConversion) -> Iterator[bytes]:
        """Start the processes; yield the images in order, each converted to the encoder's bytes.

        Raises:
            RunFailed: a process has ended.
            UwsimError: an image cannot be drawn.
        """
        self._start(to_bytes)
        for frame_index in range(sum(n_frames_of(trial, self.spec) for trial in self._trials)):
            process_index = frame_index // BLOCK_SIZE % self._n
            try:
                frame = self._pipes[process_index].recv_bytes()
            except (EOFError, OSError):
                self._processes[process_index].join(EXIT_TIMEOUT)
                reason = describe_exit(self._processes[process_index].exitcode)
                raise RunFailed(f"A process that draws the film has ended: {reason}.") from None
            if frame.startswith(ERROR_PREFIX):
                raise pickle.loads(frame.removeprefix(ERROR_PREFIX))
            yield frame

    def close(self) -> None:
        """End the processes."""
        for end in (*self._pipes, *self._parent_ends):
            end.close()
        for process in self._processes:
            process.kill()
            process.join()
            process.close()


def draw_blocks(
    job: tuple[Sequence[RecordedTrial], FilmSpec, ImageConversion],
    offset: int,
    n: int,
    pipe: Connection,
    parent: Connection,
) -> None:
    """Draw every n-th block of a film, and send its images; end when the parent process ends.

    Args:
        job: the trials, the settings of the film, and the function that converts images to bytes.
        offset: the index of the first block.
        n: the number of processes.
        pipe: the pipe to which the images are sent.
        parent: a pipe that is closed when the parent process ends.
    """
    exit_with_parent(parent)
    trials, spec, to_bytes = job
    frames: queue.Queue[bytes | None] = queue.Queue(QUEUE_SIZE)
    sender = threading.Thread(target=_send, args=(frames, pipe))
    sender.start()
    try:
        film = TrialSequenceFilm(trials, spec)
        try:
            for frame_index in range(film.n_frames):
                if frame_index // BLOCK_SIZE % n == offset:
                    frames.put(to_bytes(film.draw(frame_index)))
        finally:
            film.close()
    except Exception as error:
        frames.put(ERROR_PREFIX + pickle.dumps(make_picklable(error)))
    finally:
        frames.put(None)
        sender.join()


def _send(frames: queue.Queue[bytes | None], pipe: Connection) -> None:
    """Send each image while the next one is drawn."""
    with suppress(OSError):  # the parent has gone
        while (frame := frames.get()) is not None:
            pipe.send_bytes(frame)
