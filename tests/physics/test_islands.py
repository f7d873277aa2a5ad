"""Contacts of many bodies at rest are solved together, and the motion is the same."""

from __future__ import annotations

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from tests.simulation.girona500 import SCENE, make
from uwsim.physics import islands
from uwsim.scene.object import PhysicsSpec
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation

FLOOR, BLACKBOX = (replace(thing, is_solid=None) for thing in read_scene(SCENE).objects[:2])
LOOSE = PhysicsSpec(mass=12.0)
WITHOUT = int(mujoco.mjtDisableBit.mjDSBL_ISLAND)


def boxes(n: int, *, dropped_from: float = 0.0) -> Simulation:
    """A vehicle above ``n`` loose boxes that lie on the floor; the last one may fall, tilted."""
    places = [(1.0 + 0.5 * (k % 5), 0.5 * (k // 5), 4.74) for k in range(n)]
    things = [
        replace(BLACKBOX, name=f"b{k}", position=place, orientation=(0.0, 0.0, 0.0), physics=LOOSE)
        for k, place in enumerate(places)
    ]
    if dropped_from > 0.0:
        x, y, z = places[-1]
        things[-1] = replace(
            things[-1], position=(x, y, z - dropped_from), orientation=(0.7, 0.4, 0.0)
        )
    return make(objects=(FLOOR, *things))


def solves_together(simulation: Simulation) -> bool:
    return bool(simulation.world.engine._model.opt.disableflags & WITHOUT)


def motion(simulation: Simulation) -> np.ndarray:
    row = np.zeros(simulation.world.engine.motion.size)
    simulation.world.engine.motion.read(row)
    return row


def rows(simulation: Simulation) -> int:
    return int(simulation.world.engine._data.nefc)


@pytest.mark.slow
def test_many_boxes_at_rest_are_solved_together_and_few_are_not() -> None:
    many, few = boxes(20), boxes(5)
    for simulation in (many, few):
        simulation.advance(0.002 * (2 * islands.PERIOD + 1))
    assert rows(many) > islands.FEW_ROWS > rows(few)
    assert solves_together(many)
    assert not solves_together(few)


@pytest.mark.slow
def test_a_box_that_tumbles_among_many_at_rest_moves_as_with_islands_alone() -> None:
    free, held = (boxes(20, dropped_from=0.3) for _ in range(2))
    was_together = [False, False]
    for _ in range(1500):
        held.world.engine._model.opt.disableflags &= ~WITHOUT
        free.advance()
        held.advance()
        was_together[solves_together(free)] = True
    assert was_together == [True, True]
    # an edge that hits makes 3e-17 into 25 mm/s for a while, and leaves 0.1 mm
    assert motion(free) == pytest.approx(motion(held), abs=1e-3)


def test_what_follows_a_saved_state_solved_together_is_the_same_to_the_bit() -> None:
    simulation = boxes(20)
    simulation.advance(0.002 * (2 * islands.PERIOD + 10))
    assert solves_together(simulation)
    saved = simulation.save()
    simulation.advance(0.1)
    after = motion(simulation)
    for other in (simulation, boxes(20)):
        other.restore(saved)
        assert solves_together(other)
        other.advance(0.1)
        assert motion(other).tobytes() == after.tobytes()


def test_steps_one_by_one_choose_as_many_at_once() -> None:
    one, all_at_once = boxes(20), boxes(20)
    n = islands.PERIOD + 40
    for _ in range(n):
        one.advance()
    all_at_once.advance(0.002 * n)
    assert motion(one).tobytes() == motion(all_at_once).tobytes()
