"""The columns of the tables of the hydrodynamics in a model: parameters of bodies and actuators.

The tables are ``body_user`` and ``actuator_user`` of the model, which MuJoCo preserves when models
are attached, saved, loaded and copied for a batch. Numbers that change during a run (the water's
velocity, faults of thrusters) are in ``userdata`` of the data, and part of the state. A constant
below is the index of a column, or of the first of several columns.
"""

from __future__ import annotations

BODY_COLUMNS = 160
"""The value of ``nuser_body``."""
ACTUATOR_COLUMNS = 68
"""The value of ``nuser_actuator``."""
WATER_COLUMNS = 12
"""The number of columns of a body's row in ``userdata``, about the water at the body in the world
frame: velocity (3) [m/s], acceleration (3) [m/s2], height of the surface above still water [m], its
slope along x [1], angular velocity (3) [rad/s], slope along y [1]. The rows of all bodies are
followed by a number for each actuator: the loss of a thruster, from 0 (healthy) to 1 (dead), or the
commanded angle of a fin [rad]; then by another: the fraction of a thruster's static thrust that is
lost by inflow [1]."""

ELEVATION, SLOPE_X, OMEGA, SLOPE_Y = 6, 7, 8, 11
"""The columns of the surface's elevation, its slopes, and the water's angular velocity."""

# the row of the world body: the water as a whole
MAGIC, SURFACE, DENSITY = 0, 1, 2  # `MAGIC_NUMBER`, height of the still water [m], [kg/m3]
N_LEVELS, LEVELS = 3, 4  # of stratified water: their number; depth [m], density / DENSITY - 1
MAGIC_NUMBER = 0.0196_1998  # marks a model with these tables

# the row of any other body
KIND, DRAG_IMPLICITNESS, DISPLACED_MASS = 0, 1, 2  # a kind below, [1], mass of displaced water [kg]
CENTRE, SHAPE, SIZE = 3, 6, 7  # centre of buoyancy from the reference point [m], shape, size [m]
REFERENCE = 10  # the reference point, about which the matrices are, in body axes (3,) [m]
REACH = 13  # greatest distance of a point of the shape from the centre of buoyancy [m]
LAW = 14  # the drag law; only for diagonal matrices
M_A, LINEAR, QUADRATIC, LIFT = 16, 52, 88, 124  # matrices (6, 6), row by row

DRY_BODY, DIAGONAL_MATRICES, FULL_MATRICES = 0.0, 1.0, 2.0
SPHERE, ELLIPSOID, BOX, CYLINDER, SHRINKING_SPHERE = 0.0, 1.0, 2.0, 3.0, 4.0
DRAG_BY_AXIS, DRAG_BY_SPEED, DRAG_ABOUT_X, DRAG_ABOUT_Y, DRAG_ABOUT_Z = 0.0, 1.0, 2.0, 3.0, 4.0

# the row of an actuator: another actuator, a thruster or a fin
ROLE, NO_ROLE, PROPELLER, FIN = 0, 0.0, 1.0, 2.0

# the row of a thruster
DEAD_ZONE, MIN_THRUST, MAX_THRUST, TORQUE, RADIUS, LAG, FORWARD, BACKWARD = 1, 2, 3, 4, 5, 6, 8, 18
CURVE_TERMS = 9
"""The number of coefficients of the static thrust curve, the factors of x, x^2, ... x^9 [N], from
`FORWARD` or `BACKWARD` on."""
N_ADVANCE, WAKE, ADVANCE = 28, 29, 32  # number of points; wake fraction; J and KT of each point

# the row of a fin, which also has a LAG [s]
MIN_ANGLE, MAX_ANGLE = 2, 3  # [rad]
AREA, SLOPE, STALL, DRAG, INDUCED_DRAG, PLATE, RATE = 8, 9, 10, 11, 12, 13, 14
N_COEFFICIENTS, IS_EVEN, COEFFICIENTS = 28, 29, 32  # number of points; angle, lift, drag of each
