"""A simulated Girona 500 under its autopilot, in still and in moving water."""

from collections.abc import Sequence
from dataclasses import replace
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.currents import ConstantSpec, SceneContext, UwsimSinusoidSpec
from uwsim.errors import BadSetting, RunFailed
from uwsim.messages import Twist, TwistStamped, Vector3, header
from uwsim.scene.hydrodynamics.vehicle_file import read_vehicle
from uwsim.scene.hydrodynamics.vehicle_sets import vehicle_sets
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation

SCENE = Path(str(resources.files("uwsim"))) / "data" / "scenes" / "currents-scene.xml"


def make(velocity_loop: str = "water") -> Simulation:
    scene = read_scene(SCENE).nominal_scene
    vehicle = replace(scene.vehicles[0], velocity_loop=velocity_loop, parts=())
    simulation = open_scene(
        replace(scene, vehicles=(vehicle,), objects=(), ros_interfaces=scene.ros_interfaces[1:])
    )
    simulation.advance(0.0)
    return simulation


def run(simulation: Simulation, seconds: float) -> None:
    for _ in range(round(seconds / simulation.timestep)):
        simulation.advance()


def position(simulation: Simulation) -> np.ndarray:
    world = simulation.world.bodies.find("girona500").world_from_body
    return (simulation.world.model.scene.world_from_localized.inverse() @ world).position


def heading_deg(simulation: Simulation) -> float:
    world = simulation.world.bodies.find("girona500").world_from_body
    rotation = (simulation.world.model.scene.world_from_localized.inverse() @ world).rotation
    return float(np.degrees(np.arctan2(rotation[1, 0], rotation[0, 0])))


def set_current(simulation: Simulation, velocity: tuple[float, float, float]) -> None:
    context = SceneContext(stream=simulation.world.stream)
    simulation.world.water.set(ConstantSpec(velocity=velocity).bind(context))


def command(simulation: Simulation, surge: float, sway: float) -> None:
    zero = Vector3(x=0.0, y=0.0, z=0.0)
    twist = Twist(linear=Vector3(x=surge, y=sway, z=0.0), angular=zero)
    simulation.bus.publisher("/dataNavigator", TwistStamped)(
        TwistStamped(header=header(0.0), twist=twist)
    )


def test_in_still_water_it_stays_where_it_is() -> None:
    simulation = make()
    run(simulation, 10.0)
    assert position(simulation) == pytest.approx([3.0, 1.5, 1.515], abs=0.01)
    assert heading_deg(simulation) == pytest.approx(90.0, abs=0.2)


def test_without_bottom_lock_it_drifts_with_the_current_and_holds_depth_and_heading() -> None:
    simulation = make()
    set_current(simulation, (0.15, -0.1, 0.0))
    run(simulation, 10.0)
    before = position(simulation)
    run(simulation, 5.0)
    speed = (position(simulation) - before) / 5.0
    assert speed[:2] == pytest.approx([0.15, -0.1], abs=0.003)
    assert position(simulation)[2] == pytest.approx(1.515, abs=0.02)
    assert heading_deg(simulation) == pytest.approx(90.0, abs=1.0)


def test_with_bottom_lock_the_current_takes_it_nowhere() -> None:
    simulation = make("ground")
    set_current(simulation, (0.15, -0.1, 0.0))
    run(simulation, 10.0)
    before = position(simulation)
    run(simulation, 5.0)
    assert position(simulation) == pytest.approx(before, abs=0.01)


def test_a_twist_is_held_until_the_next_one() -> None:
    simulation = make()
    command(simulation, 0.2, 0.1)
    run(simulation, 10.0)
    before = position(simulation)
    run(simulation, 4.0)
    # the bow points along L's y, starboard along -x
    assert (position(simulation) - before) / 4.0 == pytest.approx([-0.1, 0.2, 0.0], abs=0.01)


def test_a_twist_is_followed_with_the_lag_of_the_reference_model() -> None:
    simulation = make()
    run(simulation, 2.0)
    start = position(simulation)
    command(simulation, 0.2, 0.0)
    run(simulation, 5.0)
    lag = 5.0 - (position(simulation)[1] - start[1]) / 0.2  # of a first-order loop: its constant
    assert lag == pytest.approx(2.5 * 0.2, abs=0.1)


def test_two_runs_are_the_same_to_the_last_bit() -> None:
    ends = []
    for _ in range(2):
        simulation = make()
        set_current(simulation, (0.1, 0.0, 0.0))
        command(simulation, -0.1, 0.05)
        run(simulation, 3.0)
        ends.append(position(simulation).tobytes())
    assert ends[0] == ends[1]


def test_a_vehicle_that_is_put_back_is_at_rest() -> None:
    simulation = make()
    command(simulation, 0.3, 0.0)
    run(simulation, 5.0)
    simulation.world.vehicles.find("girona500").reset_pose(None)
    assert position(simulation) == pytest.approx([3.0, 1.5, 1.515])
    run(simulation, 5.0)
    assert position(simulation) == pytest.approx([3.0, 1.5, 1.515], abs=0.02)


