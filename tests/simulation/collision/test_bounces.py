"""Objects with a restitution on relief: no energy from nothing, and nothing falls through."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.collision.test_floor import BOX, UP, grid, ground
from tests.simulation.girona500 import SCENE
from tests.support.opened import open_scene
from uwsim.base.geometry import Pose
from uwsim.errors import SimulationFailed
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.simulation import Simulation


def relief(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Waves of 5 m and of 1.6 m, in facets of 0.4 m."""
    return -6.0 + 0.5 * np.sin(1.3 * x) * np.cos(1.1 * y) + 0.15 * np.sin(4 * x) * np.sin(3.7 * y)


@pytest.fixture(scope="module")
def floor(tmp_path_factory: pytest.TempPathFactory) -> ObjectSpec:
    return ground(grid(tmp_path_factory.mktemp("relief"), relief))


def loose(name: str, x: float, y: float, height: float, *, scale: float = 2.5, rpy=(0.0, 0.0, 0.0),
          **physics: object) -> ObjectSpec:  # fmt: skip
    place = (x, y, float(relief(np.array(x), np.array(y))) + height)
    return ObjectSpec(
        name=name, file=BOX, position=place, orientation=rpy, scale_factor=(scale,) * 3,
        physics=PhysicsSpec(**physics),  # type: ignore[arg-type]
    )  # fmt: skip


def in_air(*objects: ObjectSpec, timestep: float) -> Simulation:
    sim = replace(UP, enable_physics=True, gravity=(0.0, 0.0, -9.81))
    return open_scene(SceneSpec(sim_params=sim, objects=objects), timestep=timestep, is_blind=True)


def in_water(*objects: ObjectSpec, timestep: float) -> Simulation:
    vehicle = read_scene(SCENE).vehicles[0]
    far = replace(vehicle, parts=(), position=(6.5, 6.5, -1.0), orientation=(np.pi, 0.0, 0.0))
    scene = SceneSpec(sim_params=UP, objects=objects, vehicles=(far,))
    return open_scene(scene, timestep=timestep, is_blind=True)


def height(simulation: Simulation, name: str = "thing") -> float:
    return float(simulation.world.bodies.find(name).world_from_body.position[2])


@pytest.mark.parametrize(
    ("timestep", "restitution", "mass", "scale", "seed"),
    [
        (0.01, 0.9, 157.0, 2.5, 0),
        pytest.param(0.02, 0.9, 157.0, 2.5, 3, marks=pytest.mark.slow),
        pytest.param(0.02, 0.5, 20.0, 1.5, 1, marks=pytest.mark.slow),
        pytest.param(0.01, 0.95, 900.0, 4.0, 2, marks=pytest.mark.slow),
    ],
)
def test_on_relief_nothing_rises_above_its_start(
    timestep: float, restitution: float, mass: float, scale: float, seed: int, floor: ObjectSpec
) -> None:
    random = np.random.default_rng(seed)
    x, y = random.uniform(-4.0, 4.0, 2)
    thing = loose(
        "thing", x, y, 1.5 * scale / 2.5, scale=scale, rpy=tuple(random.uniform(-3.0, 3.0, 3)),
        mass=mass, restitution=restitution,
    )  # fmt: skip
    simulation = in_air(thing, floor, timestep=timestep)
    start, highest = height(simulation), -np.inf
    with suppress(SimulationFailed):  # below the ground: that is reported
        for _ in range(60):
            simulation.advance(0.05)
            highest = max(highest, height(simulation))
    assert highest <= start


def test_in_water_the_bound_takes_nothing_from_a_bounce(floor: ObjectSpec) -> None:
    """A level floor, where a single spring adds no energy: the bound changes no bit."""
    flat = ground(floor.file.replace("ground.obj", "flat.obj"))
    Path(flat.file).write_text("v -8 -8 -6\nv 8 -8 -6\nv 8 8 -6\nv -8 8 -6\nf 1 2 3\nf 1 3 4\n")
    thing = loose("thing", 0.0, 0.0, 1.5, mass=157.0, restitution=0.6, volume=0.02)
    ends = []
    for is_on in (True, False):
        simulation = in_water(thing, flat, timestep=0.002)
        if not is_on:
            simulation.world.engine._bounce_limit.is_on = False
            simulation.world.engine._bounce_limit.apply = lambda: None
        simulation.advance(2.0)
        ends.append(simulation.world.bodies.find("thing").world_from_body.matrix.tobytes())
    assert ends[0] == ends[1]


