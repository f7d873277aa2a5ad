"""Ends a run in which a body has passed through the ground.

Contacts are soft, and ground is plates behind its faces: a body that is loaded heavily, or fast for
the length of a step, may sink through them and fall on below. Looked at once a second: a
simulated vehicle or loose object that was above the ground, an object called ``terrain``, and is
below it by more than its own size and a plate has passed through. What begins below the ground may
stay there, and where there is no ground nothing is below it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path

import numpy as np

from ...errors import SimulationFailed
from ...geometry import Array, Pose
from ...numerics.linear import length
from ...physics.collision.ground import Ground
from ...physics.collision.shapes import THICKNESS, CollisionShape, bounds
from ...physics.compile import object_body, vehicle_body
from ...physics.engine import Engine
from ...scene.spec import SceneSpec
from ...scene.urdf.robot import RobotSpec
from .collision_shapes import standing_faces

PERIOD = 1.0
"""Time between two looks [s]."""


@dataclass(frozen=True, eq=False)
class _Body:
    name: str
    pose: Callable[[], Pose]
    middle: Array  # of its box, in its axes, (3,) [m]
    size: float  # half the diagonal of its box [m]

    def place(self) -> Array:
        """The middle of its box in W, (3,) [m]."""
        place: Array = self.pose().transform(self.middle[None])[0]
        return place


class BelowGround:
    """The check of one simulation.

    Args:
        scene: spec of the scene.
        robots: the robot of each vehicle, by its number.
        shapes: collision shapes of what is simulated, by the name of its body.
        state: where everything is.
        timestep: length of a step [s].
        data_path: folders in which files are looked for.
    """

    def __init__(
        self,
        scene: SceneSpec,
        robots: Mapping[int, RobotSpec],
        shapes: Mapping[str, Sequence[CollisionShape]],
        state: Engine,
        *,
        timestep: float,
        data_path: tuple[Path, ...],
    ) -> None:
        self._scene, self._data_path, self._timestep = scene, data_path, timestep
        self._period = max(1, round(PERIOD / timestep))
        self._looked = 0  # periods that were over at the last look
        self._bodies: list[_Body] = []
        if any(
            thing.is_ground and object_body(i) in shapes for i, thing in enumerate(scene.objects)
        ):
            self._bodies = [*_bodies(scene, robots, shapes, state)]
        self._start = [body.place() for body in self._bodies]

    def look(self, step: int) -> None:
        """Look where the bodies are, if it is time.

        Raises:
            SimulationFailed: one has passed through the ground.
        """
        over = step // self._period
        if over == self._looked or not self._bodies:
            return
        self._looked = over
        for body, start in zip(self._bodies, self._start, strict=True):
            depth = self._depth(body, body.place())
            if depth > 0.0 and self._depth(body, start) == 0.0:
                raise SimulationFailed(
                    f"{body.name!r} has passed through the ground: at {step * self._timestep:g} s "
                    f"it is {depth:.3g} m below 'terrain'. Its load is too heavy, or it is too "
                    f"fast for steps of {self._timestep:g} s; expected shorter steps, or less load."
                )

    def _depth(self, body: _Body, place: Array) -> float:
        """How far a body at a place is below the ground [m]; 0 where it is not, or only in it."""
        least = body.size + THICKNESS
        if place[2] + least > self._highest:
            return 0.0
        level = self._ground.level(place)
        depth = 0.0 if level is None else level - float(place[2])
        return depth if depth > least else 0.0

    @cached_property
    def _ground(self) -> Ground:
        return Ground(self._faces)

    @cached_property
    def _highest(self) -> float:
        """Of the ground [m]."""
        return float(self._faces[:, :, 2].max(initial=-np.inf))

    @cached_property
    def _faces(self) -> Array:
        """Triangles of the ground in W, (n, 3, 3) [m]."""
        found = [np.zeros((0, 3, 3))]
        for i, thing in enumerate(self._scene.objects):
            if thing.is_ground and not thing.solid.is_loose:
                found.append(standing_faces(self._scene, i, thing.solid, self._data_path))
        return np.concatenate(found)


def _bodies(
    scene: SceneSpec,
    robots: Mapping[int, RobotSpec],
    shapes: Mapping[str, Sequence[CollisionShape]],
    state: Engine,
) -> Iterator[_Body]:
    """Simulated vehicles, by their bases, and loose objects."""
    for i, vehicle in enumerate(scene.vehicles):
        name = vehicle_body(i, robots[i].root)
        if state.is_simulated(i) and name in shapes:
            yield _body(vehicle.name, partial(state.poses.vehicle, i), shapes[name])
    for i, thing in enumerate(scene.objects):
        name = object_body(i)
        if thing.solid.is_loose and name in shapes:
            yield _body(thing.name, partial(state.poses.object, i), shapes[name])


def _body(name: str, pose: Callable[[], Pose], shapes: Sequence[CollisionShape]) -> _Body:
    box = bounds(shapes)
    return _Body(name, pose, box.body_from_shape.position, length(np.array(box.size)))
