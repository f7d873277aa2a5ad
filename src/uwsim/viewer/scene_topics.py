"""Topics that describe the scene of a run, in addition to the topics of the scene file.

======================  ==========================================================================
``/robot_description``  the first vehicle's URDF file, latched
``/scene``              the shapes, as markers that are locked to frames, latched
``/tf_static``          fixed transforms: from `MAP_FRAME` (W, z up) to the scene's localized frame
                        L, of fixed joints, of sensors on links, of fixed objects; latched
``/tf``                 moving frames, `TF_RATE` times a second
======================  ==========================================================================

The frames and their names are those of ``<WorldToROSTF>``; frames that the scene itself publishes
are not published again.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..base.geometry import Array
from ..messages import String, TFMessage
from ..messages.build import transform
from ..model.parts import Part
from ..model.segment_names import segment_names
from ..simulation import Simulation
from ..simulation.frames import scene_frames
from ..topics.frames import TF, Frame
from ..topics.world_to_ros_tf import WorldToROSTFSpec
from .shapes import SCENE_TOPIC, shape_markers

if TYPE_CHECKING:
    from ..middleware.recording import Recorder

MAP_FRAME = "map"
"""The name of the world frame W (z up), as in REP 105."""
ROOT_FRAME = "world"
"""The name of the localized frame L, if the scene gives none."""
TF_RATE = 30.0
"""The rate of messages on ``/tf``, in simulation time [Hz]."""


class SceneTopics:
    """The publisher of the topics above; create it before the simulation is connected to ROS.

    Args:
        simulation: the simulation of the scene.
        is_on_bus: True publishes the topics on the bus, for external programs; ``/tf`` only if the
            scene itself does not subscribe to it. False: they are only recorded.
    """

    def __init__(self, simulation: Simulation, *, is_on_bus: bool) -> None:
        self._simulation, world = simulation, simulation.world
        specs = [
            item for item in world.model.scene.ros_interfaces if isinstance(item, WorldToROSTFSpec)
        ]
        self._root = specs[0].root_name.strip().lstrip("/") if specs else ROOT_FRAME
        has_objects = any(item.enable_objects for item in specs)
        fixed = {
            item.name
            for i, item in enumerate(world.model.scene.objects)
            if world.engine.poses.is_fixed(i)
        }
        parts = world.model, world.engine, world.vehicles, world.bodies
        vehicles = scene_frames(*parts, with_objects=False)
        objects = scene_frames(*parts, with_objects=True)[len(vehicles) :]
        links = [] if specs else vehicles
        self._moving_frames = [item for item in links if not item.is_fixed]
        self._fixed_frames = [item for item in links if item.is_fixed]
        if not has_objects:
            self._moving_frames += [item for item in objects if item.child not in fixed]
            self._fixed_frames += [item for item in objects if item.child in fixed]
        self._recorder: Recorder | None = None
        self._publish_tf = None
        self._latched_messages = tuple(self._make_latched_messages())
        if is_on_bus:
            for topic, message in self._latched_messages:
                simulation.bus.publisher(topic, type(message))(message)
            if self._moving_frames and not simulation.bus.has_subscribers(TF):
                self._publish_tf = simulation.bus.publisher(TF, TFMessage)
        self._is_on_bus = is_on_bus
        if self._moving_frames:
            world.schedule.create_timer(TF_RATE, self._tick)

    def record(self, recorder: Recorder) -> None:
        """Record the topics, too, from the next step on."""
        self._recorder = recorder
        for topic, message in self._latched_messages:
            recorder.keep(topic, message)

    def _tick(self) -> None:
        """Publish or record the present poses of the moving frames."""
        if self._is_on_bus:
            if self._publish_tf is not None and self._simulation.bus.has_subscribers(TF):
                self._publish_tf(self._transforms(self._moving_frames))
        elif self._recorder is not None:
            self._recorder.keep(TF, self._transforms(self._moving_frames))

    def _transforms(self, frames: list[Frame]) -> TFMessage:
        time = self._simulation.time
        return TFMessage(
            transforms=[
                transform(frame.parent or self._root, frame.child, frame.parent_from_child(), time)
                for frame in frames
            ]
        )

    def _make_latched_messages(self) -> Iterator[tuple[str, Any]]:
        world = self._simulation.world
        robots = world.model.robots
        if robots and (file := Path(robots[0].path)).is_file():
            yield "/robot_description", String(data=file.read_text(encoding="utf-8"))
        pose = world.model.scene.world_from_localized
        frames = [Frame(MAP_FRAME, self._root, lambda: pose, is_fixed=True)]
        frames = [*(frames if self._root != MAP_FRAME else []), *self._fixed_frames]
        yield "/tf_static", self._transforms(frames)
        yield f"/{SCENE_TOPIC}", shape_markers(self._simulation, self._frame_of)

    def _frame_of(self, part: Part) -> tuple[str, Array]:
        """Return the name of the frame of a part's body, and ``frame_from_world``, (4, 4)."""
        world = self._simulation.world
        poses, scene = world.engine.poses, world.model.scene
        if part.vehicle is not None:
            world_from_link = poses.link(part.vehicle, part.link)
            name = f"{scene.vehicles[part.vehicle].name}/{part.link}"
            return name, world_from_link.inverse().matrix
        if part.object is None:
            name = dict(segment_names(scene))[part.link]
            return name, poses.segment(part.link).inverse().matrix
        if poses.is_fixed(part.object):
            return self._root, world.model.scene.world_from_localized.inverse().matrix
        name = scene.objects[part.object].name
        return name, world.bodies.find(name).world_from_body.inverse().matrix
