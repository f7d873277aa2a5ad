r"""The equations of motion of Prestero's thesis (2001) on the REMUS, for an independent integrator.

Prestero, Verification of a six-degree of freedom simulation model for the REMUS autonomous
underwater vehicle, MSc thesis, MIT and WHOI 2001: the equations with the combined ("total")
coefficients, the "adjusted" ones where he gives both. Axes: x forward, y to starboard, z down; the
origin is the centre of buoyancy. Positive rudders push the stern to starboard, positive stern
planes push it up. The thesis's thrust and propeller torque are those of 1500 rpm at 1.54 m/s.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from tests.algorithms.fake_node import FakeNode
from uwsim.algorithms.manoeuvres import ManoeuvreNode
from uwsim.base.geometry import quaternion_from_rotation, rotation_from_rpy
from uwsim.benchmark.metrics.manoeuvres import ManoeuvreTrack
from uwsim.manoeuvres.run import make_track
from uwsim.messages import (
    Odometry,
    Point,
    Pose,
    PoseWithCovariance,
    Quaternion,
    Twist,
    TwistWithCovariance,
    Vector3,
    header,
)

M, W, B, ZG = 299.0 / 9.81, 299.0, 306.0, 0.0196
IXX, IYY, IZZ = 0.177, 3.45, 3.45
THRUST, TORQUE = 3.86, -0.543
FIN_LIFT, FIN_ARM = 9.64, 0.638
"""The lift of a pair of fins over u^2 and angle [kg/m], and its distance behind the origin [m]."""
FINS = (
    (np.array([-FIN_ARM, 0.0, -0.11]), True),
    (np.array([-FIN_ARM, 0.0, 0.11]), True),
    (np.array([-FIN_ARM, -0.11, 0.0]), False),
    (np.array([-FIN_ARM, 0.11, 0.0]), False),
)
"""The places of the fins [m]; True: a rudder."""
LENGTH = 1.33  # [m]
MASS = np.array(
    [
        [M + 0.93, 0.0, 0.0, 0.0, M * ZG, 0.0],
        [0.0, M + 35.5, 0.0, -M * ZG, 0.0, -1.93],
        [0.0, 0.0, M + 35.5, 0.0, 1.93, 0.0],
        [0.0, -M * ZG, 0.0, IXX + 0.0704, 0.0, 0.0],
        [M * ZG, 0.0, 1.93, 0.0, IYY + 4.88, 0.0],
        [0.0, -1.93, 0.0, 0.0, 0.0, IZZ + 4.88],
    ]
)
U, V, WW, P, Q, R, X, Y, Z, PHI, THETA, PSI = range(12)
"""The indices of the state (12,): body velocities, position and roll, pitch, yaw."""

Commands = Callable[[float, np.ndarray], tuple[float, float, float]]
"""A function of time [s] and state that returns rudder, stern planes [rad], propeller (1 or -1)."""
StateRate = Callable[[np.ndarray, float, float, float], np.ndarray]
"""A function of state, rudder, stern planes [rad] and propeller that returns the state's rate."""


def state_rate(state: np.ndarray, rudder: float, planes: float, propeller: float) -> np.ndarray:
    """Return the rate of (u v w p q r x y z phi theta psi), (12,)."""
    u, v, w, p, q, r, _, _, _, phi, theta, psi = state
    s1, c1, s2, c2 = math.sin(phi), math.cos(phi), math.sin(theta), math.cos(theta)
    s3, c3 = math.sin(psi), math.cos(psi)
    # fmt: off
    forces = [
        -(W - B) * s2 - 1.62 * u * abs(u) + (-35.5 - M) * w * q - 1.93 * q**2
        + (35.5 + M) * v * r - 1.93 * r**2 - M * ZG * p * r + THRUST * propeller,
        (W - B) * c2 * s1 - 1310.0 * v * abs(v) + 0.632 * r * abs(r) - 28.6 * u * v
        + (35.5 + M) * w * p + (5.22 - M) * u * r - M * ZG * q * r + 1.93 * p * q
        + 9.64 * u**2 * rudder,
        (W - B) * c2 * c1 - 1310.0 * w * abs(w) - 0.632 * q * abs(q) - 28.6 * u * w
        + (-5.22 + M) * u * q + (-35.5 - M) * v * p + M * ZG * (p**2 + q**2) + 1.93 * r * p
        - 9.64 * u**2 * planes,
        -ZG * W * c2 * s1 - 0.13 * p * abs(p) - (IZZ - IYY) * q * r - M * ZG * w * p
        + M * ZG * u * r + TORQUE * propeller,
        -ZG * W * s2 + 3.18 * w * abs(w) - 188.0 * q * abs(q) + (4.86 - (IXX - IZZ)) * r * p
        + M * ZG * v * r - M * ZG * w * q - 2.0 * u * q + 24.0 * u * w - 1.93 * v * p
        - 6.15 * u**2 * planes,
        -3.18 * v * abs(v) - 94.0 * r * abs(r) - 24.0 * u * v + (-4.86 - (IYY - IXX)) * p * q
        - 1.93 * w * p - 2.0 * u * r - 6.15 * u**2 * rudder,
    ]
    velocities = [
        c3 * c2 * u + (c3 * s2 * s1 - s3 * c1) * v + (s3 * s1 + c3 * c1 * s2) * w,
        s3 * c2 * u + (c1 * c3 + s1 * s2 * s3) * v + (c1 * s2 * s3 - c3 * s1) * w,
        -s2 * u + c2 * s1 * v + c1 * c2 * w,
        p + s1 * s2 / c2 * q + c1 * s2 / c2 * r,
        c1 * q - s1 * r,
        s1 / c2 * q + c1 / c2 * r,
    ]
    # fmt: on
    return np.concatenate([np.linalg.solve(MASS, forces), velocities])


