"""Loose boxes, the floor of a tank and a vehicle that runs into things."""

from dataclasses import replace

import numpy as np
import pytest

from tests.simulation.girona500 import SCENE, TWIST, command, make, position, run, set_current
from uwsim.benchmark.measures.collision import CollisionSpec
from uwsim.errors import UnknownName
from uwsim.messages import Bool
from uwsim.physics.free_objects import ellipsoid_added_mass
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation
from uwsim.topics.contact_sensor_to_ros import ContactSensorToROSSpec

TANK, BLACKBOX = read_scene(SCENE).objects
BLACKBOX = replace(BLACKBOX, is_solid=None)  # in that scene a ghost, to be looked at
FLOOR = replace(TANK, physics=PhysicsSpec(mass=0.0, collision_shape_type="trimesh"))
EDGES = np.array([0.13, 0.433, 0.15])  # of the black box, m
FLOOR_DEPTH = 4.81  # of the image on the floor, m


def box(x: float, y: float, depth: float, mass: float = 10.0, **physics: object) -> ObjectSpec:
    return replace(
        BLACKBOX,
        position=(x, y, depth),
        orientation=(0.0, 0.0, 0.0),
        physics=PhysicsSpec(mass=mass, **physics),
    )


def wall(x: float, y: float, depth: float) -> ObjectSpec:
    return replace(box(x, y, depth, 0.0), name="wall", scale_factor=(20.0, 2.0, 20.0))


def test_a_box_sinks_with_its_terminal_speed() -> None:
    simulation = make(objects=(box(7.0, 1.5, 1.0),))
    run(simulation, 2.0)
    before = position(simulation, "blackbox")
    run(simulation, 0.5)
    speed = (position(simulation, "blackbox") - before)[2] / 0.5
    weight = 9.81 * (10.0 - 1000.0 * np.prod(EDGES))
    drag = 0.5 * 1000.0 * 1.05 * EDGES[0] * EDGES[1]
    assert speed == pytest.approx(np.sqrt(weight / drag), rel=0.02)


def test_a_box_dropped_above_the_floor_comes_to_rest_on_it() -> None:
    simulation = make(objects=(FLOOR, box(3.0, 1.0, 4.0)))
    run(simulation, 6.0)
    middle = position(simulation, "blackbox")[2]
    assert middle == pytest.approx(FLOOR_DEPTH - EDGES[2] / 2, abs=0.003)
    before = position(simulation, "blackbox")
    run(simulation, 2.0)
    assert position(simulation, "blackbox") == pytest.approx(before, abs=1e-3)
    touched = simulation.world.contacts.find("blackbox")
    assert {contact.other for contact in touched} == {"terrain"}
    assert len(touched) >= 3
    assert all(abs(contact.approach_speed) < 0.01 for contact in touched)


RAMP = np.arctan2(4.2, 4.0)  # steepness of the tank's ramps, rad
RAMP_FOOT = 3.49  # where the floor ends and the eastern ramp begins, m


def on_slope(steepness: float, east: float, depth: float, mass: float) -> ObjectSpec:
    """A box that lies flat on a slope that rises to the east, over the slope's point named."""
    lift = 0.5 * EDGES[2]
    place = (3.0, east - lift * np.sin(steepness), depth - lift * np.cos(steepness))
    return replace(box(*place, mass), orientation=(-steepness, 0.0, 0.0))


def test_a_box_slides_down_a_ramp_with_what_friction_leaves_of_its_weight() -> None:
    mass = 20.0
    thing = on_slope(RAMP, RAMP_FOOT + 2.0 * np.cos(RAMP), 4.85 - 2.0 * np.sin(RAMP), mass)
    simulation = make(objects=(FLOOR, thing))
    run(simulation, 0.1)
    start = position(simulation, "blackbox")
    run(simulation, 0.2)
    middle = position(simulation, "blackbox")
    run(simulation, 0.2)
    end = position(simulation, "blackbox")
    along = np.array([0.0, -np.cos(RAMP), np.sin(RAMP)])
    found = (end - 2.0 * middle + start) @ along / 0.2**2
    in_water = mass - 1000.0 * float(np.prod(EDGES))
    added = 1000.0 * ellipsoid_added_mass(0.5 * EDGES * (6.0 / np.pi) ** (1 / 3))[1]
    expected = 9.81 * in_water * (np.sin(RAMP) - 0.8 * np.cos(RAMP)) / (mass + added)
    assert found == pytest.approx(expected, rel=0.1)  # drag takes a few percent
    run(simulation, 8.0)
    there = position(simulation, "blackbox")
    assert there[1] < RAMP_FOOT + 0.3  # its end leans on the ramp, or all of it with its foot below
    assert 4.85 - 0.5 * EDGES[1] - 0.06 < there[2] < 4.85 - 0.5 * min(EDGES) + 0.01
    run(simulation, 1.0)
    assert position(simulation, "blackbox") == pytest.approx(there, abs=0.002)


def test_a_box_stays_on_a_slope_that_friction_can_hold() -> None:
    steepness = 0.6  # tan 0.68 < 0.8
    slope = replace(wall(3.0, 4.0, 4.0), scale_factor=(20.0, 20.0, 2.0))  # EDGES[2] high each way
    top = (4.0 - EDGES[2] * np.sin(steepness), 4.0 - EDGES[2] * np.cos(steepness))
    slope = replace(slope, orientation=(-steepness, 0.0, 0.0))
    thing = on_slope(steepness, *top, 20.0)
    simulation = make(objects=(slope, thing))
    run(simulation, 1.0)
    before = position(simulation, "blackbox")
    run(simulation, 3.0)
    assert position(simulation, "blackbox") == pytest.approx(before, abs=0.005)


