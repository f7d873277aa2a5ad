"""Vehicles that are put somewhere: what they touch, and how fast."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.simulation.girona500 import SCENE, TWIST, command, make, position, set_current
from uwsim.benchmark.measures.collision import CollisionSpec
from uwsim.errors import UnknownName, UwsimError
from uwsim.messages import Bool
from uwsim.scene.object import ObjectSpec, PhysicsSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.vehicle import VehicleSpec
from uwsim.simulation import Simulation
from uwsim.topics.contact_sensor_to_ros import ContactSensorToROSSpec

TANK, BLACKBOX = read_scene(SCENE).objects
BLACKBOX = replace(BLACKBOX, is_solid=None)  # in that scene a ghost, to be looked at
PERIOD = 0.1
"""Between two twists [s]."""


def kinematic(vehicle: VehicleSpec) -> VehicleSpec:
    """The vehicle stands at L (3, 1.5, 1.515) and looks along y, without dynamics."""
    return replace(vehicle, dynamics=None)


def wall(y: float, *, depth: float = 1.9) -> ObjectSpec:
    """A fixed wall 2.6 m wide, 0.866 m thick and 3 m high, its middle at L (3, y, depth)."""
    return replace(
        BLACKBOX, name="wall", position=(3.0, y, depth), orientation=(0.0, 0.0, 0.0),
        scale_factor=(20.0, 2.0, 20.0), physics=PhysicsSpec(mass=0.0),
    )  # fmt: skip


def scene(*objects: ObjectSpec, interfaces: tuple[object, ...] = ()) -> Simulation:
    return make((TWIST, *interfaces), objects=objects, change=kinematic)  # type: ignore[arg-type]


def drive(simulation: Simulation, surge: float, seconds: float, look: object = None) -> None:
    """Say a twist ten times a second; the vehicle jumps at each but the first."""
    for i in range(round(seconds / simulation.timestep)):
        if i % round(PERIOD / simulation.timestep) == 0:
            command(simulation, surge, 0.0)
        simulation.advance()
        if callable(look):
            look()


def front(simulation: Simulation, thing: ObjectSpec, surge: float = 1.0) -> float:
    """How far the vehicle drives until it touches [m], to the length of a jump."""
    while not simulation.world.contacts.find("girona500"):
        drive(simulation, surge, PERIOD)
    return position(simulation)[1] - 1.5


def test_a_vehicle_is_touched_at_the_speed_of_its_twist_and_goes_on_through_the_wall() -> None:
    simulation = scene(wall(4.0))
    measure = CollisionSpec(name="hits", target="girona500").bind(simulation.world.measure_view)
    measure.start()
    drive(simulation, 0.3, 6.0, measure.update)
    assert position(simulation)[1] == pytest.approx(1.5 + 0.3 * 5.9)
    details = measure.details
    assert details["max_speed"] == pytest.approx(0.3, rel=1e-6)
    assert 0.0 < details["contact_share"] < 0.9
    assert details["mean_speed"] == pytest.approx(0.3, rel=1e-6)
    expected = 1.0 - details["contact_share"] * 0.3 / 0.5 - 0.3 / 0.5
    assert measure.value == pytest.approx(expected, abs=1e-6)


def test_a_current_carries_a_vehicle_into_a_wall_at_its_own_speed() -> None:
    simulation = scene(wall(3.4))
    set_current(simulation, (0.0, 0.25, 0.0))
    measure = CollisionSpec(name="hits", target="girona500").bind(simulation.world.measure_view)
    measure.start()
    for _ in range(2000):
        simulation.advance()
        measure.update()
    assert measure.details["max_speed"] == pytest.approx(0.25, rel=1e-6)


def test_who_stands_in_a_wall_is_in_contact_and_hits_nothing() -> None:
    simulation = scene(wall(1.5))
    measure = CollisionSpec(name="hits", target="girona500").bind(simulation.world.measure_view)
    measure.start()
    for _ in range(5):
        simulation.advance()
        measure.update()
    assert measure.value == 1.0
    assert measure.details["contact_share"] == 1.0
    assert {contact.other for contact in simulation.world.contacts.find("girona500")} == {"wall"}


def test_the_speed_lasts_as_long_as_the_jump_took_and_no_longer() -> None:
    simulation = scene(wall(1.5))
    simulation.world.contacts.find("girona500")
    drive(simulation, 0.2, 0.304)  # jumps at 0.104, 0.204 and 0.304 s
    speeds = []
    for _ in range(100):
        simulation.advance()
        speeds += [
            max(abs(contact.own_speed) for contact in simulation.world.contacts.find("girona500"))
        ]
    assert all(speed > 0.0 for speed in speeds[:49])  # until 0.404 s
    assert not any(speeds[49:])


def test_the_touched_object_sees_the_same_from_its_side() -> None:
    simulation = scene(wall(4.0))
    simulation.world.contacts.find("girona500")
    front(simulation, wall(4.0), 0.5)
    drive(simulation, 0.5, 0.01)
    vehicle, thing = (
        simulation.world.contacts.find("girona500"),
        simulation.world.contacts.find("wall"),
    )
    assert len(vehicle) == len(thing) > 0
    for own, other in zip(vehicle, thing, strict=True):
        assert own.approach_speed == other.approach_speed
        assert own.own_speed == own.approach_speed
        assert other.own_speed == 0.0
        assert own.is_first is not other.is_first
        assert (own.other, other.other) == ("wall", "girona500")


def test_an_arm_touches_as_the_vehicle_does() -> None:
    bare = scene(wall(1.5, depth=6.0))
    assert bare.world.contacts.find("girona500") == []
    deep = 1.515 + 1.6  # below the hull, where only an arm that hangs down can be
    low = scene(replace(wall(1.5), position=(3.0, 1.5, deep + 1.5), scale_factor=(20, 20, 20)))
    before = len(low.world.contacts.find("girona500"))
    low.world.stage_view.set_joints("girona500", {1: 1.5, 2: 0.0})
    low.advance()
    assert len(low.world.contacts.find("girona500")) > before


def test_the_contact_sensor_of_a_vehicle_that_is_not_simulated_speaks() -> None:
    sensor = ContactSensorToROSSpec(name="girona500", topic="/touch", rate=100)
    simulation = scene(wall(4.0), interfaces=(sensor,))
    inbox = simulation.bus.inbox("/touch", Bool)
    drive(simulation, 0.5, 5.0)
    told = [message.data for message in inbox.take()]
    assert len(told) == 500
    assert not told[0]
    assert told[-1]
    assert told == sorted(told)


def test_looking_changes_nothing() -> None:
    places = []
    for is_watched in (False, True):
        simulation = scene(wall(4.0))
        if is_watched:
            simulation.world.contacts.find("girona500")
        drive(simulation, 0.3, 1.0)
        places.append(position(simulation).tobytes())
    assert places[0] == places[1]


def test_where_nothing_has_physics_all_is_touched_and_the_ground_by_its_faces() -> None:
    open_water = scene(replace(TANK, physics=None), replace(wall(4.0), physics=None))
    assert (
        open_water.world.contacts.find("girona500") == []
    )  # though it is within the box around the tank
    drive(open_water, 1.0, 3.0)
    assert {contact.other for contact in open_water.world.contacts.find("girona500")} == {"wall"}
    assert CollisionSpec(name="hits", target="wall").bind(open_water.world.measure_view)


def test_what_cannot_be_touched_is_reported_with_the_reason() -> None:
    both = scene(BLACKBOX, wall(4.0))
    assert both.world.contacts.find("girona500") == []
    with pytest.raises(UwsimError, match="it has no <physics>, nor <u:solid> 1; solid are: wall"):
        both.world.contacts.find("blackbox")
    with pytest.raises(UwsimError, match="<u:solid> is 0; solid are: wall"):
        scene(replace(BLACKBOX, is_solid=False), wall(4.0)).world.contacts.find("blackbox")
    with pytest.raises(UnknownName, match="Did you mean 'wall'"):
        both.world.contacts.find("wal")
