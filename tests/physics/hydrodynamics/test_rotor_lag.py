"""Rotors and fins that lag behind their commands, against an independent integration by scipy."""

from __future__ import annotations

import math
from dataclasses import replace

import mujoco
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.physics.water_models import bundled, free_body
from uwsim.physics.hydrodynamics.hydrodynamics import Hydrodynamics, install
from uwsim.scene.hydrodynamics import BodyHydrodynamics, FinSpec, ThrusterSpec

LAG, MASS, ADDED, DRAG = 0.2, 40.0, 25.0, 90.0
PERIOD, DURATION = 0.1, 2.0  # of a held command, of a test [s]
SCREW = ThrusterSpec(name="screw", link="body", forward=(0.0, 100.0), time_constant=LAG, radius=0.1)


def in_water(thruster: ThrusterSpec, integrator: str, timestep: float) -> Hydrodynamics:
    water = BodyHydrodynamics(
        link="body",
        added_mass=tuple(np.diag([ADDED, *[1.0] * 5]).ravel()),
        quadratic_damping=tuple(np.diag([DRAG, *[0.0] * 5]).ravel()),
    )
    model = free_body(
        water, mass=MASS, thrusters={"screw": thruster}, gravity=0.0, integrator=integrator,
        timestep=timestep,
    )  # fmt: skip
    return install(model)


def held(t: float) -> float:
    """The command of a time: one of a few, each held for `PERIOD`."""
    return (1.0, 0.6, 0.9, 0.35)[int(t / PERIOD + 1e-6) % 4]


def drive(
    thruster: ThrusterSpec, integrator: str, timestep: float, factor: float = 1.0
) -> np.ndarray:
    """Place, velocity and rotor at the end of the held commands times a factor, (3,)."""
    water = in_water(thruster, integrator, timestep)
    data = mujoco.MjData(water.model)
    for k in range(round(DURATION / timestep)):
        water.set_thrusters(data, [factor * held(k * timestep)])
        water.step(data)
    return np.array([data.qpos[0], data.qvel[0], *data.act])


