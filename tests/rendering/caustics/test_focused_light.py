"""Caustics and light shafts in images: mean light, contrast, long waves, switches."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import numpy.typing as npt
import pytest

from tests.rendering.models import placed, plate
from uwsim.base.geometry import Intrinsics, Pose, image_centre
from uwsim.optics import HenyeyGreenstein, Medium, find_water
from uwsim.rendering.caustics import light_shafts
from uwsim.rendering.caustics.caustic_light import find_contrast_loss
from uwsim.rendering.caustics.focused_light import FocusedLight
from uwsim.rendering.caustics.refraction import make_beam
from uwsim.rendering.caustics.ripples import Ripples
from uwsim.rendering.caustics.swell import SPACING, compute_swell
from uwsim.rendering.caustics.wave_tile import TILE_EDGE
from uwsim.rendering.physical.daylight_field import compute_light_field
from uwsim.rendering.physical.moving_surface import MovingSurface
from uwsim.rendering.physical.physical_water import Daylight, PhysicalWater
from uwsim.rendering.physical.view import ViewContents
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water
from uwsim.waves import WaveComponents, Waves

FloatArray = npt.NDArray[np.float64]
HEIGHT = 2.0
"""The height of the camera above the floor [m]."""
LEVEL = MovingSurface(time=1.0)
SWELL_LENGTH = 16.0


def physical_water(scattering: float = 0.0, **settings: object) -> PhysicalWater:
    """Return clear water with a linear camera, without blur."""
    medium = Medium(
        absorption=(0.05,) * 3, scattering=(scattering,) * 3, phase_function=HenyeyGreenstein(0.9)
    )
    water = PhysicalWater(
        medium=medium, transfer="linear", has_blur=False, exposure=0.2, ripples=Ripples()
    )
    return replace(water, **settings)  # type: ignore[arg-type]


def show_floor(renderer: Renderer, depth: float) -> None:
    """Show nothing but a level floor."""
    renderer.clear()
    renderer.place(renderer.add(plate(100.0, 100.0, (1.0, 1.0, 1.0)), 1), placed(z=-depth))


def photograph_tile(
    renderer: Renderer,
    water: PhysicalWater,
    depth: float,
    surface: MovingSurface | None = LEVEL,
    edge: float = TILE_EDGE,
) -> FloatArray:
    """Return the light of a square of the floor, (256, 256, 3)."""
    cx, cy = image_centre(256, 256)
    focal = 256.0 * HEIGHT / edge
    camera = Intrinsics(
        width=256, height=256, fx=focal, fy=focal, cx=cx, cy=cy, near=0.05, far=100.0
    )
    return draw(
        renderer, Pose(np.array([0.0, 0.0, HEIGHT - depth]), np.eye(3)), camera, water, surface
    )


def draw(
    renderer: Renderer,
    pose: Pose,
    camera: Intrinsics,
    water: PhysicalWater,
    surface: MovingSurface | None,
) -> FloatArray:
    """Return the linear light of an image without shadows."""
    image = renderer.draw(
        pose, camera, Water(physical_water=water), Light(shadows=False),
        targets={"colour"}, colour="linear16", contents=ViewContents(surface=surface),
    )  # fmt: skip
    assert image.colour is not None
    return image.colour[..., :3] / 65535.0 / water.exposure


@pytest.mark.parametrize("depth", [0.5, 3.0, 9.0])
def test_caustics_keep_the_mean_light_of_a_floor(renderer: Renderer, depth: float) -> None:
    show_floor(renderer, depth)
    water = physical_water(has_light_shafts=False, exposure=0.02)
    # divide out the loss between floor and camera, which differs from pixel to pixel
    level = photograph_tile(renderer, water, depth, None)
    gain = photograph_tile(renderer, water, depth) / level
    assert gain.std() > 0.05
    assert gain.max() * level.max() * water.exposure < 1.0
    assert gain.mean() == pytest.approx(1.0, abs=1e-3)


def test_scattering_takes_contrast_from_caustics(renderer: Renderer) -> None:
    depth = 4.0
    show_floor(renderer, depth)

    def contrast(scattering: float) -> float:
        """Return the contrast of the pattern in the sun's beam."""
        water = physical_water(scattering, has_light_shafts=False)
        field = compute_light_field(water.medium, water.daylight)
        beam, diffuse = field.compute_irradiance(depth)
        gain = photograph_tile(renderer, water, depth) / photograph_tile(
            renderer, water, depth, None
        )
        return float(gain.std() * (beam + diffuse)[0] / beam[0])

    water = physical_water(0.1)
    cosine = float(compute_light_field(water.medium, water.daylight).towards_sun[2])
    loss = find_contrast_loss(water.medium, cosine)[0]
    assert loss > 0.0
    # the veil between floor and camera takes part of it, too; both are small against the loss
    assert contrast(0.1) / contrast(0.0) == pytest.approx(math.exp(-loss * depth), rel=0.05)