def foil_rate(state: np.ndarray, rudder: float, planes: float, propeller: float) -> np.ndarray:
    """Return the rate of the state with foils in place of the published, linear fins.

    A foil pushes by L = S a (delta - atan2(v, u)) V^2, normal to the flow (u, v) at its place.
    """
    rate = state_rate(state, rudder, planes, propeller)
    u, v, w, _, q, r = state[:6]
    side = FIN_LIFT * (u * u * rudder - u * v + FIN_ARM * u * r)
    down = -FIN_LIFT * (u * u * planes + u * w + FIN_ARM * u * q)
    change = -np.array([0.0, side, down, 0.0, FIN_ARM * down, -FIN_ARM * side])
    for place, is_rudder in FINS:
        flow = state[:3] + np.cross(state[3:6], place)
        across = flow[1] if is_rudder else -flow[2]
        angle = rudder if is_rudder else planes
        speed = math.hypot(flow[0], across)
        lift = 0.5 * FIN_LIFT * (angle - math.atan2(across, flow[0])) * speed
        along, normal = -lift * across, lift * flow[0]
        force = np.array([along, normal, 0.0] if is_rudder else [along, 0.0, -normal])
        change += np.concatenate([force, np.cross(place, force)])
    rate[:6] += np.linalg.solve(MASS, change)
    return rate


def simulate(
    commands: Commands,
    duration: float,
    *,
    speed: float = 1.54,
    interval: float = 0.02,
    rate: StateRate = state_rate,
) -> np.ndarray:
    """Integrate from level motion at ``speed``; commands change at each interval.

    Returns:
        Rows of time and state (n, 13), at each interval.
    """
    state = np.zeros(12)
    state[U] = speed
    rows = [np.concatenate([[0.0], state])]
    for k in range(round(duration / interval)):
        state = advance(state, commands(k * interval, state), interval, rate=rate)
        rows.append(np.concatenate([[(k + 1) * interval], state]))
    return np.array(rows)


def advance(
    state: np.ndarray,
    commands: tuple[float, float, float],
    interval: float,
    n: int = 2,
    rate: StateRate = state_rate,
) -> np.ndarray:
    """Return the state after an interval with constant commands, by n steps of RK4."""
    h = interval / n
    for _ in range(n):
        k1 = rate(state, *commands)
        k2 = rate(state + 0.5 * h * k1, *commands)
        k3 = rate(state + 0.5 * h * k2, *commands)
        k4 = rate(state + h * k3, *commands)
        state = state + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    return state


def run_program(
    node: ManoeuvreNode,
    parameters: Mapping[str, float | str],
    time_limit: float,
    rate: StateRate = state_rate,
) -> tuple[ManoeuvreTrack, ManoeuvreNode]:
    """Let a manoeuvring algorithm steer the equations, by messages alone, and return the track."""
    desk = FakeNode(parameters=parameters)
    node.start(desk)  # type: ignore[arg-type]
    state, rows = np.zeros(12), []
    commands = (0.0, 0.0, 0.0)
    limit = float(parameters["approach"]) + time_limit
    while desk.now < limit and not (node.begin_time is not None and node.is_finished):
        desk.published.clear()
        desk.readers["/odometry"](odometry_of(state))
        for topic, message in desk.published:
            if topic == "/fins":
                fins = message.data
                commands = (float(fins[:2].mean()), float(fins[2:].mean()), commands[2])
            elif topic == "/wrench":
                thrust = min(max(message.wrench.force.x, -THRUST), THRUST)
                commands = (commands[0], commands[1], thrust / THRUST)
        rows.append(sample_of(desk.now, state, node.rudder))
        state = advance(state, commands, INTERVAL, rate=rate)
        desk.now += INTERVAL
    assert node.begin_time is not None
    return make_track(np.array(rows), node.begin_time, LENGTH), node


INTERVAL = 0.02
"""The time between two messages of odometry [s]."""


def rotation_of(state: np.ndarray) -> np.ndarray:
    return rotation_from_rpy(state[PHI], state[THETA], state[PSI])


def odometry_of(state: np.ndarray) -> Odometry:
    w, x, y, z = quaternion_from_rotation(rotation_of(state)).tolist()
    zero = Vector3(x=0.0, y=0.0, z=0.0)
    return Odometry(
        header=header(0.0),
        child_frame_id="",
        pose=PoseWithCovariance(
            pose=Pose(
                position=Point(*state[X : Z + 1].tolist()),
                orientation=Quaternion(x=x, y=y, z=z, w=w),
            ),
            covariance=np.zeros(36),
        ),
        twist=TwistWithCovariance(twist=Twist(linear=zero, angular=zero), covariance=np.zeros(36)),
    )


def sample_of(time: float, state: np.ndarray, rudder: float) -> tuple[float, ...]:
    rotation = rotation_of(state)
    velocity, rates = rotation @ state[U : WW + 1], rotation @ state[P : R + 1]
    heading = math.atan2(rotation[1, 0], rotation[0, 0])
    c, s = math.cos(heading), math.sin(heading)
    surge, sway = velocity[0] * c + velocity[1] * s, velocity[1] * c - velocity[0] * s
    return time, *state[X : Z + 1], heading, surge, sway, rates[2], rudder
