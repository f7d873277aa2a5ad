"""The particles in a view: their number, sizes, places and motion."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import numpy.typing as npt
import pytest

from uwsim.base.geometry import Intrinsics, Pose
from uwsim.particles import (
    Drift,
    Kind,
    MarineSnowSpec,
    SizeClass,
    View,
    find_particles,
    find_plume,
)
from uwsim.particles.lattice import MAX_PARTICLES

LENS = Intrinsics.from_fovy(640, 480, math.radians(50.0))
SNOW = SizeClass(
    kind=Kind.FLOC,
    key=12345,
    concentration=500.0,
    min_diameter=0.02,
    max_diameter=0.021,
    slope=3.0,
    rise_speed=-0.001,
    reflectance=0.05,
)
"""Flocs that are so large that the range of the view is the limit."""
VIEW = View(
    world_from_camera=Pose.from_rpy((1.0, 2.0, -10.0), (0.7, 0.2, 0.1)),
    intrinsics=LENS,
    surface_height=0.0,
    max_range=3.0,
)


def find_places(size_class: SizeClass, view: View, drift: Drift) -> npt.NDArray[np.float64]:
    """Return the places of particles in W, (n, 3) [m]."""
    places = find_particles(size_class, view, drift)["place"].astype(np.float64)
    return view.world_from_camera.transform(places)


def compute_volume(view: View) -> float:
    """Return the volume of the view by its solid angle [m3]."""
    lens = view.intrinsics
    x, y = 0.5 * lens.width / lens.fx, 0.5 * lens.height / lens.fy
    solid_angle = 4.0 * math.asin(x * y / math.sqrt((1.0 + x * x) * (1.0 + y * y)))
    return solid_angle * view.max_range**3 / 3.0


def test_the_number_in_view_is_that_of_the_concentration() -> None:
    numbers, expected = [], SNOW.concentration * compute_volume(VIEW)
    for key in range(40):
        records = find_particles(replace(SNOW, key=key), VIEW, Drift())
        x, y, z = records["place"].T
        is_inside = (np.abs(x) < 0.5 * LENS.width / LENS.fx * -z) & (
            np.abs(y) < 0.5 * LENS.height / LENS.fy * -z
        )
        numbers.append(int(np.count_nonzero(is_inside)))
    deviation = math.sqrt(expected / len(numbers))
    assert np.mean(numbers) == pytest.approx(expected, abs=4.0 * deviation)
    assert np.var(numbers) == pytest.approx(expected, rel=0.6)  # Poisson's


def test_particles_fill_the_view_evenly() -> None:
    view = replace(VIEW, max_range=4.0)
    records = find_particles(replace(SNOW, concentration=400.0), view, Drift())
    x, y, z = records["place"].T.astype(np.float64)
    cubes = (np.sqrt(x * x + y * y + z * z) / view.max_range) ** 3
    counts, _ = np.histogram(cubes, bins=8, range=(0.0, 1.0))
    mean = len(cubes) / 8
    assert np.sum((counts - mean) ** 2) / mean < 25.0  # chi squared of 7 degrees of freedom
    for slopes in (x / -z, y / -z):
        assert abs(np.mean(np.sign(slopes))) < 4.0 / math.sqrt(len(slopes))


def test_two_cameras_see_the_same_particles() -> None:
    drift = Drift(displacement=(0.3, -0.2, 0.1), time=7.0)
    first = find_places(SNOW, VIEW, drift)
    turned = replace(VIEW, world_from_camera=Pose.from_rpy((1.2, 2.1, -10.1), (0.5, 0.1, 0.2)))
    second = find_places(SNOW, turned, drift)
    distances = np.sqrt(((first[:, None] - second[None]) ** 2).sum(axis=2))
    n_common = int(np.count_nonzero(distances.min(axis=1) < 1e-5))
    assert n_common > 0.4 * len(first)


def test_the_same_key_gives_the_same_bytes() -> None:
    first = find_particles(SNOW, VIEW, Drift(time=2.0))
    assert first.tobytes() == find_particles(SNOW, VIEW, Drift(time=2.0)).tobytes()
    other = find_particles(replace(SNOW, key=1), VIEW, Drift(time=2.0))
    assert first.tobytes() != other.tobytes()


def test_particles_drift_with_the_water_and_sink() -> None:
    time, displacement = 20.0, np.array([0.05, -0.03, 0.02])
    drift = Drift(displacement=(0.05, -0.03, 0.02), time=time)
    moved_places = find_places(SNOW, VIEW, drift)
    expected = find_places(SNOW, VIEW, Drift()) + displacement
    expected[:, 2] += SNOW.rise_speed * time
    distances = np.sqrt(((moved_places[:, None] - expected[None]) ** 2).sum(axis=2))
    is_known = distances.min(axis=1) < 1e-5
    assert np.count_nonzero(is_known) > 0.9 * len(moved_places)  # the others came into view


def test_the_streak_is_the_motion_relative_to_the_camera() -> None:
    view = replace(
        VIEW, exposure_time=0.02, velocity=(0.3, 0.0, 0.0), angular_velocity=(0.0, 0.2, 0.0)
    )
    drift = Drift(velocity=(0.1, 0.0, 0.05))
    bubbles = replace(SNOW, kind=Kind.BUBBLE, rise_speed=0.2)  # round: no length of their own
    records = find_particles(bubbles, view, drift)
    places = view.world_from_camera.transform(records["place"].astype(np.float64))
    offsets = places - view.world_from_camera.position
    velocities = np.array([-0.2, 0.0, 0.25]) - np.cross([0.0, 0.2, 0.0], offsets)
    extents = records["extent"].astype(np.float64) @ view.world_from_camera.rotation.T
    np.testing.assert_allclose(extents, 0.02 * velocities, atol=1e-6)


def test_small_particles_fade_before_they_vanish() -> None:
    small_class = replace(SNOW, min_diameter=0.001, max_diameter=0.0012, concentration=5000.0)
    view = replace(VIEW, max_range=50.0)
    records = find_particles(small_class, view, Drift())
    ranges = np.sqrt((records["place"].astype(np.float64) ** 2).sum(axis=1))
    widths = 2.0 * records["radius"] * LENS.fx / ranges  # [px]
    assert widths.min() >= 0.499
    assert records["weight"][widths < 0.52].max() < 0.25
    assert records["weight"][widths > 0.68].min() == 1.0


def test_bubbles_below_the_surface_thin_out_with_depth() -> None:
    bubbles = replace(SNOW, kind=Kind.BUBBLE, depth_scale=1.0, concentration=4000.0)
    upwards = Pose.from_rpy((0.0, 0.0, -4.0), (math.pi / 2.0, 0.0, 0.0))
    places = find_places(bubbles, replace(VIEW, world_from_camera=upwards), Drift())
    assert places[:, 2].max() <= 0.0
    shallow = np.count_nonzero((places[:, 2] > -3.5) & (places[:, 2] < -3.0))
    deep = np.count_nonzero((places[:, 2] > -4.5) & (places[:, 2] < -4.0))
    assert shallow / deep == pytest.approx(math.e, rel=0.35)


def test_no_particle_is_above_the_surface() -> None:
    view = replace(VIEW, world_from_camera=Pose.from_rpy((0.0, 0.0, -0.5), (math.pi / 2, 0.0, 0.0)))
    places = find_places(SNOW, view, Drift())
    assert len(places) > 100
    assert places[:, 2].max() <= 1e-6


def test_a_source_has_as_many_bubbles_as_rise_through_the_water() -> None:
    bubbles = replace(SNOW, kind=Kind.BUBBLE, rise_speed=0.25, concentration=40.0)
    far_away = Pose.from_rpy((0.0, -12.0, -2.5), (math.pi / 2.0, 0.0, 0.0))
    view = replace(VIEW, world_from_camera=far_away, max_range=30.0)
    records = find_plume(bubbles, np.array([0.0, 0.0, -5.0]), view, Drift(time=100.0))
    assert len(records) == pytest.approx(40.0 * 5.0 / 0.25, abs=2)
    young_records = find_plume(bubbles, np.array([0.0, 0.0, -5.0]), view, Drift(time=4.0))
    assert len(young_records) == pytest.approx(160, abs=2)


def test_the_classes_of_snow_add_up_to_its_power_law() -> None:
    spec = MarineSnowSpec(concentration=1000.0, slope=3.0)
    classes = spec.divide(iter(range(100)).__next__)
    assert sum(c.concentration for c in classes) == pytest.approx(1000.0)
    n_above = sum(c.concentration for c in classes[len(classes) // 2 :])
    edge = classes[len(classes) // 2].min_diameter
    low, high = spec.min_diameter, spec.max_diameter
    expected = (edge**-2 - high**-2) / (low**-2 - high**-2)
    assert n_above / 1000.0 == pytest.approx(expected, rel=1e-9)
    assert all(c.rise_speed < 0.0 for c in classes)


def test_diameters_follow_the_power_law() -> None:
    wide_class = replace(
        SNOW, min_diameter=0.02, max_diameter=0.06, slope=3.0, concentration=3000.0
    )
    diameters = 2.0 * find_particles(wide_class, replace(VIEW, max_range=2.0), Drift())["radius"]
    share = np.count_nonzero(diameters > 0.03) / len(diameters)
    expected = (0.03**-2 - 0.06**-2) / (0.02**-2 - 0.06**-2)
    assert share == pytest.approx(expected, abs=4.0 * math.sqrt(expected / len(diameters)))


def test_a_view_of_too_many_particles_shows_the_nearest_ones() -> None:
    dense = replace(SNOW, concentration=1e5)
    records = find_particles(dense, VIEW, Drift())
    places = records["place"].astype(np.float64)
    ranges = np.sqrt((places**2).sum(axis=1))
    reach = ranges.max()
    assert 5000 < len(records) < MAX_PARTICLES
    slopes = np.abs(places[:, :2] / -places[:, 2:])
    inside = (slopes <= (0.5 * LENS.width / LENS.fx, 0.5 * LENS.height / LENS.fy)).all(axis=1)
    volume = compute_volume(replace(VIEW, max_range=float(reach)))
    assert inside.sum() == pytest.approx(1e5 * volume, rel=0.05)
    centre = (places[:, :2] / -places[:, 2:]).mean(axis=0)
    np.testing.assert_allclose(centre, 0.0, atol=0.02)  # they are on all sides
    near = find_particles(dense, replace(VIEW, max_range=0.5), Drift())["place"]
    wanted = {tuple(place) for place in near.tolist()}
    assert wanted <= {tuple(place) for place in places.astype(np.float32).tolist()}
