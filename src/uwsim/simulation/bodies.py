"""Names to bodies: vehicles, links, objects, and the frame L."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Literal

import numpy as np
import numpy.typing as npt

from ..base.geometry import Pose
from ..base.numerics.linear import product, transform_points
from ..errors import UnknownName, UwsimError
from ..model.parts import Part
from ..model.scene_model import SceneModel
from ..physics.engine import Engine
from ..scene.spec import SceneSpec
from ..world import Box


class SceneBody:
    """A named frame of the scene that moves with it (`uwsim.world.Body`)."""

    def __init__(self, name: str, pose: Callable[[], Pose], box: Box | None) -> None:
        self._name, self._pose, self._box = name, pose, box

    @property
    def name(self) -> str:
        """The route by which it was looked up."""
        return self._name

    @property
    def world_from_body(self) -> Pose:
        """Where it is now."""
        return self._pose()

    @property
    def box(self) -> Box | None:
        """Bounding box of its mesh in its own frame; None without a mesh."""
        return self._box


class SceneBodies:
    """The bodies of a scene by name.

    Args:
        model: of the scene.
        engine: where everything is.
    """

    def __init__(self, model: SceneModel, engine: Engine) -> None:
        self._bodies = name_bodies(model, engine)

    def find(self, name: str) -> SceneBody:
        """Find what a route ``a/b/c`` names; nodes between the first and the last may be skipped.

        The name of a link may have slashes itself, ``rov/bluerov2/base_link``.

        Raises:
            UnknownName: nothing matches; lists what there is.
        """
        nodes = [node.strip() for node in name.strip().strip("/").split("/")]
        if nodes[0] == "localizedWorld" and len(nodes) > 1:
            nodes = nodes[1:]
        for known in ("/".join(nodes), f"{nodes[0]}/{nodes[-1]}"):
            if known in self._bodies:
                return self._bodies[known]
        raise UnknownName("body", name, self._bodies)


def name_bodies(model: SceneModel, engine: Engine) -> dict[str, SceneBody]:
    """Give every frame of the scene its routes; where two share a name, the first has it.

    ``vehicle`` is the base frame, ``vehicle/link`` and ``link`` the kinematic frame of a link,
    ``link@visual`` its visual frame (the original's meaning of a link's name; the kinematic one
    where nothing is seen of the link), an object its mesh frame (scale moves the frame's origin
    and does not turn it), ``localizedWorld`` is L. The boxes of objects are as large as the
    objects; with the compatibility ``box-scale`` their ``scaleFactor`` is left out, as in the
    original.
    """
    scene = model.scene
    bodies = {
        "localizedWorld": SceneBody("localizedWorld", lambda: scene.world_from_localized, None)
    }
    boxes, link_boxes = model.compute_once(_object_boxes), model.compute_once(_link_boxes)
    engine.poses.refresh()  # the state at the start has the poses of all bodies

    def add(names: Sequence[str], pose: Callable[[], Pose], box: Box | None) -> None:
        for name in names:
            bodies.setdefault(name, SceneBody(name, pose, box))

    for index, vehicle in enumerate(scene.vehicles):
        add([vehicle.name], partial(engine.poses.vehicle, index), None)
        for link in model.robots[index].links:
            pose = partial(engine.poses.link, index, link.name)
            names = [f"{vehicle.name}/{link.name}", link.name]
            add(names, pose, None)
            seen = [f"{name}@visual" for name in names]
            if link.visual is None:
                add(seen, pose, None)
                continue
            link_from_visual = Pose.from_rpy(link.visual.position, link.visual.rpy)
            mount = engine.poses.mount(index, link.name, link_from_visual)
            pose = partial(engine.poses.mount_pose, mount)
            add(seen, pose, link_boxes[index, link.name])
    for index, thing in enumerate(scene.objects):
        mesh = thing.object_from_mesh
        origin = np.array(thing.scale_factor) * mesh.position  # (3,) [m]
        object_from_mesh = Pose(origin, mesh.rotation)
        pose = partial(_attached, partial(engine.poses.object, index), object_from_mesh)
        add([thing.name], pose().copy if engine.poses.is_fixed(index) else pose, boxes.get(index))
    return bodies


def _object_boxes(model: SceneModel) -> dict[int, Box]:
    """Return the box of each object that is seen, by its number."""
    boxes = {part.object: part.model.box for part in model.parts if part.object is not None}
    if "box-scale" in model.compatibility:
        return boxes
    things = {index: model.scene.objects[index] for index in boxes}
    return {
        index: scaled_box(boxes[index], thing.object_from_mesh.rotation, thing.scale_factor)
        for index, thing in things.items()
    }


def _link_boxes(model: SceneModel) -> dict[tuple[int, str], Box]:
    """Return the box of each link that is seen, by the number of its vehicle and its name."""
    engine = Engine(model)
    boxes = {}
    for index, robot in model.robots.items():
        for link in robot.links:
            if link.visual is None:
                continue
            link_from_visual = Pose.from_rpy(link.visual.position, link.visual.rpy)
            mount = engine.poses.mount(index, link.name, link_from_visual)
            world_from_visual = engine.poses.mount_pose(mount)
            parts = [
                each for each in model.parts if (each.vehicle, each.link) == (index, link.name)
            ]
            frame = engine.poses.link_frame(index, link.name)
            boxes[index, link.name] = _box_of(parts, world_from_visual, frame)
    return boxes


def _box_of(
    parts: Sequence[Part], world_from_visual: Pose, world_from_link: npt.NDArray[np.float64]
) -> Box:
    """Return the bounding box of all visuals of a link, in its visual frame.

    Args:
        parts: what is seen.
        world_from_visual: the visual frame.
        world_from_link: the link with its vehicle's scale, (4, 4) [m].
    """
    visual_from_link = product(world_from_visual.inverse().matrix, world_from_link)
    corners = np.concatenate(
        [
            transform_points(part.model.box.corners(), matrix[:3, :3], matrix[:3, 3])
            for part in parts
            for matrix in [product(visual_from_link, part.frame_from_mesh)]
        ]
    )  # (8 n, 3) [m]
    lower, upper = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
    return Box(tuple(lower), tuple(upper))


def scaled_box(
    box: Box, object_from_mesh: npt.NDArray[np.float64], scale: tuple[float, float, float]
) -> Box:
    """Return the bounding box, in the mesh's frame, of a mesh that is scaled along other axes.

    Args:
        box: of the mesh as it is in its file.
        object_from_mesh: how the mesh is turned in the object, (3, 3).
        scale: along the axes of the object [1].
    """
    if scale == (1.0, 1.0, 1.0):
        return box
    stretched = product(np.diag(scale), object_from_mesh)
    scaling = product(object_from_mesh.T, stretched)  # in the mesh's frame
    corners = product(box.corners(), scaling.T)  # (8, 3) [m]
    lower, upper = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
    return Box(tuple(lower), tuple(upper))


def touchable(name: str, scene: SceneSpec) -> tuple[Literal["vehicle", "object"], int]:
    """Find the vehicle or object of that name that others can touch: which kind, which number.

    Raises:
        UnknownName: there is none.
        UwsimError: nothing can touch it.
    """
    vehicles = [vehicle.name for vehicle in scene.vehicles]
    objects = [thing.name for thing in scene.objects]
    if name not in vehicles and name not in objects:
        raise UnknownName("vehicle or object", name, [*vehicles, *objects])
    if name in vehicles:
        return "vehicle", vehicles.index(name)
    solid = scene.solid_objects
    index = objects.index(name)
    if index not in solid:
        have = ", ".join(objects[each] for each in solid)
        why = (
            "it has no <physics>, nor <u:solid> 1"
            if scene.objects[index].is_solid is None
            else "<u:solid> is 0"
        )
        raise untouchable(name, f"{why}; solid are: {have or 'none'}")
    return "object", index


def untouchable(name: str, why: str) -> UwsimError:
    """Report that the body of that name cannot have contacts."""
    return UwsimError(f"{name!r} cannot be touched: {why}.", name=name)


def _attached(pose: Callable[[], Pose], a_from_b: Pose) -> Pose:
    return pose() @ a_from_b
