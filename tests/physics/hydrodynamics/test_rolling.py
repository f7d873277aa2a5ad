"""A ball that rolls: what contacts push keeps its direction while the body turns."""

from __future__ import annotations

import math
from collections.abc import Iterator

import mujoco
import pytest

from tests.physics.water_models import set_options
from uwsim.base.geometry import Pose
from uwsim.model.collision.shapes import CollisionShape
from uwsim.physics.free_objects import loose_link
from uwsim.physics.hydrodynamics import prepare
from uwsim.physics.hydrodynamics.hydrodynamics import install
from uwsim.scene.hydrodynamics import BodyHydrodynamics
from uwsim.scene.object import PhysicsSpec

RADIUS, MASS, ADDED, SLOPE = 0.1, 6.0, 2.0, 0.1
VOLUME = 4.0 / 3.0 * math.pi * RADIUS**3


@pytest.fixture(autouse=True)
def leave_the_slot_alone() -> Iterator[None]:
    yield
    mujoco.set_mjcb_passive(None)


@pytest.mark.parametrize("timestep", [0.002, 0.01, 0.02])
def test_a_ball_rolls_down_a_slope_as_fast_at_every_step(timestep: float) -> None:
    ball = CollisionShape(kind="sphere", size=(RADIUS,), body_from_shape=Pose.identity())
    inertia = loose_link("ball", PhysicsSpec(mass=MASS), [ball]).inertia[:3]
    spec = mujoco.MjSpec()
    set_options(spec, timestep=timestep, gravity=9.81)
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.worldbody.add_geom(
        type=mujoco.mjtGeom.mjGEOM_PLANE, size=[100.0, 100.0, 1.0], pos=[0.0, 0.0, -20.0],
        quat=[math.cos(0.5 * SLOPE), 0.0, math.sin(0.5 * SLOPE), 0.0], friction=[0.8, 0.0, 0.0],
    )  # fmt: skip
    up = (math.sin(SLOPE), math.cos(SLOPE))
    body = spec.worldbody.add_body(
        name="ball", mass=MASS, inertia=inertia,
        pos=[RADIUS * up[0], 0.0, -20.0 + RADIUS * up[1]],
    )  # fmt: skip
    body.explicitinertial = True
    body.add_freejoint()
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[RADIUS, 0.0, 0.0])
    water = BodyHydrodynamics(
        link="ball", added_mass=(ADDED,) * 3 + (0.0,) * 3, volume=VOLUME, shape="sphere",
        size=(RADIUS,),
    )  # fmt: skip
    prepare(spec, {"ball": water}, {}, {}, surface=0.0, density=1000.0, levels=())
    model = spec.compile()
    waters, data = install(model), mujoco.MjData(model)
    waters.step(data, round(2.0 / timestep))
    driving = (MASS - 1000.0 * VOLUME) * 9.81 * math.sin(SLOPE)
    speed = 2.0 * driving / (MASS + ADDED + 0.4 * MASS)
    assert math.hypot(*data.qvel[:3]) == pytest.approx(speed, rel=0.01)
    assert data.qvel[4] == pytest.approx(speed / RADIUS, rel=0.01)
