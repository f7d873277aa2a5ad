"""From a scene to a MuJoCo model: bodies and joints.

Every vehicle becomes a free body with its links as a tree of hinges and slides; every object a
free body. Kinematic vehicles and fixed objects are placed, not simulated: the model then serves
for forward kinematics only. Not modelled yet: mass, contact, hydrodynamics.
"""

from __future__ import annotations

from collections.abc import Mapping

import mujoco

from ..geometry import Pose, quaternion_from_rotation
from ..scene.spec import SceneSpec
from ..scene.urdf import JointSpec, RobotSpec


def vehicle_body(index: int, link: str) -> str:
    """Name in the model of a link of the vehicle number ``index``."""
    return f"vehicle/{index}/{link}"


def vehicle_joint(index: int, joint: str) -> str:
    """Name in the model of a joint of the vehicle number ``index``."""
    return f"vehicle/{index}/joint/{joint}"


def object_body(index: int) -> str:
    """Name in the model of the object number ``index``."""
    return f"object/{index}"


def compile_scene(scene: SceneSpec, robots: Mapping[int, RobotSpec]) -> mujoco.MjModel:
    """Build the MuJoCo model of a scene.

    Args:
        scene: what the file says.
        robots: the robot of each vehicle, by its number in the scene.
    """
    spec = mujoco.MjSpec()
    spec.option.gravity = [0.0, 0.0, 0.0]
    world_from_localized = scene.world_from_localized
    for index, vehicle in enumerate(scene.vehicles):
        base = _add_body(
            spec.worldbody,
            vehicle_body(index, robots[index].root),
            world_from_localized @ vehicle.localized_from_base,
        )
        base.add_freejoint(name=vehicle_joint(index, ""))
        _add_children(base, robots[index], robots[index].root, index)
    for index, thing in enumerate(scene.objects):
        body = _add_body(
            spec.worldbody, object_body(index), world_from_localized @ thing.localized_from_object
        )
        body.add_freejoint(name=f"{object_body(index)}/joint")
    return spec.compile()


def _add_children(body: mujoco.MjsBody, robot: RobotSpec, link: str, index: int) -> None:
    for joint in robot.joints:
        if joint.parent != link:
            continue
        parent_from_child = Pose.from_rpy(joint.position, joint.rpy)
        child = _add_body(body, vehicle_body(index, joint.child), parent_from_child)
        if _moves(joint):
            child.add_joint(
                name=vehicle_joint(index, joint.name),
                type=(
                    mujoco.mjtJoint.mjJNT_SLIDE
                    if joint.kind == "prismatic"
                    else mujoco.mjtJoint.mjJNT_HINGE
                ),
                axis=list(joint.axis),
            )
        _add_children(child, robot, joint.child, index)


def _add_body(parent: mujoco.MjsBody, name: str, parent_from_body: Pose) -> mujoco.MjsBody:
    return parent.add_body(
        name=name,
        pos=parent_from_body.position.tolist(),
        quat=quaternion_from_rotation(parent_from_body.rotation).tolist(),
        mass=1.0,
        inertia=[1.0, 1.0, 1.0],
    )


def _moves(joint: JointSpec) -> bool:
    return joint.kind in ("revolute", "continuous", "prismatic")
