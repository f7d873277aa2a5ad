"""Compiled water moves bit for bit as water that Python computes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.water.water_rows import ask, rows_of
from uwsim.base.geometry import Pose, quaternion_from_rotation, rotation_from_quaternion
from uwsim.base.rng import stream
from uwsim.currents import (
    Constant,
    ConstituentSpec,
    Current,
    DelayedCurrent,
    Field,
    GaussMarkovSpec,
    Grid,
    LayerSpec,
    LayersSpec,
    LogProfileSpec,
    PowerProfileSpec,
    SceneContext,
    TargetCurrent,
    TidalSpec,
    TotalCurrent,
    UwsimSinusoidSpec,
)
from uwsim.scene.reader import read_scene
from uwsim.simulation.water.water_motion import WaterMotion

SCENE = read_scene(
    Path(str(resources.files("uwsim"))) / "data" / "scenes" / "currents-scene.xml"
).nominal_scene
TILTED = replace(
    SCENE,
    sim_params=replace(SCENE.sim_params, offsetp=(1.0, 2.0, 0.5), offsetr=(3.0, 0.1, -1.2)),
)
CONTEXT = SceneContext(
    stream=lambda name: stream(3, name),
    world_from_localized=TILTED.world_from_localized,
    surface_height=0.3,
)
VELOCITY = (0.4, -0.2, 0.05)


def a_field(outside: str = "edge") -> Field:
    random = np.random.default_rng(8)
    axes = [np.cumsum(random.uniform(0.5, 2.0, n)) for n in (4, 5, 3, 6)]
    velocities = random.normal(scale=0.3, size=(4, 5, 3, 6, 3))
    grid = Grid((axes[0], axes[1], axes[2], axes[3]), velocities)
    return Field(grid, start=0.4, outer_water=outside)


def a_profile() -> Current:
    return PowerProfileSpec(velocity=VELOCITY, depth=7.0).bind(CONTEXT)


def a_walk() -> Current:
    return GaussMarkovSpec(mean=VELOCITY, deviation=(0.1, 0.2, 0.3), mu=0.1).bind(CONTEXT)


def a_swell() -> Current:
    return UwsimSinusoidSpec(
        speed=0.3, speed_variation=0.1, speed_period=2.0, phi=0.7, theta=1.1, random=0.1
    ).bind(CONTEXT)


CURRENTS: dict[str, Callable[[], Current]] = {
    "constant": lambda: Constant(VELOCITY),
    "tidal": lambda: TidalSpec(
        start=900.0, constituents=(ConstituentSpec(name="M2", semi_major=0.4, inclination=0.7),)
    ).bind(CONTEXT),
    "gaussMarkov": a_walk,
    "uwsimSinusoid": a_swell,
    "powerProfile": a_profile,
    "logProfile": lambda: LogProfileSpec(velocity=VELOCITY, depth=7.0).bind(CONTEXT),
    "layers": lambda: LayersSpec(
        layers=(
            LayerSpec(depth=0.2, velocity=VELOCITY),
            LayerSpec(depth=2.0, velocity=(0.0, 0.3, 0.0)),
            LayerSpec(depth=2.5, velocity=(-0.1, 0.0, 0.2)),
        )
    ).bind(CONTEXT),
    "field": a_field,
    "field that is still outside": lambda: a_field("still"),
    "sum": lambda: TotalCurrent([a_profile(), a_walk(), a_field()]),
    "uniform sum": lambda: TotalCurrent([a_walk(), Constant(VELOCITY), a_swell()]),
    "late": lambda: DelayedCurrent(a_swell(), start=0.7, delay=0.2, offset=0.1),
    "late field": lambda: DelayedCurrent(a_field(), start=0.7, delay=0.2),
    "of a target": lambda: TotalCurrent([TargetCurrent(a_field(), "b"), Constant(VELOCITY)]),
    "of another target": lambda: TargetCurrent(a_profile(), "nobody"),
}
TIMES = [0.001, 0.003, 0.705, 0.899, 0.9005, 0.901, 1.6, 2.0, 70.0]
STEP = 0.002
VEHICLES = ("a", "", "b", "b", "a")
POINTS = np.random.default_rng(1).uniform(-4.0, 4.0, (len(VEHICLES), 3))


class InPython(Current):
    """A current whose function is not used."""

    def __init__(self, current: Current) -> None:
        self._current = current

    @property
    def is_uniform(self) -> bool:
        return self._current.is_uniform

    def velocity(self, points: np.ndarray, time: float, vehicles: Sequence[str] = ()) -> np.ndarray:
        return self._current.velocity(points, time, vehicles)

    def acceleration(
        self, points: np.ndarray, time: float, vehicles: Sequence[str] = ()
    ) -> np.ndarray:
        return self._current.acceleration(points, time, vehicles)


def water(current: Current) -> WaterMotion:
    motion = WaterMotion(TILTED, CONTEXT)
    motion.set(current)
    return motion


@pytest.mark.parametrize("name", CURRENTS)
def test_compiled_water_is_that_of_python_to_the_bit(name: str) -> None:
    motion = water(CURRENTS[name]())
    assert not motion.needs_positions(VEHICLES)
    last = range(1, round(TIMES[-1] / STEP) + 1)
    function = motion.motion_during(
        lambda: pytest.fail("asked for positions"), last, STEP, VEHICLES
    )
    assert function is not None
    found = rows_of(function, POINTS, TIMES)
    reference = water(InPython(CURRENTS[name]()))
    for row, time in zip(found, TIMES, strict=True):
        velocity, acceleration, rotation = reference.motion_at(POINTS, time, VEHICLES)
        turning = np.zeros_like(velocity) if rotation is None else rotation
        assert row.tobytes() == np.hstack([velocity, acceleration, turning]).tobytes()


@pytest.mark.parametrize("n", [1, 2, 3, 8])
def test_however_many_bodies_there_are(n: int) -> None:
    points, vehicles = np.random.default_rng(n).uniform(0.0, 4.0, (n, 3)), ("a",) * n
    function = water(a_field()).motion_during(lambda: points, range(1, 2), STEP, vehicles)
    assert function is not None
    velocity, acceleration, rotation = water(InPython(a_field())).motion_at(points, 1.3, vehicles)
    expected = np.hstack([velocity, acceleration, rotation]).tobytes()
    assert rows_of(function, points, [1.3])[0].tobytes() == expected


def test_water_with_one_current_of_python_is_asked_of_python() -> None:
    motion = water(TotalCurrent([a_profile(), InPython(a_walk())]))
    assert motion.needs_positions(VEHICLES)
    assert motion.drift_function(VEHICLES, 0.002, 1.0) is None


@pytest.mark.parametrize("name", CURRENTS)
def test_vehicles_drift_in_compiled_steps_as_python_carries_them(name: str) -> None:
    motion, reference = water(CURRENTS[name]()), water(InPython(CURRENTS[name]()))
    step, names = 0.25, ("a", "b")
    turns = np.random.default_rng(2).normal(size=(2, 4))
    poses = [
        Pose(point, rotation_from_quaternion(turn))
        for point, turn in zip(POINTS, turns, strict=False)
    ]
    rows = np.array([[*p.position, *quaternion_from_rotation(p.rotation)] for p in poses])
    for k in range(1, 30):
        time = k * step
        function = motion.drift_function(names, step, time)
        assert function is not None
        ask(function.function, function.address, rows, time)
        poses = [
            reference.drifted_pose(pose, time, step, vehicle)
            for pose, vehicle in zip(poses, names, strict=True)
        ]
        assert rows[:, :3].tobytes() == np.array([p.position for p in poses]).tobytes()
    for row, pose in zip(rows, poses, strict=True):
        assert rotation_from_quaternion(row[3:]) == pytest.approx(pose.rotation, abs=1e-14)
