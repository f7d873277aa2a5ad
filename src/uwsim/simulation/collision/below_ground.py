"""Ends a run in which a body has passed through the ground.

Contacts are soft, and ground is plates behind its faces: a body that is loaded heavily, or fast for
the length of a step, may sink through them and fall on below. Twice a second it is looked where
simulated vehicles and loose objects are. One that is wholly below a ground (`solid_grounds`) at two
looks one after another, and was not as the run began, has passed through it. Below a sheet with an
edge it has where it was over the sheet before, and could not have swum around the edge at
`FASTEST`. What begins below the ground may stay there, and where there is no ground nothing is
below it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import NoReturn

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Pose
from ...base.record import Record
from ...errors import SimulationFailed
from ...model.body_names import object_body, vehicle_body
from ...model.collision.shapes import CollisionShape, bounds
from ...model.collision.solid_grounds import SolidGround
from ...model.scene_model import SceneModel
from ...physics.engine import Engine

PERIOD = 0.5
"""Time between two looks [s]."""
FASTEST = 5.0
"""Speed at which a body may have got around an edge [m/s]."""
CORNERS = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) * 2.0 - 1.0


@dataclass(frozen=True, eq=False)
class _Body:
    name: str
    pose: Callable[[], Pose]
    points: Array  # the middle and the corners of its box, in its axes, (9, 3) [m]

    def places(self) -> Array:
        """The middle and the corners of its box in W, (9, 3) [m]."""
        return self.pose().transform(self.points)


@dataclass(slots=True)
class BelowGroundState(Record):
    """What the last look has found."""

    middles: Array
    """The middle of each body in W, (n, 3) [m]."""
    below: npt.NDArray[np.bool_]
    """Whether each body was below each ground, (n, m)."""
    above: npt.NDArray[np.bool_]
    """Whether each body was above each ground, and has not got around it since, (n, m)."""
    n_looks: int = 0
    """The periods that were over."""
    step: int = 0
    """The step of the look."""


class BelowGround:
    """The check of one simulation.

    Args:
        model: of the scene.
        engine: where everything is.
    """

    def __init__(self, model: SceneModel, engine: Engine) -> None:
        self._timestep = model.timestep
        self._period = max(1, round(PERIOD / self._timestep))
        self._bodies = [*_bodies(model, engine)]
        self._grounds = model.grounds if self._bodies else ()
        self._start = [body.places() for body in self._bodies]
        middles = np.array([places[0] for places in self._start]).reshape(-1, 3)
        size = len(self._bodies), len(self._grounds)
        self.state = BelowGroundState(middles, np.zeros(size, bool), np.zeros(size, bool))
        """What the last look has found."""

    @property
    def due(self) -> float:
        """The step of the next look."""
        return (self.state.n_looks + 1) * self._period if self._grounds else math.inf

    def look(self, step: int) -> None:
        """Look where the bodies are, if it is time.

        Raises:
            SimulationFailed: one has passed through the ground.
        """
        over = step // self._period
        if over == self.state.n_looks or not self._grounds:
            return
        elapsed = (step - self.state.step) * self._timestep
        self.state.n_looks, self.state.step = over, step
        places = [body.places() for body in self._bodies]
        for i, k in np.ndindex(self.state.below.shape):
            depth = self._grounds[k].depth(places[i])
            is_below = self._has_passed(i, k, places[i][0], depth, elapsed)
            if is_below and self.state.below[i, k]:
                self._fail(self._bodies[i], self._grounds[k], step, depth)
            self.state.below[i, k] = is_below
        self.state.middles = np.array([points[0] for points in places])

    def _has_passed(self, i: int, k: int, middle: Array, depth: float, elapsed: float) -> bool:
        """Whether body i is below ground k and has passed through it.

        Args:
            i: number of the body.
            k: number of the ground.
            middle: of its box in W, (3,) [m].
            depth: how deep all of it is below [m]; 0 if it is not.
            elapsed: time since the last look [s].
        """
        ground = self._grounds[k]
        way = ground.path_length_around(self.state.middles[i], middle)
        if way == 0.0 and depth == 0.0:  # far away
            self.state.above[i, k] = False
            return False
        if not ground.has_edge:
            return depth > 0.0 and ground.depth(self._start[i]) == 0.0
        if self.state.n_looks == 1:  # for the first time
            self.state.above[i, k] = ground.is_above(self._start[i][0])
        if ground.is_above(middle):
            self.state.above[i, k] = True
        elif way < FASTEST * elapsed:
            self.state.above[i, k] = False
        return depth > 0.0 and bool(self.state.above[i, k])

    def _fail(self, body: _Body, ground: SolidGround, step: int, depth: float) -> NoReturn:
        raise SimulationFailed(
            f"{body.name!r} has passed through the ground: at {step * self._timestep:g} s it is "
            f"{depth:.3g} m below {ground.name!r}. Its load is too heavy, or it is too fast for "
            f"steps of {self._timestep:g} s; expected shorter steps, or less load."
        )


def _bodies(model: SceneModel, engine: Engine) -> Iterator[_Body]:
    """Simulated vehicles, by their bases, and loose objects."""
    scene, shapes = model.scene, model.shapes
    for i, vehicle in enumerate(scene.vehicles):
        name = vehicle_body(i, model.robots[i].root)
        if engine.is_simulated(i) and name in shapes:
            yield _body(vehicle.name, partial(engine.poses.vehicle, i), shapes[name])
    for i, thing in enumerate(scene.objects):
        name = object_body(i)
        if thing.solid.is_loose and name in shapes:
            yield _body(thing.name, partial(engine.poses.object, i), shapes[name])


def _body(name: str, pose: Callable[[], Pose], shapes: Sequence[CollisionShape]) -> _Body:
    box = bounds(shapes)
    points = np.concatenate([np.zeros((1, 3)), CORNERS * np.array(box.size)])
    return _Body(name, pose, box.body_from_shape.transform(points))
