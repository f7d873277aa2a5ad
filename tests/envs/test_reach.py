"""The tasks Reach and Grasp: what is observed, held against independent kinematics and contacts."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import gymnasium
import mujoco
import numpy as np
import pytest

import uwsim
from tests.support.random_steps import check_without_warnings, take_random_steps
from uwsim.base.geometry import Pose
from uwsim.benchmark.measures import MEASURES, GraspSpec, InsertionSpec, ReachSpec
from uwsim.envs import BenchmarkEnv, make_env
from uwsim.errors import BadSetting, BenchmarkError, UnknownName

LEVEL = {"level": {"current": 0.2}}
LINKS = ("part0", "kinematic_base", "part1", "part2", "part3", "part4_base", "end_effector")


@pytest.fixture(scope="module")
def reach() -> Iterator[BenchmarkEnv]:
    env = make_env("reach")
    yield env
    env.close()


def slices_of(env: BenchmarkEnv) -> dict[str, slice]:
    names, sizes = zip(*env.layout, strict=True)
    ends = np.cumsum(sizes).tolist()
    return {name: slice(end - n, end) for name, n, end in zip(names, sizes, ends, strict=True)}


def base_from_tool(joints: np.ndarray) -> Pose:
    """Return the pose of ``end_effector`` in the base by MuJoCo's kinematics of the URDF alone.

    The joints' origins and axes are written out from the robot's file.
    """
    spec = mujoco.MjSpec()
    origins = {  # xyz, rpy of each joint's origin, and whether it turns about z
        "part0": ((0, 0, 0.95), (0, 0, np.pi), False),
        "kinematic_base": ((0, 0, 0.13), (0, 0, 0), False),
        "part1": ((0, 0, 0), (0, 0, 0), True),
        "part2": ((0.08052, 0, 0), (np.pi / 2, 0, 0), True),
        "part3": ((0.438492379277, 0.0614700067987, 0), (0, 0, 0.139277274), True),
        "part4_base": ((0.349117258152, 0.058023572508, 0), (np.pi / 2, 0, 1.972222055), True),
        "end_effector": ((0, 0, 0.1485), (0, 0, 0), False),
    }
    parent = spec.worldbody
    for name in LINKS:
        position, (roll, pitch, yaw), turns = origins[name]
        quaternion = np.zeros(4)
        mujoco.mju_euler2Quat(quaternion, np.array([roll, pitch, yaw]), "XYZ")
        parent = parent.add_body(name=name, pos=position, quat=quaternion)
        parent.add_geom(size=[0.01, 0, 0], mass=1.0)
        if turns:
            parent.add_joint(axis=[0, 0, 1])
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qpos[:] = joints
    mujoco.mj_kinematics(model, data)
    body = data.body("end_effector")
    return Pose(body.xpos.copy(), body.xmat.reshape(3, 3).copy())


def test_gymnasium_finds_nothing_wrong_with_reach(reach: BenchmarkEnv) -> None:
    check_without_warnings(reach)


@pytest.mark.slow
def test_gymnasium_finds_nothing_wrong_with_grasp() -> None:
    env = gymnasium.make("uwsim.envs:uwsim/Grasp-v0")
    check_without_warnings(env.unwrapped)
    env.close()


def test_the_observed_handle_is_where_kinematics_and_odometry_put_it(reach: BenchmarkEnv) -> None:
    reach.reset(seed=3, options=LEVEL)
    action = np.array([0.3, -0.5, 0.4, 0.8, 0.1, -0.1, 0.0, 0.2], np.float32)
    for _ in range(10):
        observation, *_ = reach.step(action)
    parts = slices_of(reach)
    world = reach._stepper._episode.simulation.world.measure_view  # type: ignore[union-attr]
    # the joints' state has a rate of 50 Hz: it is published at the end of each period of 0.1 s
    joints = observation[parts["/girona500/joint_state:position"]]
    tool = world.body("girona500").world_from_body @ base_from_tool(joints[:4])
    box = world.body("blackbox").world_from_body
    handle = box.position + box.rotation @ np.array([0.0, 0.0, 0.128])
    expected = tool.rotation.T @ (handle - tool.position)
    seen = observation[parts["handle"]]
    assert seen[:3] == pytest.approx(expected, abs=1e-6)
    axes = tool.rotation.T @ box.rotation[:, :2]
    assert seen[3:] == pytest.approx(axes.T.ravel(), abs=1e-6)


def test_the_observed_contact_is_that_of_the_engine() -> None:
    env = make_env(
        "grasp",
        observation=[
            "box=pose(blackbox, terrain)",
            "lying=contact(blackbox, terrain)",
            "held=contact(blackbox, girona500)",
        ],
        action=["/girona500/twist:vx=0.3"],
        reward="lying - held",
    )
    assert env.layout == (("box", 9), ("lying", 1), ("held", 1))
    env.reset(seed=1)
    for _ in range(3):
        observation, reward, *_ = env.step(np.zeros(1, np.float32))
    assert observation[9:].tolist() == [1.0, 0.0]
    assert reward == 1.0
    env.close()


def test_the_controller_reaches_the_handle_and_the_environment_says_so(reach: BenchmarkEnv) -> None:
    result = uwsim.bench("reach", seeds=(1,), levels={"current": [0.2]})
    names = [column.name for column in result.columns]
    row = dict(zip(names, result.rows[0], strict=True))
    assert (row["success"], row["status"]) == (1.0, "ok")
    assert row["success.distance"] < 0.03
    assert row["time"] < 12.0


def test_the_measures_of_an_episode_are_those_of_the_benchmark(
    reach: BenchmarkEnv, tmp_path: Path
) -> None:
    (tmp_path / "policy.py").write_text(
        "class Policy:\n"
        "    def __call__(self, observation):\n"
        "        return [0.1, -0.2, 0.1, 0.3, 0.1, 0.05, 0.1, 0.0]\n"
    )
    text = (Path(uwsim.__file__).parent / "data/benchmarks/reach.xml").read_text()
    benchmark = tmp_path / "reach.xml"
    benchmark.write_text(text.replace("<interval>20<", "<interval>1.5<"))
    result = uwsim.bench(
        str(benchmark),
        algorithm=f"{tmp_path / 'policy.py'}:Policy",
        seeds=(5,),
        levels={"current": [0.2]},
    )
    env = make_env(benchmark)
    env.reset(seed=5, options=LEVEL)
    is_over = False
    while not is_over:
        action = np.array([0.1, -0.2, 0.1, 0.3, 0.1, 0.05, 0.1, 0.0])
        _, _, terminated, truncated, info = env.step(action)
        is_over = terminated or truncated
    env.close()
    names = [column.name for column in result.columns]
    row = dict(zip(names, result.rows[0], strict=True))
    for name, value in info["measures"].items():
        assert value == pytest.approx(row[name], rel=1e-12)
    assert info["status"] == row["status"] == "unreached"
    assert (truncated, info["is_success"]) == (True, False)


def test_random_steps_give_the_same_finite_numbers_twice(reach: BenchmarkEnv) -> None:
    assert take_random_steps(reach, 15) == take_random_steps(reach, 15)


@pytest.mark.slow
@pytest.mark.parametrize("task", ["reach", "grasp"])
def test_two_thousand_random_steps_give_finite_numbers(task: str) -> None:
    env = make_env(task, period=0.02)
    take_random_steps(env, 2000)
    env.close()


def test_the_columns_for_rewards_are_in_the_logs() -> None:
    assert {name for name, spec in MEASURES.items() if spec.columns} == {
        "u:delivery",
        "u:grasp",
        "u:insertion",
        "u:reach",
    }
    with uwsim.load("reach-scene") as simulation:
        world = simulation.world.measure_view
        specs = (
            ReachSpec(name="a", from_="girona500", to="blackbox"),
            InsertionSpec(name="c", plug="girona500", socket="blackbox"),
            GraspSpec(name="b", target="blackbox", vehicle="girona500", jaw="girona500"),
        )
        for spec in specs:
            labels = [label.partition(" ")[0] for label in spec.bind(world).log_header]
            assert set(spec.columns) <= set(labels[1:])


def test_mistakes_name_what_is_expected(tmp_path: Path) -> None:
    with pytest.raises(UnknownName, match="blackbox"):
        make_env("reach", observation=["a=pose(blackbax, girona500)"], reward="0")
    with pytest.raises(BadSetting, match="dock=pose"):
        make_env("reach", observation=["pose(blackbox)"], reward="0")
    with pytest.raises(BadSetting, match="success_distance"):
        make_env("reach", reward="success_distanc")
    text = (Path(uwsim.__file__).parent / "data/benchmarks/reach.xml").read_text()
    path = tmp_path / "wrong.xml"
    path.write_text(text.replace("<name>handle</name>", "<name>success</name>"))
    with pytest.raises(BenchmarkError, match=r"wrong\.xml:.*success"):
        make_env(path)
