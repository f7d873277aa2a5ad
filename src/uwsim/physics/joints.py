"""Joints of a MuJoCo model: their losses, what drives them, and gears between them."""

from __future__ import annotations

import math

import mujoco

from ..scene.urdf.robot import JointSpec, MimicSpec, RobotSpec

SERVO = (400.0, 60.0)
"""Stiffness [N m/rad] and damping [N m s/rad] of the servo that holds a joint of much effort."""
STRONG = 100.0
"""Servos of less effort than this are softer in proportion [N m]."""
LEVER = 0.1
"""A joint that slides is driven as one that turns with a lever of this length: by it come stiffness
and inertia in N/m and kg from those in N m/rad and kg m2 [m]."""
STIFF_FRICTION = [0.9999, 0.9999, 0.001, 0.5, 2.0]
"""Impedance of the dry friction of joints: with the engine's own a joint that is held creeps."""
GEAR = (500.0, 10.0)
"""Stiffness [N m/rad] and damping between a joint and the one that it mimics; a constraint would
bind them as well, and cost a solver at every step."""
BEYOND, BEYOND_TURN = 0.02, 0.1
"""How far beyond its limits a joint that slides [m] or turns [rad] has its stops while a servo
holds it, so that one that comes to a limit does not hit them."""
ROTOR = 0.1
"""Inertia of a motor behind its gear, such as 1e-5 kg m2 behind 100:1 [kg m2]."""


def add_joint(body: mujoco.MjsBody, name: str, joint: JointSpec, *, is_driven: bool) -> None:
    """Let a link's body turn or slide; ``is_driven`` with rotor, damping and friction."""
    is_slide = joint.kind == "prismatic"
    low, high = stops(joint, is_held=True)
    body.add_joint(
        name=name,
        type=mujoco.mjtJoint.mjJNT_SLIDE if is_slide else mujoco.mjtJoint.mjJNT_HINGE,
        axis=list(joint.axis),
        range=[low, high],
        limited=is_driven and joint.mimic is None and joint.has_stops and low < high,
        armature=ROTOR / _lever(joint) ** 2 if is_driven else 0.0,
        damping=[joint.damping if is_driven else 0.0, 0.0, 0.0],  # the first of a joint of one
        frictionloss=joint.friction if is_driven else 0.0,
        solimp_friction=STIFF_FRICTION,
    )


def stops(joint: JointSpec, *, is_held: bool) -> tuple[float, float]:
    """Where a joint stops, whatever pushes it; ``is_held`` by a servo [rad or m].

    A joint without end stops has 0 to 0, which the engine does not use.
    """
    if not joint.has_stops:
        return 0.0, 0.0
    beyond = BEYOND if joint.kind == "prismatic" else BEYOND_TURN
    if not is_held:
        beyond = 0.0
    return joint.lower - beyond, joint.upper + beyond


def is_geared(joint: JointSpec, robot: RobotSpec) -> bool:
    """Whether a joint is coupled to another by a gear."""
    moving = [other.name for other in robot.joints if other.moves]
    is_bound = joint.mimic is not None and joint.mimic.joint in moving
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
    """Stiffness [N m/rad or N/m] and damping of the servo of a joint, by its greatest effort."""
    lever = _lever(joint)
    share = min(1.0, joint.effort * lever / STRONG)
    return share * SERVO[0] / lever**2, share * SERVO[1] / lever**2


def add_servo(spec: mujoco.MjSpec, name: str, joint: JointSpec) -> None:
    """Hold a joint by a servo."""
    stiffness, damping = servo_gains(joint)
    servo = spec.add_actuator(name=f"{name}/servo", target=name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    servo.set_to_position(kp=stiffness, kv=damping)
    if math.isfinite(joint.effort):
        servo.forcerange = [-joint.effort, joint.effort]
        servo.forcelimited = mujoco.mjtLimited.mjLIMITED_TRUE


def _lever(joint: JointSpec) -> float:
    return LEVER if joint.kind == "prismatic" else 1.0
