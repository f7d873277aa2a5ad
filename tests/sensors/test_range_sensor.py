"""The range sensor against geometry, and in the tank of the original."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.sensors.acoustic_world import AcousticWorld, FakeCarrier, plate
from tests.support.opened import open_scene
from uwsim.assets.find import find
from uwsim.base.geometry import Pose, rotation_from_rpy
from uwsim.messages import Range
from uwsim.scene.reader import read_scene
from uwsim.sensors.range_sensor import RangeSensor, RangeSensorSpec

DOWN = rotation_from_rpy(0.0, 0.5 * math.pi, 0.0)  # x of the sensor points down


def make(
    world: AcousticWorld, height: float = 0.0, tilt: float = 0.0, **fields: float
) -> RangeSensor:
    spec = RangeSensorSpec(name="sonar", relative_to="base", **{"range": 10.0, **fields})  # type: ignore[arg-type]
    pose = Pose(np.array([0.0, 0.0, height]), rotation_from_rpy(tilt, 0.0, 0.0) @ DOWN)
    return spec.bind(world, FakeCarrier(pose))  # type: ignore[arg-type]


def test_the_range_is_the_distance_along_the_ray() -> None:
    message = make(AcousticWorld(plate(20.0, -4.0)), tilt=0.5).sample(1.5)
    assert message.range == pytest.approx(4.0 / math.cos(0.5), abs=1e-12)
    assert (message.min_range, message.max_range, message.field_of_view) == (0.0, 10.0, 0.0)
    assert message.radiation_type == Range.ULTRASOUND
    assert (message.header.frame_id, message.header.stamp.nanosec) == ("sonar", 500_000_000)


def test_where_nothing_is_hit_it_is_the_range_of_the_sensor() -> None:
    assert make(AcousticWorld(plate(20.0, -10.1))).sample(0.0).range == 10.0


def test_a_beam_finds_the_nearest_point_in_it() -> None:
    """At a tilt of 20 degrees a beam of 20 meets the bottom at 10 degrees first."""
    world = AcousticWorld(plate(30.0, -5.0))
    tilt = math.radians(20)
    message = make(world, tilt=tilt, beam_width=20.0).sample(0.0)
    assert message.range == pytest.approx(5.0 / math.cos(math.radians(10)), rel=2e-3)
    assert message.field_of_view == pytest.approx(math.radians(20))


def test_noise_has_its_standard_deviation() -> None:
    """1000 samples: the deviation is within 7 % with a confidence of 99.8 %."""
    sensor = make(AcousticWorld(plate(20.0, -4.0)), std=0.02)
    ranges = [sensor.sample(0.0).range for _ in range(1000)]
    assert np.std(ranges) == pytest.approx(0.02, rel=0.07)
    assert np.mean(ranges) == pytest.approx(4.0, abs=4 * 0.02 / math.sqrt(1000))


def test_the_sonar_of_the_tank_measures_down_to_the_image_on_its_floor() -> None:
    """4.81 m deep; the vehicle is at 2 m, the sonar 0.95 m below; 0.1 degrees of tilt."""
    path = find("cirs.xml")
    assert isinstance(path, Path)
    with open_scene(read_scene(path), is_blind=True) as simulation:
        simulation.latest_message("uwsim/g500/range")
        simulation.advance()
        assert simulation.latest_message("uwsim/g500/range").range == pytest.approx(1.86, abs=1e-4)
