"""A tether in a scene: its pull on a vehicle, winch, break, state, and what sees it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import uwsim
from uwsim.errors import SceneError
from uwsim.forces import Tether
from uwsim.messages import Float64, WrenchStamped
from uwsim.rays import Hits
from uwsim.simulation import Simulation
from uwsim.simulation.tracked_bodies import TrackedBodies

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  {ocean}
  <vehicle> <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>-6</z> </position>
    <orientation> <r>M_PI</r> <p>0</p> <y>0</y> </orientation>
    {dynamics} </vehicle>
  {objects}
  <rosInterfaces>
    {commands}
    <u:tetherToROS> <name>tether</name> <topic>tether</topic> <statusTopic>status</statusTopic>
      <rate>20</rate> </u:tetherToROS>
    <u:ROSToWinch> <name>tether</name> <topic>winch</topic> </u:ROSToWinch>
  </rosInterfaces>
  <u:forces> <u:tether> <name>tether</name>
    <from> <body>rov</body> </from>
    {end}
    {tether} </u:tether> </u:forces>
</UWSimScene>"""
SHORT = "<length>4</length> <segments>8</segments>"
WINCH = "<winch> <maxLength>8</maxLength> <maxSpeed>1</maxSpeed> </winch>"
DYNAMICS = "<u:dynamics>bluerov2_heavy</u:dynamics>"
COMMANDS = (
    "<u:ROSWrenchToPAT> <u:topic>wrench</u:topic> <u:vehicleName>rov</u:vehicleName>"
    " </u:ROSWrenchToPAT>"
)

Load = Callable[..., Simulation]


@pytest.fixture
def load(tmp_path: Path) -> Load:
    def open_scene(
        tether: str = SHORT,
        *,
        ocean: str = "",
        objects: str = "",
        end: str = "<to> <position> <x>-4</x> <y>0</y> <z>-6</z> </position> </to>",
        is_dynamic: bool = True,
        timestep: float = 0.01,
    ) -> Simulation:
        file = tmp_path / "scene.xml"
        moved = {"dynamics": DYNAMICS, "commands": COMMANDS}
        parts = moved if is_dynamic else dict.fromkeys(moved, "")
        file.write_text(SCENE.format(tether=tether, ocean=ocean, objects=objects, end=end, **parts))
        return uwsim.load(file, is_blind=True, timestep=timestep)

    return open_scene


def tether_of(simulation: Simulation) -> Tether:
    force = simulation.world.forces[0]
    assert isinstance(force, Tether)
    return force


def pull(simulation: Simulation, force: float, duration: float) -> None:
    message = WrenchStamped()
    message.wrench.force.x = force
    simulation.publish("wrench", message)
    simulation.advance(duration)


@pytest.mark.parametrize("timestep", [0.002, 0.005])
@pytest.mark.parametrize(("stiffness", "damping"), [(5e4, 100.0), (1e8, 0.0)])
def test_the_tension_of_a_taut_tether_is_the_thrust_at_any_stiffness(
    load: Load, timestep: float, stiffness: float, damping: float
) -> None:
    """The vehicle floats up a little: the tension has a vertical part of less than 1 %."""
    simulation = load(
        f"{SHORT} <axialStiffness>{stiffness}</axialStiffness> "
        f"<axialDamping>{damping}</axialDamping>",
        timestep=timestep,
    )
    pull(simulation, 40.0, 6.0)
    assert tether_of(simulation).end_tensions == pytest.approx((40.0, 40.0), rel=0.01)
    assert simulation.velocity("rov")[:3] == pytest.approx(np.zeros(3), abs=0.01)


def test_the_tether_starts_at_its_point_of_the_vehicle(load: Load) -> None:
    simulation = load()
    pull(simulation, 20.0, 1.0)
    start = tether_of(simulation).state.positions[0]
    assert start == pytest.approx(simulation.pose("rov", "W").position, abs=2e-3)


def test_a_kinematic_vehicle_carries_the_end_and_feels_nothing(load: Load) -> None:
    simulation = load(is_dynamic=False)
    simulation.set_pose("rov", uwsim.Pose.from_rpy((1.0, 0.0, -6.0), (0.0, 0.0, 0.0)), "W")
    simulation.advance(1.0)
    assert tether_of(simulation).end_tensions[0] > 1000.0  # stretched by a quarter
    assert simulation.pose("rov", "W").position.tolist() == [1.0, 0.0, -6.0]


def test_a_vehicle_that_is_placed_elsewhere_has_its_tether_laid_anew(load: Load) -> None:
    simulation = load("<length>8</length> <segments>16</segments>")
    simulation.advance(0.5)
    place = uwsim.Pose.from_rpy((-1.0, 5.0, -7.0), (np.pi, 0.0, 0.0))
    simulation.set_pose("rov", place, "W")
    simulation.advance(0.5)
    assert max(tether_of(simulation).end_tensions) < 5.0
    assert simulation.pose("rov", "W").position == pytest.approx(place.position, abs=0.05)


def test_one_vehicle_tows_another(load: Load) -> None:
    simulation = load(
        SHORT,
        objects="""<vehicle> <name>rov2</name> <file>bluerov2_heavy.urdf</file>
          <position> <x>-4</x> <y>0</y> <z>-6</z> </position>
          <orientation> <r>M_PI</r> <p>0</p> <y>0</y> </orientation>
          <u:dynamics>bluerov2_heavy</u:dynamics> </vehicle>""",
        end="<to> <body>rov2</body> </to>",
    )
    pull(simulation, 40.0, 6.0)
    first, second = (simulation.pose(name, "W").position for name in ("rov", "rov2"))
    assert first[0] > 0.2
    assert second[0] > -3.8
    assert first[0] - second[0] == pytest.approx(4.0, abs=0.02)


