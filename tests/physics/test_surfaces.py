"""Friction, restitution and centre of mass that a scene says of an object."""

from __future__ import annotations

import math
from dataclasses import replace

import mujoco
import numpy as np
import pytest

from uwsim.base.geometry import Pose
from uwsim.model.body_names import object_body
from uwsim.model.collision.shapes import CollisionShape
from uwsim.model.resolved_scene import SimulatedScene
from uwsim.physics.engine_model import compile_engine_model
from uwsim.physics.free_objects import loose_link
from uwsim.physics.restitution import bounce, contact_spring
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.sim_params import SimParamsSpec
from uwsim.scene.spec import SceneSpec

BOX = CollisionShape(kind="box", size=(0.1, 0.1, 0.1), body_from_shape=Pose.identity())
FLOOR = CollisionShape(kind="box", size=(5.0, 5.0, 0.5), body_from_shape=Pose.identity())
BALL = CollisionShape(kind="sphere", size=(0.1,), body_from_shape=Pose.identity())
GROUND = PhysicsSpec(mass=0.0)
USUAL = SimParamsSpec()
RK4 = SimParamsSpec(integrator="RK4")


def falling(
    physics: PhysicsSpec,
    shape: CollisionShape,
    height: float,
    tilt: float,
    *,
    floor: PhysicsSpec = GROUND,
    sim: SimParamsSpec = USUAL,
    timestep: float = 0.001,
) -> mujoco.MjModel:
    """A thing over a floor in air, under a gravity that leans by an angle."""
    pull = (9.81 * math.sin(tilt), 0.0, -9.81 * math.cos(tilt))
    thing = ObjectSpec(name="thing", file="", position=(0, 0, height), physics=physics)
    ground = ObjectSpec(name="floor", file="", position=(0, 0, -0.5), physics=floor)
    scene = SceneSpec(
        objects=(thing, ground), sim_params=replace(sim, enable_physics=True, gravity=pull)
    )
    shapes = {object_body(0): [shape], object_body(1): [FLOOR]}
    return compile_engine_model(
        SimulatedScene(scene=scene, robots={}, dynamics={}, shapes=shapes, timestep=timestep)
    )


def bounce_of(model: mujoco.MjModel) -> float:
    """Speed of a thing after its first bounce by the speed before."""
    data = mujoco.MjData(model)
    fastest, thrown = 0.0, 0.0
    for _ in range(round(0.8 / model.opt.timestep)):
        mujoco.mj_step(model, data)
        fastest = min(fastest, float(data.qvel[2]))
        thrown = max(thrown, float(data.qvel[2]))
    return thrown / -fastest


@pytest.mark.parametrize(("friction", "slides"), [(0.2, True), (0.4, False)])
def test_a_box_slides_on_a_slope_steeper_than_its_friction(friction: float, slides: bool) -> None:
    tilt = math.atan(0.3)
    model = falling(PhysicsSpec(mass=1.0, friction=friction), BOX, 0.1, tilt)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 1000)
    slid = 0.5 * 9.81 * (math.sin(tilt) - friction * math.cos(tilt))
    assert data.qpos[0] == pytest.approx(slid if slides else 0.0, abs=0.03)


@pytest.mark.parametrize(
    ("timestep", "tolerance"),
    [(0.001, 0.02), (0.002, 0.04), (0.005, 0.1), (0.01, 0.1), (0.02, 0.1)],
)
@pytest.mark.parametrize("restitution", [0.3, 0.6, 0.9])
def test_a_ball_bounces_back_with_its_restitution(
    restitution: float, timestep: float, tolerance: float
) -> None:
    physics = PhysicsSpec(mass=1.0, restitution=restitution)
    bounces = [
        bounce_of(falling(physics, BALL, height, 0.0, timestep=timestep))
        for height in np.linspace(1.0, 1.2, 9)
    ]
    assert bounces == pytest.approx([restitution] * 9, abs=tolerance)
    assert np.mean(bounces) == pytest.approx(restitution, abs=0.35 * tolerance)


@pytest.mark.parametrize("timestep", [0.001, 0.002, 0.01, 0.02])
def test_a_restitution_of_0_gives_no_more_than_3_percent_back(timestep: float) -> None:
    physics = PhysicsSpec(mass=1.0, restitution=0.0)
    for height in np.linspace(1.0, 1.2, 9):
        assert bounce_of(falling(physics, BALL, height, 0.0, timestep=timestep)) < 0.03


@pytest.mark.parametrize("sim", [USUAL, RK4], ids=["implicitfast", "RK4"])
@pytest.mark.parametrize("shape", [BALL, BOX], ids=["ball", "box"])
@pytest.mark.parametrize("timestep", [0.005, 0.01, 0.015, 0.02])
@pytest.mark.parametrize("restitution", [0.5, 0.8, 0.95])
def test_nothing_bounces_higher_than_it_fell_from(
    restitution: float, timestep: float, shape: CollisionShape, sim: SimParamsSpec
) -> None:
    physics = PhysicsSpec(mass=60.0, restitution=restitution)
    model = falling(physics, shape, 0.3, 0.0, sim=sim, timestep=timestep)
    data = mujoco.MjData(model)
    highest = 0.0
    for _ in range(round(6.0 / timestep)):
        mujoco.mj_step(model, data)
        highest = max(highest, float(data.qpos[2]))
    assert highest <= 0.3
    assert data.qpos[2] > 0.05


def test_of_two_that_say_a_restitution_the_smaller_counts() -> None:
    lively, dull = (PhysicsSpec(mass=1.0, restitution=e) for e in (0.9, 0.3))
    assert bounce_of(falling(lively, BALL, 1.1, 0.0, floor=replace(dull, mass=0.0))) < 0.33
    assert bounce_of(falling(dull, BALL, 1.1, 0.0, floor=replace(lively, mass=0.0))) < 0.33


@pytest.mark.parametrize("timestep", [1e-5, 0.001, 0.002, 0.005, 0.01, 0.02])
def test_no_phase_of_a_bounce_returns_more_than_came_in(timestep: float) -> None:
    for restitution in np.linspace(0.0, 0.95, 39):
        stiffness, damping = contact_spring(float(restitution), timestep)
        back = [
            bounce(stiffness * timestep**2, damping * timestep, phase)
            for phase in np.linspace(0.001, 1.0, 101)
        ]
        assert max(back) < 1.0
        assert np.mean(back) == pytest.approx(restitution, abs=0.015)


def test_the_centre_of_mass_is_where_the_file_puts_it() -> None:
    link = loose_link("t", PhysicsSpec(mass=1.0, centre_of_mass=(0.0, 0.0, -0.05)), [BOX])
    assert link.centre_of_mass == (0.0, 0.0, -0.05)
    assert np.all(np.array(link.inertia[:3]) > 0.0)
