"""Terrain is solid for what is simulated, unless the file says otherwise; so is other scenery."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.girona500 import SCENE, TWIST, make, position, run
from tests.support.opened import open_scene
from uwsim.messages import Twist, TwistStamped, header
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.vehicle import VehicleSpec
from uwsim.simulation import Simulation

TANK, BLACKBOX = read_scene(SCENE).objects
BLACKBOX = replace(BLACKBOX, is_solid=None)  # in that scene a ghost, to be looked at
GHOST = replace(TANK, physics=None)
FLOOR_DEPTH = 4.81  # of the image on the floor of the tank [m]


def dive(simulation: Simulation, seconds: float, speed: float = 0.5) -> float:
    """Tell the Girona 500 to dive, and return how deep its base came [m]."""
    from tests.simulation.girona500 import vector

    twist = Twist(linear=vector(0.0, 0.0, speed), angular=vector(0.0, 0.0, 0.0))
    simulation.bus.publisher("/twist", TwistStamped)(TwistStamped(header=header(0.0), twist=twist))
    run(simulation, seconds)
    return float(position(simulation)[2])


def box_scenery(**changes: object) -> ObjectSpec:
    """A slab whose top lies at 3.0 m, under the whole vehicle."""
    slab = replace(
        BLACKBOX,
        name="seabed_west",
        position=(3.0, 1.5, 4.0),
        orientation=(0.0, 0.0, 0.0),
        scale_factor=(30.0, 10.0, 2.0 / 0.15),
        physics=None,
    )
    return replace(slab, **changes)  # type: ignore[arg-type]


def test_a_vehicle_does_not_dive_through_terrain_that_nobody_gave_physics() -> None:
    ghostly = dive(make(objects=(replace(GHOST, is_solid=False),)), 8.0)
    assert ghostly > FLOOR_DEPTH
    assert dive(make(objects=(GHOST,)), 8.0) == pytest.approx(
        dive(make(objects=(TANK,)), 8.0), abs=1e-9
    )


def test_terrain_that_is_no_solid_is_passed_through_and_stays_where_it_is() -> None:
    simulation = make(objects=(replace(TANK, is_solid=False),))
    assert dive(simulation, 8.0) > FLOOR_DEPTH
    assert position(simulation, "terrain") == pytest.approx(
        position(make(objects=(TANK,)), "terrain"), abs=0.0
    )


def test_scenery_that_is_declared_solid_stops_a_vehicle() -> None:
    through = dive(make(objects=(box_scenery(),)), 6.0)
    stopped = dive(make(objects=(box_scenery(is_solid=True),)), 6.0)
    assert through > 3.5
    assert stopped < 2.6
    simulation = make(objects=(box_scenery(is_solid=True),))
    dive(simulation, 6.0)
    assert {contact.other for contact in simulation.world.contacts.find("girona500")} == {
        "seabed_west"
    }


def test_something_with_physics_that_is_no_solid_is_passed_through_and_hangs_where_it_is() -> None:
    ghost = box_scenery(is_solid=False, physics=PhysicsSpec(mass=50.0))
    simulation = make(objects=(ghost,))
    before = position(simulation, "seabed_west")
    assert dive(simulation, 6.0) > 3.5
    assert np.array_equal(position(simulation, "seabed_west"), before)


def test_two_simulated_vehicles_meet_in_open_water() -> None:
    scene = read_scene(SCENE).nominal_scene
    one = replace(scene.vehicles[0], parts=(), orientation=(0.0, 0.0, 0.0))
    other = replace(one, name="other", position=(6.0, 1.5, 1.515))
    simulation = open_scene(
        replace(scene, vehicles=(one, other), objects=(), ros_interfaces=(TWIST,))
    )
    simulation.advance(0.0)
    twist = TWIST.topic
    from tests.simulation.girona500 import vector

    message = TwistStamped(
        header=header(0.0), twist=Twist(linear=vector(0.8, 0, 0), angular=vector(0, 0, 0))
    )
    simulation.bus.publisher(twist, TwistStamped)(message)
    run(simulation, 12.0)
    assert position(simulation)[0] < position(simulation, "other")[0]
    assert position(simulation, "other")[0] > 6.5


DESERT = ObjectSpec(
    name="terrain",
    file="terrain/desert/desert2.osg",
    position=(0.0, 0.0, 3.0),
    orientation=(0.0, 1.5707963, 0.0),
)


@pytest.mark.parametrize(
    "scenery",
    [
        DESERT,
        replace(DESERT, file="terrain/seafloor/terrain_noship.osg", position=(0.0, 0.0, -11.5),
                orientation=(3.1415927, 0.0, 0.0)),
        replace(DESERT, file="terrain/islands/islands.osg", position=(0.0, 0.0, 3.0),
                orientation=(0.0, 0.0, 0.0)),
    ],
    ids=["a sheet", "sand with boulders", "a labelled box"],
)  # fmt: skip
@pytest.mark.slow
def test_every_bundled_sea_floor_stops_a_vehicle(scenery: ObjectSpec) -> None:
    simulation = make(objects=(scenery,))
    deep = dive(simulation, 12.0)
    assert 0.8 < deep < 4.2  # where it begins in the sand it is lifted, and stands on its arm
    assert {contact.other for contact in simulation.world.contacts.find("girona500")} == {"terrain"}
    run(simulation, 2.0)
    assert position(simulation)[2] == pytest.approx(deep, abs=0.1)


def paper(tmp_path: Path, text: str) -> ObjectSpec:
    (tmp_path / "floor.obj").write_text(text)
    return replace(
        DESERT, file=str(tmp_path / "floor.obj"), position=(3.0, 1.5, 3.0), orientation=(0, 0, 0)
    )


SQUARE = "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\n"


@pytest.mark.parametrize("faces", ["f 1 2 3\nf 1 3 4\n", "f 3 2 1\nf 4 3 1\n"])
def test_a_sheet_that_is_wound_the_wrong_way_round_stops_where_it_is_seen(
    faces: str, tmp_path: Path
) -> None:
    deep = dive(make(objects=(paper(tmp_path, SQUARE + faces),), data_path=(tmp_path,)), 8.0)
    on_a_slab = dive(make(objects=(box_scenery(is_solid=True),)), 8.0)
    assert deep == pytest.approx(on_a_slab, abs=0.02)


@pytest.mark.slow
def test_a_mesh_of_many_triangles_is_simplified_so_that_it_can_be_touched(tmp_path: Path) -> None:
    n = 120  # 28 800 triangles
    x, y = np.meshgrid(np.linspace(-9.0, 9.0, n + 1), np.linspace(-9.0, 9.0, n + 1))
    z = 0.3 * np.sin(x) * np.cos(y)
    points = "".join(
        f"v {a:.4f} {b:.4f} {c:.4f}\n"
        for a, b, c in zip(x.ravel(), y.ravel(), z.ravel(), strict=True)
    )
    k = np.arange(n * n) + np.arange(n * n) // n + 1
    faces = "".join(f"f {i + n + 1} {i + 1} {i}\nf {i + n + 1} {i + n + 2} {i + 1}\n" for i in k)
    simulation = make(objects=(paper(tmp_path, points + faces),), data_path=(tmp_path,))
    assert 1.4 < dive(simulation, 6.0) < 3.5  # it stands on its arm, whose elbow is at its stop


def kinematic(vehicle: VehicleSpec) -> VehicleSpec:
    return replace(vehicle, dynamics=None)


def test_solid_scenery_is_touched_by_a_vehicle_that_is_not_simulated_too() -> None:
    wall = box_scenery(is_solid=True, position=(3.0, 1.5, 1.9))
    simulation = make(objects=(wall, GHOST), change=kinematic)
    assert {contact.other for contact in simulation.world.contacts.find("girona500")} == {
        "seabed_west"
    }
