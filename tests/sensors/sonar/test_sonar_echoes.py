"""Echoes against the sonar equation: targets of known strength, spreading, speckle, shadow."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats

from tests.sensors.acoustic_world import AcousticWorld, box, plate, sphere
from uwsim.acoustics import Material, SeaWater
from uwsim.base.geometry import Pose, rotation_from_rpy
from uwsim.sensors.sonar.echoes import Echoes
from uwsim.sensors.sonar.spec import SonarSpec

DOWN = rotation_from_rpy(0.0, 0.5 * math.pi, 0.0)
MIRROR = Material(reflection=1.0, slope=0.05, strength=-300.0)
CHALK = Material(reflection=0.0, slope=0.1, strength=-10.0)
SOURCE = 200.0  # [dB]
WIDE = {"vertical_aperture": 120.0, "rows": 512, "source_level": SOURCE, "bins": 400}


def listen(
    world: AcousticWorld, pose: Pose, *, half_width: float = 10.0, n: int = 81, **fields: float
) -> Echoes:
    """A sonar with ``n`` beams over some degrees, so narrow that each has a ray of its own."""
    narrow = {"beam_width": 4.0 * half_width / (n - 1)}
    spec = SonarSpec(name="s", relative_to="l", **{**WIDE, **narrow, **fields})  # type: ignore[arg-type]
    azimuths = np.radians(np.linspace(-half_width, half_width, n))
    return Echoes(spec, world, azimuths, float(azimuths[1] - azimuths[0]))  # type: ignore[arg-type]


def echo_level(world: AcousticWorld, pose: Pose, **fields: float) -> float:
    """All that comes back [dB re 1 uPa]."""
    power = listen(world, pose, **fields).power(pose).columns
    return 10.0 * math.log10(power.sum(dtype=np.float64)) + 120.0


def at_height(height: float, rotation: np.ndarray = DOWN) -> Pose:
    return Pose(np.array([0.0, 0.0, height]), rotation)


def losses(r: float) -> float:
    """There and back, at the depth of the tests [dB]."""
    return 2.0 * r * SeaWater().absorption(900e3, 100.0)


@pytest.mark.parametrize("slope", [0.03, 0.08])
def test_a_large_plate_sends_back_what_its_mirror_image_would(slope: float) -> None:
    """EL = SL - 20 log 2h - 2 alpha h + 20 log R, whatever its roughness."""
    rough = Material(reflection=0.5, slope=slope, strength=-300.0)
    world = AcousticWorld(plate(50.0, -6.0), materials=[rough])
    found = echo_level(world, at_height(0.0), half_width=25.0, n=201)
    expected = SOURCE - 20.0 * math.log10(12.0) - losses(6.0) + 20.0 * math.log10(0.5)
    assert found == pytest.approx(expected, abs=0.2)


@pytest.mark.parametrize("radius", [0.5, 1.0])
def test_a_large_sphere_has_the_target_strength_of_half_its_radius(radius: float) -> None:
    """TS = 20 log(a / 2) for plane waves; for those from a distance, a / 2 times r / (r + a)."""
    r = 15.0
    ball = sphere((r + radius, 0.0, 0.0), radius, n=200)
    world = AcousticWorld(ball, materials=[MIRROR])
    found = echo_level(
        world, at_height(0.0, np.eye(3)), half_width=4.0, n=401, rows=2048, vertical_aperture=20.0
    )
    strength = 20.0 * math.log10(0.5 * radius * r / (r + radius))
    expected = SOURCE - 40.0 * math.log10(r) - losses(r) + strength
    assert found == pytest.approx(expected, abs=0.3)


def test_a_sphere_of_one_metre_has_minus_six_decibels() -> None:
    assert 20.0 * math.log10(1.0 / 2.0) == pytest.approx(-6.02, abs=5e-3)


@pytest.mark.parametrize("tilt_deg", [0.0, 30.0, 60.0])
def test_a_small_rough_plate_follows_lambert(tilt_deg: float) -> None:
    """TS = mu + 10 log A + 20 log cos theta."""
    tilt = math.radians(tilt_deg)
    facing = plate(0.1, 0.0) @ rotation_from_rpy(0.0, tilt, 0.0).T + [0.0, 0.0, -8.0]
    world = AcousticWorld(facing, materials=[CHALK])
    found = echo_level(
        world, at_height(0.0), half_width=1.5, n=301, rows=2048, vertical_aperture=8.0
    )
    strength = -10.0 + 10.0 * math.log10(0.04) + 20.0 * math.log10(math.cos(tilt))
    expected = SOURCE - 40.0 * math.log10(8.0) - losses(8.0) + strength
    assert found == pytest.approx(expected, abs=0.25)


def test_echoes_fall_with_the_fourth_power_of_the_range_and_come_when_sound_does() -> None:
    levels = []
    for height in (5.0, 10.0):
        world = AcousticWorld(plate(0.2, -height), materials=[CHALK])
        echoes = listen(
            world, at_height(0.0), half_width=4.0, n=201, rows=2048, vertical_aperture=30.0
        )
        power = echoes.power(at_height(0.0)).columns.sum(axis=1, dtype=np.float64)
        assert echoes.ranges[int(np.argmax(power))] == pytest.approx(height, abs=echoes.bin_size)
        levels.append(10.0 * math.log10(power.sum()) + losses(height))
    assert levels[1] - levels[0] == pytest.approx(-40.0 * math.log10(2.0), abs=0.1)


def test_a_flat_bottom_has_no_gaps_between_rays() -> None:
    """At grazing angles rays are many bins apart; 24 rows find what 512 find, to half a decibel."""
    world = AcousticWorld(plate(100.0, -3.0))
    pose = at_height(0.0, rotation_from_rpy(0.0, 0.3, 0.0))
    few, many = (
        listen(world, pose, rows=rows, vertical_aperture=25.0).power(pose).columns[120:360, 40]
        for rows in (24, 512)
    )
    assert (few > 0.0).all()
    sums = [each.reshape(-1, 40).sum(axis=1) for each in (few, many)]
    np.testing.assert_allclose(10.0 * np.log10(sums[0] / sums[1]), 0.0, atol=0.5)


def test_there_is_no_echo_from_the_shadow_of_a_box() -> None:
    """From x to H x / (H - h) on the floor, seen over the far edge of the top."""
    world = AcousticWorld(plate(100.0, 0.0), box((6.0, -2.0, -1.0), (7.0, 2.0, 1.0)))
    pose = at_height(3.0, rotation_from_rpy(0.0, 0.3, 0.0))
    echoes = listen(world, pose, half_width=5.0, vertical_aperture=40.0)
    power = echoes.power(pose).columns
    end = 7.0 * 3.0 / (3.0 - 1.0)
    begin_range, end_range = math.hypot(7.0, 2.0), math.hypot(end, 3.0)
    middle = power[:, 41]
    dark = (echoes.ranges > begin_range + 0.15) & (echoes.ranges < end_range - 0.15)
    assert dark.sum() > 50
    assert (middle[dark] == 0.0).all()
    assert (
        middle[(echoes.ranges > end_range + 0.15) & (echoes.ranges < end_range + 1.0)].min() > 0.0
    )


def test_speckle_of_a_bottom_is_of_rayleighs_distribution() -> None:
    """Kolmogorov-Smirnov over 7000 cells, at a level of 1 %; std over mean 0.5227."""
    world = AcousticWorld(plate(100.0, -3.0))
    pose = at_height(0.0, rotation_from_rpy(0.0, 0.4, 0.0))
    fields = {"rows": 64, "vertical_aperture": 25.0, "source_level": 220.0}
    ping = listen(world, pose, half_width=20.0, n=101, **fields).ping(pose, 7)
    mean = listen(world, pose, half_width=20.0, n=101, speckle=False, **fields).ping(pose, 7)
    lit = mean > 100.0 * mean.min()
    amplitude = (ping[lit] / mean[lit]).astype(np.float64)
    assert len(amplitude) > 7000
    assert stats.kstest(amplitude, stats.rayleigh(scale=math.sqrt(0.5)).cdf).pvalue > 0.01
    ratio = amplitude.std() / amplitude.mean()
    assert ratio == pytest.approx(math.sqrt(4.0 / math.pi - 1.0), rel=0.01)


def test_without_any_echo_there_is_the_noise_of_the_receiver() -> None:
    """40 400 cells: the mean power is within 2 % with a confidence of 99.99 %."""
    world = AcousticWorld(plate(1.0, -1000.0))
    ping = listen(world, at_height(0.0), n=101, noise_level=70.0, rows=4).ping(at_height(0.0), 3)
    power = (ping.astype(np.float64) ** 2).mean()
    assert power == pytest.approx(10.0 ** ((70.0 - 120.0) / 10.0), rel=0.02)


def test_a_beam_hears_half_of_the_power_at_half_of_its_width() -> None:
    """Beams of 2 degrees at steps of half a degree; the target is on the axis of the middle one."""
    ball = sphere((10.0, 0.0, 0.0), 0.001, n=12)
    world = AcousticWorld(ball, materials=[CHALK])
    pose = at_height(0.0, np.eye(3))
    fields = {"vertical_aperture": 2.0, "rows": 256, "beam_width": 2.0, "speckle": False}
    echoes = listen(world, pose, half_width=3.0, n=13, noise_level=0.0, **fields)
    heard = (echoes.ping(pose, 1).astype(np.float64) ** 2).sum(axis=0)
    for off, share in ((0, 1.0), (1, 2.0**-0.25), (2, 0.5), (4, 2.0**-4.0)):
        assert heard[6 - off] == pytest.approx(share * heard[6], rel=1e-4)
        assert heard[6 + off] == pytest.approx(share * heard[6], rel=1e-4)


def test_beams_between_two_rays_hear_as_those_on_a_ray() -> None:
    """Over a flat bottom all of a row of beams hear the same; there are two beams a ray."""
    world = AcousticWorld(plate(100.0, -3.0))
    pose = at_height(0.0)
    fields = {"vertical_aperture": 30.0, "beam_width": 2.0, "speckle": False, "noise_level": 0.0}
    echoes = listen(world, pose, half_width=4.0, n=21, rows=64, **fields)
    assert len(echoes.grid.directions) // 64 < 21
    heard = echoes.ping(pose, 1)[: int(3.05 / echoes.bin_size)].astype(np.float64) ** 2
    levels = 10.0 * np.log10(heard.sum(axis=0))
    assert np.abs(np.diff(levels)).max() < 0.1


def test_the_water_surface_is_heard_from_below() -> None:
    world = AcousticWorld(plate(1.0, -1000.0), surface_height=4.0)
    pose = at_height(0.0, rotation_from_rpy(0.0, -0.5 * math.pi, 0.0))
    echoes = listen(world, pose)
    power = echoes.power(pose).columns.sum(axis=1)
    assert echoes.ranges[int(np.flatnonzero(power)[0])] == pytest.approx(4.0, abs=echoes.bin_size)


def test_echoes_by_way_of_the_surface_come_only_if_wanted_and_later() -> None:
    """By the mirror image of the target, 2 m below the surface and 10 m away."""
    ball = sphere((10.0, 0.0, 0.0), 0.3, n=48)
    world = AcousticWorld(ball, surface_height=2.0, materials=[CHALK])
    pose = at_height(0.0, np.eye(3))
    fields = {"vertical_aperture": 70.0, "rows": 1024, "half_width": 3.0}
    direct = listen(world, pose, **fields).power(pose).columns
    both = listen(world, pose, multipath=True, **fields).power(pose).columns
    added = np.flatnonzero((both - direct).sum(axis=1))
    ranges = listen(world, pose, **fields).ranges[added]
    assert ranges[0] == pytest.approx(math.hypot(10.0, 4.0) - 0.3, abs=0.06)
    assert ((both - direct).sum() < 0.5 * direct.sum()).all()


def test_nothing_comes_by_way_of_the_surface_through_a_roof() -> None:
    """Rays that end at the roof never get to the water's surface above it."""
    roof = box((-50.0, -50.0, 1.0), (8.0, 50.0, 1.2))
    world = AcousticWorld(roof, surface_height=2.0, materials=[CHALK])
    pose = at_height(0.0, np.eye(3))
    fields = {"vertical_aperture": 70.0, "rows": 256, "half_width": 3.0}
    direct = listen(world, pose, **fields).power(pose).columns
    both = listen(world, pose, multipath=True, **fields).power(pose).columns
    assert direct.sum() > 0.0
    np.testing.assert_array_equal(both, direct)


def test_no_ray_goes_past_straight_up_and_sends_back_less_than_nothing() -> None:
    """0.6 times an aperture of 160 degrees is more than a quarter of a turn."""
    world = AcousticWorld(plate(50.0, -3.0), surface_height=1.0)
    pose = at_height(0.0, np.eye(3))
    echoes = listen(world, pose, vertical_aperture=160.0, rows=64, multipath=True)
    assert echoes.grid.directions[:, 0].min() > 0.0
    assert echoes.power(pose).columns.min() >= 0.0
    assert np.isfinite(echoes.ping(pose, 1)).all()


def test_beams_that_hardly_differ_cost_no_more_than_others() -> None:
    """A million of them fit between two rays: each hears what all hear."""
    world = AcousticWorld(plate(100.0, -3.0))
    fields = {"beam_width": 1.0, "speckle": False, "noise_level": 0.0}
    echoes = listen(world, at_height(0.0), half_width=1e-6, n=9, rows=16, **fields)
    assert len(echoes.grid.patterns) == 9
    heard = echoes.ping(at_height(0.0), 1)
    np.testing.assert_allclose(heard, np.broadcast_to(heard[:, :1], heard.shape), rtol=1e-3)
