"""Fingerprints of a trial: hashes of its motion and images that locate where two runs diverge.

The motion of every body is sampled every 16th step and hashed, body by body, from the beginning of
the trial; so are the images on each topic. Periodically a *checkpoint* is stored: the hashes
of all samples so far, four bytes each. A difference changes all later checkpoints, so the first
checkpoint that differs locates the steps, and the body or topic, at which two runs diverged.

A trial has at most 64 checkpoints: when there are more, every second checkpoint is dropped and the
period doubles. The cost is a third of a microsecond per step and a few kilobytes per trial,
however long the trial is.
"""

from __future__ import annotations

import hashlib
import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...simulation import Simulation

SAMPLE_PERIOD = 16
"""The number of steps from one sample to the next."""
BLOCK_SIZE = 4
"""The number of samples that are hashed at a time."""
MAX_CHECKPOINTS = 64
HASH_SIZE = 4
"""The size of each hash in a checkpoint [bytes]."""


@dataclass(frozen=True, kw_only=True)
class Checkpoints:
    """The checkpoints of one trial."""

    period: int
    """The number of steps from one checkpoint to the next."""
    n_steps: int
    """The number of steps of the whole trial; the last checkpoint is at its end."""
    parts: tuple[str, ...]
    """The names of the parts that are hashed separately: bodies, then topics of images."""
    marks: tuple[str, ...]
    """The hashes of all parts at each checkpoint, 8 hexadecimal digits for each part."""

    def as_dict(self) -> dict[str, object]:
        """Return the checkpoints as they are stored."""
        return {
            "every": self.period,
            "steps": self.n_steps,
            "parts": list(self.parts),
            "marks": list(self.marks),
        }

    @staticmethod
    def from_dict(record: Any) -> Checkpoints | None:
        """Read the value of `as_dict`; return None if it is incomplete."""
        try:
            return Checkpoints(
                period=int(record["every"]),
                n_steps=int(record["steps"]),
                parts=tuple(map(str, record["parts"])),
                marks=tuple(map(str, record["marks"])),
            )
        except (KeyError, TypeError, ValueError):
            return None

    def hashes_by_step(self) -> dict[int, tuple[str, ...]]:
        """Return the hashes of the parts at each checkpoint, by the step of the checkpoint."""
        width = 2 * HASH_SIZE
        return {
            min((i + 1) * self.period, self.n_steps): tuple(
                mark[k : k + width] for k in range(0, len(mark), width)
            )
            for i, mark in enumerate(self.marks)
        }


@dataclass(frozen=True, kw_only=True)
class Divergence:
    """The steps between which two executions of a trial diverge, from their checkpoints."""

    last_equal: int
    """The step of the last checkpoint that is equal; 0 if there is none."""
    first_different: int
    """The step of the first checkpoint that differs."""
    parts: tuple[str, ...]
    """The parts that differ at that step; empty if the executions have different parts or
    lengths."""


def divergence(a: Checkpoints, b: Checkpoints) -> Divergence | None:
    """Return the steps between which two executions of a trial diverge; None if they are equal."""
    if a == b:
        return None
    if a.parts == b.parts:
        last_step = 0
        a_hashes, b_hashes = a.hashes_by_step(), b.hashes_by_step()
        for step in (step for step in a_hashes if step in b_hashes):
            pairs = list(zip(a.parts, a_hashes[step], b_hashes[step], strict=False))
            if names := tuple(name for name, a_hash, b_hash in pairs if a_hash != b_hash):
                return Divergence(last_equal=last_step, first_different=step, parts=names)
            last_step = step
        return Divergence(last_equal=last_step, first_different=max(a.n_steps, b.n_steps), parts=())
    return Divergence(last_equal=0, first_different=max(a.n_steps, b.n_steps), parts=())


class Fingerprinter:
    """A recorder of the fingerprints of a simulation while it runs."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation, self._motion = simulation, simulation.world.engine.motion
        self._block = np.zeros((BLOCK_SIZE, self._motion.size))
        self._n = self._step = 0
        ends = np.cumsum([0, *(size for _, size in self._motion.parts)], dtype=int).tolist()
        self._hashes = [
            (slice(start, end), hashlib.blake2b(digest_size=HASH_SIZE))
            for start, end in itertools.pairwise(ends)
        ]
        self._marks: list[str] = []
        self._period = SAMPLE_PERIOD * BLOCK_SIZE
        simulation.watch(self.tick)

    def tick(self) -> None:
        """Sample the state after one more step."""
        self._step += 1
        step = self._step
        if step % SAMPLE_PERIOD:
            return
        self._motion.read(self._block[self._n])
        self._n += 1
        if self._n == BLOCK_SIZE:
            self._hash_block()
        if step % self._period == 0:
            self._hash_block()
            self._set_checkpoint()

    @property
    def fingerprint(self) -> str:
        """The fingerprint of all samples so far, in 16 hexadecimal digits."""
        self._hash_block()
        return hashlib.blake2b(bytes.fromhex(self._digests()), digest_size=8).hexdigest()

    def checkpoints(self) -> Checkpoints:
        """Return the checkpoints so far, with a last one at the current step."""
        self._hash_block()
        step = self._step
        marks = (*self._marks, *([self._digests()] if step % self._period else []))
        return Checkpoints(period=self._period, n_steps=step, parts=self._names(), marks=marks)

    def _hash_block(self) -> None:
        for columns, digest in self._hashes:
            digest.update(self._block[: self._n, columns].tobytes())
        self._n = 0

    def _set_checkpoint(self) -> None:
        self._marks.append(self._digests())
        if len(self._marks) > MAX_CHECKPOINTS:
            self._marks = self._marks[1::2]
            self._period *= 2

    def _digests(self) -> str:
        images = self._simulation.world.images
        hashes = [images[topic].sha256[: 2 * HASH_SIZE] for topic in sorted(images)]
        return "".join([*(digest.hexdigest() for _, digest in self._hashes), *hashes])

    def _names(self) -> tuple[str, ...]:
        return (*(name for name, _ in self._motion.parts), *sorted(self._simulation.world.images))
