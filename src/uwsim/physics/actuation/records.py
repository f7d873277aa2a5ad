"""Records of autopilots, thrusters and servos: parameters and state, for compiled code."""

from __future__ import annotations

import numpy as np

from .allocation import N_POINTS

_FLAG, _PLACE, _NUMBER = np.int64, np.int64, np.float64

VELOCITY, POSITION, WRENCH, THRUSTERS = range(4)
"""Modes of an autopilot."""

AUTOPILOT = np.dtype(
    [
        ("place", _PLACE),  # of the base in qpos
        ("dof", _PLACE),  # of the base among the degrees of freedom
        ("body", _PLACE),  # the base
        ("is_over_ground", _FLAG),  # whether its velocity loop is over ground
        ("lag", _NUMBER),  # with which the model goes after what is wanted [s]
        ("depth", _NUMBER),  # gains, as in `autopilot.Gains` [1/s]
        ("position", _NUMBER),
        ("heading", _NUMBER),
        ("velocity", _NUMBER),  # of the velocity loops [1/s]
        ("integral", _NUMBER),  # [1/s2]
        ("mass", _NUMBER, (6,)),  # and added mass along the axes [kg, kg m2]
        ("added", _NUMBER, (6,)),  # the added mass of it [kg, kg m2]
        ("linear", _NUMBER, (6,)),  # damping along the axes
        ("quadratic", _NUMBER, (6,)),
        ("reference", _NUMBER, (3,)),  # what forces and velocities are about, base axes [m]
        ("n_axes", _PLACE),
        ("axes", _PLACE, (6,)),  # of the forces and moments that the thrusters are to give
        ("n_asked", _PLACE),
        ("asked", _PLACE, (6,)),  # the same of a commanded wrench
        ("drives", _NUMBER, (6,)),  # 1 for each axis that the thrusters drive, 0 for the others
        ("max_force", _NUMBER, (6,)),  # force of an axis at most, lest the hull leans [N]
    ],
    align=True,
)
"""The parameters of an autopilot."""

AUTOPILOT_STATE = np.dtype(
    [
        ("mode", _FLAG),
        ("has_news", _FLAG),  # whether forces or thrusts were commanded and not given yet
        ("takes_over", _FLAG),  # whether depth and heading are still to be taken from the pose
        ("wanted", _NUMBER, (6,)),  # the twist asked for, base axes [m/s, rad/s]
        ("model", _NUMBER, (6,)),  # the velocity that is followed [m/s, rad/s]
        ("integral", _NUMBER, (6,)),  # of the error [m, rad]
        ("target", _NUMBER, (3,)),  # position and height to hold, W [m]
        ("heading", _NUMBER, (3, 3)),  # world_from_base whose yaw is to be held
        ("wrench", _NUMBER, (6,)),  # force and moment about the reference [N, N m]
    ],
    align=True,
)
"""The state of an autopilot."""

THRUSTER = np.dtype(
    [
        ("control", _PLACE),  # its place in ctrl
        ("min_thrust", _NUMBER),  # thrust [N]
        ("max_thrust", _NUMBER),  # [N]
        ("share", _NUMBER, (6,)),  # thrust for a unit of each driven axis
        ("reached", _NUMBER, (6,)),  # the other way: of each driven axis for a newton
        ("nearest", _NUMBER, (6,)),  # thrust for a unit of each axis of a commanded wrench
        ("thrusts", _NUMBER, (N_POINTS,)),  # points of its curve, rising [N]
        ("commands", _NUMBER, (N_POINTS,)),  # that give them [1]
    ],
    align=True,
)
"""A thruster as an autopilot knows it."""

OWN, GEARED, CRANKED = range(3)
"""What a joint's position follows from: its own value, that of another, or a slider crank's."""

JOINT = np.dtype(
    [
        ("place", _PLACE),  # in qpos
        ("dof", _PLACE),  # among the degrees of freedom
        ("control", _PLACE),  # in ctrl
        ("kind", _FLAG),
        ("leader", _PLACE),  # number of the joint that it mimics; below 0 none
        ("multiplier", _NUMBER),
        ("offset", _NUMBER),
        ("lower", _NUMBER),  # [rad or m]
        ("upper", _NUMBER),
        ("stiffness", _NUMBER),  # of its servo [N m/rad or N/m]
        ("damping", _NUMBER),
        ("max_effort", _NUMBER),  # greatest effort [N m or N]
        ("max_speed", _NUMBER),  # greatest speed of the target [rad/s or m/s]
    ],
    align=True,
)
"""The parameters of a joint and its servo."""

JOINT_STATE = np.dtype(
    [
        ("is_on", _FLAG),  # whether the servo is
        ("wanted", _NUMBER),  # where the target is to go [rad or m]; of what mimics nothing
        ("speed", _NUMBER),  # at which that moves on [rad/s or m/s]
        ("aim", _NUMBER),  # that within the limits, and for what mimics, too
        ("target", _NUMBER),  # where the target is now
        ("step", _NUMBER),  # how far it was moved last
        ("integral", _NUMBER),  # effort over stiffness for what the servo cannot know [rad or m]
    ],
    align=True,
)
"""The state of a joint's servo."""
