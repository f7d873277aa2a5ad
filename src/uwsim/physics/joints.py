"""Joints of the MuJoCo model: damping, friction, servos, gears and end stops; joints of objects."""

from __future__ import annotations

import math

import mujoco

from ..scene.object import HingeSpec, ObjectJointSpec
from ..scene.urdf.robot import JointSpec, MimicSpec, RobotSpec

SERVO = (400.0, 60.0)
"""The stiffness [N m/rad] and damping [N m s/rad] of the servo of a joint with at least the effort
`FULL_EFFORT`."""
FULL_EFFORT = 100.0
"""The greatest effort of a joint below which stiffness and damping of its servo are proportional to
it [N m]."""
LEVER = 0.1
"""The lever arm [m] that converts the stiffness [N m/rad] and the inertia [kg m2] of a revolute
joint to the stiffness [N/m] and the mass [kg] of a prismatic joint."""
STIFF_FRICTION = [0.9999, 0.9999, 0.001, 0.5, 2.0]
"""The impedance of the dry friction of joints; with the engine's default a held joint creeps."""
GEAR = (500.0, 10.0)
"""The stiffness [N m/rad] and damping [N m s/rad] of the spring between a mimic joint and its
leader. An equality constraint would need the constraint solver in every step."""
STOP_MARGIN, STOP_MARGIN_ANGLE = 0.02, 0.1
"""The distance of the end stops beyond the limits of a prismatic joint [m] or revolute joint [rad]
whose servo is on, so that a joint at its limit does not hit the stops."""
ROTOR = 0.1
"""The inertia of a motor at the output of its gear, such as 1e-5 kg m2 with a ratio of 100:1
[kg m2]."""


def add_joint(body: mujoco.MjsBody, name: str, joint: JointSpec, *, is_driven: bool) -> None:
    """Add a joint to the body of a link.

    Args:
        body: the body of the child link.
        name: the name of the joint in the model.
        joint: the spec of the joint.
        is_driven: true for a vehicle with dynamics, whose joint has rotor inertia, damping,
            friction and end stops.
    """
    is_slide = joint.kind == "prismatic"
    low, high = stops(joint, is_held=True)
    body.add_joint(
        name=name,
        type=mujoco.mjtJoint.mjJNT_SLIDE if is_slide else mujoco.mjtJoint.mjJNT_HINGE,
        axis=list(joint.axis),
        range=[low, high],
        limited=is_driven and joint.mimic is None and joint.has_stops and low < high,
        armature=ROTOR / _lever(joint) ** 2 if is_driven else 0.0,
        damping=[joint.damping if is_driven else 0.0, 0.0, 0.0],  # of one degree of freedom
        frictionloss=joint.friction if is_driven else 0.0,
        solimp_friction=STIFF_FRICTION,
    )


def add_fixture_joint(body: mujoco.MjsBody, name: str, joint: ObjectJointSpec) -> None:
    """Add the hinge or slide of an object to its body, through the origin of the object."""
    is_limited = joint.lower is not None and joint.upper is not None
    size = math.sqrt(sum(number * number for number in joint.axis))
    body.add_joint(
        name=name,
        type=mujoco.mjtJoint.mjJNT_HINGE
        if isinstance(joint, HingeSpec)
        else mujoco.mjtJoint.mjJNT_SLIDE,
        axis=[number / size for number in joint.axis],
        range=[joint.lower, joint.upper] if is_limited else [0.0, 0.0],
        limited=is_limited,
        damping=[joint.damping, 0.0, 0.0],  # of one degree of freedom
        stiffness=[joint.stiffness, 0.0, 0.0],
        frictionloss=joint.friction,
        solimp_friction=STIFF_FRICTION,
    )


def stops(joint: JointSpec, *, is_held: bool) -> tuple[float, float]:
    """Return the lower and upper end stop of a joint [rad or m].

    Args:
        joint: the spec of the joint. Without end stops the result is (0, 0), which the engine does
            not use.
        is_held: true if the servo of the joint is on.
    """
    if not joint.has_stops:
        return 0.0, 0.0
    margin = STOP_MARGIN if joint.kind == "prismatic" else STOP_MARGIN_ANGLE
    if not is_held:
        margin = 0.0
    return joint.lower - margin, joint.upper + margin


def is_geared(joint: JointSpec, robot: RobotSpec) -> bool:
    """Return whether a joint is coupled to another by a gear."""
    names = [other.name for other in robot.joints if other.moves]
    is_bound = joint.mimic is not None and joint.mimic.joint in names
    return is_bound and not joint.is_crank


def add_gear(
    spec: mujoco.MjSpec, name: str, leader: str, joint: JointSpec, mimic: MimicSpec
) -> None:
    """Couple a mimic joint to its leader by a stiff spring."""
    stiffness, damping = (gain / _lever(joint) ** 2 for gain in GEAR)
    gear = spec.add_tendon(
        name=f"{name}/gear",
        stiffness=stiffness,
        damping=damping,
        springlength=[mimic.offset] * 2,
    )
    gear.wrap_joint(name, 1.0)
    gear.wrap_joint(leader, -mimic.multiplier)


def servo_gains(joint: JointSpec) -> tuple[float, float]:
    """Return the stiffness [N m/rad or N/m] and the damping of a joint's servo."""
    lever = _lever(joint)
    share = min(1.0, joint.effort * lever / FULL_EFFORT)
    return share * SERVO[0] / lever**2, share * SERVO[1] / lever**2


def add_servo(spec: mujoco.MjSpec, name: str, joint: JointSpec) -> None:
    """Add the servo of a joint."""
    stiffness, damping = servo_gains(joint)
    servo = spec.add_actuator(name=f"{name}/servo", target=name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    servo.set_to_position(kp=stiffness, kv=damping)
    if math.isfinite(joint.effort):
        servo.forcerange = [-joint.effort, joint.effort]
        servo.forcelimited = mujoco.mjtLimited.mjLIMITED_TRUE


def _lever(joint: JointSpec) -> float:
    return LEVER if joint.kind == "prismatic" else 1.0
