"""An independent simulator of a BlueROV2: Fossen's equations, integrated by Runge and Kutta.

It shares no code with uwsim. Equations: Fossen, Handbook of Marine Craft (2011), 6.3 and 7.5, with
the coefficients of von Benzon et al. 2022 for a body frame forward, starboard, down at the centre
of gravity, and a world frame north, east, down.
"""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

GRAVITY = 9.81
MASS, VOLUME, DENSITY = 13.5, 0.0134, 1000.0
INERTIA = (0.26, 0.23, 0.37)
CENTRE_OF_BUOYANCY = np.array([0.0, 0.0, -0.01])
LAG = 0.029
NAMES = (
    *("bow_starboard", "bow_port", "stern_starboard", "stern_port"),
    *("down_bow_starboard", "down_bow_port", "down_stern_starboard", "down_stern_port"),
)
PLACES = np.array(
    [
        *((0.156, 0.111, 0.085), (0.156, -0.111, 0.085)),
        *((-0.156, 0.111, 0.085), (-0.156, -0.111, 0.085)),
        *((0.12, 0.218, 0.0), (0.12, -0.218, 0.0), (-0.12, 0.218, 0.0), (-0.12, -0.218, 0.0)),
    ]
)
C45 = 0.7071068
DIRECTIONS = np.array(
    [(C45, -C45, 0), (C45, C45, 0), (C45, C45, 0), (C45, -C45, 0), *[(0, 0, 1)] * 4]
)
POWERS = {1: 8.9, 3: 176.0, 5: -404.1, 7: 389.9, 9: -140.3}


@dataclass
class Rov:
    """The coefficients of the vehicle, with the true ones as defaults."""

    added_mass: np.ndarray = field(
        default_factory=lambda: np.array([6.36, 7.12, 18.68, 0.189, 0.135, 0.222])
    )
    linear: np.ndarray = field(default_factory=lambda: np.array([13.7, 0, 33, 0, 0.8, 0]))
    quadratic: np.ndarray = field(
        default_factory=lambda: np.array([141, 217, 190, 1.19, 0.47, 1.5])
    )
    strength: np.ndarray = field(default_factory=lambda: np.ones(8))
    is_planar: bool = False
    """True if heave, roll and pitch are held."""

    def derivative(self, state: np.ndarray, commands: np.ndarray) -> np.ndarray:
        """Return the derivative of position, quaternion wxyz, twist and rotors, (21,)."""
        quaternion, nu, rotors = state[3:7], state[7:13], state[13:]
        rotation = rotation_of(quaternion / np.linalg.norm(quaternion))
        inertia = np.array([MASS] * 3 + list(INERTIA)) + self.added_mass
        v, w = nu[:3], nu[3:]
        momentum = inertia * nu
        coriolis = np.concatenate(
            [np.cross(w, momentum[:3]), np.cross(v, momentum[:3]) + np.cross(w, momentum[3:])]
        )
        damping = self.linear * nu + self.quadratic * np.abs(nu) * nu
        down = rotation.T @ np.array([0.0, 0.0, 1.0])
        buoyancy = -DENSITY * VOLUME * GRAVITY * down
        restoring = np.concatenate(
            [MASS * GRAVITY * down + buoyancy, np.cross(CENTRE_OF_BUOYANCY, buoyancy)]
        )
        thrusts = self.strength * sum(c * rotors**power for power, c in POWERS.items())
        force = thrusts @ DIRECTIONS
        torque = (thrusts[:, None] * np.cross(PLACES, DIRECTIONS)).sum(axis=0)
        acceleration = (np.concatenate([force, torque]) + restoring - damping - coriolis) / inertia
        if self.is_planar:
            acceleration[2:5] = 0.0
        p, q, r = w
        rates = 0.5 * np.array([[0, -p, -q, -r], [p, 0, r, -q], [q, -r, 0, p], [r, q, -p, 0]])
        return np.concatenate(
            [rotation @ v, rates @ quaternion, acceleration, (commands - rotors) / LAG]
        )

    def step(self, state: np.ndarray, commands: np.ndarray, h: float) -> np.ndarray:
        """Return the state after a step of the classical method of Runge and Kutta."""
        k1 = self.derivative(state, commands)
        k2 = self.derivative(state + 0.5 * h * k1, commands)
        k3 = self.derivative(state + 0.5 * h * k2, commands)
        k4 = self.derivative(state + h * k3, commands)
        state = state + h / 6.0 * (k1 + 2 * k2 + 2 * k3 + k4)
        state[3:7] /= np.linalg.norm(state[3:7])
        return state


def rotation_of(quaternion: np.ndarray) -> np.ndarray:
    """Return the rotation matrix of a quaternion wxyz."""
    w, x, y, z = quaternion
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def excite(time: float, state: np.ndarray) -> np.ndarray:
    """Return commands that excite all axes, and keep the depth near 20 m, (8,)."""
    sines = [math.sin(2 * math.pi * f * time + a) for f, a in ((0.11, 0), (0.13, 1), (0.17, 2))]
    squares = [
        math.copysign(1.0, math.sin(2 * math.pi * f * time + a))
        for f, a in ((0.05, 0.3), (0.07, 1.1), (0.09, 0.7))
    ]
    surge, sway, yaw = 0.35 * squares[0], 0.3 * squares[1], 0.25 * squares[2]
    heave = 0.3 * sines[0] - 0.3 * (state[2] - 20.0)
    pitch, roll = 0.12 * sines[1], 0.12 * sines[2]
    horizontal_commands = [
        surge - sway - yaw,
        surge + sway + yaw,
        surge + sway - yaw,
        surge - sway + yaw,
    ]
    vertical_commands = [heave - pitch + roll, heave - pitch - roll, heave + pitch + roll]
    vertical_commands.append(heave + pitch - roll)
    return np.clip(np.array([*horizontal_commands, *vertical_commands]), -0.85, 0.85)


def write_log(
    path: Path,
    rov: Rov,
    *,
    duration: float = 60.0,
    rate: float = 50.0,
    command_rate: float = 10.0,
    noise: np.ndarray | None = None,
    seed: int = 0,
) -> Path:
    """Write the log of a run as CSV, with the names of uwsim's columns."""
    rng = np.random.default_rng(seed)
    h = 0.005
    state = np.zeros(21)
    state[2], state[3] = 20.0, 1.0
    commands = np.zeros(8)
    rows = []
    for k in range(round(duration / h) + 1):
        is_command = k % round(1 / (command_rate * h)) == 0
        if is_command:
            commands = excite(k * h, state)
        if k % round(1 / (rate * h)) == 0:
            motion = state[:13].copy()
            if noise is not None:
                motion += noise * rng.standard_normal(13)
            cells = [f"{k * h:.3f}", *map(repr, motion.tolist())]
            rows.append([*cells, *(map(repr, commands.tolist()) if is_command else [""] * 8)])
        state = rov.step(state, commands, h)
    columns = ("time", "x", "y", "z", "qw", "qx", "qy", "qz", "u", "v", "w", "p", "q", "r")
    with path.open("w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow([*columns, *(f"thrusters.{name}" for name in NAMES)])
        writer.writerows(rows)
    return path
