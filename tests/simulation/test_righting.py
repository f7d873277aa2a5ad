"""An autopilot rights its vehicle in pitch, and in roll where its thrusters can."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.simulation.girona500 import make, position, run, set_current, vector
from uwsim.messages import Float64MultiArray, MultiArrayLayout, Twist, TwistStamped, header
from uwsim.simulation import Simulation
from uwsim.topics.ros_twist_to_pat import ROSTwistToPATSpec
from uwsim.topics.thruster_commands import ROSThrustersToPATSpec

UPSIDE = {"bluerov2_heavy": 0.0, "rexrov": math.pi}
"""Roll in the scene's frame, whose z points down: RexROV's own z points up."""
TOP_SURGE = 0.734
"""BlueROV2 Heavy with von Benzon's numbers, on rails (`tests/physics`) [m/s]."""
NAME = "girona500"
INTERFACES = (
    ROSTwistToPATSpec(topic="/twist", vehicle_name=NAME),
    ROSThrustersToPATSpec(topic="/thrusters", vehicle_name=NAME),
)


def afloat(kind: str, *, roll: float = 0.0, pitch: float = 0.0) -> Simulation:
    """A vehicle of a kind, tilted [rad], 5 m deep."""
    return make(
        INTERFACES,
        change=lambda spec: replace(
            spec,
            file=f"data/vehicles/{kind}.urdf",
            dynamics=kind,
            joint_values=(),
            position=(0.0, 0.0, 5.0),
            orientation=(UPSIDE[kind] + roll, pitch, 0.0),
        ),
    )


def tilt_deg(simulation: Simulation) -> float:
    """Angle between the vehicle's z and the vertical [deg]."""
    rotation = simulation.world.bodies.find(NAME).world_from_body.rotation
    return math.degrees(math.acos(min(abs(float(rotation[2, 2])), 1.0)))


def fly(simulation: Simulation, surge: float, sway: float) -> None:
    twist = Twist(linear=vector(surge, sway, 0.0), angular=vector(0.0, 0.0, 0.0))
    say = simulation.bus.publisher("/twist", TwistStamped)
    say(TwistStamped(header=header(0.0), twist=twist))


def let_go(simulation: Simulation) -> None:
    """Thrusters at rest: the hull rights itself, or not."""
    say = simulation.bus.publisher("/thrusters", Float64MultiArray)
    layout = MultiArrayLayout(dim=[], data_offset=0)
    say(Float64MultiArray(layout=layout, data=np.zeros(8)))


@pytest.mark.parametrize("axis", ["roll", "pitch"])
@pytest.mark.parametrize("kind", UPSIDE)
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_tilt_dies_out(kind: str, axis: str, side: float) -> None:
    simulation = afloat(kind, **{axis: side * 0.2})
    assert tilt_deg(simulation) == pytest.approx(math.degrees(0.2), abs=0.1)
    run(simulation, 5.0)
    assert tilt_deg(simulation) < 0.5


def test_it_dies_out_faster_than_the_hull_alone_rights_itself() -> None:
    held, free = afloat("rexrov", pitch=0.2), afloat("rexrov", pitch=0.2)
    let_go(free)
    run(held, 3.0)
    run(free, 3.0)
    assert tilt_deg(held) < 0.3 * tilt_deg(free)


@pytest.mark.parametrize("kind", UPSIDE)
@pytest.mark.parametrize(("surge", "sway"), [(0.4, 0.0), (0.0, 0.2)])
def test_a_vehicle_stays_level_as_it_moves(kind: str, surge: float, sway: float) -> None:
    simulation = afloat(kind)
    fly(simulation, surge, sway)
    run(simulation, 3.0)
    before = position(simulation)
    run(simulation, 5.0)
    way = position(simulation) - before
    assert np.linalg.norm(way[:2]) / 5.0 == pytest.approx(surge + sway, rel=0.02)
    assert abs(way[2]) < 0.05
    assert tilt_deg(simulation) < 2.0


@pytest.mark.parametrize("kind", UPSIDE)
def test_a_place_in_a_current_is_held_upright(kind: str) -> None:
    simulation = afloat(kind)
    set_current(simulation, (0.3, 0.0, 0.0))
    run(simulation, 20.0)
    assert tilt_deg(simulation) < 0.5


def test_who_asks_for_more_than_there_is_gets_the_top_speed_and_stays_level() -> None:
    simulation = afloat("bluerov2_heavy")
    fly(simulation, 3.0, 0.0)
    run(simulation, 10.0)
    before = position(simulation)
    run(simulation, 5.0)
    way = position(simulation) - before
    assert way[0] / 5.0 == pytest.approx(TOP_SURGE, rel=0.05)
    assert abs(way[2]) < 0.1
    assert tilt_deg(simulation) < 5.0
