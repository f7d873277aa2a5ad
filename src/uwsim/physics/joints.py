"""Joints of a MuJoCo model: their losses, servos, and gears between them."""

from __future__ import annotations

import math

import mujoco

from ..scene.urdf.robot import JointSpec, MimicSpec, RobotSpec

SERVO = (400.0, 60.0)
"""The stiffness [N m/rad] and damping [N m s/rad] of the servo of a joint of great effort."""
FULL_EFFORT = 100.0
"""The effort below which servos are softer in proportion [N m]."""
LEVER = 0.1
"""The lever that converts stiffness and inertia of joints that turn, in N m/rad and kg m2, to those
of joints that slide, in N/m and kg [m]."""
STIFF_FRICTION = [0.9999, 0.9999, 0.001, 0.5, 2.0]
"""The impedance of the dry friction of joints: with the engine's default a held joint creeps."""
GEAR = (500.0, 10.0)
"""The stiffness [N m/rad] and damping between a joint and its leader; a constraint would couple
them, too, and need a solver at every step."""
STOP_MARGIN, STOP_MARGIN_ANGLE = 0.02, 0.1
"""The distance of the end stops beyond the limits of a joint that slides [m] or turns [rad] while a
servo holds it: a joint at its limit does not hit them."""
ROTOR = 0.1
"""The inertia of a motor behind its gear, such as 1e-5 kg m2 behind 100:1 [kg m2]."""


def add_joint(body: mujoco.MjsBody, name: str, joint: JointSpec, *, is_driven: bool) -> None:
    """Add a joint to a link's body; ``is_driven``: with rotor, damping and friction."""
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


def stops(joint: JointSpec, *, is_held: bool) -> tuple[float, float]:
    """Return the end stops of a joint [rad or m]; ``is_held``: a servo holds it.

    A joint without end stops returns 0 and 0, which the engine does not use.
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
    """Couple a joint that mimics to its leader by a stiff spring, as a linkage does."""
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
    """Return stiffness [N m/rad or N/m] and damping of a joint's servo, by its greatest effort."""
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