def test_a_current_drags_the_tether_and_the_vehicle_with_it(load: Load) -> None:
    velocity = "<x>0</x> <y>0.5</y> <z>0</z>"
    ocean = (
        "<oceanState> <u:current> <u:constant> <u:velocity>"
        f" {velocity} </u:velocity> </u:constant> </u:current> </oceanState>"
    )
    simulation = load("<length>6</length> <segments>12</segments>", ocean=ocean)
    simulation.advance(5.0)
    assert tether_of(simulation).state.positions[6, 1] > 0.5


def test_the_winch_pays_out_by_its_speed_and_stops_at_its_limits(load: Load) -> None:
    simulation = load(SHORT + WINCH)
    tether = tether_of(simulation)
    simulation.publish("winch", Float64(data=5.0))  # limited to 1 m/s
    simulation.latest_message("tether")
    simulation.advance(2.0)
    assert tether.length == pytest.approx(6.0, abs=2e-3)
    message = simulation.latest_message("tether")
    assert message.position[1] == pytest.approx(6.0, abs=0.06)
    assert message.velocity[1] == 1.0
    simulation.advance(4.0)
    assert tether.length == pytest.approx(8.0, rel=1e-12)
    assert tether.winch_speed == 0.0
    simulation.publish("winch", Float64(data=-1.0))
    simulation.advance(9.0)
    assert tether.length == pytest.approx(1.0, rel=1e-12)


def test_hauling_in_a_taut_tether_pulls_the_vehicle(load: Load) -> None:
    simulation = load(SHORT + WINCH)
    simulation.publish("winch", Float64(data=-0.3))
    simulation.advance(5.0)
    assert simulation.pose("rov", "W").position[0] < -1.0


def test_a_snap_load_breaks_the_tether_once_and_frees_the_vehicle(load: Load) -> None:
    simulation = load(f"{SHORT} <breakLoad>30</breakLoad>")
    simulation.latest_message("status")
    simulation.advance(0.1)
    assert simulation.latest_message("status").data == "whole"
    pull(simulation, 40.0, 4.0)
    tether = tether_of(simulation)
    report = simulation.latest_message("status").data
    assert report == tether.break_report
    assert "broke at" in report
    assert tether.state.break_tension > 30.0
    assert simulation.pose("rov", "W").position[0] > 1.0
    assert tether.end_tensions[0] < 3.0  # the drag of the rest


def test_a_saved_state_continues_with_the_same_bytes(load: Load) -> None:
    simulation = load(SHORT + WINCH)
    simulation.publish("winch", Float64(data=0.4))
    pull(simulation, 30.0, 1.5)
    saved = simulation.save()
    simulation.advance(1.0)
    after = simulation.save()
    simulation.restore(saved)
    assert simulation.save() == saved
    simulation.advance(1.0)
    assert simulation.save() == after


@pytest.mark.slow
def test_a_tether_comes_to_rest_on_the_ground_and_not_in_a_vehicle(load: Load) -> None:
    floor = (
        "<object> <name>terrain</name> <file>terrain/pool/pool.glb</file>"
        " <position> <x>0</x> <y>0</y> <z>-3</z> </position> </object>"
    )
    simulation = load(
        "<length>9</length> <segments>18</segments> <weightInWater>1</weightInWater>",
        objects=floor,
    )
    simulation.advance(8.0)
    height = -7.0 + 0.0038  # the floor of the pool is 4 m below its origin
    inner = tether_of(simulation).state.positions[1:-1]
    assert inner[:, 2].min() == pytest.approx(height, abs=2e-3)
    assert (inner[4:14, 2] < height + 0.05).all()


def test_rays_find_the_tether_where_it_is(load: Load) -> None:
    simulation = load()
    simulation.advance(0.5)
    nodes = tether_of(simulation).state.positions
    rays = simulation.world.rays
    above = 0.5 * (nodes[3] + nodes[4]) + [0.0, 0.0, 1.0]
    hits: Hits = rays.cast(
        uwsim.Pose.from_rpy(tuple(above), (0.0, 0.0, 0.0)), np.array([[0.0, 0.0, -1.0]]), 5.0
    )
    assert hits.distance[0] == pytest.approx(1.0 - 0.0038, abs=5e-4)
    assert rays.vehicles[hits.surface[0]] == "tether"


def test_motion_tracks_have_a_body_for_each_segment(load: Load) -> None:
    simulation = load()
    bodies = TrackedBodies(simulation.world)
    pull(simulation, 30.0, 0.5)
    rows = dict(zip(bodies.names, bodies.rows(), strict=True))
    nodes = tether_of(simulation).state.positions
    for k in range(8):
        assert rows[f"tether/{k}"][:3] == pytest.approx(0.5 * (nodes[k] + nodes[k + 1]), abs=5e-3)


@pytest.mark.parametrize(
    ("elements", "message"),
    [
        (f"{SHORT} <density>900</density> <weightInWater>1</weightInWater>", "are both given"),
        ("<length>9</length>" + WINCH, "<length> is 9; expected a length from <minLength> 1 to"),
        ("<length>1</length> <segments>900</segments>" + WINCH, "expected at most 1000 segments"),
        ("<length>1</length> <segments>5000</segments>", "<segments>"),
    ],
)
def test_contradictions_and_excessive_sizes_are_errors_of_the_file(
    load: Load, elements: str, message: str
) -> None:
    with pytest.raises(SceneError, match=message):
        load(elements)
