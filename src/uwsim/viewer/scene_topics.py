"""What a run tells others of its scene, besides the topics of the scene file.

======================  ==========================================================================
``/robot_description``  the first vehicle's URDF file, latched
``/scene``              the shapes, as markers locked to frames, latched
``/tf_static``          frames that stay: `UP` (W, z up) to the scene's own frame, fixed joints,
                        sensors on links, objects that nothing moves; latched
``/tf``                 frames that move, `RATE` times a second
======================  ==========================================================================

The frames and their names are those of ``<WorldToROSTF>``; what the scene publishes so by itself is
not published again.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..base.geometry import Array
from ..messages import String, TFMessage
from ..messages.build import transform
from ..model.parts import Part
from ..simulation import Simulation
from ..simulation.frames import scene_frames
from ..topics.frames import TF, Frame
from ..topics.world_to_ros_tf import WorldToROSTFSpec
from .shapes import SCENE, shapes

if TYPE_CHECKING:
    from ..middleware.recording import Recorder

UP = "map"
"""Frame of W, as REP 105 calls a frame of the world: z up."""
ROOT = "world"
"""Frame of L, where the scene names none."""
RATE = 30.0
"""Messages on ``/tf`` for each second of simulation time [Hz]."""


class SceneTopics:
    """Publishes them; make it before the simulation is connected.

    Args:
        simulation: of the scene.
        is_on_bus: whether they are topics of the bus, for programs outside. A scene that reads
            ``/tf`` itself is not given any.
    """

    def __init__(self, simulation: Simulation, *, is_on_bus: bool) -> None:
        self._simulation, world = simulation, simulation.world
        own = [
            each for each in world.model.scene.ros_interfaces if isinstance(each, WorldToROSTFSpec)
        ]
        self._root = own[0].root_name.strip().lstrip("/") if own else ROOT
        has_objects = any(each.enable_objects for each in own)
        fixed = {
            each.name
            for i, each in enumerate(world.model.scene.objects)
            if world.engine.poses.is_fixed(i)
        }
        parts = world.model, world.engine, world.vehicles, world.bodies
        vehicles = scene_frames(*parts, with_objects=False)
        objects = scene_frames(*parts, with_objects=True)[len(vehicles) :]
        missing = [] if own else vehicles
        self._moving = [each for each in missing if not each.is_fixed]
        self._fixed = [each for each in missing if each.is_fixed]
        if not has_objects:
            self._moving += [each for each in objects if each.child not in fixed]
            self._fixed += [each for each in objects if each.child in fixed]
        self._recorder: Recorder | None = None
        self._publish_tf = None
        self._latched = tuple(self._published_once())
        if is_on_bus:
            for topic, message in self._latched:
                simulation.bus.publisher(topic, type(message))(message)
            if self._moving and not simulation.bus.has_readers(TF):
                self._publish_tf = simulation.bus.publisher(TF, TFMessage)
        self._is_on_bus = is_on_bus
        if self._moving:
            world.schedule.every(RATE, self._tick)

    def record(self, recorder: Recorder) -> None:
        """Have them recorded, too, from now on."""
        self._recorder = recorder
        for topic, message in self._latched:
            recorder.keep(topic, message)

    def _tick(self) -> None:
        """Publish the frames that move, as they are now, if anybody reads them."""
        if self._is_on_bus:
            if self._publish_tf is not None and self._simulation.bus.has_readers(TF):
                self._publish_tf(self._transforms(self._moving))
        elif self._recorder is not None:
            self._recorder.keep(TF, self._transforms(self._moving))

    def _transforms(self, frames: list[Frame]) -> TFMessage:
        time = self._simulation.time
        return TFMessage(
            transforms=[
                transform(each.parent or self._root, each.child, each.parent_from_child(), time)
                for each in frames
            ]
        )

    def _published_once(self) -> Iterator[tuple[str, Any]]:
        """What is published once."""
        world = self._simulation.world
        robots = world.model.robots
        if robots and (file := Path(robots[0].path)).is_file():
            yield "/robot_description", String(data=file.read_text(encoding="utf-8"))
        up = Frame(UP, self._root, lambda: world.model.scene.world_from_localized, is_fixed=True)
        yield "/tf_static", self._transforms([*([up] if self._root != UP else []), *self._fixed])
        yield f"/{SCENE}", shapes(self._simulation, self._frame_of)

    def _frame_of(self, part: Part) -> tuple[str, Array]:
        """The frame that a part moves with, and ``frame_from_world``."""
        world = self._simulation.world
        poses, scene = world.engine.poses, world.model.scene
        if part.vehicle is not None:
            here = poses.link(part.vehicle, part.link)
            return f"{scene.vehicles[part.vehicle].name}/{part.link}", here.inverse().matrix
        assert part.object is not None
        if poses.is_fixed(part.object):
            return self._root, world.model.scene.world_from_localized.inverse().matrix
        name = scene.objects[part.object].name
        return name, world.bodies.find(name).world_from_body.inverse().matrix
