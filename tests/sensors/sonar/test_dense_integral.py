"""Levels against the integral of the sonar equation over many rays, by formulas of the docs."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from tests.sensors.acoustic_world import AcousticWorld, FakeCarrier, box, plate, sphere
from uwsim.acoustics import MATERIALS, Material, MaterialName
from uwsim.base.geometry import Pose, rotation_from_rpy
from uwsim.sensors.sonar.echoes import Echoes
from uwsim.sensors.sonar.imaging_sonar import ImagingSonarSpec
from uwsim.sensors.sonar.message import amplitudes
from uwsim.sensors.sonar.scanning_sonar import ScanningSonarSpec
from uwsim.sensors.sonar.side_scan_sonar import SideScanSonarSpec
from uwsim.sensors.sonar.spec import SonarSpec

QUIET = {"speckle": False, "noise_level": 0.0}
TOLERANCE = 0.5  # [dB]


def cross_section(material: Material, cosine: np.ndarray) -> np.ndarray:
    """As `uwsim.acoustics.material` defines it, of many angles."""
    tangent = np.sqrt(1.0 - cosine**2) / cosine
    facets = np.exp(-0.5 * (tangent / material.slope) ** 2) / cosine**4
    glint = material.reflection**2 / (8.0 * math.pi * material.slope**2) * facets
    found: np.ndarray = glint + 10.0 ** (0.1 * material.strength) * cosine**2
    return found


def dense_power(
    world: AcousticWorld,
    pose: Pose,
    spec: SonarSpec,
    beam: float,
    window: tuple[float, float, float, float],
    n: int = 300,
) -> tuple[np.ndarray, np.ndarray]:
    """Ranges and powers of the echoes of n x n rays in a window.

    The window is left, right, low and high [deg]."""
    left, right, low, high = np.radians(window)
    azimuths = left + (np.arange(n) + 0.5) * (right - left) / n
    elevations = low + (np.arange(n) + 0.5) * (high - low) / n
    azimuth, elevation = (each.ravel() for each in np.meshgrid(azimuths, elevations))
    level = np.cos(elevation)
    directions = np.stack(
        [level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)], axis=1
    )
    hits = world.rays.cast(pose, directions, spec.range)
    met = np.isfinite(hits.distance)
    r, surface = hits.distance[met], hits.surface[met]
    cosine = -((directions[met] @ pose.rotation.T) * hits.normal[met]).sum(axis=1)
    sigma = np.zeros(len(r))
    for number, material in enumerate(world.rays.materials):
        sigma[surface == number] = cross_section(
            material, np.maximum(cosine[surface == number], 0.02)
        )
    u = (
        math.pi
        * 0.4429
        * np.sin(elevation[met])
        / math.sin(math.radians(spec.vertical_aperture) / 2)
    )
    off = 2.0 * (azimuth[met] - beam) / math.radians(spec.beam_width)
    pattern = np.sinc(u / math.pi) ** 4 * np.where(np.abs(off) <= 2.5, 2.0 ** -(off**2), 0.0)
    solid = (right - left) * (high - low) / n**2 * level[met]
    alpha = world.sea_water.absorption(spec.frequency, world.surface.height - pose.position[2])
    strength = 10.0 ** (0.1 * (spec.source_level - 120.0 - 2.0 * alpha * r))
    return r, strength * pattern * sigma * solid / (r**2 * np.maximum(cosine, 0.02))


def decibels(power: float) -> float:
    return 10.0 * math.log10(power)


def imaging(beams: int, aperture: float, **fields: object) -> ImagingSonarSpec:
    return ImagingSonarSpec(
        name="fls", relative_to="base", beams=beams, horizontal_aperture=aperture,
        **{**QUIET, **fields},
    )  # type: ignore[arg-type]  # fmt: skip


def beam_powers(spec: ImagingSonarSpec, world: AcousticWorld, pose: Pose) -> np.ndarray:
    """What each beam receives in all bins [Pa2]."""
    sonar = spec.bind(world, FakeCarrier(pose))  # type: ignore[arg-type]
    echoes = amplitudes(sonar.sample(0.0)).astype(np.float64)
    found: np.ndarray = (echoes**2).sum(axis=0)
    return found


LEVEL = Pose(np.array([0.0, 0.0, 0.0]), np.eye(3))


@pytest.mark.parametrize("spacing", [0.3, 1.0, 3.0, 10.0])
def test_a_wall_is_as_loud_for_any_spacing_of_the_beams(spacing: float) -> None:
    wall = box((9.0, -40.0, -40.0), (10.0, 40.0, 40.0))
    world = AcousticWorld(wall, materials=[MATERIALS["concrete"]])
    spec = imaging(5, 4.0 * spacing)
    heard = beam_powers(spec, world, LEVEL)
    for beam in (2, 3):
        middle = math.degrees(spec.azimuths[beam])
        window = (middle - 1.3, middle + 1.3, -23.0, 23.0)
        _, powers = dense_power(world, LEVEL, spec, math.radians(middle), window)
        assert decibels(heard[beam] / powers.sum()) == pytest.approx(0.0, abs=TOLERANCE)


@pytest.mark.parametrize(
    "material",
    [
        name if name in ("clay", "smoothSteel") else pytest.param(name, marks=pytest.mark.slow)
        for name in MATERIALS
    ],
)
@pytest.mark.parametrize(("radius", "distance"), [(0.04, 6.0), (0.4, 13.0)])
def test_a_ball_is_as_loud_wherever_it_is_between_rays(
    material: MaterialName, radius: float, distance: float
) -> None:
    """Of every bundled material, at several places between rows and beams."""
    levels = []
    for k in (0, 2, 3):
        azimuth, elevation = math.radians(1.7 + 0.29 * k), math.radians(-2.0 + 0.37 * k)
        way = np.array(
            [
                math.cos(elevation) * math.cos(azimuth),
                math.cos(elevation) * math.sin(azimuth),
                math.sin(elevation),
            ]
        )
        ball = sphere(tuple(way * distance), radius, n=32)
        world = AcousticWorld(ball, materials=[MATERIALS[material]])
        spec = imaging(64, 40.0, beam_width=1.5)
        beam = int(np.abs(spec.azimuths - azimuth).argmin())
        span = 1.05 * math.degrees(math.asin(radius / distance))
        a, e = math.degrees(azimuth), math.degrees(elevation)
        window = (a - span, a + span, e - span, e + span)
        _, powers = dense_power(world, LEVEL, spec, float(spec.azimuths[beam]), window)
        levels.append(decibels(beam_powers(spec, world, LEVEL)[beam] / powers.sum()))
    assert np.abs(levels).max() < TOLERANCE, levels


@pytest.mark.parametrize("spacing", [0.5, 2.0, 4.0, 10.0])
def test_a_target_at_the_side_of_a_beam_is_heard_by_its_pattern(spacing: float) -> None:
    """Half a beam width off the axis it has half the power; four spacings and three sizes."""
    for radius in (0.02, 0.1, 0.25):
        half_width = math.radians(0.5)
        centre = (10.0 * math.cos(half_width), 10.0 * math.sin(half_width), 0.05)
        world = AcousticWorld(sphere(centre, radius, 48), materials=[MATERIALS["rock"]])
        spec = imaging(3, 2.0 * spacing)
        _, powers = dense_power(world, LEVEL, spec, 0.0, (-1.3, 2.5, -1.5, 2.0))
        heard = beam_powers(spec, world, LEVEL)
        assert decibels(heard[1] / powers.sum()) == pytest.approx(0.0, abs=TOLERANCE)


def test_a_thin_pipe_between_two_rows_is_heard_in_all_its_length() -> None:
    """4 cm thick, across the view at 15 m, where rows are 20 cm apart; also when it slants."""
    for lean in (0.0, 0.2):
        pipe = box((14.98, -9.0, -0.02), (15.02, 9.0, 0.02)) @ rotation_from_rpy(lean, 0.0, 0.0).T
        world = AcousticWorld(pipe, materials=[MATERIALS["steel"]])
        spec = imaging(90, 44.5)
        heard = beam_powers(spec, world, LEVEL)
        for beam in range(5, 86, 10):
            middle = math.degrees(spec.azimuths[beam])
            height = math.degrees(math.atan(-math.tan(math.radians(middle)) * math.tan(-lean)))
            window = (middle - 1.3, middle + 1.3, height - 1.0, height + 1.0)
            _, powers = dense_power(world, LEVEL, spec, math.radians(middle), window)
            assert decibels(heard[beam] / powers.sum()) == pytest.approx(0.0, abs=TOLERANCE)


def test_small_targets_cast_shadows_and_are_hidden_by_others() -> None:
    """The wall behind a small plate has a hole in its echo; a plate behind the wall has none."""
    wall = box((9.0, -9.0, -9.0), (9.1, 9.0, 9.0))
    front = box((6.0, -0.1, -0.1), (6.05, 0.1, 0.1))
    behind = box((11.0, -0.1, -0.1), (11.05, 0.1, 0.1))
    rock = [MATERIALS["rock"]]
    spec = imaging(3, 4.0)
    alone = beam_powers(spec, AcousticWorld(wall, materials=rock), LEVEL)
    hidden = beam_powers(spec, AcousticWorld(wall, behind, materials=rock * 2), LEVEL)
    np.testing.assert_array_equal(hidden, alone)
    both = AcousticWorld(wall, front, materials=rock * 2)
    _, powers = dense_power(both, LEVEL, spec, 0.0, (-1.3, 1.3, -23.0, 23.0), n=600)
    assert decibels(beam_powers(spec, both, LEVEL)[1] / powers.sum()) == pytest.approx(0.0, abs=0.5)


@pytest.mark.parametrize("material", ["sand", "smoothSteel"])
@pytest.mark.parametrize(("tilt", "aperture"), [(25.0, 50.0), (40.0, 30.0), (20.0, 70.0)])
def test_a_side_scan_hears_the_floor_below_it_first(
    material: MaterialName, tilt: float, aperture: float
) -> None:
    """From the altitude on; metre by metre as loud as the integral."""
    height = 7.0
    world = AcousticWorld(plate(200.0, 0.0), materials=[MATERIALS[material]])
    spec = SideScanSonarSpec(
        name="sss", relative_to="base", tilt=tilt, vertical_aperture=aperture, range=30.0, bins=590,
        source_level=250.0, **QUIET,
    )  # type: ignore[arg-type]  # fmt: skip
    pose = Pose(np.array([0.0, 0.0, height]), np.eye(3))
    message = spec.bind(world, FakeCarrier(pose)).sample(0.0)  # type: ignore[arg-type]
    echo = amplitudes(message)[:, 0].astype(np.float64) ** 2
    assert message.ranges[int(np.flatnonzero(echo > 1e-11)[0])] == pytest.approx(height, abs=0.1)
    head = pose.rotation @ rotation_from_rpy(0.0, 0.0, 0.5 * math.pi)
    head = head @ rotation_from_rpy(0.0, math.radians(tilt), 0.0)
    r, powers = dense_power(
        world, Pose(pose.position, head), spec, 0.0, (-0.65, 0.65, -89.9, 89.9), n=900
    )
    edges = np.array([6.9, 7.3, 8.0, 9.0, 10.0, 12.0, 15.0, 20.0])
    for begin, end in itertools.pairwise(edges):
        expected = powers[(r >= begin) & (r < end)].sum()
        found = echo[(message.ranges >= begin) & (message.ranges < end)].sum()
        assert decibels(found / expected) == pytest.approx(0.0, abs=TOLERANCE), begin


def test_an_imaging_sonar_hears_the_floor_up_to_the_null_of_its_beam() -> None:
    """At 3 m altitude, 17 degrees down: metre by metre as loud as the integral."""
    world = AcousticWorld(plate(200.0, 0.0), materials=[MATERIALS["gravel"]])
    pose = Pose(np.array([0.0, 0.0, 3.0]), rotation_from_rpy(0.0, 0.3, 0.0))
    spec = imaging(4, 3.0)
    heard = amplitudes(spec.bind(world, FakeCarrier(pose)).sample(0.0))  # type: ignore[arg-type]
    echo, ranges = (
        heard[:, 1].astype(np.float64) ** 2,
        Echoes(spec, world, spec.azimuths, 1.0).ranges,
    )
    middle = math.degrees(spec.azimuths[1])
    r, powers = dense_power(
        world, pose, spec, math.radians(middle), (middle - 1.3, middle + 1.3, -23.0, 23.0), n=900
    )
    for begin in (5.2, 6.2, 7.2, 9.2, 12.2, 16.2):
        expected = powers[(r >= begin) & (r < begin + 1.0)].sum()
        found = echo[(ranges >= begin) & (ranges < begin + 1.0)].sum()
        assert decibels(found / expected) == pytest.approx(0.0, abs=TOLERANCE), begin


def test_a_scanning_sonar_finds_a_small_ball_wherever_it_is() -> None:
    ball = sphere((12.0, 0.06, 0.9), 0.1, 32)
    world = AcousticWorld(ball, materials=[MATERIALS["smoothSteel"]])
    spec = ScanningSonarSpec(name="msis", relative_to="base", init_angle=0, final_angle=1, **QUIET)  # type: ignore[arg-type]
    heard = amplitudes(spec.bind(world, FakeCarrier(LEVEL)).sample(0.0)).astype(np.float64)  # type: ignore[arg-type]
    _, powers = dense_power(world, LEVEL, spec, 0.0, (-0.3, 0.9, 3.7, 4.9))
    assert decibels((heard**2).sum() / powers.sum()) == pytest.approx(0.0, abs=TOLERANCE)


@pytest.mark.parametrize("heading", [0.0, 35.0, 60.0])
def test_a_wall_at_an_angle_has_no_gaps_between_the_rays_of_a_beam(heading: float) -> None:
    """At 60 degrees neighbouring rays are 15 cm apart in range; bins are 4 cm."""
    wall = box((0.0, -40.0, -40.0), (1.0, 40.0, 40.0))
    wall = wall @ rotation_from_rpy(0.0, 0.0, math.radians(heading)).T + [12.0, 0.0, 0.0]
    world = AcousticWorld(wall, materials=[MATERIALS["cobble"]])
    spec = imaging(5, 4.0)
    sonar = spec.bind(world, FakeCarrier(LEVEL))  # type: ignore[arg-type]
    heard = amplitudes(sonar.sample(0.0))[:, 2].astype(np.float64) ** 2
    size = (spec.range - spec.min_range) / spec.bins
    r, powers = dense_power(world, LEVEL, spec, 0.0, (-1.3, 1.3, -23.0, 23.0), n=900)
    expected = np.bincount(((r - spec.min_range) / size).astype(int), powers, spec.bins)[:500]
    loud = np.flatnonzero(expected > 0.1 * expected.max())[1:-1]
    assert len(loud) > (0 if heading == 0.0 else 3)
    for bin in loud:
        assert decibels(heard[bin] / expected[bin]) == pytest.approx(0.0, abs=1.0), bin
