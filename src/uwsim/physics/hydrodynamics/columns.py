"""The columns of the tables in the model: the parameters of a body and of a thruster.

The tables are ``body_user`` and ``actuator_user`` of the model, which MuJoCo keeps when models are
attached, saved, loaded and copied for a batch. Numbers that change while a simulation runs (the
water's velocity, faults of thrusters) are in ``userdata`` and part of the state.
"""

from __future__ import annotations

BODY_COLUMNS = 160
"""The value of ``nuser_body``."""
ACTUATOR_COLUMNS = 68
"""The value of ``nuser_actuator``."""
WATER_COLUMNS = 12
"""The numbers of a body's row in ``userdata``: velocity (3) [m/s], acceleration (3) [m/s2], height
of the surface above still water [m], spare, angular velocity (3) [rad/s], spare. Behind the rows of
all bodies: the loss of each thruster, 0 (healthy) .. 1 (dead), and the commanded angle of each fin
[rad]; then the share of each thruster's thrust at rest that the inflow takes [1]."""

OMEGA = 8
"""The column of the water's angular velocity."""

# the row of the world body: the water as a whole
MAGIC, SURFACE, DENSITY = 0, 1, 2
N_LEVELS, LEVELS = 3, 4  # of a profile: their number; depth [m], density / DENSITY - 1
MAGIC_NUMBER = 0.0196_1998  # marks our tables

# the row of any other body
KIND, THETA, DISPLACED_MASS = 0, 1, 2  # [0 dry, 1 diagonal matrices, 2 full], [1], [kg]
CENTRE, SHAPE, SIZE = 3, 6, 7  # (3,) [m] from the reference point, 0..4, (3,) [m]
REFERENCE = 10  # (3,) [m] in the body: the point that the matrices are about
REACH = 13  # greatest distance of a point of the shape from the centre of buoyancy [m]
LAW = 14  # of the drag; only where the matrices are diagonal
M_A, LINEAR, QUADRATIC, LIFT = 16, 52, 88, 124  # (6, 6) each, row by row

DRY_BODY, DIAGONAL_MATRICES, FULL_MATRICES = 0.0, 1.0, 2.0
SPHERE, ELLIPSOID, BOX, CYLINDER, SHRINKING_SPHERE = 0.0, 1.0, 2.0, 3.0, 4.0
DRAG_BY_AXIS, DRAG_BY_SPEED, DRAG_ABOUT_X, DRAG_ABOUT_Y, DRAG_ABOUT_Z = 0.0, 1.0, 2.0, 3.0, 4.0

# an actuator: none of ours, a thruster or a fin
ROLE, NO_ROLE, PROPELLER, FIN = 0, 0.0, 1.0, 2.0

# a thruster
DEAD_ZONE, MIN_THRUST, MAX_THRUST, TORQUE, RADIUS, LAG, FORWARD, BACKWARD = 1, 2, 3, 4, 5, 6, 8, 18
CURVE_TERMS = 9
"""The number of coefficients of x, x^2, ... x^9 [N]."""
N_ADVANCE, WAKE, ADVANCE = 28, 29, 32  # points; share of the inflow; J and KT of each point

# a fin: its angle follows with LAG [s]
MIN_ANGLE, MAX_ANGLE = 2, 3
AREA, SLOPE, STALL, DRAG, INDUCED_DRAG, PLATE, RATE = 8, 9, 10, 11, 12, 13, 14
N_COEFFICIENTS, IS_EVEN, COEFFICIENTS = 28, 29, 32  # points; angle, lift and drag of each
