"""Records of autopilots, thrusters and servos: parameters and state, for compiled code."""

from __future__ import annotations

import numpy as np

from .allocation import N_POINTS

_FLAG, _INDEX, _FLOAT = np.int64, np.int64, np.float64

VELOCITY, POSITION, WRENCH, THRUSTERS = range(4)
"""The modes of an autopilot."""

AUTOPILOT = np.dtype(
    [
        ("qpos_address", _INDEX),  # of the base's pose in qpos
        ("dof_address", _INDEX),  # of the base among the degrees of freedom
        ("body", _INDEX),  # the engine's number of the base
        ("is_over_ground", _FLAG),  # true if its velocity loops use the velocity over ground
        ("time_constant", _FLOAT),  # of the reference model [s]
        ("depth_gain", _FLOAT),  # gains, as in `autopilot.Gains` [1/s]
        ("position_gain", _FLOAT),
        ("heading_gain", _FLOAT),
        ("velocity_gain", _FLOAT),  # k_v [1/s]
        ("integral_gain", _FLOAT),  # k_i [1/s2]
        ("mass", _FLOAT, (6,)),  # mass and added mass along the axes [kg, kg m2]
        ("added_mass", _FLOAT, (6,)),  # [kg, kg m2]
        ("linear_damping", _FLOAT, (6,)),  # along the axes
        ("quadratic_damping", _FLOAT, (6,)),
        ("reference_point", _FLOAT, (3,)),  # of forces and velocities, base axes [m]
        ("n_axes", _INDEX),
        ("axes", _INDEX, (6,)),  # the driven axes
        ("n_wrench_axes", _INDEX),
        ("wrench_axes", _INDEX, (6,)),  # the axes of a commanded wrench
        ("driven_mask", _FLOAT, (6,)),  # 1 for each driven axis, 0 for the others
        ("max_forces", _FLOAT, (6,)),  # the greatest force of each axis that limits the tilt [N]
    ],
    align=True,
)
"""The parameters of an autopilot."""

AUTOPILOT_STATE = np.dtype(
    [
        ("mode", _FLAG),
        ("has_news", _FLAG),  # a wrench or thrusts were commanded and are not carried out yet
        ("takes_over", _FLAG),  # the setpoints of depth and heading are not set yet
        ("wanted", _FLOAT, (6,)),  # the commanded twist, base axes [m/s, rad/s]
        ("model", _FLOAT, (6,)),  # the velocity of the reference model [m/s, rad/s]
        ("integral", _FLOAT, (6,)),  # of the velocity error [m, rad]
        ("target", _FLOAT, (3,)),  # setpoint of the position, W [m]
        ("heading", _FLOAT, (3, 3)),  # world_from_base whose yaw is the setpoint
        ("wrench", _FLOAT, (6,)),  # the commanded force and moment about the reference [N, N m]
    ],
    align=True,
)
"""The state of an autopilot."""

THRUSTER = np.dtype(
    [
        ("ctrl_address", _INDEX),  # of its command in ctrl
        ("min_thrust", _FLOAT),  # [N]
        ("max_thrust", _FLOAT),  # [N]
        ("allocation", _FLOAT, (6,)),  # thrust for a unit of each driven axis
        ("wrench", _FLOAT, (6,)),  # along each driven axis for a newton
        ("wrench_allocation", _FLOAT, (6,)),  # thrust for a unit of each axis of a commanded wrench
        ("thrusts", _FLOAT, (N_POINTS,)),  # points of its curve, in rising order [N]
        ("commands", _FLOAT, (N_POINTS,)),  # the commands that give them [1]
    ],
    align=True,
)
"""The parameters of a thruster for an autopilot."""

OWN_VALUE, GEAR_RATIO, SLIDER_CRANK = range(3)
"""The sources of a joint's position: its own value, that of another joint, or a slider crank's."""

JOINT = np.dtype(
    [
        ("qpos_address", _INDEX),  # of the position in qpos
        ("dof_address", _INDEX),  # among the degrees of freedom
        ("ctrl_address", _INDEX),  # in ctrl
        ("kind", _FLAG),
        ("leader", _INDEX),  # the index of the joint that it mimics; below 0 none
        ("multiplier", _FLOAT),
        ("offset", _FLOAT),
        ("lower", _FLOAT),  # [rad or m]
        ("upper", _FLOAT),
        ("stiffness", _FLOAT),  # of its servo [N m/rad or N/m]
        ("damping", _FLOAT),
        ("max_effort", _FLOAT),  # [N m or N]
        ("max_speed", _FLOAT),  # of the target [rad/s or m/s]
    ],
    align=True,
)
"""The parameters of a joint and its servo."""

JOINT_STATE = np.dtype(
    [
        ("is_on", _FLAG),  # true if the servo is on
        ("wanted", _FLOAT),  # the requested position [rad or m]; of joints that do not mimic
        ("speed", _FLOAT),  # of the requested position [rad/s or m/s]
        ("aim", _FLOAT),  # the requested position within the limits, of joints that mimic, too
        ("target", _FLOAT),  # the present target of the servo
        ("step", _FLOAT),  # the last change of the target
        ("integral", _FLOAT),  # effort over stiffness for unknown loads [rad or m]
    ],
    align=True,
)
"""The state of a joint's servo."""
