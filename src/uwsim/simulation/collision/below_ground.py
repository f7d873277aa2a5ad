"""A check that ends a run in which a body has passed through the ground.

Contacts are soft, and the contact shape of the ground is a layer of plates behind its faces. A body
under a heavy load, or one that moves far in a step, may sink through these plates and fall on. The
check reads the poses of vehicles with dynamics (their root links) and of loose objects every
`CHECK_PERIOD`, if they have collision shapes. A body has passed through a ground (`solid_grounds`)
if it is wholly below the ground at two consecutive checks, and

- below a ground without an edge: was not below it when the run began. A body that begins below the
  ground may stay there;
- below a ground with an edge, a sheet, around which bodies can move: was above the sheet before,
  and since then too far from the edge to move around it at `MAX_SPEED`.
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
from ...model.collision.shapes import CollisionShape, bounding_box
from ...model.collision.solid_grounds import SolidGround
from ...model.scene_model import SceneModel
from ...physics.engine import Engine

CHECK_PERIOD = 0.5
"""The time between two consecutive checks [s]."""
MAX_SPEED = 5.0
"""The highest speed at which a body can have moved around an edge [m/s]."""
CORNERS = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)]) * 2.0 - 1.0
"""The corners of a box with half edges of 1, (8, 3) [1]."""


@dataclass(frozen=True, eq=False)
class _Body:
    name: str
    pose: Callable[[], Pose]
    points: Array  # the centre and the corners of its bounding box, in its frame, (9, 3) [m]

    def world_points(self) -> Array:
        """Return the centre and the corners of the bounding box in W, (9, 3) [m]."""
        return self.pose().transform(self.points)


@dataclass(slots=True)
class BelowGroundState(Record):
    """The result of the last check, for each body and ground."""

    centres: Array
    """The centre of the bounding box of each body in W, (n bodies, 3) [m]."""
    seems_passed: npt.NDArray[np.bool_]
    """The flags that are True where, at the last check, a body was below a ground that it can only
    have reached through the ground, (n bodies, m grounds)."""
    was_above: npt.NDArray[np.bool_]
    """The flags that are True where a body was above a ground and has not moved around its edge
    since, (n bodies, m grounds)."""
    n_periods: int = 0
    """The number of check periods that have passed."""
    step: int = 0
    """The step of the last check."""


class BelowGround:
    """The check of one simulation for bodies that have passed through the ground."""

    def __init__(self, model: SceneModel, engine: Engine) -> None:
        self._timestep = model.timestep
        self._period = max(1, round(CHECK_PERIOD / self._timestep))
        self._bodies = [*_list_bodies(model, engine)]
        self._grounds = model.grounds if self._bodies else ()
        self._start_points = [body.world_points() for body in self._bodies]
        centres = np.array([points[0] for points in self._start_points]).reshape(-1, 3)
        size = len(self._bodies), len(self._grounds)
        self.state = BelowGroundState(centres, np.zeros(size, bool), np.zeros(size, bool))
        """The result of the last check."""

    @property
    def due(self) -> float:
        """The step of the next check; infinity if there is nothing to check."""
        return (self.state.n_periods + 1) * self._period if self._grounds else math.inf

    def check(self, step: int) -> None:
        """Compare the positions of the bodies with the grounds, if the check is due.

        Raises:
            SimulationFailed: a body has passed through the ground.
        """
        n_periods = step // self._period
        if n_periods == self.state.n_periods or not self._grounds:
            return
        elapsed_time = (step - self.state.step) * self._timestep
        self.state.n_periods, self.state.step = n_periods, step
        points_by_body = [body.world_points() for body in self._bodies]
        for i, k in np.ndindex(self.state.seems_passed.shape):
            depth = self._grounds[k].depth(points_by_body[i])
            seems_passed = self._seems_passed(i, k, points_by_body[i][0], depth, elapsed_time)
            if seems_passed and self.state.seems_passed[i, k]:
                self._fail(self._bodies[i], self._grounds[k], step, depth)
            self.state.seems_passed[i, k] = seems_passed
        self.state.centres = np.array([box_points[0] for box_points in points_by_body])

    def _seems_passed(
        self, i: int, k: int, centre: Array, depth: float, elapsed_time: float
    ) -> bool:
        """Update `was_above`; return whether body i seems to have passed through ground k.

        Args:
            i: the index of the body.
            k: the index of the ground.
            centre: the centre of the body's bounding box in W, (3,) [m].
            depth: the depth of the body's highest point below the ground [m]; 0 if not below.
            elapsed_time: the time since the last check [s].
        """
        ground = self._grounds[k]
        path_length = ground.path_length_around(self.state.centres[i], centre)
        if path_length == 0.0 and depth == 0.0:  # a distant body
            self.state.was_above[i, k] = False
            return False
        if not ground.has_edge:
            return depth > 0.0 and ground.depth(self._start_points[i]) == 0.0
        if self.state.n_periods == 1:  # the first check
            self.state.was_above[i, k] = ground.is_above(self._start_points[i][0])
        if ground.is_above(centre):
            self.state.was_above[i, k] = True
        elif path_length < MAX_SPEED * elapsed_time:
            self.state.was_above[i, k] = False
        return depth > 0.0 and bool(self.state.was_above[i, k])

    def _fail(self, body: _Body, ground: SolidGround, step: int, depth: float) -> NoReturn:
        raise SimulationFailed(
            f"{body.name!r} has passed through the ground: at {step * self._timestep:g} s it is "
            f"{depth:.3g} m below {ground.name!r}. Its load is too heavy, or it is too fast for "
            f"steps of {self._timestep:g} s; expected shorter steps, or less load."
        )


def _list_bodies(model: SceneModel, engine: Engine) -> Iterator[_Body]:
    scene, shapes = model.scene, model.shapes
    for i, vehicle in enumerate(scene.vehicles):
        name = vehicle_body(i, model.robots[i].root)
        if engine.has_dynamics(i) and name in shapes:
            yield _make_body(vehicle.name, partial(engine.poses.vehicle, i), shapes[name])
    for i, spec in enumerate(scene.objects):
        name = object_body(i)
        if spec.is_free and name in shapes:
            yield _make_body(spec.name, partial(engine.poses.object, i), shapes[name])


def _make_body(name: str, pose: Callable[[], Pose], shapes: Sequence[CollisionShape]) -> _Body:
    box = bounding_box(shapes)
    points = np.concatenate([np.zeros((1, 3)), CORNERS * np.array(box.size)])
    return _Body(name, pose, box.body_from_shape.transform(points))