def test_a_heavy_box_at_full_speed_does_not_go_through_the_floor() -> None:
    simulation = make(objects=(FLOOR, box(1.0, 1.5, 1.0, 80.0)))
    lowest, fastest, last = 0.0, 0.0, 1.0
    for _ in range(round(4.0 / simulation.timestep)):
        simulation.advance()
        depth = position(simulation, "blackbox")[2]
        fastest = max(fastest, (depth - last) / simulation.timestep)
        lowest, last = max(lowest, depth), depth
    assert fastest > 3.0
    assert lowest < FLOOR_DEPTH - EDGES[2] / 2 + 0.03
    assert last == pytest.approx(FLOOR_DEPTH - EDGES[2] / 2, abs=0.003)


def test_a_light_box_rises_and_floats() -> None:
    simulation = make(objects=(box(7.0, 1.5, 1.0, 2.0),))
    run(simulation, 12.0)
    assert position(simulation, "blackbox")[2] == pytest.approx(0.0, abs=0.15)


def test_the_volume_of_the_file_decides_what_floats() -> None:
    simulation = make(objects=(box(7.0, 1.5, 1.0, 2.0, volume=0.002),))
    run(simulation, 5.0)
    assert position(simulation, "blackbox") == pytest.approx([7.0, 1.5, 1.0], abs=0.01)


def test_a_box_drifts_with_the_current() -> None:
    volume = float(np.prod(EDGES))
    simulation = make(objects=(box(7.0, 1.5, 1.0, 1000.0 * volume),))
    set_current(simulation, (0.2, 0.0, 0.0))
    run(simulation, 20.0)
    before = position(simulation, "blackbox")
    run(simulation, 1.0)
    speed = position(simulation, "blackbox") - before
    # what is left of the difference falls as 1/t: 0.2 / (1 + 0.2 t 34 / 16)
    assert speed == pytest.approx([0.18, 0.0, 0.0], abs=0.01)


def test_an_object_that_is_kinematic_or_without_mass_stays() -> None:
    kinematic = box(7.0, 1.5, 1.0, is_kinematic=True)
    simulation = make(objects=(kinematic, replace(box(9.0, 1.5, 1.0, 0.0), name="heavy")))
    run(simulation, 1.0)
    assert position(simulation, "blackbox") == pytest.approx([7.0, 1.5, 1.0])
    assert position(simulation, "heavy") == pytest.approx([9.0, 1.5, 1.0])


def run_into(thing: ObjectSpec, surge: float = 0.4) -> tuple[Simulation, object, list[bool]]:
    sensor = ContactSensorToROSSpec(name="girona500", topic="/touch", rate=100)
    simulation = make((TWIST, sensor), objects=(thing,))
    inbox = simulation.bus.inbox("/touch", Bool)
    measure = CollisionSpec(name="hits", target="girona500").bind(simulation.world.measure_view)
    measure.start()
    command(simulation, surge, 0.0)
    for _ in range(round(8.0 / simulation.timestep)):
        simulation.advance()
        measure.update()
    return simulation, measure, [message.data for message in inbox.take()]


def test_a_vehicle_that_runs_into_a_wall_stops_and_the_collision_is_seen() -> None:
    simulation, measure, touches = run_into(wall(3.0, 4.0, 1.9))
    start = 1.5
    assert position(simulation)[1] < start + 2.0
    assert measure.details["max_speed"] == pytest.approx(0.4, abs=0.05)
    assert 0.2 < measure.details["contact_share"] < 0.9
    assert measure.value < 0.3
    assert not touches[0]
    assert touches[-1]


def test_a_vehicle_pushes_a_loose_box_before_it() -> None:
    volume = float(np.prod(EDGES))
    thing = box(3.0, 3.2, 1.9, 1000.0 * volume)
    simulation, measure, _ = run_into(thing)
    assert position(simulation, "blackbox")[1] > 3.6
    assert measure.details["max_speed"] == pytest.approx(0.4, abs=0.06)
    assert position(simulation)[1] > 3.0


def test_with_the_quirk_collision_only_what_is_listed_first_counts() -> None:
    simulation = make(objects=(FLOOR, box(3.0, 1.0, 4.7)))
    run(simulation, 2.0)
    firsts = [contact.is_first for contact in simulation.world.contacts.find("blackbox")]
    others = [contact.is_first for contact in simulation.world.contacts.find("terrain")]
    assert firsts == [not other for other in others]
    assert len(firsts) > 0


def test_two_runs_with_contacts_are_the_same_to_the_last_bit() -> None:
    ends = []
    for _ in range(2):
        simulation = make(objects=(FLOOR, box(3.0, 1.0, 4.5), wall(3.0, 3.5, 1.9)))
        command(simulation, 0.4, 0.0)
        run(simulation, 4.0)
        ends.append([position(simulation, name).tobytes() for name in ("girona500", "blackbox")])
    assert ends[0] == ends[1]


def test_a_vehicle_in_the_middle_of_the_tank_touches_nothing() -> None:
    simulation = make(objects=(FLOOR,))
    run(simulation, 1.0)
    assert simulation.world.contacts.find("girona500") == []
    assert position(simulation) == pytest.approx([3.0, 1.5, 1.515], abs=0.01)


def test_without_any_physics_everything_is_touched_where_it_stands() -> None:
    over = replace(BLACKBOX, position=(3.0, 1.5, 2.0))
    simulation = make(objects=(over,))
    [*contacts] = simulation.world.contacts.find("girona500")
    assert {contact.other for contact in contacts} == {"blackbox"}
    assert simulation.world.contacts.find("blackbox")
    with pytest.raises(UnknownName, match="blackbox"):
        simulation.world.contacts.find("blackbux")
