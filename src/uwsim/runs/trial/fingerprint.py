"""Fingerprints of a run: hashes of the state that locate where two runs diverge.

The motion of every body is sampled every 16th step and hashed as the run goes on, body by body and
without ever beginning anew; so are the images on each topic. At intervals a *checkpoint* is stored:
the hashes so far, four bytes each. A difference shows in all later checkpoints, so the first one
that differs says between which steps, and in what, two runs diverged.

A trial has at most 64 checkpoints: when there are more every second one is dropped, and the
distance doubles. That costs a third of a microsecond a step and a few kilobytes a trial, however
long the trial is.
"""

from __future__ import annotations

import hashlib
import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...simulation import Simulation

EVERY = 16
"""Steps between two samples."""
BLOCK = 4
"""Samples that are hashed at a time."""
MAX_CHECKPOINTS = 64
BYTES = 4
"""Of each hash in a checkpoint."""


@dataclass(frozen=True, kw_only=True)
class Checkpoints:
    """The checkpoints of one trial."""

    every: int
    """Steps from one checkpoint to the next."""
    n_steps: int
    """Steps of the whole trial; the last checkpoint is at its end."""
    parts: tuple[str, ...]
    """What is hashed: bodies, then topics of images."""
    marks: tuple[str, ...]
    """Hexadecimal, 8 digits a part."""

    def plain(self) -> dict[str, object]:
        """Return it as it is stored."""
        return {
            "every": self.every,
            "steps": self.n_steps,
            "parts": list(self.parts),
            "marks": list(self.marks),
        }

    @staticmethod
    def of(stored: Any) -> Checkpoints | None:
        """Read what `plain` gave; None if it is not whole."""
        try:
            return Checkpoints(
                every=int(stored["every"]),
                n_steps=int(stored["steps"]),
                parts=tuple(map(str, stored["parts"])),
                marks=tuple(map(str, stored["marks"])),
            )
        except (KeyError, TypeError, ValueError):
            return None

    def by_step(self) -> dict[int, tuple[str, ...]]:
        """Return step -> the hash of each part up to there."""
        width = 2 * BYTES
        return {
            min((i + 1) * self.every, self.n_steps): tuple(
                mark[k : k + width] for k in range(0, len(mark), width)
            )
            for i, mark in enumerate(self.marks)
        }


@dataclass(frozen=True, kw_only=True)
class Divergence:
    """Where two traces diverge."""

    after: int
    """They are the same up to this step ..."""
    until: int
    """... and no more by this one."""
    parts: tuple[str, ...]
    """What differs first; empty when the traces are not of one kind."""


def divergence(a: Checkpoints, b: Checkpoints) -> Divergence | None:
    """Return where two traces of one trial diverge; None if they are equal."""
    if a == b:
        return None
    if a.parts == b.parts:
        after = 0
        one, other = a.by_step(), b.by_step()
        for step in (step for step in one if step in other):
            pairs = list(zip(a.parts, one[step], other[step], strict=False))
            if names := tuple(name for name, mine, theirs in pairs if mine != theirs):
                return Divergence(after=after, until=step, parts=names)
            after = step
        return Divergence(after=after, until=max(a.n_steps, b.n_steps), parts=())
    return Divergence(after=0, until=max(a.n_steps, b.n_steps), parts=())


class Fingerprinter:
    """Takes the fingerprints of a simulation while it runs."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation, self._motion = simulation, simulation.world.engine.motion
        self._block = np.zeros((BLOCK, self._motion.size))
        self._n = self._step = 0
        ends = np.cumsum([0, *(size for _, size in self._motion.parts)], dtype=int).tolist()
        self._hashes = [
            (slice(start, end), hashlib.blake2b(digest_size=BYTES))
            for start, end in itertools.pairwise(ends)
        ]
        self._marks: list[str] = []
        self._every = EVERY * BLOCK
        simulation.watch(self.tick)

    def tick(self) -> None:
        """Look at the world after one more step."""
        self._step += 1
        step = self._step
        if step % EVERY:
            return
        self._motion.read(self._block[self._n])
        self._n += 1
        if self._n == BLOCK:
            self._absorb()
        if step % self._every == 0:
            self._absorb()
            self._set_checkpoint()

    @property
    def fingerprint(self) -> str:
        """All that was sampled so far, in 16 hexadecimal digits."""
        self._absorb()
        return hashlib.blake2b(bytes.fromhex(self._digests()), digest_size=8).hexdigest()

    def checkpoints(self) -> Checkpoints:
        """Return the checkpoints, with a last one of the current state."""
        self._absorb()
        step = self._step
        marks = [*self._marks, *([self._digests()] if step % self._every else [])]
        return Checkpoints(every=self._every, n_steps=step, parts=self._names(), marks=tuple(marks))

    def _absorb(self) -> None:
        for columns, digest in self._hashes:
            digest.update(self._block[: self._n, columns].tobytes())
        self._n = 0

    def _set_checkpoint(self) -> None:
        self._marks.append(self._digests())
        if len(self._marks) > MAX_CHECKPOINTS:
            self._marks = self._marks[1::2]
            self._every *= 2

    def _digests(self) -> str:
        images = self._simulation.world.images
        hashes = [images[topic].sha256[: 2 * BYTES] for topic in sorted(images)]
        return "".join([*(digest.hexdigest() for _, digest in self._hashes), *hashes])

    def _names(self) -> tuple[str, ...]:
        return (*(name for name, _ in self._motion.parts), *sorted(self._simulation.world.images))
