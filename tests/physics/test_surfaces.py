"""Friction, restitution and centre of mass that a scene says of an object."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

from uwsim.geometry import Pose
from uwsim.physics.collision.shapes import CollisionShape
from uwsim.physics.compile import compile_scene, object_body
from uwsim.physics.free_objects import loose_link
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.sim_params import SimParamsSpec
from uwsim.scene.spec import SceneSpec

BOX = CollisionShape(kind="box", size=(0.1, 0.1, 0.1), body_from_shape=Pose.identity())
FLOOR = CollisionShape(kind="box", size=(5.0, 5.0, 0.5), body_from_shape=Pose.identity())
BALL = CollisionShape(kind="sphere", size=(0.1,), body_from_shape=Pose.identity())


def falling(
    physics: PhysicsSpec, shape: CollisionShape, height: float, tilt: float
) -> mujoco.MjModel:
    """A thing over a floor in air, under a gravity that leans by an angle."""
    pull = (9.81 * math.sin(tilt), 0.0, -9.81 * math.cos(tilt))
    thing = ObjectSpec(name="thing", file="", position=(0, 0, height), physics=physics)
    floor = ObjectSpec(name="floor", file="", position=(0, 0, -0.5), physics=PhysicsSpec(mass=0.0))
    scene = SceneSpec(
        objects=(thing, floor), sim_params=SimParamsSpec(enable_physics=True, gravity=pull)
    )
    return compile_scene(scene, {}, {}, 0.001, {object_body(0): [shape], object_body(1): [FLOOR]})


@pytest.mark.parametrize(("friction", "slides"), [(0.2, True), (0.4, False)])
def test_a_box_slides_on_a_slope_steeper_than_its_friction(friction: float, slides: bool) -> None:
    tilt = math.atan(0.3)
    model = falling(PhysicsSpec(mass=1.0, friction=friction), BOX, 0.1, tilt)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 1000)
    slid = 0.5 * 9.81 * (math.sin(tilt) - friction * math.cos(tilt))
    assert data.qpos[0] == pytest.approx(slid if slides else 0.0, abs=0.03)


@pytest.mark.parametrize("restitution", [0.3, 0.6, 0.9])
def test_a_ball_bounces_back_with_its_restitution(restitution: float) -> None:
    model = falling(PhysicsSpec(mass=1.0, restitution=restitution), BALL, 1.1, 0.0)
    data = mujoco.MjData(model)
    fastest, thrown = 0.0, 0.0
    for _ in range(800):
        mujoco.mj_step(model, data)
        fastest = min(fastest, float(data.qvel[2]))
        thrown = max(thrown, float(data.qvel[2]))
    assert thrown / -fastest == pytest.approx(restitution, abs=0.05)


def test_the_centre_of_mass_is_where_the_file_puts_it() -> None:
    link = loose_link("t", PhysicsSpec(mass=1.0, centre_of_mass=(0.0, 0.0, -0.05)), [BOX])
    assert link.centre_of_mass == (0.0, 0.0, -0.05)
    assert np.all(np.array(link.inertia[:3]) > 0.0)
