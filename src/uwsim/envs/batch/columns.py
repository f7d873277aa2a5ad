"""The columns and codes of the tables that compiled rows read.

A constant is the index of a column, or of the first of several columns; or the code of a channel, a
term or a trajectory. Vectors are in axes of the world (`WORLD`) or of the base (`BASE`).
"""

from __future__ import annotations

# the table of observations: a row for each channel
CHANNEL, AXES, LEAD_TIME, OFFSET = (
    0,
    1,
    2,
    3,
)  # code, axes, time ahead [s], first index of its numbers
CHANNEL_COLUMNS = 4
WORLD, BASE = 0.0, 1.0

POSITION_ERROR = 0.0  # the goal minus the position, at a time ahead (3) [m]
ATTITUDE_ERROR = 1.0  # the rotation from the base to the goal, wxyz with w >= 0 (4)
QUATERNION = 2.0  # the attitude, wxyz with w >= 0 (4)
ROTATION = 3.0  # the rotation matrix of the attitude by rows (9)
LINEAR_VELOCITY = 4.0  # over ground (3) [m/s]
RELATIVE_VELOCITY = 5.0  # through the water at the base (3) [m/s]
ANGULAR_VELOCITY = 6.0  # (3) [rad/s]
GOAL_VELOCITY = 7.0  # of the goal, at a time ahead (3) [m/s]
CURRENT = 8.0  # the velocity of the water (3) [m/s]
LAST_ACTION = 9.0  # the last action (actions)
ACTUATORS = 10.0  # the commands that rotors have reached, or angles of fins (actuators)
POSITION = 11.0  # in W (3) [m]
TIME = 12.0  # since the beginning of the episode (1) [s]

CHANNELS = {
    "position_error": (POSITION_ERROR, 3),
    "attitude_error": (ATTITUDE_ERROR, 4),
    "quaternion": (QUATERNION, 4),
    "rotation": (ROTATION, 9),
    "linear_velocity": (LINEAR_VELOCITY, 3),
    "relative_velocity": (RELATIVE_VELOCITY, 3),
    "angular_velocity": (ANGULAR_VELOCITY, 3),
    "goal_velocity": (GOAL_VELOCITY, 3),
    "current": (CURRENT, 3),
    "last_action": (LAST_ACTION, 0),
    "actuators": (ACTUATORS, 0),
    "position": (POSITION, 3),
    "time": (TIME, 1),
}
"""The code and the number of numbers of each channel by name; 0: as many as actions or actuators.
"""

# the table of rewards: a row for each term, whose weighted values are added
TERM, WEIGHT, SCALE = 0, 1, 2
TERM_COLUMNS = 3

CONSTANT = 0.0  # 1
DISTANCE = 1.0  # the position error e over the scale [m]
CAPPED_DISTANCE = 2.0  # the smaller of 1 and e over the scale [m]
SQUARED_DISTANCE = 3.0  # the square of e over the scale [m]
CLOSENESS = 4.0  # 1 / (1 + (e / scale)^2), with the scale in [m]
ATTITUDE = 5.0  # 2 sin(angle / 2) of the attitude error, over the scale [rad]
SPEED_ERROR = 6.0  # the velocity relative to that of the goal, over the scale [m/s]
EFFORT = 7.0  # the mean square of the actions
CHANGE = 8.0  # the mean square of the changes of the actions
SUCCESS = 9.0  # 1 in the step in which the row succeeds
EXIT = 10.0  # 1 in the step in which the row leaves the region of the task

TERMS = {
    "constant": CONSTANT,
    "distance": DISTANCE,
    "capped_distance": CAPPED_DISTANCE,
    "squared_distance": SQUARED_DISTANCE,
    "closeness": CLOSENESS,
    "attitude": ATTITUDE,
    "speed_error": SPEED_ERROR,
    "effort": EFFORT,
    "change": CHANGE,
    "success": SUCCESS,
    "exit": EXIT,
}
"""The code of each term by name."""

# the row of a trajectory, the same for all rows of a batch
KIND, RADIUS, RATE, CLIMB, FACES_ALONG, LEVEL = 0, 1, 2, 3, 4, 5
"""The code of the kind, the radius [m], the angular speed [rad/s], the speed upwards [m/s], 1 if
the goal's heading is that of its motion, and the attitude of a level base with the heading 0, wxyz
(4)."""
TRAJECTORY_COLUMNS = 9
HOLD, CIRCLE, HELIX, LEMNISCATE = 0.0, 1.0, 2.0, 3.0
TRAJECTORIES = {"hold": HOLD, "circle": CIRCLE, "helix": HELIX, "lemniscate": LEMNISCATE}
"""The code of each trajectory by name."""

# the row of an origin: where the trajectory of one row is
CENTRE, YAW, PHASE = 0, 3, 4  # the centre in W [m], the heading in W [rad], the phase [rad]
ORIGIN_COLUMNS = 5

# the row of a goal at one time: position [m], velocity [m/s], attitude (wxyz)
GOAL_POSITION, GOAL_SPEED, GOAL_ATTITUDE = 0, 3, 6
GOAL_COLUMNS = 10

# the row of sums over an episode
SUM_OF_REWARDS, SUM_OF_ERRORS, SUM_OF_SQUARES, MAX_ERROR, LAST_ERROR, SUM_OF_EFFORT = range(6)
N_INSIDE = 6  # the number of successive steps within the tolerance
TALLY_COLUMNS = 7

# the row of the parameters that are drawn for each episode
PARAMETERS = {
    "start_x": 0.0,
    "start_y": 0.0,
    "start_z": 0.0,
    "start_yaw": 0.0,
    "phase": 0.0,
    "current_speed": 0.0,
    "current_heading": 0.0,
    "mass": 1.0,
    "volume": 1.0,
    "added_mass": 1.0,
    "drag": 1.0,
    "thrust": 1.0,
    "time_constant": 1.0,
    "delay": 0.0,
    "lost_thruster": -1.0,
    "loss": 0.0,
}
"""The nominal value of each parameter by name: the start relative to the goal in W [m, rad], the
phase of the trajectory [rad], the current [m/s] and the direction it flows to [rad], factors of the
vehicle's numbers [1], the delay of actions [steps], and the index of a thruster (-1: none) that
loses a fraction of its thrust."""
(
    START, START_YAW, START_PHASE, CURRENT_SPEED, CURRENT_HEADING, MASS, VOLUME, ADDED_MASS, DRAG,
    THRUST, TIME_CONSTANT, DELAY, LOST_THRUSTER, LOSS,
) = (0, *range(3, 16))  # fmt: skip
"""The columns of the parameters; `START` is the first of three."""
MAX_DELAY = 16
"""The greatest delay of actions [steps]."""