@pytest.mark.parametrize("pitch", [0.0, 0.6, 1.2])
def test_light_shafts_keep_the_mean_of_open_water(renderer: Renderer, pitch: float) -> None:
    renderer.clear()
    cosine, sine = math.cos(pitch), math.sin(pitch)
    rotation = np.array([[1, 0, 0], [0, -sine, -cosine], [0, cosine, -sine]])
    places = [np.array([2.0 * (i % 4), 2.0 * (i // 4), -6.0]) for i in range(16)]
    camera = Intrinsics.from_fovy(160, 120, 1.2)
    medium = find_water("jerlov-II")
    water = physical_water(medium=medium, daylight=Daylight(elevation=1.0, azimuth=1.5))
    level = draw(renderer, Pose(places[0], rotation), camera, water, None)
    images = [
        draw(renderer, Pose(place, rotation), camera, water, MovingSurface(time=3.0 * i))
        for i, place in enumerate(places)
    ]
    assert np.mean(images) == pytest.approx(np.mean(level), rel=0.01)
    # a level ray crosses so many shafts that little of them is left
    assert np.abs(images[0] - level).max() > (0.003 if pitch == 0.0 else 0.05) * level.mean()


def test_shafts_near_the_image_of_the_sun_keep_the_mean_light(renderer: Renderer) -> None:
    renderer.clear()
    cosine, sine = math.cos(0.9), math.sin(0.9)
    rotation = np.array([[1, 0, 0], [0, -sine, -cosine], [0, cosine, -sine]])
    camera = Intrinsics.from_fovy(160, 120, 1.0)
    water = physical_water(
        medium=find_water("jerlov-II"),
        daylight=Daylight(elevation=1.0, azimuth=1.5),
        has_surface=True,
        has_blur=True,
        exposure=0.02,
    )
    still_water = replace(water, has_light_shafts=False)
    sums, largest = np.zeros(2), 0.0
    for i in range(16):
        pose = Pose(np.array([2.0 * (i % 4), 2.0 * (i // 4), -6.0]), rotation)
        surface = MovingSurface(time=3.0 * i)
        images = [draw(renderer, pose, camera, w, surface) for w in (water, still_water)]
        sums += [image.mean() for image in images]
        largest = max(largest, float(np.abs(images[0] - images[1]).max()))
        assert images[0][..., 1:].min() > 0.1 * images[1][..., 1:].min()
    assert sums[0] == pytest.approx(sums[1], rel=0.01)
    assert largest > 0.2 * sums[1] / 16.0


@pytest.mark.parametrize("pitch", [0.35, 0.75])
def test_shafts_have_the_contrast_of_a_fine_integral(
    renderer: Renderer, monkeypatch: pytest.MonkeyPatch, pitch: float
) -> None:
    """Compare with 400 steps of the full length, towards the sun from 4 m deep."""
    renderer.clear()
    cosine, sine = math.cos(pitch), math.sin(pitch)
    rotation = np.array([[0, -sine, -cosine], [-1, 0, 0], [0, cosine, -sine]])
    pose, camera = Pose(np.array([0.3, 0.2, -4.0]), rotation), Intrinsics.from_fovy(320, 240, 1.05)
    medium = find_water("jerlov-II")
    daylight = Daylight(elevation=1.0, azimuth=0.0)
    water = physical_water(medium=medium, daylight=daylight, ripples=Ripples(wind_speed=1.0))
    level = draw(renderer, pose, camera, water, None)
    shafts: list[FloatArray] = []
    fine_switches: dict[str, int] = {"N_STEPS": 400, "MAP_PERCENT": 100}
    for switches in ({}, fine_switches):
        for name, value in switches.items():
            monkeypatch.setitem(light_shafts.SWITCHES, name, value)
        renderer._focused_light._shafts = None
        image = draw(renderer, pose, camera, water, MovingSurface(time=2.0, seed=3))
        shafts.append((image / level)[..., 1])
    renderer._focused_light._shafts = None
    assert shafts[0].std() == pytest.approx(shafts[1].std(), rel=0.15)
    assert shafts[1].std() > 0.03
    assert not np.array_equal(shafts[0], shafts[1])
    assert np.corrcoef(shafts[0].ravel(), shafts[1].ravel())[0, 1] > 0.7


def make_swell(amplitude: float) -> Waves:
    """Return a regular wave of 16 m along x, with its crest at the origin at time 0."""
    frequency = math.sqrt(9.80665 * 2.0 * math.pi / SWELL_LENGTH)
    components = WaveComponents(
        amplitude=np.array([amplitude]),
        angular_frequency=np.array([frequency]),
        direction=np.zeros(1),
        phase=np.zeros(1),
    )
    return Waves(components, 1000.0, Pose.identity(), 0.0, np.ones(1))


def test_the_grid_of_long_waves_has_their_slopes() -> None:
    waves = make_swell(0.3)
    beam = make_beam(Daylight(elevation=0.5 * math.pi))
    corner, time = (-12.0, 3.0), 2.5
    swell = compute_swell(waves, beam.slope_matrix, corner, time, 2.0)
    points = np.array([[corner[0] + SPACING * i, corner[1], 0.0] for i in range(40)])
    slopes = 2.0 * waves.motion(points, time).slope
    expected = slopes[:, 0] * beam.slope_matrix[0, 0]
    np.testing.assert_allclose(swell[0, :, 0], expected, atol=1e-5)
    centre = np.gradient(expected, SPACING)[1:-1]
    np.testing.assert_allclose(swell[5, 1:-1, 2], centre, atol=0.02 * np.abs(centre).max())


def test_a_swell_focuses_light_below_its_crest(renderer: Renderer) -> None:
    """Compare with 1 / (1 - d/f cos(k x)), to the first order in d/f."""
    depth, amplitude = 6.0, 0.6
    show_floor(renderer, depth)
    waves = make_swell(amplitude)
    water = physical_water(
        has_light_shafts=False,
        daylight=Daylight(elevation=0.5 * math.pi, sky_share=0.0),
        ripples=Ripples(wind_speed=0.0),
    )
    level = photograph_tile(renderer, water, depth, None, 16.0)
    surface = MovingSurface(time=0.0, waves=waves)
    gain = (photograph_tile(renderer, water, depth, surface, 16.0) / level)[..., 0].mean(axis=0)
    k = 2.0 * math.pi / SWELL_LENGTH
    share = depth * make_beam(water.daylight).slope_matrix[0, 0] * amplitude * k * k
    x = (np.arange(256) + 0.5) / 16.0 - 8.0
    expected = 1.0 / (1.0 - share * np.cos(k * x))
    assert 0.1 < share < 0.2
    smooth = np.convolve(gain, np.full(32, 1.0 / 32.0), mode="valid")
    assert (
        np.abs(smooth - np.convolve(expected, np.full(32, 1.0 / 32.0), mode="valid")).max() < 0.06
    )
    assert gain.mean() == pytest.approx(1.0, abs=0.01)


def test_images_without_focused_light_are_those_of_a_level_surface(renderer: Renderer) -> None:
    show_floor(renderer, 3.0)
    water = physical_water()
    level = photograph_tile(renderer, water, 3.0, None)
    assert not np.array_equal(photograph_tile(renderer, water, 3.0), level)
    for dark in (
        {"has_caustics": False, "has_light_shafts": False},
        {"ripples": None},
        {"daylight": Daylight(sky_share=1.0)},
    ):
        still_water = replace(water, **dark)  # type: ignore[arg-type]
        with_surface = photograph_tile(renderer, still_water, 3.0)
        assert np.array_equal(with_surface, photograph_tile(renderer, still_water, 3.0, None))


def test_images_are_the_same_bytes_twice() -> None:
    images = []
    for _ in range(2):
        renderer = Renderer()
        show_floor(renderer, 3.0)
        surface = MovingSurface(time=0.5, waves=make_swell(0.1), seed=4)
        images.append(photograph_tile(renderer, physical_water(0.1), 3.0, surface).tobytes())
        renderer.close()
    assert images[0] == images[1]


def test_a_shadow_of_the_sun_has_no_caustics(renderer: Renderer) -> None:
    depth = 3.0
    show_floor(renderer, depth)
    renderer.place(renderer.add(plate(3.0, 3.0, (1.0, 1.0, 1.0)), 2), placed(z=-1.5))
    water = Water(
        physical_water=physical_water(
            has_light_shafts=False, daylight=Daylight(elevation=0.5 * math.pi)
        )
    )
    pose, camera = Pose(np.array([0.0, 0.0, -2.0]), np.eye(3)), Intrinsics.from_fovy(64, 64, 1.0)
    shadowed, sunlit = (
        [
            renderer.draw(
                pose, camera, water, Light(shadows=has_shadows),
                targets={"colour"}, colour="linear16", contents=ViewContents(surface=surface),
            ).colour
            for surface in (LEVEL, None)
        ]
        for has_shadows in (True, False)
    )  # fmt: skip
    assert np.array_equal(shadowed[0], shadowed[1])
    assert not np.array_equal(sunlit[0], sunlit[1])


def test_no_map_is_computed_without_caustics_and_light_shafts(renderer: Renderer) -> None:
    light = FocusedLight(renderer._context)
    water = physical_water(has_caustics=False, has_light_shafts=False)
    assert light.prepare(water, LEVEL, Pose.identity(), 0.0) == ()
    assert light._caustics is None
