"""Look-up of the bodies of a scene by name: vehicles, links, objects, and the frame L."""

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
    """A named frame of the scene (`uwsim.world.Body`): of a vehicle, a link or an object, or L."""

    def __init__(self, name: str, pose: Callable[[], Pose], box: Box | None) -> None:
        self._name, self._pose, self._box = name, pose, box

    @property
    def name(self) -> str:
        """The route by which the body is found, such as ``girona500/base_link``."""
        return self._name

    @property
    def world_from_body(self) -> Pose:
        """The present pose of the body in W."""
        return self._pose()

    @property
    def box(self) -> Box | None:
        """The bounding box of the visuals in the frame of the body; see `name_bodies`."""
        return self._box


class SceneBodies:
    """The bodies of a scene, by name."""

    def __init__(self, model: SceneModel, engine: Engine) -> None:
        self._bodies = name_bodies(model, engine)

    def find(self, name: str) -> SceneBody:
        """Find the body of a route ``a/b/c``.

        Names between the first and the last are ignored, and so is a leading ``localizedWorld``.
        The name of a link may contain slashes itself, as in ``rov/bluerov2/base_link``.

        Raises:
            UnknownName: no body matches; the error message lists the bodies.
        """
        nodes = [node.strip() for node in name.strip().strip("/").split("/")]
        if nodes[0] == "localizedWorld" and len(nodes) > 1:
            nodes = nodes[1:]
        for key in ("/".join(nodes), f"{nodes[0]}/{nodes[-1]}"):
            if key in self._bodies:
                return self._bodies[key]
        raise UnknownName("body", name, self._bodies)


def name_bodies(model: SceneModel, engine: Engine) -> dict[str, SceneBody]:
    """Return every frame of the scene by its routes; a name that two share is that of the first.

    ``vehicle`` is the base frame of a vehicle, ``vehicle/link`` and ``link`` the kinematic frame of
    a link. ``link@visual`` is the frame of its visual, which the original UWSim means by the
    name of a link; for a link without a visual it is the kinematic frame. The name of an object is
    its mesh frame, whose origin moves with the scale. ``localizedWorld`` is the frame L.

    Objects and ``link@visual`` have the bounding box of their visuals; other frames, and those
    without a visual, have none. The bounding boxes of objects include their ``scaleFactor``; with
    the compatibility quirk ``box-scale`` they do not, as in the original UWSim.
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
            visuals = [f"{name}@visual" for name in names]
            if link.visual is None:
                add(visuals, pose, None)
                continue
            link_from_visual = Pose.from_rpy(link.visual.position, link.visual.rpy)
            mount = engine.poses.mount(index, link.name, link_from_visual)
            pose = partial(engine.poses.mount_pose, mount)
            add(visuals, pose, link_boxes[index, link.name])
    for index, spec in enumerate(scene.objects):
        mesh = spec.object_from_mesh
        origin = np.array(spec.scale_factor) * mesh.position  # (3,) [m]
        object_from_mesh = Pose(origin, mesh.rotation)
        pose = partial(_attached_pose, partial(engine.poses.object, index), object_from_mesh)
        add([spec.name], pose().copy if engine.poses.is_fixed(index) else pose, boxes.get(index))
    return bodies


def _object_boxes(model: SceneModel) -> dict[int, Box]:
    """Return the bounding box of each object that has a visual, by the index of the object."""
    boxes = {part.object: part.model.box for part in model.parts if part.object is not None}
    if "box-scale" in model.compatibility:
        return boxes
    objects = {index: model.scene.objects[index] for index in boxes}
    return {
        index: scaled_box(boxes[index], spec.object_from_mesh.rotation, spec.scale_factor)
        for index, spec in objects.items()
    }


def _link_boxes(model: SceneModel) -> dict[tuple[int, str], Box]:
    """Return the box of each link that has a visual, by vehicle index and name of the link."""
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
                part for part in model.parts if (part.vehicle, part.link) == (index, link.name)
            ]
            frame = engine.poses.link_frame(index, link.name)
            boxes[index, link.name] = _bounding_box(parts, world_from_visual, frame)
    return boxes


def _bounding_box(
    parts: Sequence[Part], world_from_visual: Pose, world_from_link: npt.NDArray[np.float64]
) -> Box:
    """Return the bounding box of all visuals of a link, in its visual frame.

    Args:
        parts: the visuals of the link.
        world_from_visual: the pose of the visual frame in W.
        world_from_link: the frame of the link in W, with the scale of its vehicle, (4, 4) [m].
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
    """Return the bounding box, in the mesh's frame, of a mesh scaled along the axes of its object.

    Args:
        box: the bounding box of the mesh without scale.
        object_from_mesh: the rotation of the mesh in the object, (3, 3).
        scale: the scale along the axes of the object [1].
    """
    if scale == (1.0, 1.0, 1.0):
        return box
    object_scaling = product(np.diag(scale), object_from_mesh)
    scaling = product(object_from_mesh.T, object_scaling)  # in the mesh's frame
    corners = product(box.corners(), scaling.T)  # (8, 3) [m]
    lower, upper = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
    return Box(tuple(lower), tuple(upper))


def find_contact_body(name: str, scene: SceneSpec) -> tuple[Literal["vehicle", "object"], int]:
    """Return the kind and the index of the vehicle or object with this name.

    Raises:
        UnknownName: there is no such vehicle or object.
        UwsimError: the object cannot have contacts.
    """
    vehicles = [vehicle.name for vehicle in scene.vehicles]
    objects = [spec.name for spec in scene.objects]
    if name not in vehicles and name not in objects:
        raise UnknownName("vehicle or object", name, [*vehicles, *objects])
    if name in vehicles:
        return "vehicle", vehicles.index(name)
    solid = scene.solid_objects
    index = objects.index(name)
    if index not in solid:
        solid_names = ", ".join(objects[solid_index] for solid_index in solid)
        reason = (
            "it has no <physics>, nor <u:solid> 1"
            if scene.objects[index].is_solid is None
            else "<u:solid> is 0"
        )
        raise no_contacts_error(name, f"{reason}; solid are: {solid_names or 'none'}")
    return "object", index


def no_contacts_error(name: str, reason: str) -> UwsimError:
    """Return the error for a body that cannot have contacts."""
    return UwsimError(f"{name!r} cannot have contacts: {reason}.", name=name)


def _attached_pose(pose: Callable[[], Pose], a_from_b: Pose) -> Pose:
    return pose() @ a_from_b
