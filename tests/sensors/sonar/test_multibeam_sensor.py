"""Beams of a multibeam against a plane, and what its scan says of them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.sensors.acoustic_world import AcousticWorld, FakeCarrier, box, plate
from uwsim.base.geometry import Pose, rotation_from_rpy
from uwsim.sensors.pencil import pencil_rays
from uwsim.sensors.sonar.multibeam_sensor import (
    BeamFan,
    FanSpec,
    MultibeamSensorSpec,
    find_surface_rays,
)
from uwsim.sensors.sonar.profiling_sonar import ProfilingSonarSpec

FAN = {"init_angle": -60.0, "final_angle": 60.0, "angle_incr": 0.5, "range": 30.0}


def make(world: AcousticWorld, *, roll: float = 0.0, **fields: float) -> BeamFan:
    spec = MultibeamSensorSpec(name="sonar", relative_to="base", **{**FAN, **fields})  # type: ignore[arg-type]
    return bound(spec, world, Pose(np.zeros(3), rotation_from_rpy(roll, 0.0, 0.0)))


def bound(spec: FanSpec, world: AcousticWorld, pose: Pose) -> BeamFan:
    return spec.bind(world, FakeCarrier(pose))  # type: ignore[arg-type]


@pytest.mark.parametrize("roll", [0.0, math.radians(30.0)])
def test_beams_find_a_flat_floor_at_every_angle(roll: float) -> None:
    message = make(AcousticWorld(plate(100.0, -5.0)), roll=roll).sample(0.0)
    angles = message.angle_min + message.angle_increment * np.arange(len(message.ranges))
    expected = 5.0 / np.cos(angles + roll)
    expected = np.where((expected > 0.0) & (expected < 30.0), expected, 30.0)
    np.testing.assert_allclose(message.ranges, expected, rtol=1e-6)


def test_the_scan_says_its_angles() -> None:
    message = make(AcousticWorld(plate(100.0, -5.0))).sample(2.0)
    assert len(message.ranges) == 241
    assert message.angle_min == pytest.approx(math.radians(-60))
    assert message.angle_max == pytest.approx(math.radians(60))
    assert message.angle_increment == pytest.approx(math.radians(0.5))
    assert (message.range_min, message.range_max) == (0.0, 30.0)
    assert (message.header.frame_id, message.header.stamp.sec) == ("sonar", 2)
    assert len(message.intensities) == 0


def test_positive_angles_are_towards_y_whichever_end_comes_first() -> None:
    wall = box((-1.0, 2.0, -3.0), (1.0, 2.5, 3.0))
    up = make(AcousticWorld(wall)).sample(0.0)
    down = make(AcousticWorld(wall), init_angle=60.0, final_angle=-60.0).sample(0.0)
    assert up.ranges[:120].min() == 30.0
    assert up.ranges[-1] == pytest.approx(2.0 / math.sin(math.radians(60)))
    assert down.angle_increment < 0.0
    np.testing.assert_allclose(down.ranges, up.ranges[::-1], rtol=1e-6)


def test_a_wide_beam_gives_the_mean_of_what_it_covers() -> None:
    """At nadir of a plane: h (1 + <t^2> / 2), t of the rays with their weights."""
    message = make(AcousticWorld(plate(100.0, -5.0)), beam_width=4.0).sample(0.0)
    narrow = make(AcousticWorld(plate(100.0, -5.0))).sample(0.0)
    width = math.radians(4.0)
    weights = np.array([1.0, 6.0 * 2.0**-0.25, 12.0 * 0.5])
    angles = np.array([0.0, 0.25, 0.5]) * width
    mean = 5.0 * (weights / np.cos(angles)).sum() / weights.sum()
    assert message.ranges[120] == pytest.approx(mean, rel=1e-6)
    assert (message.ranges[1:-1] >= narrow.ranges[1:-1] - 1e-6).all()


@pytest.mark.parametrize("width", [0.5, 2.0, 6.0])
@pytest.mark.parametrize("top", [-2.0, -3.5, -4.7])
@pytest.mark.parametrize("incr", [0.5, 0.13])
def test_at_an_edge_a_wide_beam_gives_one_surface_or_the_other(
    width: float, top: float, incr: float
) -> None:
    world = AcousticWorld(plate(100.0, -5.0), plate(0.9, top))
    message = make(world, beam_width=width, angle_incr=incr).sample(0.0)
    angles = message.angle_min + message.angle_increment * np.arange(len(message.ranges))
    half, is_one = math.radians(0.5 * width), np.zeros(len(angles), dtype=bool)
    for height in (5.0, -top):
        ends = height / np.cos(np.abs(angles) + half)
        starts = height / np.cos(np.maximum(np.abs(angles) - half, 0.0))
        is_one |= (message.ranges > starts - 1e-4) & (message.ranges < ends + 1e-4)
    assert is_one.all()
    assert np.unique(np.round(message.ranges, 1)).size > 2


@pytest.mark.parametrize("width", [0.5, 3.0, 10.0])
def test_a_beam_on_one_sloping_surface_keeps_all_its_rays(width: float) -> None:
    """At every slope that the whole beam meets."""
    turns = np.radians(np.linspace(0.0, 84.0 - width, 60))
    axes = np.stack([np.zeros(60), np.sin(turns), -np.cos(turns)], axis=1)
    beside = np.broadcast_to([1.0, 0.0, 0.0], axes.shape)
    rays, weights = pencil_rays(axes, beside, math.radians(width))
    distances = 5.0 / -rays[:, :, 2]
    assert find_surface_rays(distances, weights, math.radians(width)).all()


def test_of_three_surfaces_that_with_most_of_the_beam_counts() -> None:
    distances = np.array([[4.0] * 3 + [6.0] * 5 + [9.0] * 4 + [np.inf] * 2])
    found = find_surface_rays(distances, np.ones(14), 0.02)
    assert found[0].tolist() == [False] * 3 + [True] * 5 + [False] * 6


def test_noise_is_that_of_the_sensor_and_spares_beams_that_hit_nothing() -> None:
    """2410 ranges: the deviation is within 5 % with a confidence of 99.9 %."""
    sensor = make(AcousticWorld(plate(5.0, -5.0)), std=0.03)
    clean = make(AcousticWorld(plate(5.0, -5.0))).sample(0.0).ranges
    noise = np.array([sensor.sample(0.0).ranges - clean for _ in range(10)])
    hit = clean < 30.0
    assert 0 < hit.sum() < len(hit)
    assert (noise[:, ~hit] == 0.0).all()
    assert noise[:, hit].std() == pytest.approx(0.03, rel=0.07)


def test_a_profiling_sonar_scans_as_a_multibeam_does() -> None:
    world = AcousticWorld(plate(100.0, -5.0))
    profiler = ProfilingSonarSpec(name="p", relative_to="base", fov=2.0, **FAN)  # type: ignore[arg-type]
    scan = bound(profiler, world, Pose.identity()).sample(0.0)
    np.testing.assert_array_equal(scan.ranges, make(world).sample(0.0).ranges)


def test_its_own_vehicle_hides_nothing_from_inside_but_from_outside() -> None:
    """A sensor within a hull sees through it, as a camera does; a part beside it is in the way."""
    floor, hull = plate(100.0, -5.0), box((-0.3, -0.3, -0.3), (0.3, 0.3, 0.3))
    foot = box((-0.1, -0.1, -1.2), (0.1, 0.1, -1.0))
    ranges = make(AcousticWorld(floor, hull, foot)).sample(0.0).ranges
    assert ranges[120] == pytest.approx(1.0)
    assert ranges[0] == pytest.approx(10.0)


IMAGES = frozenset({"multibeam-images"})


@pytest.mark.parametrize("half", [60.0, 80.0])
def test_the_originals_multibeam_finds_a_floor_between_its_pixels(half: float) -> None:
    """One camera up to 120 degrees: depth is the same everywhere; two beyond, interpolated."""
    world = AcousticWorld(plate(100.0, -2.0), compatibility=IMAGES)
    message = make(world, init_angle=-half, final_angle=half).sample(0.0)
    angles = message.angle_min + message.angle_increment * np.arange(len(message.ranges))
    expected = np.minimum(2.0 / np.cos(angles), 30.0)
    np.testing.assert_allclose(message.ranges, expected, rtol=1e-6 if half == 60.0 else 0.03)


def test_the_originals_multibeam_is_blind_to_what_is_near() -> None:
    foot = box((-0.1, -0.1, -0.6), (0.1, 0.1, -0.4))
    original = AcousticWorld(plate(100.0, -5.0), foot, compatibility=IMAGES)
    assert make(original).sample(0.0).ranges[120] == pytest.approx(5.0)
    assert make(AcousticWorld(plate(100.0, -5.0), foot)).sample(0.0).ranges[120] == pytest.approx(
        0.4
    )


def test_an_edge_is_smeared_between_two_pixels_of_the_original() -> None:
    """The depth between a pixel on the top of a wall and one on the floor behind is of neither."""
    wall = box((-1.0, 3.0, -4.9), (1.0, 3.2, -3.0))
    smeared = make(AcousticWorld(plate(100.0, -5.0), wall, compatibility=IMAGES)).sample(0.0)
    exact = make(AcousticWorld(plate(100.0, -5.0), wall)).sample(0.0)
    assert np.abs(smeared.ranges - exact.ranges).max() > 0.3
