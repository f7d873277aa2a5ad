"""Types of the records with parameters and state of autopilots, thrusters and servos.

Compiled code reads and writes the records. ``..._address`` fields are indices into the engine's
arrays; W is the world frame.
"""

from __future__ import annotations

import numpy as np

from .allocation import N_POINTS

_FLAG, _INDEX, _FLOAT = np.int64, np.int64, np.float64

VELOCITY, POSITION, WRENCH, THRUSTERS = range(4)
"""The modes of an autopilot."""

AUTOPILOT = np.dtype(
    [
        ("qpos_address", _INDEX),  # of the base's pose in qpos
        ("dof_address", _INDEX),  # of the base's first degree of freedom
        ("body", _INDEX),  # the index of the base among the engine's bodies
        ("is_over_ground", _FLAG),  # 1 if the velocity loops control the velocity over ground
        ("time_constant", _FLOAT),  # the time constant of the reference model [s]
        ("depth_gain", _FLOAT),  # gains, as in `autopilot.Gains` [1/s]
        ("position_gain", _FLOAT),
        ("heading_gain", _FLOAT),
        ("velocity_gain", _FLOAT),  # k_v [1/s]
        ("integral_gain", _FLOAT),  # k_i [1/s2]
        ("mass", _FLOAT, (6,)),  # mass plus added mass along each axis [kg, kg m2]
        ("added_mass", _FLOAT, (6,)),  # added mass along each axis [kg, kg m2]
        ("linear_damping", _FLOAT, (6,)),  # along each axis [N s/m, N m s]
        ("quadratic_damping", _FLOAT, (6,)),  # along each axis [N s2/m2, N m s2]
        ("reference_point", _FLOAT, (3,)),  # the point of forces and velocities, base axes [m]
        ("n_axes", _INDEX),
        ("axes", _INDEX, (6,)),  # the driven axes
        ("n_wrench_axes", _INDEX),
        ("wrench_axes", _INDEX, (6,)),  # the axes of a commanded wrench that are allocated
        ("driven_mask", _FLOAT, (6,)),  # 1 for a driven axis, 0 for the others
        ("max_forces", _FLOAT, (6,)),  # the greatest force along each axis, by the tilt [N]
    ],
    align=True,
)
"""The parameters of an autopilot."""

AUTOPILOT_STATE = np.dtype(
    [
        ("mode", _INDEX),  # one of the modes above
        ("has_new_command", _FLAG),  # 1 until a commanded wrench or thruster command is applied
        ("needs_setpoints", _FLAG),  # 1 until depth and heading are taken as setpoints
        ("commanded_twist", _FLOAT, (6,)),  # in base axes [m/s, rad/s]
        ("reference_twist", _FLOAT, (6,)),  # of the reference model, in base axes [m/s, rad/s]
        ("integral", _FLOAT, (6,)),  # the integral of the twist error, in base axes [m, rad]
        ("position_setpoint", _FLOAT, (3,)),  # in W [m]; z is the setpoint of the depth
        ("heading_setpoint", _FLOAT, (3, 3)),  # a rotation world_from_base; only its yaw is used
        ("commanded_wrench", _FLOAT, (6,)),  # about the reference point, in base axes [N, N m]
    ],
    align=True,
)
"""The state of an autopilot."""

THRUSTER = np.dtype(
    [
        ("ctrl_address", _INDEX),  # of the thruster's command in ctrl
        ("min_thrust", _FLOAT),  # the greatest backward thrust, negative [N]
        ("max_thrust", _FLOAT),  # the greatest forward thrust [N]
        ("allocation", _FLOAT, (6,)),  # thrust per force or moment along each driven axis [1, 1/m]
        ("wrench", _FLOAT, (6,)),  # force or moment along each driven axis per thrust [1, m]
        ("wrench_allocation", _FLOAT, (6,)),  # thrust per unit of each axis of a commanded wrench
        (
            "thrusts",
            _FLOAT,
            (N_POINTS,),
        ),  # the thrusts of the curve's points, ascending [N]
        ("commands", _FLOAT, (N_POINTS,)),  # the commands of the curve's points [1]
    ],
    align=True,
)
"""The parameters of a thruster, for the autopilot."""

OWN_VALUE, GEAR_RATIO, SLIDER_CRANK = range(3)
"""The kinds of joints by the source of their position: the joint vector, the position of a leader
joint by a gear ratio, or the position of a leader joint by a slider crank."""

JOINT = np.dtype(
    [
        ("qpos_address", _INDEX),  # of the joint's position in qpos
        ("dof_address", _INDEX),  # of the joint's degree of freedom
        ("ctrl_address", _INDEX),  # of the servo's control in ctrl
        ("kind", _INDEX),  # one of the kinds above
        ("leader", _INDEX),  # the index of the joint that this joint mimics; below 0 without one
        ("multiplier", _FLOAT),  # the position per position of the leader
        # the position at position 0 of the leader [rad or m]; for a slider crank, the length of the
        # crank over the length of the rod [1]
        ("offset", _FLOAT),
        ("lower", _FLOAT),  # the lower position limit [rad or m]
        ("upper", _FLOAT),  # the upper position limit [rad or m]
        ("stiffness", _FLOAT),  # of the servo [N m/rad or N/m]
        ("damping", _FLOAT),  # of the servo [N m s/rad or N s/m]
        ("max_effort", _FLOAT),  # the greatest effort of the servo [N m or N]
        ("max_speed", _FLOAT),  # the greatest speed of the servo's target [rad/s or m/s]
    ],
    align=True,
)
"""The parameters of a joint and its servo."""

JOINT_STATE = np.dtype(
    [
        ("is_on", _FLAG),  # 1 if the servo is on
        ("requested_position", _FLOAT),  # of a joint that is not a mimic joint [rad or m]
        ("requested_speed", _FLOAT),  # the speed of the requested position [rad/s or m/s]
        ("final_target", _FLOAT),  # the position that the target approaches [rad or m]
        ("target", _FLOAT),  # the present target of the servo [rad or m]
        ("target_change", _FLOAT),  # the change of the target in the last step [rad or m]
        ("integral", _FLOAT),  # the integral term of the effort over the stiffness [rad or m]
    ],
    align=True,
)
"""The state of a joint's servo."""
