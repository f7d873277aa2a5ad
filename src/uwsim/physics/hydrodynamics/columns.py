"""Columns of the tables inside the model: the parameters of a body and of a thruster.

The tables are ``body_user`` and ``actuator_user`` of the model, so that they survive attaching,
saving and loading, and copies for a batch. What changes while a simulation runs (the water's
velocity, faults of thrusters) lies in ``userdata`` and is part of the state.
"""

from __future__ import annotations

BODY_COLUMNS = 160
"""``nuser_body``."""
ACTUATOR_COLUMNS = 68
"""``nuser_actuator``."""
WATER_COLUMNS = 12
"""Of a body's row in ``userdata``: velocity (3) [m/s], acceleration (3) [m/s2], elevation of the
surface above its still height [m], spare, rotation (3) [rad/s], spare. Behind the rows of all
bodies: of each thruster the loss, 0 (healthy) .. 1 (dead), of each fin the angle that is wanted
[rad]; then of each thruster the share of its thrust at rest that the inflow takes [1]."""

TURN = 8
"""Where the rotation is."""

# the row of the world body: the water as a whole
MAGIC, SURFACE, DENSITY = 0, 1, 2
N_LEVELS, LEVELS = 3, 4  # of a profile: how many; depth [m] and density / DENSITY - 1 of each
MAGIC_NUMBER = 0.0196_1998  # nobody else's body_user begins like this

# the row of any other body
KIND, THETA, DISPLACED = 0, 1, 2  # [0 dry, 1 diagonal matrices, 2 full], [1], [kg]
CENTRE, SHAPE, SIZE = 3, 6, 7  # (3,) [m] from the reference point, 0..4, (3,) [m]
REFERENCE = 10  # (3,) [m] in the body: the point the matrices are about
REACH = 13  # distance from the centre of buoyancy that no point of the shape exceeds [m]
LAW = 14  # of the drag; only where the matrices are diagonal
ADDED, LINEAR, QUADRATIC, LIFT = 16, 52, 88, 124  # (6, 6) each, row by row

DRY, DIAGONAL, FULL = 0.0, 1.0, 2.0
SPHERE, ELLIPSOID, BOX, CYLINDER, SHRINKING_SPHERE = 0.0, 1.0, 2.0, 3.0, 4.0
BY_AXIS, BY_SPEED, ABOUT_X, ABOUT_Y, ABOUT_Z = 0.0, 1.0, 2.0, 3.0, 4.0

# an actuator: none of ours, a thruster or a fin
ROLE, NO_ROLE, PROPELLER, FIN = 0, 0.0, 1.0, 2.0

# a thruster
DEAD_ZONE, MIN_THRUST, MAX_THRUST, TORQUE, RADIUS, LAG, FORWARD, BACKWARD = 1, 2, 3, 4, 5, 6, 8, 18
CURVE_TERMS = 9
"""Coefficients of x, x^2, ... x^9 [N]."""
N_ADVANCE, WAKE, ADVANCE = 28, 29, 32  # points; share of the inflow; J and KT of each point

# a fin: its angle follows with LAG [s]
MIN_ANGLE, MAX_ANGLE = 2, 3
AREA, SLOPE, STALL, DRAG, INDUCED, PLATE, RATE = 8, 9, 10, 11, 12, 13, 14
N_COEFFICIENTS, IS_EVEN, COEFFICIENTS = 28, 29, 32  # points; angle, lift and drag of each
