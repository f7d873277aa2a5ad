"""Steps taken many at once, where nothing comes between, end at the same bytes as one by one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import mujoco
import numpy as np
import pytest

from tests.simulation.girona500 import SCENE, TWIST, make
from tests.support.opened import open_scene
from uwsim.bus import Node
from uwsim.currents import (
    ConstantSpec,
    PowerProfileSpec,
    SceneContext,
    TotalCurrent,
    UwsimSinusoidSpec,
)
from uwsim.devices.fault import FaultSpec
from uwsim.errors import RunFailed
from uwsim.messages import Odometry, Twist, TwistStamped, Vector3, header
from uwsim.physics.step_kernel import engine_rotation
from uwsim.scene.reader import read_scene
from uwsim.sensors import ImuSpec
from uwsim.simulation import Simulation
from uwsim.topics.pat_to_ros_odom import PATToROSOdomSpec

SECONDS = 0.5
ODOMETRY = PATToROSOdomSpec(topic="/odometry", vehicle_name="girona500", rate=30)
SWELL = UwsimSinusoidSpec(speed=0.2, speed_variation=0.1, speed_period=0.4, random=0.1)
FAULT = FaultSpec(thruster="sway", loss=0.7, start=0.1003, end=0.3)


class Pilot:
    """Sends a twist 20 times a second, some time after it was decided on."""

    def start(self, node: Node) -> None:
        publish = node.publisher("/twist", TwistStamped)

        def steer() -> None:
            surge = Vector3(x=0.3 * np.sin(5.0 * node.now), y=0.1, z=0.0)
            twist = Twist(linear=surge, angular=Vector3(x=0.0, y=0.0, z=0.2))
            publish(TwistStamped(header=header(0.0), twist=twist))

        node.create_timer(0.05, steer)


def swell(simulation: Simulation) -> None:
    simulation.world.water.set(SWELL.bind(SceneContext(stream=simulation.world.stream)))


def sheared(simulation: Simulation) -> None:
    context = SceneContext(
        stream=simulation.world.stream,
        world_from_localized=simulation.world.model.scene.world_from_localized,
    )
    profile = PowerProfileSpec(velocity=(0.4, 0.1, 0.0), depth=20.0).bind(context)
    simulation.world.water.set(TotalCurrent([profile, SWELL.bind(context)]))


def with_pilot(simulation: Simulation) -> None:
    simulation.attach(Pilot(), parameters={"latency_s": 0.013})


def driving_an_arm(simulation: Simulation) -> None:
    servos = simulation.world.engine.actuation[0].servos
    servos.set_velocity_targets(np.array([0, 2]), np.array([0.3, -0.4]))
    servos.set_efforts(np.array([1]), np.array([3.0]))


def adrift(simulation: Simulation) -> None:
    simulation.world.engine.actuation[0].autopilot.set_wrench(
        np.array([20.0, 3.0, 1.0]), np.zeros(3)
    )


def still(simulation: Simulation) -> None:
    pass


def played(prepare: Callable[[Simulation], None], *, at_once: bool) -> tuple[bytes, list[bytes]]:
    """Advance a while; the motion at the end, and each odometry message."""
    simulation = make((TWIST, ODOMETRY), change=lambda vehicle: replace(vehicle, parts=(FAULT,)))
    heard: list[bytes] = []
    simulation.bus.subscribe(
        "/odometry",
        Odometry,
        lambda m: heard.append(np.array([*vars(m.pose.pose.position).values()][:3]).tobytes()),
    )
    prepare(simulation)
    if at_once:
        simulation.advance(SECONDS)
    else:
        for _ in range(round(SECONDS / simulation.timestep)):
            simulation.advance()
    motion = np.zeros(simulation.world.engine.motion.size)
    simulation.world.engine.motion.read(motion)
    assert simulation.step == round(SECONDS / simulation.timestep)
    return motion.tobytes(), heard


@pytest.mark.parametrize("prepare", [still, swell, sheared, with_pilot, driving_an_arm, adrift])
def test_many_steps_at_once_are_the_same_bytes(prepare: Callable[[Simulation], None]) -> None:
    one_by_one, at_once = played(prepare, at_once=False), played(prepare, at_once=True)
    assert at_once == one_by_one
    assert len(at_once[1]) == 15


def count_runs(simulation: Simulation, monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Return a list to which each run of steps adds how many it takes."""
    taken: list[int] = []
    step = simulation.world.engine.step

    def counted(n: int, *rest: Any, **others: Any) -> Any:
        taken.append(n)
        return step(n, *rest, **others)

    monkeypatch.setattr(simulation.world.engine, "step", counted)
    return taken


