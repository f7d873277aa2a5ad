"""A free vehicle against scipy's integration of Fossen's equations (`fossen.py`)."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

from tests.physics.fossen import Fossen, angle_between
from tests.physics.water_models import free_body
from uwsim.physics.hydrodynamics.hydrodynamics import Hydrodynamics, install
from uwsim.scene.hydrodynamics import BodyHydrodynamics

MASS, DISPLACED = 150.0, 152.0
CENTRE_OF_MASS, CENTRE_OF_BUOYANCY = (0.01, -0.02, -0.05), (-0.01, 0.01, 0.06)
INERTIA = (14.0, 22.0, 25.0, 0.6, -0.9, 0.4)  # xx yy zz xy xz yz
ADDED = np.diag([55.0, 160.0, 120.0, 12.0, 25.0, 30.0])
for _i, _j, _value in ((0, 4, -6.0), (1, 3, 9.0), (1, 5, 7.0), (2, 4, -5.0), (0, 2, 4.0)):
    ADDED[_i, _j] = ADDED[_j, _i] = _value
LINEAR = np.diag([20.0, 40.0, 35.0, 15.0, 25.0, 20.0])
LINEAR[1, 5] = LINEAR[5, 1] = 4.0
LINEAR[2, 4] = -6.0
QUADRATIC = np.diag([90.0, 220.0, 180.0, 30.0, 60.0, 50.0])
QUADRATIC[2, 4] = 5.0
POSITION, TWIST = (0.3, -0.2, -5.0), (0.5, -0.3, 0.2, 0.2, -0.3, 0.4)
ATTITUDE = np.array([0.9, 0.2, -0.3, 0.25]) / np.linalg.norm([0.9, 0.2, -0.3, 0.25])
DURATION = 20.0  # [s]


def wrench(t: float) -> np.ndarray:
    amplitude = np.array([40.0, 30.0, 25.0, 6.0, 8.0, 10.0])
    return amplitude * np.sin(np.array([0.5, 0.7, 0.4, 0.9, 0.6, 0.8]) * t + np.arange(6))


def current(t: float) -> np.ndarray:
    return np.array([0.3 * math.sin(0.4 * t), 0.2 * math.cos(0.5 * t), 0.1 * math.sin(0.3 * t)])


def current_rate(t: float) -> np.ndarray:
    return np.array([0.12 * math.cos(0.4 * t), -0.1 * math.sin(0.5 * t), 0.03 * math.cos(0.3 * t)])


def steady(t: float) -> np.ndarray:
    return np.array([0.3, -0.2, 0.1])


def model(*, damped: bool, integrator: str, timestep: float, theta: float = 0.0) -> mujoco.MjModel:
    water = BodyHydrodynamics(
        link="body",
        added_mass=tuple(ADDED.ravel()),
        linear_damping=tuple(damped * LINEAR.ravel()),
        quadratic_damping=tuple(damped * QUADRATIC.ravel()),
        volume=DISPLACED / 1000.0,
        centre_of_buoyancy=CENTRE_OF_BUOYANCY,
        implicitness=theta,
    )
    return free_body(
        water, mass=MASS, inertia=INERTIA, centre_of_mass=CENTRE_OF_MASS, integrator=integrator,
        timestep=timestep,
    )  # fmt: skip


def oracle(*, damped: bool) -> Fossen:
    xx, yy, zz, xy, xz, yz = INERTIA
    return Fossen(
        mass=MASS,
        inertia=np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]),
        centre_of_mass=np.array(CENTRE_OF_MASS),
        added=ADDED,
        linear=damped * LINEAR,
        quadratic=damped * QUADRATIC,
        displaced=DISPLACED,
        centre_of_buoyancy=np.array(CENTRE_OF_BUOYANCY),
    )


def begin(built: mujoco.MjModel) -> tuple[Hydrodynamics, mujoco.MjData, np.ndarray]:
    """Return also the same state for the oracle."""
    water, data = install(built), mujoco.MjData(built)
    data.qpos[:] = *POSITION, *ATTITUDE
    mujoco.mj_forward(built, data)
    axes = data.xmat[1].reshape(3, 3)
    data.qvel[:3] = axes @ TWIST[:3]  # MuJoCo: linear part in world axes
    data.qvel[3:] = TWIST[3:]
    return water, data, np.concatenate([data.qpos, TWIST])


def errors(data: mujoco.MjData, end: np.ndarray) -> tuple[float, float]:
    return float(np.linalg.norm(data.qpos[:3] - end[:3])), angle_between(data.qpos[3:], end[3:7])


@pytest.mark.parametrize("damped", [False, True], ids=["conservative", "damped"])
def test_under_rk4_a_free_vehicle_agrees_with_scipy_to_1e_8(damped: bool) -> None:
    built = model(damped=damped, integrator="RK4", timestep=0.002, theta=0.5)
    water, data, start = begin(built)
    water.set_current(data, steady(0.0))
    water.step(data, round(DURATION / built.opt.timestep))
    fossen = oracle(damped=damped)
    fossen.current = steady
    position, attitude = errors(data, fossen.run(start, DURATION))
    assert position < 1e-8
    assert attitude < 1e-8


@pytest.mark.parametrize("theta", [pytest.param(0.0, marks=pytest.mark.slow), 0.5])
def test_implicitfast_at_2_ms_stays_within_5_mm_when_everything_acts(theta: float) -> None:
    built = model(damped=True, integrator="implicitfast", timestep=0.002, theta=theta)
    water, data, start = begin(built)
    for step in range(round(DURATION / 0.002)):
        t = 0.002 * step
        axes = np.empty(9)
        mujoco.mju_quat2Mat(axes, data.qpos[3:])
        force = wrench(t)
        data.qfrc_applied[:3] = axes.reshape(3, 3) @ force[:3]
        data.qfrc_applied[3:] = force[3:]
        water.set_current(data, current(t), current_rate(t))
        water.step(data)
    fossen = oracle(damped=True)
    fossen.wrench, fossen.current, fossen.current_rate = wrench, current, current_rate
    position, _ = errors(data, fossen.run(start, DURATION))
    assert position < 5e-3


def test_halving_the_step_halves_the_error() -> None:
    found = []
    end = None
    for timestep in (0.004, 0.002):
        built = model(damped=True, integrator="implicitfast", timestep=timestep)
        water, data, start = begin(built)
        if end is None:
            end = oracle(damped=True).run(start, 5.0)
        water.step(data, round(5.0 / timestep))
        found.append(errors(data, end)[0])
    assert found[0] / found[1] == pytest.approx(2.0, abs=0.2)


def test_coefficients_may_be_given_about_any_point() -> None:
    """Moved to another point by hand (no drag squared, which has no such rule)."""
    point = np.array([0.2, -0.1, 0.3])
    s = np.array([[0, -point[2], point[1]], [point[2], 0, -point[0]], [-point[1], point[0], 0]])
    move = np.block([[np.eye(3), -s], [np.zeros((3, 3)), np.eye(3)]])  # twist at the point
    ends = []
    for about_point in (True, False):
        added = ADDED if about_point else move.T @ ADDED @ move
        linear = LINEAR if about_point else move.T @ LINEAR @ move
        water = BodyHydrodynamics(
            link="body",
            reference=tuple(point) if about_point else (0.0, 0.0, 0.0),
            added_mass=tuple(added.ravel()),
            linear_damping=tuple(linear.ravel()),
            volume=0.15,
            centre_of_buoyancy=CENTRE_OF_BUOYANCY,
        )
        built = free_body(water, mass=MASS, inertia=INERTIA, centre_of_mass=CENTRE_OF_MASS)
        hydrodynamics, data, _ = begin(built)
        hydrodynamics.set_current(data, (0.2, 0.1, 0.0), (0.1, -0.2, 0.1))
        hydrodynamics.step(data, 500)
        ends.append(data.qpos.copy())
    assert ends[0] == pytest.approx(ends[1], abs=1e-9)
