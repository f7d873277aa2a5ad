"""Poses of frames, and placement of vehicles and objects by the program that owns a simulation."""

from __future__ import annotations

from ...base.geometry import Pose
from ...errors import UnknownName, UwsimError
from ..live_scene import LiveScene


def world_from_frame(scene: LiveScene, frame: str) -> Pose:
    """Return the pose in W of a frame; for an object, of the frame of its mesh.

    Args:
        scene: the scene.
        frame: ``L``, ``W`` or the name of a body.

    Raises:
        UnknownName: there is no such body; the error message suggests the nearest name.
    """
    if frame == "W":
        return Pose.identity()
    if frame == "L":
        return scene.model.scene.world_from_localized
    return scene.bodies.find(frame).world_from_body


def place(scene: LiveScene, name: str, world_from_body: Pose) -> None:
    """Set the pose of a vehicle or an object, at rest.

    Args:
        scene: the scene.
        name: the name of a vehicle, or of an object that can move.
        world_from_body: the pose in W of the vehicle's base frame or of the frame of the object's
            mesh, which differs from the frame of its rigid body.

    Raises:
        UnknownName: there is no such vehicle or object; the error message suggests the nearest
            name.
        UwsimError: the object is fixed, or a vehicle holds it.
    """
    vehicles = scene.vehicles
    if name in vehicles.names:
        vehicles.find(name).place(world_from_body)
        return
    names = [scene_object.name for scene_object in scene.model.scene.objects]
    if name not in names:
        raise UnknownName("vehicle or object", name, [*vehicles.names, *names])
    index, engine = names.index(name), scene.engine
    if not engine.grips.can_hold(index):
        raise UwsimError(
            f"{name!r} cannot be placed: it is fixed, or a vehicle holds it. Set "
            f"object[{name}].position when you load the scene, or vary it with <u:vary>."
        )
    mesh_from_world = scene.bodies.find(name).world_from_body.inverse()
    mesh_from_object = mesh_from_world @ engine.poses.object(index)
    engine.grips.place(index, world_from_body @ mesh_from_object)