@pytest.mark.parametrize("prepare", [still, swell, sheared])
def test_the_engine_is_called_once_for_many_steps_that_nothing_comes_between(
    prepare: Callable[[Simulation], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    simulation = make()
    simulation.advance()
    prepare(simulation)
    taken = count_runs(simulation, monkeypatch)
    simulation.advance(0.1)
    assert taken == [50]
    simulation.watch(lambda: None)  # who observes does so in every step
    simulation.advance(0.01)
    assert taken == [50, 1, 1, 1, 1, 1]


def test_a_current_of_uwsim_that_a_program_sets_ends_no_run(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    simulation = make()
    profile = PowerProfileSpec(velocity=(0.4, 0.0, 0.0), depth=20.0)
    simulation.set_current(profile.bind(SceneContext(stream=simulation.world.stream)))
    taken = count_runs(simulation, monkeypatch)
    simulation.advance(0.1)
    assert taken == [50]
    simulation.set_current(Gyre())
    simulation.advance(0.01)
    assert taken == [50, 1, 1, 1, 1, 1]


def beside_a_drifter(*, is_read: bool = False, has_dynamics: bool = True) -> Simulation:
    """A vehicle, simulated or not, and one that drifts, whose motion a sensor may read."""
    scene = read_scene(SCENE).nominal_scene
    first = replace(scene.vehicles[0], parts=())
    first = first if has_dynamics else replace(first, dynamics=None)
    imu = ImuSpec(name="imu", relative_to="base_link")
    second = replace(
        first,
        name="drifter",
        dynamics=None,
        position=(3.0, 4.0, 2.0),
        orientation=(0.1, -0.2, 0.7),
        parts=(imu,) if is_read else (),
    )
    simulation = open_scene(replace(scene, vehicles=(first, second), objects=(), ros_interfaces=()))
    simulation.advance(0.0)
    return simulation


@pytest.mark.parametrize(("is_read", "runs"), [(False, [50]), (True, [1] * 50)])
def test_a_vehicle_drifts_in_many_steps_at_once_unless_its_motion_is_read(
    monkeypatch: pytest.MonkeyPatch, *, is_read: bool, runs: list[int]
) -> None:
    ends = []
    for at_once in (True, False):
        simulation = beside_a_drifter(is_read=is_read)
        sheared(simulation)
        taken = count_runs(simulation, monkeypatch)
        before = simulation.pose("drifter").position
        for _ in range(1 if at_once else 50):
            simulation.advance(0.1 if at_once else None)
        assert taken == (runs if at_once else [1] * 50)
        after = simulation.pose("drifter").position
        assert 0.03 < np.linalg.norm(after - before) < 0.07
        ends.append(simulation.world.engine._data.qpos.tobytes())
    assert ends[0] == ends[1]


@pytest.mark.parametrize("is_read", [False, True])
@pytest.mark.parametrize("has_dynamics", [False, True])
def test_a_vehicle_drifts_as_python_carries_it(
    monkeypatch: pytest.MonkeyPatch, *, is_read: bool, has_dynamics: bool
) -> None:
    ends, twists = [], []
    for in_python in (True, False):
        simulation = beside_a_drifter(is_read=is_read, has_dynamics=has_dynamics)
        sheared(simulation)
        if in_python:
            monkeypatch.setattr(simulation.world.water, "drift_function", lambda *_: None)
        simulation.advance(0.5)
        ends.append(simulation.world.engine._data.qpos.tobytes())
        twists.append(simulation.world.vehicles.find("drifter").velocity.tolist())
    assert ends[0] == ends[1]
    assert twists[0] == twists[1]
    assert any(twists[0]) is is_read


class Gyre:
    """Water that turns about the origin of L; counts at how many times it was asked."""

    is_uniform = False
    is_still = False

    def __init__(self) -> None:
        self.times: set[float] = set()

    def velocity(self, points: np.ndarray, time: float, vehicles: Sequence[str] = ()) -> np.ndarray:
        self.times.add(time)
        return 0.1 * np.column_stack([-points[:, 1], points[:, 0], 0.0 * points[:, 0]])

    def acceleration(
        self, points: np.ndarray, time: float, vehicles: Sequence[str] = ()
    ) -> np.ndarray:
        return np.zeros_like(points)

    def motion(
        self, points: np.ndarray, time: float, vehicles: Sequence[str] = ()
    ) -> tuple[np.ndarray, np.ndarray]:
        return self.velocity(points, time, vehicles), self.acceleration(points, time, vehicles)


def test_water_that_differs_from_place_to_place_is_asked_in_every_step() -> None:
    simulation, gyre = make(), Gyre()
    simulation.world.water.set(gyre)
    simulation.advance(0.02)
    assert len(gyre.times) == 10


def test_water_that_comes_to_rest_is_still() -> None:
    ends = []
    for at_once in (True, False):
        simulation = make()
        simulation.world.water.set(
            ConstantSpec(velocity=(0.4, 0.0, 0.0)).bind(
                SceneContext(stream=simulation.world.stream)
            )
        )
        simulation.advance(0.1)
        simulation.world.water.set(None)
        for _ in range(1 if at_once else 50):
            simulation.advance(0.1 if at_once else None)
        ends.append(simulation.velocity("girona500").tolist())
    assert ends[0] == ends[1]
    assert not simulation.world.engine._data.userdata.any()


@pytest.mark.parametrize("at_once", [True, False])
def test_a_run_that_fails_ends_at_the_step_that_failed(*, at_once: bool) -> None:
    simulation = open_scene(read_scene(SCENE).nominal_scene, is_blind=True)
    simulation.advance(0.01)
    data = simulation.world.engine._data
    data.qfrc_applied[3] = 4e6  # soon it spins too fast

    def go_on() -> None:
        for _ in range(1 if at_once else 500):
            simulation.advance(1.0 if at_once else None)

    with pytest.raises(RunFailed, match="moves at") as error:
        go_on()
    assert f"at {simulation.time:g} s" in str(error.value)
    assert 5 < simulation.step < 500


def test_a_base_is_turned_as_the_engine_turns_it() -> None:
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>"
    )
    data, random = mujoco.MjData(model), np.random.default_rng(3)
    for _ in range(200):
        data.qpos[3:] = random.normal(size=4)
        mujoco.mj_kinematics(model, data)
        assert np.array_equal(engine_rotation(*data.qpos[3:].tolist()).ravel(), data.xmat[1])