@pytest.mark.parametrize("timestep", [0.002, 0.02])
@pytest.mark.parametrize("name", ["thing", "girona500"])
def test_a_body_that_has_passed_through_the_ground_ends_the_run_by_its_name(
    timestep: float, name: str, floor: ObjectSpec
) -> None:
    """It is put there between two steps, as a load that is too heavy would press it."""
    thing = loose("thing", 0.3, 0.2, 0.5, mass=157.0, restitution=0.5, volume=0.02)
    simulation = in_water(thing, floor, timestep=timestep)
    engine = simulation.world.engine
    simulation.advance(0.5)
    joint = int(engine._model.body_jntadr[engine.poses.loose_body(0)])
    place = int(engine._model.jnt_qposadr[joint]) if name == "thing" else engine._base_addresses[0]
    engine._data.qpos[place + 2] -= 1.0 if name == "thing" else 9.0
    with pytest.raises(SimulationFailed, match=f"'{name}' has passed through the ground"):
        simulation.advance(1.5)


@pytest.mark.slow
def test_a_ball_too_fast_for_its_step_does_not_fall_on_silently(floor: ObjectSpec) -> None:
    """Of drops from 3 m at 20 ms some go through; the run of each ends or it stays above."""
    for seed in range(6):
        x, y = np.random.default_rng(seed).uniform(-4.0, 4.0, 2)
        thing = loose("thing", x, y, 3.0, mass=157.0, restitution=0.9, volume=0.02)
        simulation = in_air(thing, floor, timestep=0.02)
        with suppress(SimulationFailed):
            simulation.advance(4.0)
            body = simulation.world.bodies.find("thing").world_from_body.position
            inside = np.abs(body[:2]).max() < 8.0
            assert not inside or body[2] > float(relief(body[0], body[1])) - 1.5


STEPS = [0.002, 0.005, 0.01, 0.02]
MEDIA = {"air": in_air, "water": in_water}


def drawn(random: np.random.Generator, *, is_in_water: bool) -> dict[str, float]:
    """Physics of a box of 1 to 200 kg."""
    mass = float(np.exp(random.uniform(0.0, np.log(200.0))))
    restitution, friction = random.uniform(0.0, 0.9), random.uniform(0.0, 1.5)
    volume = {"volume": 0.3e-3 * mass} if is_in_water else {}
    return {"mass": mass, "restitution": restitution, "friction": friction, **volume}


def is_below(simulation: Simulation, name: str, reach: float) -> bool:
    x, y, z = simulation.world.bodies.find(name).world_from_body.position
    return bool(max(abs(x), abs(y)) < 8.0 and z < relief(x, y) - reach)


@pytest.mark.slow
@pytest.mark.parametrize("medium", MEDIA)
@pytest.mark.parametrize("timestep", STEPS)
def test_random_drops_end_on_the_ground_or_by_name_and_never_rise(
    timestep: float, medium: str, floor: ObjectSpec
) -> None:
    """Mass, restitution, friction, size, height and attitude vary."""
    n_ended = 0
    for seed in range(16):
        random = np.random.default_rng(seed)
        physics = drawn(random, is_in_water=medium == "water")
        scale = float(random.uniform(0.8, 3.0))
        (x, y), turn = random.uniform(-4.0, 4.0, 2), tuple(random.uniform(-3.0, 3.0, 3))
        above = 0.3 + 0.4 * scale * random.uniform(0.5, 2.0)
        thing = loose("thing", x, y, above, scale=scale, rpy=turn, **physics)
        simulation = MEDIA[medium](thing, floor, timestep=timestep)
        start = height(simulation)
        try:
            for _ in range(30):
                simulation.advance(0.1)
                assert height(simulation) <= start
            simulation.advance(1.2)  # what is below now is reported by then
            assert not is_below(simulation, "thing", 0.1 + 0.25 * scale)
        except SimulationFailed as error:
            assert "'thing'" in str(error)  # noqa: PT017
            n_ended += 1
    assert n_ended <= (2 if timestep > 0.01 else 0)