def test_a_twist_beyond_its_reach_is_forgotten_with_the_next_one() -> None:
    simulation = make()
    command(simulation, 1e300, 0.0)
    run(simulation, 10.0)
    command(simulation, 0.0, 0.0)
    run(simulation, 8.0)
    before = position(simulation)
    run(simulation, 2.0)
    assert np.linalg.norm(position(simulation) - before) < 0.2


def test_motion_beyond_all_bounds_is_an_error_that_says_where() -> None:
    simulation = make()
    set_current(simulation, (1e30, 0.0, 0.0))
    with pytest.raises(RunFailed, match=r"'girona500/.*' grew beyond all bounds at 0\.002 s"):
        run(simulation, 1.0)


@pytest.mark.parametrize("dof", [0, 3])
def test_a_body_beyond_100_m_s_or_100_rad_s_ends_the_run(dof: int) -> None:
    simulation = make()
    simulation.advance()
    simulation.world.engine._data.qvel[dof] = 400.0
    with pytest.raises(RunFailed, match=r"'girona500/.*' moves at .* at 0\.004 s"):
        simulation.advance()


def test_an_integrator_may_be_chosen() -> None:
    scene = read_scene(SCENE).nominal_scene
    simulation = open_scene(scene, integrator="RK4", is_blind=True)
    assert simulation.world.engine._model.opt.integrator == 1
    with pytest.raises(BadSetting, match="expected implicitfast or RK4"):
        open_scene(scene, integrator="Euler")  # type: ignore[arg-type]


@pytest.mark.parametrize("timestep", [0.021, 0.05, 0.0, -0.002, float("nan"), float("inf")])
def test_a_step_that_the_physics_does_not_bear_is_refused(timestep: float) -> None:
    scene = read_scene(SCENE).nominal_scene
    said = "expected 0.02 s at most" if 0.0 < timestep < 1.0 else "expected a time > 0"
    with pytest.raises(BadSetting, match=said):
        open_scene(scene, timestep=timestep, is_blind=True)


def test_without_a_simulated_vehicle_a_step_may_be_long() -> None:
    scene = read_scene(SCENE).nominal_scene
    vehicle = replace(scene.vehicles[0], dynamics=None, parts=())
    still = replace(scene, vehicles=(vehicle,), ros_interfaces=())
    open_scene(still, timestep=0.05, is_blind=True).close()


class Asked:
    """Still water that remembers where it was asked about."""

    is_uniform = False
    is_still = False

    def __init__(self) -> None:
        self.points: list[list[float]] = []
        self.names: set[str] = set()

    def velocity(self, points: np.ndarray, time: float, vehicles: Sequence[str] = ()) -> np.ndarray:
        self.points += points.tolist()
        self.names |= set(vehicles)
        return np.zeros((len(points), 3))

    acceleration = velocity

    def motion(
        self, points: np.ndarray, time: float, vehicles: Sequence[str] = ()
    ) -> tuple[np.ndarray, np.ndarray]:
        return self.velocity(points, time, vehicles), self.acceleration(points, time, vehicles)


def test_water_is_asked_only_where_it_acts() -> None:
    scene = read_scene(SCENE).nominal_scene
    vehicle = replace(scene.vehicles[0], parts=())
    simulation = open_scene(replace(scene, vehicles=(vehicle,)), is_blind=True)
    simulation.advance(0.0)
    asked = Asked()
    simulation.world.water.set(asked)
    simulation.advance()
    assert asked.names == {"girona500"}
    # velocity, acceleration, and the velocity at six points around for the shear
    assert len(asked.points) == 8 * len(read_vehicle(vehicle_sets()["g500_physical"]).bodies)
    away = np.linalg.norm(np.array(asked.points) - vehicle.position, axis=1)
    assert away.max() < 2.0


def test_water_that_never_moves_leaves_the_same_bytes_asked_or_not() -> None:
    ends = []
    for is_asked in (False, True):
        simulation = make()
        context = SceneContext(stream=simulation.world.stream)
        none = UwsimSinusoidSpec(speed=0.0, theta=1.0).bind(context)
        simulation.world.water.set(Asked() if is_asked else none)
        assert simulation.world.water.is_still != is_asked
        wanted = Twist(linear=Vector3(x=0.3, y=0.1, z=0.0), angular=Vector3(x=0.0, y=0.0, z=0.2))
        publish = simulation.bus.publisher("/dataNavigator", TwistStamped)
        publish(TwistStamped(header=header(0.0), twist=wanted))
        run(simulation, 0.2)
        ends.append(np.zeros(simulation.world.engine.motion.size))
        simulation.world.engine.motion.read(ends[-1])
    assert np.array_equal(*ends)
    assert np.linalg.norm(simulation.velocity("girona500")) > 0.01
