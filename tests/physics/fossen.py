"""Fossen's equations for one free body, integrated by scipy: shares no code with uwsim.

State: position of the origin, attitude as quaternion wxyz, twist in body axes. The matrices of
Coriolis forces are Fossen's (2011), eq. 3.46 with M partitioned; kinematics are quaternions.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import solve_ivp


def skew(a: np.ndarray) -> np.ndarray:
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def rotation(q: np.ndarray) -> np.ndarray:
    e, n = q[1:], q[0]
    return np.eye(3) + 2 * n * skew(e) + 2 * skew(e) @ skew(e)


def coriolis(m: np.ndarray, nu: np.ndarray) -> np.ndarray:
    s1 = skew(m[:3, :3] @ nu[:3] + m[:3, 3:] @ nu[3:])
    s2 = skew(m[3:, :3] @ nu[:3] + m[3:, 3:] @ nu[3:])
    return np.block([[np.zeros((3, 3)), -s1], [-s1, -s2]])


@dataclass
class Fossen:
    mass: float
    inertia: np.ndarray  # (3, 3) about the centre of mass
    centre_of_mass: np.ndarray
    added: np.ndarray = field(default_factory=lambda: np.zeros((6, 6)))
    linear: np.ndarray = field(default_factory=lambda: np.zeros((6, 6)))
    quadratic: np.ndarray = field(default_factory=lambda: np.zeros((6, 6)))
    displaced: float = 0.0
    centre_of_buoyancy: np.ndarray = field(default_factory=lambda: np.zeros(3))
    gravity: float = 9.81
    current: Callable[[float], np.ndarray] = lambda t: np.zeros(3)
    current_rate: Callable[[float], np.ndarray] = lambda t: np.zeros(3)
    wrench: Callable[[float], np.ndarray] = lambda t: np.zeros(6)

    @property
    def rigid(self) -> np.ndarray:
        s = skew(self.centre_of_mass)
        about_origin = self.inertia - self.mass * s @ s
        return np.block([[self.mass * np.eye(3), -self.mass * s], [self.mass * s, about_origin]])

    def rate(self, t: float, y: np.ndarray) -> np.ndarray:
        q, nu = y[3:7] / np.linalg.norm(y[3:7]), y[7:]
        r = rotation(q)
        stream = np.concatenate([r.T @ self.current(t), np.zeros(3)])
        stream_rate = np.zeros(6)
        stream_rate[:3] = r.T @ self.current_rate(t) - np.cross(nu[3:], stream[:3])
        relative = nu - stream
        down = r.T @ np.array([0, 0, -self.gravity])
        weight = self.mass * down
        lift = self.displaced * (r.T @ self.current_rate(t) - down)
        force = np.concatenate(
            [
                weight + lift,
                np.cross(self.centre_of_mass, weight) + np.cross(self.centre_of_buoyancy, lift),
            ]
        )
        force += self.wrench(t) + self.added @ stream_rate
        force -= coriolis(self.rigid, nu) @ nu + coriolis(self.added, relative) @ relative
        force -= self.linear @ relative + self.quadratic @ (np.abs(relative) * relative)
        nu_rate = np.linalg.solve(self.rigid + self.added, force)
        w, x, yy, z = q
        turn = np.array([[-x, -yy, -z], [w, -z, yy], [z, w, -x], [-yy, x, w]])
        return np.concatenate([r @ nu[:3], 0.5 * turn @ nu[3:], nu_rate])

    def run(self, y0: np.ndarray, duration: float) -> np.ndarray:
        found = solve_ivp(self.rate, (0, duration), y0, method="DOP853", rtol=1e-13, atol=1e-13)
        end = found.y[:, -1]
        end[3:7] /= np.linalg.norm(end[3:7])
        return end


def angle_between(p: np.ndarray, q: np.ndarray) -> float:
    """Angle of the turn from one attitude to another [rad], good for small ones."""
    difference = rotation(p).T @ rotation(q)
    return float(np.linalg.norm(difference - difference.T) / (2 * np.sqrt(2)))