def reference(lag: float) -> np.ndarray:
    """The same by scipy: place, velocity and rotor."""
    y = np.zeros(3)
    for k in range(round(DURATION / PERIOD)):
        command = held(k * PERIOD)

        def rate(_: float, y: np.ndarray, command: float = command) -> list[float]:
            force = 100.0 * y[2] * abs(y[2]) - DRAG * y[1] * abs(y[1])
            return [y[1], force / (MASS + ADDED), (command - y[2]) / lag]

        y = solve_ivp(rate, (0, PERIOD), y, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    return y


@pytest.mark.parametrize("factor", [1.0, 3.0])
@pytest.mark.parametrize("integrator", ["implicitfast", "RK4"])
def test_the_order_of_the_integrator_is_kept_with_a_lag(integrator: str, factor: float) -> None:
    """Also where the commands are beyond the limits, at which they are constant."""
    order = {"implicitfast": 2, "RK4": 4}[integrator]
    steps = {"implicitfast": (0.01, 0.005), "RK4": (0.05, 0.025)}[integrator]
    if factor == 1.0:
        end = reference(LAG)
        found = [abs(drive(SCREW, integrator, step)[0] - end[0]) for step in steps]
    else:
        clipped = replace(SCREW, limits=(-0.3, 0.3))
        found = [
            abs(drive(clipped, integrator, step, factor)[0] - _constant(0.3)[0]) for step in steps
        ]
    assert math.log2(found[0] / found[1]) == pytest.approx(order, abs=0.35)


def _constant(command: float) -> np.ndarray:
    def rate(_: float, y: np.ndarray) -> list[float]:
        force = 100.0 * y[2] * abs(y[2]) - DRAG * y[1] * abs(y[1])
        return [y[1], force / (MASS + ADDED), (command - y[2]) / LAG]

    return solve_ivp(rate, (0, DURATION), np.zeros(3), method="DOP853", rtol=1e-12, atol=1e-13).y[
        :, -1
    ]


@pytest.mark.parametrize("lag", [0.05, 0.2, 1.0])
def test_under_rk4_a_rotor_follows_its_lag_to_1e_8(lag: float) -> None:
    found, end = drive(replace(SCREW, time_constant=lag), "RK4", 0.002), reference(lag)
    assert found == pytest.approx(end, abs=1e-8)


def test_rk4_is_more_accurate_than_the_default_with_a_lag() -> None:
    end = reference(LAG)
    for step in (0.002, 0.02):
        rk4, default = (
            abs(drive(SCREW, name, step)[0] - end[0]) for name in ("RK4", "implicitfast")
        )
        assert rk4 < 0.01 * default


@pytest.mark.parametrize("lag", [1e-4, 1e-3, 0.01])
def test_a_lag_shorter_than_a_step_is_stable_under_rk4(lag: float) -> None:
    """It counts as a lag of one step."""
    found, end = drive(replace(SCREW, time_constant=lag), "RK4", 0.02), reference(0.02)
    assert found[0] == pytest.approx(end[0], abs=3e-3)  # a step is a whole lag
    assert abs(found[2]) <= 1.0


@pytest.mark.parametrize("lag", [0.05, 0.3])
def test_under_rk4_a_fin_follows_its_lag_to_1e_8(lag: float) -> None:
    fin = FinSpec(name="fin", link="body", area=0.02, lift_slope=3.0, time_constant=lag)
    model = free_body(
        BodyHydrodynamics(link="body"), mass=1e6, fins={"fin": fin}, gravity=0.0, integrator="RK4"
    )
    water, data = install(model), mujoco.MjData(model)
    water.turn_fin(data, "fin", 0.3)
    water.step(data, 100)
    assert data.act[0] == pytest.approx(0.3 * -math.expm1(-0.2 / lag), abs=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["bluerov2_heavy", "rexrov"])
def test_bundled_vehicles_under_held_commands_are_within_the_documented_errors(name: str) -> None:
    """Of 0.1 mm with the default, 0.1 um with RK4; the reference is RK4 with half the step."""

    def end(integrator: str, timestep: float) -> np.ndarray:
        built, vehicle = bundled(name, timestep=timestep)
        built.opt.integrator = getattr(mujoco.mjtIntegrator, integrator)
        water, data = install(built), mujoco.MjData(built)
        limits = np.array([one.limits[1] for one in vehicle.thrusters])
        phases = np.arange(len(limits))
        for k in range(round(10.0 / timestep)):
            if k % round(0.02 / timestep) == 0:
                pace = 0.4 + 0.13 * phases
                water.set_thrusters(data, 0.5 * limits * np.sin(pace * k * timestep + phases))
            water.step(data)
        return data.qpos[:3].copy()

    reference = end("mjINT_RK4", 0.001)
    assert np.linalg.norm(end("mjINT_IMPLICITFAST", 0.002) - reference) < 1e-4
    assert np.linalg.norm(end("mjINT_RK4", 0.002) - reference) < 1e-7


@pytest.mark.slow
def test_a_vehicle_with_the_bundled_arm_at_rest_is_within_2_um() -> None:
    """Drag of the arm's links is of second order; the reference is RK4 with half the step."""

    def end(integrator: str, timestep: float) -> np.ndarray:
        built, vehicle = bundled("g500_physical", timestep=timestep)
        built.opt.integrator = getattr(mujoco.mjtIntegrator, integrator)
        water, data = install(built), mujoco.MjData(built)
        limits = np.array([one.limits[1] for one in vehicle.thrusters])
        phases = np.arange(len(limits))
        for k in range(round(10.0 / timestep)):
            if k % round(0.02 / timestep) == 0:
                pace = 0.4 + 0.13 * phases
                water.set_thrusters(data, 0.6 * limits * np.sin(pace * k * timestep + phases))
            water.step(data)
        return data.qpos[:3].copy()

    apart = end("mjINT_IMPLICITFAST", 0.002) - end("mjINT_RK4", 0.001)
    assert np.linalg.norm(apart) < 2e-6
