"""The bundled REMUS 100 turns as the equations that Prestero's thesis published."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.physics.prestero import THETA, WW, U, foil_rate, simulate, state_rate
from tests.physics.water_models import bundled
from uwsim.physics.hydrodynamics.hydrodynamics import install


def radius(places: np.ndarray) -> float:
    """Of the circle through places (n, 2), by least squares [m]."""
    sides = np.column_stack([2.0 * places, np.ones(len(places))])
    x, y, rest = np.linalg.lstsq(sides, (places**2).sum(axis=1), rcond=None)[0]
    return math.sqrt(rest + x * x + y * y)


@pytest.mark.parametrize("rudder", [-0.07, 0.14])
def test_the_remus_turns_with_the_radius_of_the_published_equations(rudder: float) -> None:
    planes = -0.03
    start = np.zeros(12)
    start[0] = 1.54
    times = np.arange(0.0, 60.0, 0.5)
    solved = solve_ivp(
        lambda _, state: state_rate(state, rudder, planes, 1.0), (0.0, 60.0), start, "DOP853",
        times, rtol=1e-8,
    ).y.T  # fmt: skip
    model, _ = bundled("remus100")
    water, data = install(model), mujoco.MjData(model)
    data.qvel[0] = 1.54
    water.set_thrusters(data, [1.0])
    for name, angle in (
        ("upper_rudder", rudder), ("lower_rudder", rudder),
        ("port_plane", planes), ("starboard_plane", planes),
    ):  # fmt: skip
        water.turn_fin(data, name, angle)
    ours = []
    for _ in times:
        ours.append([data.qpos[0], -data.qpos[1], -data.qpos[2]])
        water.step(data, 250)
    places = np.array(ours)
    late = times > 30.0
    expected = radius(solved[late, 6:8])
    assert 5.0 < expected < 60.0
    assert radius(places[late, :2]) == pytest.approx(expected, rel=0.02)
    # a rudder that pushes the stern to starboard turns the bow to port
    assert places[10, 1] * rudder < 0.0


def simulate_dive(planes: float, duration: float) -> np.ndarray:
    """Return surge, heave (z down) and pitch of the bundled vehicle, each 0.05 s, (n, 3)."""
    model, _ = bundled("remus100")
    water, data = install(model), mujoco.MjData(model)
    data.qvel[0] = 1.54
    water.set_thrusters(data, [1.0])
    for name in ("port_plane", "starboard_plane"):
        water.turn_fin(data, name, planes)
    rows, rotation = [], np.zeros(9)
    for _ in range(round(duration / 0.05)):
        water.step(data, 25)
        mujoco.mju_quat2Mat(rotation, data.qpos[3:7])
        world_from_body = rotation.reshape(3, 3)
        velocity = world_from_body.T @ data.qvel[:3]
        rows.append([velocity[0], velocity[2], math.asin(world_from_body[2, 0])])
    return np.array(rows)


@pytest.mark.parametrize("planes", [-4.0, -2.0, 0.0, 2.0, 4.0, 8.0, 13.5])
def test_the_remus_pitches_at_a_step_of_its_planes_as_the_published_equations(
    planes: float,
) -> None:
    """Mean of 30 to 40 s. At -8 deg both are near a fold, from which on they go up steeply."""
    angle = math.radians(planes)
    published = simulate(lambda _, state: (0.0, angle, 1.0), 40.0, interval=0.05)
    ours = simulate_dive(angle, 40.0)
    late = published[-200:, [1 + U, 1 + WW, 1 + THETA]].mean(axis=0)
    assert ours[-200:].mean(axis=0) == pytest.approx(late, rel=0.05)


@pytest.mark.parametrize(("planes", "tolerance"), [(-13.5, 0.005), (-8.0, 0.02), (0.0, 0.005)])
def test_the_remus_differs_from_the_published_equations_by_its_fins_alone(
    planes: float, tolerance: float
) -> None:
    """Surge, heave, pitch and depth rate, which differ by 5 % and more with the published fins.

    At -8 deg the foils move the fold: the published equations climb at 12 deg, both others at 35.
    """
    angle = math.radians(planes)
    solved = simulate(lambda _, state: (0.0, angle, 1.0), 40.0, interval=0.05, rate=foil_rate)
    surge, heave, pitch = solved[-200:, [1 + U, 1 + WW, 1 + THETA]].mean(axis=0)
    ours = simulate_dive(angle, 40.0)[-200:].mean(axis=0)
    expected = (surge, heave, pitch, depth_rate(surge, heave, pitch))
    assert (*ours, depth_rate(*ours)) == pytest.approx(expected, rel=tolerance)


def depth_rate(surge: float, heave: float, pitch: float) -> float:
    return -surge * math.sin(pitch) + heave * math.cos(pitch)
