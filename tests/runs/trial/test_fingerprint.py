"""Fingerprints of a run: where two runs part, and in what."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.runs.trial.fingerprint import (
    MAX_CHECKPOINTS,
    SAMPLE_PERIOD,
    Checkpoints,
    Fingerprinter,
    divergence,
)
from uwsim.scene.spec import SceneSpec


class FakeMotion:
    """Two bodies, the second of one number."""

    parts = (("rov", 2), ("box", 1))
    size = 3

    def __init__(self) -> None:
        self.row = np.zeros(3)

    def read(self, into: np.ndarray) -> None:
        into[:] = self.row


class FakeImages:
    def __init__(self) -> None:
        self.digest = hashlib.sha256()

    @property
    def sha256(self) -> str:
        return self.digest.hexdigest()


class FakeSimulation:
    """Moves as ``bump`` says."""

    def __init__(self) -> None:
        engine = SimpleNamespace(motion=FakeMotion())
        self.world = SimpleNamespace(engine=engine, images={"/camera": FakeImages()})
        self.look: Callable[[], None] = lambda: None

    def watch(self, look: Callable[[], None]) -> None:
        self.look = look


def traced(
    n_steps: int, bump: Callable[[int, FakeSimulation], None] | None = None, *, flush: int = 0
) -> Checkpoints:
    simulation = FakeSimulation()
    fingerprinter = Fingerprinter(cast(Any, simulation))
    for step in range(1, n_steps + 1):
        simulation.world.engine.motion.row[:] = (step, 2 * step, 5.0)
        if bump is not None:
            bump(step, simulation)
        simulation.look()
        if flush and step % flush == 0:
            assert len(fingerprinter.fingerprint) == 16
    return fingerprinter.checkpoints()


def test_the_same_motion_leaves_the_same_trace_however_often_it_is_asked() -> None:
    assert traced(1000) == traced(1000)
    assert traced(1000) == traced(1000, flush=7)
    assert divergence(traced(1000), traced(1000)) is None


@pytest.mark.parametrize("n_steps", [1, 63, 64, 65, 4096, 4160, 4161, 100_000])
def test_there_are_never_more_marks_than_fit_and_the_last_is_at_the_end(n_steps: int) -> None:
    checkpoints = traced(n_steps)
    assert len(checkpoints.marks) <= MAX_CHECKPOINTS + 1
    assert list(checkpoints.hashes_by_step())[-1] == n_steps
    assert checkpoints.period * len(checkpoints.marks) >= n_steps
    assert n_steps < 1000 or len(checkpoints.marks) >= MAX_CHECKPOINTS // 4
    assert {len(mark) for mark in checkpoints.marks} == {8 * 3}


def test_marks_that_are_kept_are_those_of_the_finer_trace() -> None:
    fine, coarse = traced(4096), traced(8192)
    assert coarse.period == 2 * fine.period
    assert coarse.marks[: len(fine.marks) // 2] == fine.marks[1::2]


@pytest.mark.parametrize("at", [SAMPLE_PERIOD, 160, 1600, 9984])
def test_the_interval_and_the_body_of_a_difference_are_named(at: int) -> None:
    def nudge(step: int, simulation: FakeSimulation) -> None:
        if step == at:
            simulation.world.engine.motion.row[2] = np.nextafter(5.0, 6.0)

    found = divergence(traced(10_000), traced(10_000, nudge))
    assert found is not None
    assert found.last_equal < at <= found.first_different
    assert found.first_different - found.last_equal <= 256
    assert found.parts == ("box",)


def test_an_image_that_differs_is_named_by_its_topic() -> None:
    def capture(step: int, simulation: FakeSimulation) -> None:
        simulation.world.images["/camera"].digest.update(b"b" if step == 300 else b"a")

    def same(step: int, simulation: FakeSimulation) -> None:
        simulation.world.images["/camera"].digest.update(b"a")

    found = divergence(traced(1000, same), traced(1000, capture))
    assert found is not None
    assert (found.last_equal, found.first_different, found.parts) == (256, 320, ("/camera",))


def test_a_run_that_ends_earlier_parts_where_it_ends() -> None:
    found = divergence(traced(64 * 10), traced(64 * 20))
    assert found is not None
    assert (found.last_equal, found.first_different) == (640, 1280)
    found = divergence(traced(8192), traced(10_000))  # the one has twice the distance of the other
    assert found is not None
    assert (found.last_equal, found.first_different) == (8192, 10_000)


def test_traces_of_other_bodies_cannot_be_compared() -> None:
    one = traced(1000)
    found = divergence(one, replace(one, parts=("rov", "tin", "/camera")))
    assert found is not None
    assert found.parts == ()


def test_a_trace_is_read_back_as_it_was_stored() -> None:
    checkpoints = traced(1000)
    assert Checkpoints.from_dict(checkpoints.as_dict()) == checkpoints
    assert Checkpoints.from_dict(None) is None
    assert Checkpoints.from_dict({"every": 1}) is None


def test_a_scene_in_which_nothing_can_move_leaves_a_trace_too() -> None:
    simulation = open_scene(SceneSpec())
    fingerprinter = Fingerprinter(simulation)
    simulation.advance(0.0)
    for _ in range(100):
        simulation.advance()
    assert len(fingerprinter.fingerprint) == 16
    assert fingerprinter.checkpoints().n_steps == 100
