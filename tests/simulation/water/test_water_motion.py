"""Water that turns and is sheared, and what floats in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from importlib import resources
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

from tests.simulation.water.water_rows import rows_of
from tests.support.opened import open_scene
from uwsim.currents import Constant, SceneContext, TargetCurrent, TotalCurrent, UwsimSinusoidSpec
from uwsim.currents.current import Current
from uwsim.scene.hydrodynamics import BodyHydrodynamics
from uwsim.scene.hydrodynamics.vehicle_file import read_vehicle
from uwsim.scene.hydrodynamics.vehicle_sets import vehicle_sets
from uwsim.scene.reader import read_scene
from uwsim.scene.vehicle import VehicleSpec
from uwsim.simulation import Simulation
from uwsim.simulation.water.water_motion import WaterMotion

SCENE = Path(str(resources.files("uwsim"))) / "data" / "scenes" / "currents-scene.xml"


class Linear(Current):
    """A velocity that is linear in the place."""

    def __init__(self, gradient: Sequence[Sequence[float]], steady: Sequence[float] = (0, 0, 0)):
        self._gradient, self._steady = np.array(gradient, float), np.array(steady, float)

    def velocity(self, points: np.ndarray, time: float, vehicles: Sequence[str] = ()) -> np.ndarray:
        return np.asarray(points @ self._gradient.T + self._steady)


EDDY = [[0.0, -0.1, 0.0], [0.1, 0.0, 0.0], [0.0, 0.0, 0.0]]
SHEAR = [[0.0, 0.3, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]


def test_an_eddy_accelerates_towards_its_middle_and_turns() -> None:
    scene = read_scene(SCENE).nominal_scene
    motion = WaterMotion(scene, SceneContext(stream=lambda _: np.random.default_rng()))
    motion.set(Linear(EDDY))
    at = scene.world_from_localized.transform(np.array([[10.0, 0.0, 0.0]]))
    velocity, acceleration, rotation = motion.motion_at(at, 0.0, ("",))
    back = scene.world_from_localized.rotation
    assert velocity[0] == pytest.approx(back @ [0.0, 1.0, 0.0], abs=1e-9)
    assert acceleration[0] == pytest.approx(back @ [-0.1, 0.0, 0.0], abs=1e-9)
    assert rotation is not None
    assert rotation[0] == pytest.approx(back @ [0.0, 0.0, 0.1], abs=1e-9)


def bluerov(current: Current) -> Simulation:
    scene = read_scene(SCENE).nominal_scene
    vehicle = VehicleSpec(
        name="bluerov", file="bluerov2_heavy.urdf", dynamics="bluerov2_heavy", position=(0, 0, 3.0)
    )
    simulation = open_scene(
        replace(scene, vehicles=(vehicle,), objects=(), ros_interfaces=()), is_blind=True
    )
    simulation.advance(0.0)
    simulation.world.water.set(current)
    simulation.world.engine.actuation[0].autopilot.set_wrench(np.zeros(3), np.zeros(3))  # adrift
    return simulation


def test_a_vehicle_adrift_in_sheared_water_turns_with_it() -> None:
    simulation = bluerov(Linear(SHEAR))
    for _ in range(round(6.0 / simulation.timestep)):
        simulation.advance()
    # half the shear, a little less for what is not a ball
    assert -0.16 < simulation.world.engine.vehicle_velocity(0)[5] < -0.09


def test_a_neutral_ball_goes_round_in_an_eddy() -> None:
    """Released with the water 2 m from the middle it stays there, and is not flung out."""
    simulation = bluerov(Linear(EDDY))
    state = simulation.world.engine
    frame = simulation.world.model.scene.world_from_localized
    base = state.poses.vehicle(0)
    state.place_vehicle(0, replace(base, position=frame.transform(np.array([[2.0, 0, 3.0]]))[0]))
    velocity = state._data.qvel[state._base_dofs[0] : state._base_dofs[0] + 6]
    velocity[:3] = frame.rotation @ [0.0, 0.2, 0.0]
    velocity[3:] = base.rotation.T @ frame.rotation @ [0.0, 0.0, 0.1]
    for _ in range(round(5.0 / simulation.timestep)):
        simulation.advance()
    place = frame.inverse().transform(state.poses.vehicle(0).position[None])[0]
    assert np.hypot(*place[:2]) == pytest.approx(2.0, abs=0.01)


def test_a_hull_below_its_origin_feels_the_water_where_it_is() -> None:
    """Of a current that grows with depth."""
    shift = (0.0, 0.0, 2.0)
    simulation = bluerov(Linear([[0.0, 0.0, 0.1], [0.0] * 3, [0.0] * 3]))
    water = simulation.world.engine._water
    assert water is not None
    own = read_vehicle(vehicle_sets()["bluerov2_heavy"]).bodies[0]
    assert isinstance(own, BodyHydrodynamics)
    row = water.model.body_user[water.bodies[0]]
    assert water.reference_point(water.bodies[0]) == pytest.approx(own.centre_of_buoyancy)
    row[3:6] += shift  # the centre of buoyancy
    assert water.reference_point(water.bodies[0])[2] == pytest.approx(
        own.centre_of_buoyancy[2] + 2.0
    )


@pytest.mark.parametrize("vehicles", [(), ("",), ("a", "", "b", "b", "a", "")])
def test_uniform_water_of_several_steps_is_that_of_each_step(vehicles: tuple[str, ...]) -> None:
    scene = read_scene(SCENE).nominal_scene
    context = SceneContext(stream=lambda _: np.random.Generator(np.random.Philox(4)))
    swelling = UwsimSinusoidSpec(
        speed=0.3, speed_variation=0.1, speed_period=2.0, phi=0.7, theta=1.1, random=0.1
    ).bind(context)
    motion = WaterMotion(scene, context)
    motion.set(TotalCurrent([Constant((0.1, -0.2, 0.03)), TargetCurrent(swelling, "b")]))
    steps, timestep = range(249, 252), 0.002
    times = [step * timestep - 0.5 * timestep for step in steps]
    found = motion.motion_during(lambda: np.zeros((len(vehicles), 3)), steps, timestep, vehicles)
    assert found is not None
    rows = rows_of(found, np.zeros((len(vehicles), 3)), times)
    assert rows.shape == (3, len(vehicles), 9)
    for row, time in zip(rows, times, strict=True):
        velocity, acceleration, rotation = motion.motion_at(
            np.ones((len(vehicles), 3)), time, vehicles
        )
        assert rotation is None
        assert (
            row.tobytes() == np.hstack([velocity, acceleration, np.zeros_like(velocity)]).tobytes()
        )


class Asked(Constant):
    """Notes the vehicles it is asked for."""

    asked: ClassVar[list[tuple[str, ...]]] = []

    def velocity(self, points: np.ndarray, time: float, vehicles: Sequence[str] = ()):
        self.asked.append(tuple(vehicles))
        return super().velocity(points, time, vehicles)


class Changing(Asked):
    """Says that it may change with time."""

    @property
    def is_steady(self) -> bool:
        return False


@pytest.mark.parametrize(("kind", "n"), [(Changing, 4), (Asked, 2)])
def test_uniform_water_of_python_is_asked_for_once_a_vehicle(kind: type[Asked], n: int) -> None:
    """At each time; if it is steady, once for all times of a run."""
    Asked.asked.clear()
    motion = WaterMotion(
        read_scene(SCENE).nominal_scene, SceneContext(stream=lambda _: np.random.default_rng())
    )
    motion.set(kind((0.1, 0.0, 0.0)))
    vehicles, points, rows = ("a", "a", "", "a", ""), np.zeros((5, 3)), []
    for first in (1, 3):
        found = motion.motion_during(lambda: points, range(first, first + 2), 0.1, vehicles)
        assert found is not None
        rows.append(rows_of(found, points, (0.1, 0.2)))
    assert Asked.asked == [("a", "")] * n
    assert rows[0][0].tobytes() == rows[0][1].tobytes() == rows[1][0].tobytes()


def test_another_current_or_other_bodies_are_not_taken_for_those_before() -> None:
    motion = WaterMotion(
        read_scene(SCENE).nominal_scene, SceneContext(stream=lambda _: np.random.default_rng())
    )
    rows = []
    for x, vehicles in ((0.1, ("a",)), (0.2, ("a",)), (0.2, ("a", "b")), (0.1, ("a", "b"))):
        motion.set(TargetCurrent(Constant((x, 0.0, 0.0)), "a"))
        found = motion.motion_during(lambda: np.zeros((9, 3)), range(1, 2), 0.1, vehicles)
        assert found is not None
        asked = rows_of(found, np.zeros((len(vehicles), 3)), (0.1,))
        rows.append(np.linalg.norm(asked[0, :, :3], axis=1).tolist())
    assert rows == [pytest.approx(speeds) for speeds in ([0.1], [0.2], [0.2, 0.0], [0.1, 0.0])]
