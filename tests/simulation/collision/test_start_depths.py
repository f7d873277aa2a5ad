"""What begins in the ground is lifted out of it, and `uwsim check` says where it would be clear."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.collision.test_bounces import in_water, relief
from tests.simulation.collision.test_bounces import loose as on_relief
from tests.simulation.collision.test_floor import EDGES, UP, grid, ground
from tests.simulation.girona500 import SCENE
from tests.support.opened import open_scene
from uwsim.base.geometry import Pose
from uwsim.checks import check_file
from uwsim.checks.model.starts import Starts
from uwsim.model.collision.ground import Ground, triangles_of
from uwsim.model.collision.shapes import CollisionShape
from uwsim.model.resolved_scene import ResolvedScene
from uwsim.physics.kinematics.lift import LIFT_SPEED
from uwsim.scene.object import ObjectSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.simulation import Simulation
from uwsim.simulation.collision.start_depths import StartDepths

SCALE = 2.5
HEIGHT = SCALE * EDGES[2]


@pytest.fixture(scope="module", params=["height field", "plates"])
def floor(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> ObjectSpec:
    """The same relief, as 5000 triangles and as 512."""
    n = 50 if request.param == "height field" else 16
    return ground(grid(tmp_path_factory.mktemp("floor"), relief, n=n))


def resolved(scene: SceneSpec) -> ResolvedScene:
    return ResolvedScene(scene=scene, robots={})


def sunk(depth: float, name: str = "thing", x: float = 0.3, **physics: object) -> ObjectSpec:
    """A box of 0.375 m whose middle is so far below the relief [m]."""
    given = {"mass": 157.0, "volume": 0.02, **physics}
    return on_relief(name, x, 0.2, -depth, scale=SCALE, **given)


def height(simulation: Simulation, name: str = "thing") -> float:
    return float(simulation.world.bodies.find(name).world_from_body.position[2])


def test_a_body_beside_the_ground_rests_on_the_ground_under_its_corners() -> None:
    origin = Pose.identity()
    body = triangles_of(
        [CollisionShape(kind="box", body_from_shape=origin, size=(1.0, 1.0, 0.5))], origin
    )
    low, high = ([[x, y, z] for x, y in ((0.9, 0.8), (3.0, 0.8), (0.9, 3.0))] for z in (-2.0, 0.2))
    assert Ground(np.array([low, high])).rise(body) == pytest.approx(0.7)
    beside = np.array([low, high]) + np.array([0.2, 0.0, 0.0])
    assert Ground(beside).rise(body) is None
    assert Ground(np.empty((0, 3, 3))).rise(body) is None


@pytest.mark.parametrize("timestep", [0.002, 0.01])
@pytest.mark.parametrize("depth", [0.0, 0.1, 0.25])
def test_a_box_that_begins_in_the_ground_is_lifted_slowly(
    depth: float, timestep: float, floor: ObjectSpec
) -> None:
    simulation = in_water(sunk(depth), floor, timestep=timestep)
    heights = [height(simulation)]
    for _ in range(40):
        simulation.advance(0.1)
        heights.append(height(simulation))
    assert np.diff(heights).max() < 1.1 * LIFT_SPEED * 0.1
    x, y, z = simulation.world.bodies.find("thing").world_from_body.position
    assert z > relief(x, y) - 0.05
    assert max(heights) < float(relief(0.3, 0.2)) + 1.5 * HEIGHT  # and then it may roll down


def test_only_what_is_deeper_than_its_height_stays(floor: ObjectSpec) -> None:
    for depth, is_lifted in ((0.3, True), (3.0, False)):
        simulation = in_water(sunk(depth), floor, timestep=0.01)
        assert simulation.world.engine.lift.is_active == is_lifted
        start = height(simulation)
        simulation.advance(2.0)
        assert (height(simulation) > start) == is_lifted


def test_an_accepted_start_or_one_that_is_shallow_is_left_to_contacts(floor: ObjectSpec) -> None:
    accepted = replace(sunk(0.1), accepts=("start",))
    rest = sunk(-0.5 * HEIGHT)
    depths = StartDepths(resolved(SceneSpec(sim_params=UP, objects=(rest, floor))))
    rise = depths.floor.ground.rise(depths.floor.body_of_object(0, rest.localized_from_object))
    assert rise is not None
    shallow = sunk(-0.5 * HEIGHT - rise + 0.015)
    for thing in (accepted, shallow):
        assert not in_water(thing, floor, timestep=0.01).world.engine.lift.is_active


def test_each_of_several_is_lifted_by_its_own_depth(floor: ObjectSpec) -> None:
    things = [sunk(0.05, "a", x=-3.0), sunk(0.2, "b", x=3.0), sunk(-2.0, "c")]
    simulation = in_water(*things, floor, timestep=0.01)
    left = simulation.world.engine.lift.state.steps_left
    assert len(left) == 2
    assert left[1] > left[0] > 0
    simulation.advance(6.0)
    assert not simulation.world.engine.lift.is_active
    for name in "ab":
        x, y, z = simulation.world.bodies.find(name).world_from_body.position
        assert z > relief(x, y) - 0.05


def test_what_is_placed_elsewhere_meanwhile_is_no_longer_lifted(floor: ObjectSpec) -> None:
    simulation = in_water(sunk(0.25), floor, timestep=0.01)
    simulation.advance(0.2)
    simulation.set_pose("thing", Pose(np.array([2.0, 2.0, -2.0]), np.eye(3)))
    simulation.advance(0.1)
    assert not simulation.world.engine.lift.is_active
    assert height(simulation) < -2.0
    simulation.advance(8.0)
    x, y, z = simulation.world.bodies.find("thing").world_from_body.position
    assert relief(x, y) - 0.05 < z < -2.0  # it touches the ground again


def motion_of(simulation: Simulation) -> bytes:
    """Positions and velocities of all bodies, as bytes."""
    row = np.zeros(simulation.world.engine.motion.size)
    simulation.world.engine.motion.read(row)
    return row.tobytes()


def test_a_saved_simulation_goes_on_being_lifted_to_the_bit(floor: ObjectSpec) -> None:
    first = in_water(sunk(0.25), floor, timestep=0.01)
    first.advance(0.3)
    middle = first.save()
    first.advance(3.0)
    last = motion_of(first)
    first.restore(middle)
    assert first.world.engine.lift.is_active
    first.advance(3.0)
    assert motion_of(first) == last
    other = in_water(sunk(0.25), floor, timestep=0.01)
    other.restore(middle)
    other.advance(3.0)
    assert motion_of(other) == last


def test_the_steps_of_a_lift_do_not_depend_on_how_they_are_asked_for(floor: ObjectSpec) -> None:
    ends = []
    for seconds in (0.01, 0.5):
        simulation = in_water(sunk(0.25), floor, timestep=0.01)
        for _ in range(round(3.0 / seconds)):
            simulation.advance(seconds)
        ends.append(simulation.world.bodies.find("thing").world_from_body.matrix.tobytes())
    assert ends[0] == ends[1]


def test_a_vehicle_whose_arm_begins_in_the_ground_is_not_thrown(floor: ObjectSpec) -> None:
    vehicle = replace(
        read_scene(SCENE).nominal_scene.vehicles[0],
        orientation=(np.pi, 0.0, 0.0),
        position=(0.0, 0.0, -5.2),
        parts=(),
    )
    simulation = open_scene(
        SceneSpec(sim_params=UP, objects=(floor,), vehicles=(vehicle,)), is_blind=True
    )
    assert simulation.world.engine.lift.is_active
    for _ in range(50):
        simulation.advance(0.1)
        velocity = simulation.world.engine.vehicle_velocity(0)
        assert np.abs(velocity).max() < 3.0


@pytest.mark.parametrize("frame", ["up", "down"])
@pytest.mark.parametrize("depth", [0.1, 0.25, 1.0])
def test_check_names_a_position_that_clears_it(depth: float, frame: str, floor: ObjectSpec) -> None:
    sim = UP if frame == "up" else replace(UP, offsetr=(np.pi, 0.0, 0.0))
    turn = Pose.from_xyz(sim.offsetp, sim.offsetr).inverse()
    flip = (np.pi, 0.0, 0.0) if frame == "down" else (0.0, 0.0, 0.0)
    thing = sunk(depth)
    at = tuple(turn.transform(np.array([thing.position]))[0])
    thing = replace(thing, position=at)
    scene = SceneSpec(
        sim_params=sim,
        objects=(thing, replace(floor, orientation=flip)),
        vehicles=tuple(read_scene(SCENE).vehicles),
    )
    said = Starts(resolved(scene)).describe_object(0)
    found = re.search(r"expected above it, at z (-?\d+\.\d+): <u:onFloor/> sets it there", said)
    assert found, said
    clear = replace(thing, position=(at[0], at[1], float(found[1])))
    assert (
        Starts(resolved(replace(scene, objects=(clear, *scene.objects[1:])))).describe_object(0)
        == ""
    )


@pytest.mark.parametrize("timestep", [0.002, 0.01])
@pytest.mark.parametrize(("name", "depth"), [("b", 0.3), ("rod", 0.6)])
def test_an_object_of_the_original_s_physics_is_lifted_too_and_check_warns(
    name: str, depth: float, timestep: float, tmp_path: Path
) -> None:
    path = tmp_path / "sunk.xml"
    path.write_text(
        "<UWSimScene><simParams><enablePhysics>1</enablePhysics>"
        "<gravity><x>0</x><y>0</y><z>-9.81</z></gravity></simParams>"
        "<object><name>terrain</name><file>terrain/floor/floor.osg</file>"
        "<position><x>0</x><y>0</y><z>-5</z></position></object>"
        f"<object><name>{name}</name><file>objects/box.osg</file>"
        f"<position><x>0</x><y>0</y><z>{-4.5 - depth}</z></position><physics><mass>1500</mass>"
        "<collisionShapeType>box</collisionShapeType></physics></object></UWSimScene>"
    )
    warned = [each.message for each in check_file(path) if "begins" in each.message]
    assert len(warned) == 1
    assert f"the object {name!r}: it begins " in warned[0]
    with open_scene(read_scene(path).nominal_scene, timestep=timestep) as simulation:
        heights = []
        for _ in range(50):
            simulation.advance(0.1)
            heights.append(height(simulation, name))
    assert np.diff(heights).max() < 1.1 * LIFT_SPEED * 0.1
    assert heights[-1] == pytest.approx(-4.5, abs=0.01)
