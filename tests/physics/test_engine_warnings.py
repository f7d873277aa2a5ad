"""What the engine warns of: one line, and no file in the folder that the user works in."""

from __future__ import annotations

from importlib import resources
from multiprocessing import get_context
from pathlib import Path

import mujoco
import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.base.geometry import Pose
from uwsim.errors import RunFailed
from uwsim.model.body_names import object_body
from uwsim.model.collision.shapes import CollisionShape
from uwsim.model.resolved_scene import SimulatedScene
from uwsim.physics.engine_model import compile_engine_model
from uwsim.physics.engine_warnings import (
    describe_speed,
    describe_warning,
    find_excess_speed,
    speed_limits,
    suppress_warnings,
)
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.sim_params import SimParamsSpec
from uwsim.scene.spec import SceneSpec

BALLS = "".join(f'<body name="b{i}"><freejoint/><geom size="0.1"/></body>' for i in range(30))
MODEL = '<mujoco><size memory="{memory}"/><worldbody>' + BALLS + "</worldbody></mujoco>"
SCENE = Path(str(resources.files("uwsim") / "data" / "scenes" / "currents-scene.xml"))


def diverge() -> None:
    simulation = open_scene(read_scene(SCENE).nominal_scene, is_blind=True)
    simulation.world.engine._data.qvel[0] = 1e12
    try:
        simulation.advance()
    except RunFailed:
        print("failed", flush=True)


def warned(memory: str) -> str:
    model = mujoco.MjModel.from_xml_string(MODEL.format(memory=memory))
    data = mujoco.MjData(model)
    suppress_warnings()
    mujoco.mj_step(model, data)
    names = [model.body(i).name for i in model.dof_bodyid]
    assert data.warning.number.any()
    return describe_warning(data, 0.002, 0.002, names)


def test_contacts_that_find_no_room_are_reported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert "more contacts at 0.002 s than the engine has memory for" in warned("100K")
    assert list(tmp_path.iterdir()) == []
    assert capfd.readouterr() == ("", "")


def test_what_moves_too_fast_is_named_with_what_may_be_wrong() -> None:
    velocities, speeds = np.array([0.0, 90.0, 90.0]), np.array([[0, 3, 100]], dtype=np.int64)
    said = describe_speed(velocities, speeds, 0, 1.5, ["needle"] * 3)
    assert said.startswith("'needle' moves at 127.3 m/s or rad/s at 1.5 s")
    assert "bodies were inside each other as they began, or it is so thin" in said


@pytest.mark.parametrize(("radius", "limit"), [(0.0005, 2000), (0.006, 166), (0.1, 100)])
def test_a_thin_thing_that_is_loose_may_turn_as_fast_as_it_rolls(radius: float, limit: int) -> None:
    thing = ObjectSpec(name="pin", file="", physics=PhysicsSpec(mass=0.01))
    rod = CollisionShape(kind="cylinder", size=(radius, 0.15), body_from_shape=Pose.identity())
    scene = SceneSpec(objects=(thing,), sim_params=SimParamsSpec(enable_physics=True))
    model = compile_engine_model(
        SimulatedScene(
            scene=scene, robots={}, dynamics={}, shapes={object_body(0): (rod,)}, timestep=0.002
        )
    )
    speeds = speed_limits(model)
    assert speeds.tolist() == [[0, 3, 100], [3, 3, limit]]
    assert find_excess_speed(np.array([0.0, 0.0, 0.0, 0.9 * limit, 0.0, 0.0]), speeds) == -1
    assert find_excess_speed(np.array([0.0, 0.0, 0.0, 0.9 * limit, 0.9 * limit, 0.0]), speeds) == 3
    assert find_excess_speed(np.array([101.0, 0.0, 0.0, 0.0, 0.0, 0.0]), speeds) == 0


@pytest.mark.slow
def test_a_run_that_diverges_leaves_no_file_in_a_worker_either(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    diverge()
    worker = get_context("spawn").Process(target=diverge)
    worker.start()
    worker.join()
    assert capfd.readouterr() == ("failed\nfailed\n", "")
    assert list(tmp_path.iterdir()) == []


def test_somebody_elses_listener_stays() -> None:
    before = mujoco.get_mju_user_warning()
    try:
        mujoco.set_mju_user_warning(print)
        suppress_warnings()
        assert mujoco.get_mju_user_warning() is print
    finally:
        mujoco.set_mju_user_warning(before)