@pytest.mark.slow
@pytest.mark.parametrize("timestep", STEPS)
def test_objects_that_bounce_on_each_other_gain_no_energy(
    timestep: float, floor: ObjectSpec
) -> None:
    """Stacks of three boxes; seeds 6, 18, 26, 32 and 36 rose by up to 1.5 m at one of the steps."""
    for seed in (*range(10), 18, 26, 32, 36):
        random = np.random.default_rng(seed)
        x, y = random.uniform(-4.0, 4.0, 2)
        things, masses = [], []
        for k, name in enumerate("abc"):
            mass = float(np.exp(random.uniform(0.0, np.log(200.0))))
            turn = (0.0, 0.0, float(random.uniform(-3.0, 3.0)))
            restitution, friction = random.uniform(0.0, 0.9), random.uniform(0.0, 1.5)
            masses.append(mass)
            things.append(
                loose(name, x, y, 1.0 + 0.6 * k, rpy=turn, mass=mass, restitution=restitution,
                      friction=friction)
            )  # fmt: skip
        simulation = in_air(*things, floor, timestep=timestep)
        weights = np.array(masses) / sum(masses)
        start = weights @ [height(simulation, name) for name in "abc"]
        with suppress(SimulationFailed):  # below the ground: that is reported
            for _ in range(50):
                simulation.advance(0.1)
                assert weights @ [height(simulation, name) for name in "abc"] <= start
            assert not any(is_below(simulation, name, 1.0) for name in "abc")


@pytest.mark.parametrize("timestep", [0.002, pytest.param(0.02, marks=pytest.mark.slow)])
@pytest.mark.parametrize("restitution", [0.0, 0.8])
def test_what_a_kinematic_vehicle_lifts_or_presses_is_above_the_ground_or_named(
    timestep: float, restitution: float, floor: ObjectSpec
) -> None:
    thing = loose("thing", 0.0, 0.0, 0.7, mass=40.0, restitution=restitution, friction=1.5)
    base = read_scene(SCENE).vehicles[0]
    lift = replace(base, parts=(), dynamics=None, position=(0.0, 0.0, -9.0))
    sim = replace(UP, enable_physics=True, gravity=(0.0, 0.0, -9.81))
    scene = SceneSpec(sim_params=sim, objects=(thing, floor), vehicles=(lift,))
    simulation = open_scene(scene, timestep=timestep, is_blind=True)
    simulation.advance(4.0)
    x, y, rest = simulation.world.bodies.find("thing").world_from_body.position
    highest = -np.inf
    try:
        for z in (*np.linspace(-9.0, -4.5, 60), *np.linspace(-4.5, -9.0, 60)):
            simulation.set_pose(lift.name, Pose(np.array([x, y, z]), np.eye(3)))
            simulation.advance(0.1)
            highest = max(highest, height(simulation))
        simulation.advance(2.0)
        assert not is_below(simulation, "thing", 0.5)
    except SimulationFailed as error:  # the vehicle has pressed it through
        assert "'thing' has passed through the ground" in str(error)  # noqa: PT017
    assert rest + 0.2 < highest < rest + 3.0  # it was lifted, through the ground, and not thrown


def test_what_begins_below_the_ground_may_stay_there(floor: ObjectSpec) -> None:
    thing = loose("thing", 0.3, 0.2, -3.0, mass=157.0, volume=0.02)
    simulation = in_water(thing, floor, timestep=0.01)
    simulation.advance(2.5)
    assert height(simulation) < -9.0


def test_what_leaves_the_ground_over_its_edge_is_not_below_it(floor: ObjectSpec) -> None:
    beside = loose("thing", 10.0, 0.2, 1.0, mass=157.0, volume=0.02)
    simulation = in_water(beside, floor, timestep=0.01)
    simulation.advance(6.0)
    assert height(simulation) < -9.0
