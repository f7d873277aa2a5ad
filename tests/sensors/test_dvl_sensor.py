"""The DVL against geometry: ranges, velocities, lock, dropout, noise and water track."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.sensors.acoustic_world import AcousticWorld, MovingCarrier, plate
from tests.support.opened import open_scene
from uwsim.assets.find import find
from uwsim.base.geometry import Pose, rotation_from_rpy, rotation_y
from uwsim.messages import DVL
from uwsim.scene.reader import read_scene
from uwsim.sensors.dvl_sensor import Dvl, DvlSensorSpec
from uwsim.sensors.janus import Janus

LOOKS_DOWN = rotation_from_rpy(math.pi, 0.0, 0.0)  # x ahead, y to starboard, z down
VELOCITY = (0.8, -0.3, 0.1)


def make(
    world: AcousticWorld,
    rpy: tuple[float, float, float] = (0.0, 0.0, 0.0),
    velocity: tuple[float, float, float] = VELOCITY,
    height: float = 10.0,
    **fields: float,
) -> Dvl:
    """At a height over the origin, turned by these angles from looking straight down."""
    pose = Pose(np.array([1.0, 2.0, height]), rotation_from_rpy(*rpy) @ LOOKS_DOWN)
    spec = DvlSensorSpec(name="dvl", relative_to="base", **fields)
    return spec.bind(world, MovingCarrier(pose, velocity))  # type: ignore[arg-type]


def slope(degrees: float) -> np.ndarray:
    """A large plate through the origin that falls towards +x."""
    return plate(500.0, 0.0) @ rotation_y(math.radians(degrees)).T


def beams_of(message: DVL) -> tuple[np.ndarray, np.ndarray]:
    """Ranges and velocities along the beams, as published."""
    numbers = np.array([float(each) for each in message.raw_data.split()])
    return numbers[:4], numbers[4:]


@pytest.mark.parametrize("tilt", [0.0, 10.0])
@pytest.mark.parametrize("roll", [0.0, 30.0])
def test_ranges_and_velocity_are_those_of_geometry(tilt: float, roll: float) -> None:
    """A plane n.p = 0 is met at r = -n.p0 / n.d, to 1e-9, on a slope and at a roll, moving."""
    sensor = make(AcousticWorld(slope(tilt)), rpy=(math.radians(roll), 0.0, 0.7))
    message = sensor.sample(1.0)
    ranges, along = beams_of(message)
    rotation = rotation_from_rpy(math.radians(roll), 0.0, 0.7) @ LOOKS_DOWN
    lean = math.radians(30.0)
    for k, azimuth in enumerate(np.radians([45.0, 135.0, 225.0, 315.0])):
        beam = np.array(
            [
                math.sin(lean) * math.cos(azimuth),
                math.sin(lean) * math.sin(azimuth),
                math.cos(lean),
            ]
        )
        direction = rotation @ beam
        normal = rotation_y(math.radians(tilt))[:, 2]
        expected = -(normal @ [1.0, 2.0, 10.0]) / (normal @ direction)
        assert ranges[k] == pytest.approx(expected, abs=1e-9)
        assert along[k] == pytest.approx(direction @ VELOCITY, abs=1e-12)
    instrument = [message.bi_x_axis, message.bi_y_axis, message.bi_z_axis]
    assert instrument == pytest.approx(rotation.T @ VELOCITY, abs=1e-9)
    assert [message.be_east, message.be_north, message.be_upwards] == pytest.approx(
        VELOCITY, abs=1e-9
    )
    assert message.bi_error == pytest.approx(0.0, abs=1e-9)
    assert (message.bi_status, message.be_status) == ("A", "A")


def test_over_a_level_bottom_the_range_is_the_height() -> None:
    message = make(AcousticWorld(plate(500.0, 0.0)), rpy=(0.2, -0.1, 0.0)).sample(0.0)
    assert message.bd_range == pytest.approx(10.0, abs=1e-9)
    assert message.depth == pytest.approx(90.0)
    assert message.sound_speed > 1400.0


def test_beyond_its_limits_there_is_no_lock() -> None:
    for height, status in ((0.4, "V"), (0.6, "A"), (14.9, "A"), (15.1, "V")):
        sensor = make(AcousticWorld(plate(500.0, 0.0)), height=height, max_altitude=15.0)
        message = sensor.sample(0.0)
        assert message.bi_status == status
        assert math.isnan(message.bi_x_axis) is (status == "V")
        assert math.isnan(message.bd_range) is (status == "V")


def test_three_beams_are_enough_and_two_are_not() -> None:
    """A bottom that ends at x 4, then also at y 5; the beams reach 5.8 m ahead and aside."""
    found = []
    for end in ([496.0, 0.0, 0.0], [496.0, 495.0, 0.0]):
        sensor = make(AcousticWorld(plate(500.0, 0.0) - end), rpy=(0.0, 0.0, math.radians(45.0)))
        found.append(sensor.sample(0.0))
    three, two = found
    assert np.isfinite(beams_of(three)[0]).sum() == 3
    assert three.be_east == pytest.approx(VELOCITY[0], abs=1e-9)
    assert math.isnan(three.bi_error)
    assert np.isfinite(beams_of(two)[0]).sum() == 2
    assert (two.bi_status, two.bd_time) == ("V", 0.0)


def test_beams_drop_out_as_often_as_given() -> None:
    """2000 pings of four beams at 0.1: within 0.013, 3.9 standard errors (99.99 %)."""
    sensor = make(AcousticWorld(plate(500.0, 0.0)), dropout=0.1)
    lost, status = 0, []
    for k in range(2000):
        message = sensor.sample(0.2 * k)
        lost += int(np.isnan(beams_of(message)[0]).sum())
        status.append(message.bi_status)
    assert lost / 8000 == pytest.approx(0.1, abs=0.013)
    two_or_more = 1.0 - 0.9**4 - 4 * 0.1 * 0.9**3  # 0.0523
    assert status.count("V") / 2000 == pytest.approx(two_or_more, abs=0.02)


def test_noise_along_the_beams_becomes_that_of_the_axes() -> None:
    """x, y: s / (sqrt2 sin), z: s / (2 cos); 2500 pings, within 6 %, 4.2 standard errors."""
    sensor = make(AcousticWorld(plate(500.0, 0.0)), beam_std=0.005, beam_angle=25.0)
    messages = [sensor.sample(0.1 * k) for k in range(2500)]
    lean = math.radians(25.0)
    level, upright = 0.005 / (math.sqrt(2.0) * math.sin(lean)), 0.005 / (2.0 * math.cos(lean))
    for name, expected in (
        ("bi_x_axis", level), ("bi_y_axis", level), ("bi_z_axis", upright), ("bi_error", level),
        ("wi_x_axis", 3.0 * level),
    ):  # fmt: skip
        assert np.std([getattr(each, name) for each in messages]) == pytest.approx(
            expected, rel=0.06
        )


def test_the_noise_of_the_file_is_that_of_each_axis() -> None:
    """2500 pings: within 6 %, 4.2 standard errors; the mean within 4."""
    sensor = make(AcousticWorld(plate(500.0, 0.0)), std=0.0015, velocity=(0.0, 0.0, 0.0))
    found = [sensor.sample(0.1 * k).bi_y_axis for k in range(2500)]
    assert np.std(found) == pytest.approx(0.0015, rel=0.06)
    assert np.mean(found) == pytest.approx(0.0, abs=4 * 0.0015 / 50.0)


def test_water_is_tracked_where_there_is_enough_of_it() -> None:
    world = AcousticWorld(plate(500.0, 0.0))
    world.current = np.array([0.3, 0.4, 0.0])
    message = make(world).sample(0.0)
    through = np.subtract(VELOCITY, world.current)
    assert [message.we_east, message.we_north, message.we_upwards] == pytest.approx(
        through, abs=1e-9
    )
    assert (message.ws_status, message.wd_range) == ("A", 2.0)
    assert make(world, height=1.5).sample(0.0).wi_status == "V"


def test_distances_made_good_add_up() -> None:
    sensor = make(AcousticWorld(plate(500.0, 0.0)))
    for k in range(11):
        message = sensor.sample(0.2 * k)
    assert [message.bd_east, message.bd_north, message.bd_upwards] == pytest.approx(
        2.0 * np.array(VELOCITY), abs=1e-9
    )
    assert message.bd_time == 0.0


def test_the_beams_go_through_their_own_vehicle() -> None:
    world = AcousticWorld(plate(500.0, 0.0), plate(50.0, 9.0), plate(50.0, 8.0))
    world.rays.vehicles = ("", "vehicle", "another")
    ranges, _ = beams_of(make(world).sample(0.0))
    assert ranges == pytest.approx(2.0 / math.cos(math.radians(30.0)), abs=1e-9)


def test_the_original_differentiates_its_position() -> None:
    world = AcousticWorld(compatibility=frozenset({"dvl-differences"}))
    sensor = make(world)
    assert sensor.sample(0.0) == DVL()
    carrier = sensor._mount
    carrier.move(1.0, 2.5, 10.0)  # type: ignore[attr-defined]
    message = sensor.sample(0.5)
    assert [message.bi_x_axis, message.bi_y_axis, message.bi_z_axis] == pytest.approx(
        [0.0, -1.0, 0.0], abs=1e-12
    )
    assert message.bi_status == ""


def test_the_angle_of_the_beams_is_that_of_their_directions() -> None:
    directions = Janus(0.4).directions
    assert directions[:, 2] == pytest.approx(math.cos(0.4))
    assert directions.sum(axis=0) == pytest.approx([0.0, 0.0, 4.0 * math.cos(0.4)])


def test_in_the_tank_it_locks_on_the_floor() -> None:
    """4.81 m deep (the image on the floor, or 4.85 beside it), the sensor at 2 m; std 0.0015."""
    path = find("cirs.xml")
    assert isinstance(path, Path)
    with open_scene(read_scene(path), is_blind=True) as simulation:
        simulation.latest_message("g500/dvl")
        simulation.advance(0.4)
        message = simulation.latest_message("g500/dvl")
    assert message.bi_status == "A"
    assert message.bd_range == pytest.approx(4.81 - 2.0, abs=0.04)
    assert abs(message.bi_x_axis) < 5 * 0.0015
