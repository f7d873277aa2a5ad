"""Bodies that come into the water take its added mass along, and leave it behind as they go out."""

from __future__ import annotations

import math
from collections.abc import Iterator

import mujoco
import numpy as np
import pytest

from tests.physics.water_models import free_body
from uwsim.physics.hydrodynamics.hydrodynamics import install
from uwsim.scene.hydrodynamics import BodyHydrodynamics

MASS, ADDED, SPEED = 3.0, 2.0, 2.0  # [kg], [kg], [m/s]


@pytest.fixture(autouse=True)
def leave_the_slot_alone() -> Iterator[None]:
    yield
    mujoco.set_mjcb_passive(None)


def shot(timestep: float, start: float, speed: float, integrator: str = "implicitfast") -> float:
    """Speed of a ball without drag and weight that was shot through the surface [m/s]."""
    ball = BodyHydrodynamics(
        link="body", added_mass=(ADDED, ADDED, ADDED, 0, 0, 0), volume=4.2e-3, shape="sphere",
        size=(0.1,),
    )  # fmt: skip
    model = free_body(
        ball, mass=MASS, surface=0.0, gravity=0.0, timestep=timestep, integrator=integrator
    )
    water, data = install(model), mujoco.MjData(model)
    data.qpos[2], data.qvel[2] = start, speed
    water.step(data, round(0.5 / timestep))
    return float(data.qvel[2])


@pytest.mark.parametrize("timestep", [0.0005, 0.002, 0.01])
def test_a_ball_that_is_shot_into_the_water_keeps_its_momentum(timestep: float) -> None:
    found = shot(timestep, 0.2, -SPEED)
    assert found == pytest.approx(-SPEED * MASS / (MASS + ADDED), rel=1e-6)


def test_under_rk4_too() -> None:
    found = shot(0.0005, 0.2, -SPEED, "RK4")
    assert found == pytest.approx(-SPEED * MASS / (MASS + ADDED), rel=0.01)


def test_a_ball_that_comes_out_of_the_water_keeps_its_speed() -> None:
    assert shot(0.002, -0.2, SPEED) == pytest.approx(SPEED, rel=1e-9)


@pytest.mark.parametrize("timestep", [0.002, 0.005, 0.01])
def test_a_raft_that_falls_into_the_water_comes_to_rest(timestep: float) -> None:
    """1 m x 1 m x 2 cm, 5 kg: it jumped out again and again, and dived by a metre."""
    raft = BodyHydrodynamics(
        link="body", added_mass=(0.3, 0.3, 455.0, 7.0, 7.0, 0.0), volume=0.02, shape="box",
        size=(1.0, 1.0, 0.02), quadratic_damping=(10.5, 10.5, 525.0, 16.4, 16.4, 0.01),
        implicitness=1.0,
    )  # fmt: skip
    model = free_body(raft, mass=5.0, inertia=(0.417, 0.417, 0.833), surface=0.0, timestep=timestep)
    water, data = install(model), mujoco.MjData(model)
    data.qpos[2], data.qpos[3:5] = 1.0, (math.cos(0.25), math.sin(0.25))
    water.step(data, round(8.0 / timestep))
    highest = 0.0
    for _ in range(round(4.0 / timestep)):
        water.step(data)
        highest = max(highest, abs(float(data.qpos[2])))
    assert highest < 0.02
    assert np.abs(data.qvel[2:5]).max() < 0.05


@pytest.mark.parametrize("timestep", [0.002, 0.01])
@pytest.mark.parametrize("seed", [4, 5, 9, 12, 14, 23])
def test_no_box_jumps_higher_than_it_fell_from(seed: int, timestep: float) -> None:
    """Without any drag; these did, and a third of all that were tried."""
    random = np.random.default_rng(seed)
    edges = random.uniform(0.05, 1.0, 3)
    displaced = 1000.0 * float(np.prod(edges))
    mass = displaced * random.uniform(0.1, 0.8)
    added = displaced * np.concatenate([random.uniform(0.2, 3.0, 3), 0.02 * random.random(3)])
    box = BodyHydrodynamics(
        link="body", added_mass=tuple(added), volume=displaced / 1000.0, shape="box",
        size=tuple(edges),
    )  # fmt: skip
    inertia = tuple(mass / 12.0 * ((edges**2).sum() - edges**2))
    model = free_body(box, mass=mass, inertia=inertia, surface=0.0, timestep=timestep)
    water, data = install(model), mujoco.MjData(model)
    attitude = random.normal(size=4)
    data.qpos[2], data.qpos[3:] = 1.0, attitude / np.linalg.norm(attitude)
    water.step(data, round(0.8 / timestep))
    for _ in range(round(20.0 / timestep)):
        water.step(data)
        assert data.qpos[2] < 1.0
