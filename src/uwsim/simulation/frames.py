"""The tree of frames of a scene: vehicles, links, sensors, objects."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

from ..base.geometry import Pose
from ..model.scene_model import SceneModel
from ..model.segment_names import segment_names
from ..physics.engine import Engine
from ..scene.spec import SceneSpec
from ..topics.frames import Frame
from ..world import Body
from .bodies import SceneBodies
from .vehicles import SceneVehicles


def scene_frames(
    model: SceneModel,
    engine: Engine,
    vehicles: SceneVehicles,
    bodies: SceneBodies,
    *,
    with_objects: bool,
) -> list[Frame]:
    """List the frames of vehicles, links and sensors.

    With ``with_objects``, the frames of objects and of the segments of tethers are included.
    """
    frames = [*_vehicle_frames(model, engine, vehicles)]
    if not with_objects:
        return frames
    return [*frames, *_object_frames(model.scene, bodies), *_segment_frames(model.scene, engine)]


def _vehicle_frames(model: SceneModel, engine: Engine, vehicles: SceneVehicles) -> Iterator[Frame]:
    """Yield the frames of vehicles, links and sensors, without sensors on missing links."""
    scene = model.scene
    localized_from_world = scene.world_from_localized.inverse()
    for index, (spec, vehicle) in enumerate(zip(scene.vehicles, vehicles, strict=True)):
        robot = model.robots[index]
        pose = _compose(localized_from_world, partial(engine.poses.vehicle, index))
        yield Frame("", spec.name, pose)
        yield Frame(spec.name, f"{spec.name}/{robot.root}", Pose.identity, is_fixed=True)
        links = {link.name: partial(engine.poses.link, index, link.name) for link in robot.links}
        for joint in robot.joints:
            parent, child = f"{spec.name}/{joint.parent}", f"{spec.name}/{joint.child}"
            parent_from_child = _relative_pose(links[joint.parent], links[joint.child])
            yield Frame(parent, child, parent_from_child, is_fixed=not joint.moves)
        for sensor in (part for owner, part in model.mounted_sensors if owner == index):
            if (link := links.get(sensor.relative_to)) is not None:
                sensor_from_frame = Pose.from_rpy((0.0, 0.0, 0.0), sensor.frame_rpy)
                frame = _frame_pose(vehicle.mount(sensor), sensor_from_frame)
                parent = f"{spec.name}/{sensor.relative_to}"
                yield Frame(parent, sensor.name, _relative_pose(link, frame), is_fixed=True)


def _object_frames(scene: SceneSpec, bodies: SceneBodies) -> Iterator[Frame]:
    """Yield the mesh frames of all objects in L; the first of several objects with one name."""
    localized_from_world = scene.world_from_localized.inverse()
    for name in dict.fromkeys(spec.name for spec in scene.objects):
        body = bodies.find(name)
        yield Frame("", name, _compose(localized_from_world, _frame_pose(body, Pose.identity())))


def _segment_frames(scene: SceneSpec, engine: Engine) -> Iterator[Frame]:
    """Yield the frames in L of the segments of tethers, ``tether/0``, ``tether/1`` ..."""
    localized_from_world = scene.world_from_localized.inverse()
    for body, name in segment_names(scene):
        pose = _compose(localized_from_world, partial(engine.poses.segment, body))
        yield Frame("", name, pose)


def _frame_pose(body: Body, body_from_frame: Pose) -> Callable[[], Pose]:
    return lambda: body.world_from_body @ body_from_frame


def _compose(a_from_world: Pose, world_from_b: Callable[[], Pose]) -> Callable[[], Pose]:
    return lambda: a_from_world @ world_from_b()


def _relative_pose(
    world_from_a: Callable[[], Pose], world_from_b: Callable[[], Pose]
) -> Callable[[], Pose]:
    return lambda: world_from_a().inverse() @ world_from_b()
