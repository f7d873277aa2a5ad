"""How points on links move, against MuJoCo's Jacobians and against differences of places."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from tests.simulation.girona500 import make
from uwsim.physics.kinematics.link_motion import LinkMotion
from uwsim.simulation import Simulation
from uwsim.world import BodyMotion


def moving(seed: int) -> Simulation:
    """The vehicle and its arm at a random place, all joints moving."""
    simulation, random = make(), np.random.default_rng(seed)
    engine = simulation.world.engine
    data = engine._data
    data.qpos[:] += random.normal(size=len(data.qpos))
    mujoco.mj_normalizeQuat(engine._model, data.qpos)
    data.qvel[:] = random.normal(size=len(data.qvel))
    data.qacc[:] = random.normal(size=len(data.qacc))
    engine.poses.mark_stale()
    return simulation


def by_mujoco(simulation: Simulation, body: int, point: np.ndarray) -> np.ndarray:
    """Velocity, angular velocity and acceleration by the Jacobians of all joints, (3, 3)."""
    model, data = simulation.world.engine._model, simulation.world.engine._data
    own = mujoco.MjData(model)
    own.qpos[:], own.qvel[:] = data.qpos, data.qvel
    mujoco.mj_kinematics(model, own)
    mujoco.mj_comPos(model, own)
    mujoco.mj_comVel(model, own)
    shift, turn, change = (np.zeros((3, model.nv)) for _ in range(3))
    mujoco.mj_jac(model, own, shift, turn, point, body)
    mujoco.mj_jacDot(model, own, change, None, point, body)
    found = np.zeros((3, 3))
    for row in range(3):  # one joint after the other
        pushed = bent = 0.0
        for dof in range(model.nv):
            found[0, row] += shift[row, dof] * data.qvel[dof]
            found[1, row] += turn[row, dof] * data.qvel[dof]
            pushed += shift[row, dof] * data.qacc[dof]
            bent += change[row, dof] * data.qvel[dof]
        found[2, row] = pushed + bent
    return found


def numbers(motion: BodyMotion) -> np.ndarray:
    return np.array([motion.velocity, motion.angular_velocity, motion.acceleration])


@pytest.mark.parametrize("seed", range(3))
def test_every_link_moves_as_the_engine_says_to_the_bit(seed: int) -> None:
    simulation = moving(seed)
    engine, random = simulation.world.engine, np.random.default_rng(seed)
    links = [link.name for link in simulation.world.model.robots[0].links]
    assert len(links) > 5
    for link in links:
        body, point = engine.poses.link_body(0, link), random.normal(size=3)
        found = numbers(engine.link_motion.point_motion(body, point))
        assert found.tobytes() == by_mujoco(simulation, body, point).tobytes(), link


def test_velocities_and_accelerations_are_differences_of_places() -> None:
    """Of a point of the last link, all speeds constant: central differences over 1e-4 s."""
    simulation = moving(5)
    engine = simulation.world.engine
    model, data = engine._model, engine._data
    body = engine.poses.link_body(0, simulation.world.model.robots[0].links[-1].name)
    data.qacc[:] = 0.0
    engine.poses.refresh()
    on_link = np.array([0.1, -0.2, 0.3])
    point = data.xpos[body] + data.xmat[body].reshape(3, 3) @ on_link
    motion = engine.link_motion.point_motion(body, point)
    places, begin, dt = [], data.qpos.copy(), 1e-4
    for step in (-1, 0, 1):
        data.qpos[:] = begin
        mujoco.mj_integratePos(model, data.qpos, data.qvel, step * dt)
        mujoco.mj_kinematics(model, data)
        places.append(data.xpos[body] + data.xmat[body].reshape(3, 3) @ on_link)
    before, here, after = places
    assert motion.velocity == pytest.approx((after - before) / (2.0 * dt), abs=1e-6)
    assert motion.acceleration == pytest.approx((after - 2.0 * here + before) / dt**2, abs=1e-5)


def test_what_has_no_joint_is_at_rest() -> None:
    engine = moving(1).world.engine
    assert not numbers(engine.link_motion.point_motion(0, np.ones(3))).any()


def test_joints_that_are_led_move_as_they_are_led() -> None:
    simulation = moving(2)
    engine = simulation.world.engine
    motion = LinkMotion(engine._model, engine._data, engine.poses)
    speeds, _ = motion.joint_rates(0)
    speeds[:] = 2.0 * engine._data.qvel
    body = engine.poses.link_body(0, simulation.world.model.robots[0].links[-1].name)
    led, own = (
        motion.point_motion(body, np.ones(3), vehicle=0),
        motion.point_motion(body, np.ones(3)),
    )
    assert led.velocity == pytest.approx(2.0 * own.velocity, rel=1e-12)
