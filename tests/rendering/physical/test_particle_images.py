"""Particles in images through physical water: their light, their places, and clouds of sediment."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
import pytest

from tests.rendering.physical.photographs import (
    AT_ORIGIN,
    SHADOWLESS,
    FloatArray,
    camera_of,
    show_plane,
)
from uwsim.base.geometry import Intrinsics, Pose
from uwsim.optics import Medium
from uwsim.particles import PARTICLE, Kind
from uwsim.particles.puffs import compute_optical_depth
from uwsim.rendering.lights.lamp import Lamp
from uwsim.rendering.physical.physical_water import Daylight, PhysicalWater
from uwsim.rendering.physical.view import ViewContents
from uwsim.rendering.physical.visible_particles import LUMP, VisibleClouds, VisibleParticles
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Water

CLEAR = Medium(absorption=(0.1, 0.2, 0.3), scattering=(0.0, 0.0, 0.0))
NIGHT = Daylight(irradiance=0.0)
CAMERA = camera_of(400.0, 161, 121)


def make_particles(
    places: Sequence[tuple[float, float, float]],
    *,
    radius: float = 0.002,
    extent: tuple[float, float, float] = (0.0, 0.0, 0.0),
    reflectance: float = 0.2,
    clouds: VisibleClouds | None = None,
) -> VisibleParticles:
    """Return sharp particles at places in the camera's frame."""
    records = np.zeros(len(places), PARTICLE)
    records["place"] = np.array(places).reshape(-1, 3)
    records["radius"], records["extent"], records["weight"] = radius, extent, 1.0
    records["reflectance"], records["kind"] = reflectance, float(Kind.FLOC)
    return VisibleParticles(records, aperture=0.0, focus_distance=1.0, clouds=clouds)


def photograph(
    renderer: Renderer,
    water: PhysicalWater,
    particles: VisibleParticles | None,
    camera: Intrinsics = CAMERA,
    lamps: Sequence[Lamp] = (),
) -> FloatArray:
    """Return the radiance of each pixel in linear light, (h, w, 3)."""
    image = renderer.draw(
        AT_ORIGIN, camera, Water(physical_water=water), SHADOWLESS,
        targets={"colour"}, colour="linear16",
        contents=ViewContents(lamps=lamps, particles=particles),
    )  # fmt: skip
    assert image.colour is not None
    return image.colour[..., :3] / 65535.0 / water.exposure


def make_lamp(intensity: float = 1.0) -> Lamp:
    """Return a lamp 0.5 m to the right of the camera that shines in all directions."""
    return Lamp(
        world_from_lamp=Pose(np.array([0.5, 0.0, 0.0]), np.eye(3)),
        half_angle=math.pi,
        intensity=intensity,
        casts_shadow=False,
    )


def night_water(medium: Medium = CLEAR, exposure: float = 3.0) -> PhysicalWater:
    """Return water at night, whose images are linear and have no veil."""
    return PhysicalWater(
        medium=medium, daylight=NIGHT, transfer="linear", exposure=exposure, has_lamp_veil=False
    )


def isotropic_water(medium: Medium) -> PhysicalWater:
    """Return water in an isotropic field of the radiance 0.5."""
    return PhysicalWater(medium=medium, transfer="linear", isotropic_radiance=(0.5,) * 3)


@pytest.mark.parametrize("distance", [0.5, 1.5, 4.0])
def test_a_particle_under_a_lamp_has_the_light_of_the_formula(
    renderer: Renderer, distance: float
) -> None:
    renderer.clear()
    radius, reflectance = 0.0015, 0.2
    particles = make_particles([(0.0, 0.0, -distance)], radius=radius, reflectance=reflectance)
    exposure = 2.0 * (distance**2 + 0.25)
    light = photograph(renderer, night_water(exposure=exposure), particles, lamps=[make_lamp()])
    path = math.hypot(distance, 0.5)
    attenuation = np.array(CLEAR.absorption)
    irradiance = 1.0 / path**2 * np.exp(-attenuation * path)  # of a white surface: radiance
    solid_angle = math.pi * radius**2 / distance**2
    expected = reflectance * irradiance * np.exp(-attenuation * distance) * solid_angle
    pixel = 1.0 / CAMERA.fx**2
    np.testing.assert_allclose(light.sum(axis=(0, 1)) * pixel, expected, rtol=0.05)


def test_the_light_of_a_particle_does_not_depend_on_the_resolution(renderer: Renderer) -> None:
    renderer.clear()
    particles = make_particles([(0.02, 0.013, -2.0)])
    totals = []
    for scale in (1, 2, 4, 8):
        camera = camera_of(150.0 * scale, 80 * scale, 60 * scale)
        light = photograph(renderer, night_water(exposure=20.0), particles, camera, [make_lamp()])
        totals.append(light.sum(axis=(0, 1)) / camera.fx**2)
    np.testing.assert_allclose(totals, [totals[-1]] * 4, rtol=0.05)


def find_centroid(light: FloatArray) -> tuple[float, float]:
    """Return column and row of the centroid of an image's light [px]."""
    brightness = light.sum(axis=2)
    rows, columns = np.indices(brightness.shape)
    total = brightness.sum()
    return float((columns * brightness).sum() / total), float((rows * brightness).sum() / total)


def test_a_particle_is_where_the_pinhole_projects_it(renderer: Renderer) -> None:
    renderer.clear()
    velocity, time = np.array([0.08, -0.05, 0.1]), 0.5
    for seconds in (0.0, time):
        place = np.array([-0.1, 0.05, -1.0]) + seconds * velocity
        light = photograph(
            renderer, night_water(), make_particles([tuple(place)]), lamps=[make_lamp()]
        )
        np.testing.assert_allclose(
            find_centroid(light), CAMERA.project(place[None])[0, :2], atol=0.1
        )


def test_a_streak_has_the_length_of_the_motion_and_the_same_light(renderer: Renderer) -> None:
    renderer.clear()
    sharp = photograph(
        renderer, night_water(), make_particles([(0.0, 0.0, -1.0)]), lamps=[make_lamp()]
    )
    streak = photograph(
        renderer, night_water(),
        make_particles([(0.0, 0.0, -1.0)], extent=(0.05, 0.0, 0.0)), lamps=[make_lamp()],
    )  # fmt: skip
    np.testing.assert_allclose(streak.sum(axis=(0, 1)), sharp.sum(axis=(0, 1)), rtol=0.04)
    columns = np.flatnonzero(streak.sum(axis=(0, 2)) > 0.0)
    rows = np.flatnonzero(streak.sum(axis=(1, 2)) > 0.0)
    assert len(columns) == pytest.approx(20 + len(rows), abs=2)  # 0.05 m * 400 px / 1 m


def test_a_nearer_surface_hides_a_particle(renderer: Renderer) -> None:
    water = night_water()
    for distance, is_visible in ((0.9, False), (1.2, True)):
        show_plane(renderer, distance, (0.2, 0.2, 0.2))
        bare = photograph(renderer, water, None)
        image = photograph(renderer, water, make_particles([(0.0, 0.0, -1.0)], reflectance=0.0))
        lit = photograph(
            renderer, water, make_particles([(0.0, 0.0, -1.0)]), lamps=[make_lamp(0.1)]
        ) - photograph(renderer, water, None, lamps=[make_lamp(0.1)])
        assert (np.abs(lit).max() > 0.0) == is_visible
        np.testing.assert_array_equal(image, bare)  # it is night


def test_a_white_particle_in_an_isotropic_field_is_invisible(renderer: Renderer) -> None:
    renderer.clear()
    medium = Medium(absorption=(0.1, 0.2, 0.3), scattering=(0.5, 0.5, 0.5))
    places = [(0.0, 0.0, -0.5), (0.05, 0.0, -1.0), (-0.1, 0.05, -2.0)]
    particles = make_particles(places, radius=0.01, reflectance=0.25)
    light = photograph(renderer, isotropic_water(medium), particles)
    np.testing.assert_allclose(light, 0.5, rtol=2e-3)


def test_a_black_particle_dims_the_water_behind_it(renderer: Renderer) -> None:
    renderer.clear()
    medium = Medium(absorption=(0.1, 0.2, 0.3), scattering=(0.5, 0.5, 0.5))
    radius, distance = 0.002, 1.0
    particles = make_particles([(0.0, 0.0, -distance)], radius=radius, reflectance=0.0)
    bare = photograph(renderer, isotropic_water(medium), None)
    light = photograph(renderer, isotropic_water(medium), particles)
    lost_light = (bare - light).sum(axis=(0, 1)) / CAMERA.fx**2
    direct = np.exp(-(np.array(medium.absorption) + 0.5) * distance)
    np.testing.assert_allclose(
        lost_light, 0.5 * direct * math.pi * radius**2 / distance**2, rtol=0.06
    )


def make_snow(
    concentration: float, radii: tuple[float, float], reflectance: float
) -> VisibleParticles:
    """Return flocs of a concentration [1/m3], up to 1.2 m in the view of `CAMERA`."""
    random, reach = np.random.default_rng(3), 1.2
    width, height = reach * CAMERA.width / CAMERA.fx, reach * CAMERA.height / CAMERA.fy
    count = int(concentration * width * height * reach)
    places = (random.random((count, 3)) - (0.5, 0.5, 1.0)) * (width, height, reach)
    places = places[places[:, 2] < -0.05]
    radius = random.uniform(*radii, len(places))
    particles = make_particles([tuple(place) for place in places], reflectance=reflectance)
    particles.records["radius"] = radius
    return particles


def make_dense_snow(reflectance: float) -> VisibleParticles:
    """Return flocs with diameters of 5 to 10 mm, 1e5 per cubic metre."""
    return make_snow(1e5, (0.0025, 0.005), reflectance)


def test_thin_snow_keeps_the_light_of_its_flocs(renderer: Renderer) -> None:
    renderer.clear()
    snow = make_snow(5000.0, (0.0005, 0.001), 0.2)
    water, lamps = night_water(exposure=0.5), [make_lamp()]
    light = photograph(renderer, water, snow, lamps=lamps).sum(axis=(0, 1))
    alone = sum(
        photograph(
            renderer, water, VisibleParticles(snow.records[i::20].copy(), 0.0, 1.0), lamps=lamps
        ).sum(axis=(0, 1))
        for i in range(20)
    )
    np.testing.assert_allclose(light, alone, rtol=0.05)


@pytest.mark.parametrize("is_plane_visible", [False, True])
@pytest.mark.parametrize("reflectance", [0.0, 0.05, 0.2])
def test_dense_snow_has_no_colour_below_that_of_flocs_and_water(
    renderer: Renderer, reflectance: float, *, is_plane_visible: bool
) -> None:
    medium = Medium(absorption=(0.4, 0.1, 0.03), scattering=(0.3, 0.3, 0.3))
    water = PhysicalWater(medium=medium, transfer="linear", isotropic_radiance=(0.1, 0.4, 0.6))
    if is_plane_visible:  # black, so that it takes light from the water around its image, too
        show_plane(renderer, 1.5, (0.0, 0.0, 0.0))
    else:
        renderer.clear()
    bare = photograph(renderer, water, None)
    light = photograph(renderer, water, make_dense_snow(reflectance))
    least = np.minimum(bare, 4.0 * reflectance * np.array(water.isotropic_radiance))
    assert (light >= least - 2e-3).all()
    assert (light <= bare.max(axis=(0, 1)) + 2e-3).all() or is_plane_visible
    if reflectance < 0.1:
        assert light.mean() < 0.8 * bare.mean() or is_plane_visible  # the snow is dense


def test_dense_white_snow_in_an_isotropic_field_is_invisible(renderer: Renderer) -> None:
    renderer.clear()
    medium = Medium(absorption=(0.1, 0.2, 0.3), scattering=(0.5, 0.5, 0.5))
    light = photograph(renderer, isotropic_water(medium), make_dense_snow(0.25))
    np.testing.assert_allclose(light, 0.5, rtol=2e-3)


@pytest.mark.parametrize("near_first", [False, True])
def test_a_near_particle_hides_a_far_one_in_any_order(
    renderer: Renderer, *, near_first: bool
) -> None:
    renderer.clear()
    places = [(0.0, 0.0, -1.0), (0.0, 0.0, -2.0)]
    particles = make_particles(places, radius=0.05)
    particles.records["reflectance"] = 0.0, 0.2
    if not near_first:
        particles = VisibleParticles(particles.records[::-1].copy(), 0.0, 1.0)
    light = photograph(renderer, night_water(), particles, lamps=[make_lamp()])
    far = make_particles(places[1:], radius=0.05)
    alone = photograph(renderer, night_water(), far, lamps=[make_lamp()])
    row, column = round(CAMERA.cy), round(CAMERA.cx)
    assert alone[row, column].min() > 1e-3
    assert light[row, column].max() < 0.02 * alone[row, column].min()


def make_cloud(centre: tuple[float, float, float], width: float, depth: float) -> VisibleClouds:
    """Return a cloud of one lump with an optical depth through its centre."""
    lumps = np.zeros(1, LUMP)
    lumps["place"][0] = *centre, width
    lumps["depth"][0] = depth
    return VisibleClouds(lumps, (1.0, 1.0, 1.0))


def test_a_white_cloud_in_an_isotropic_field_is_invisible(renderer: Renderer) -> None:
    renderer.clear()
    medium = Medium(absorption=(0.1, 0.2, 0.3), scattering=(0.5, 0.5, 0.5))
    cloud = make_cloud((0.0, 0.0, -2.0), 0.4, 3.0)
    light = photograph(renderer, isotropic_water(medium), make_particles([], clouds=cloud))
    np.testing.assert_allclose(light, 0.5, rtol=2e-3)


@pytest.mark.parametrize("plane_distance", [1.6, 2.0, 2.4, 5.0])
def test_a_surface_behind_a_cloud_is_dimmed_by_its_optical_depth(
    renderer: Renderer, plane_distance: float
) -> None:
    width, depth = 0.4, 1.5
    show_plane(renderer, plane_distance, (1.0, 1.0, 1.0))
    water = PhysicalWater(
        medium=Medium(absorption=(0.01,) * 3, scattering=(0.0,) * 3),
        transfer="linear",
        isotropic_radiance=(0.5,) * 3,
    )
    camera = camera_of(400.0, 320, 240)
    cloud = make_cloud((0.0, 0.0, -2.0), width, depth)
    lumps = VisibleClouds(cloud.lumps, (0.0, 0.0, 0.0))
    bare = photograph(renderer, water, None, camera)
    light = photograph(renderer, water, make_particles([], clouds=lumps), camera)
    mass = 2.0 * math.pi * width**2 * depth  # with the scattering 1 m2/kg
    for column, row in ((160, 120), (200, 120), (160, 60)):
        ray = np.array([(column - camera.cx) / camera.fx, -(row - camera.cy) / camera.fy, -1.0])
        length = float(np.sqrt((ray * ray).sum()))
        optical_depth = compute_optical_depth(
            np.array([0.0, 0.0, -2.0]), width, mass, 1.0, ray / length, plane_distance * length
        )
        # four layers between the ends of the cloud are interpolated
        shares = light[row, column] / bare[row, column]
        np.testing.assert_allclose(shares, math.exp(-optical_depth), atol=0.09)


def test_without_particles_the_bytes_are_the_same(renderer: Renderer) -> None:
    show_plane(renderer, 2.0, (0.5, 0.5, 0.5))
    water = PhysicalWater(medium=Medium(absorption=(0.1,) * 3, scattering=(0.3,) * 3))

    def draw(particles: VisibleParticles | None) -> npt.NDArray[np.uint8]:
        image = renderer.draw(
            AT_ORIGIN,
            CAMERA,
            Water(physical_water=water),
            SHADOWLESS,
            contents=ViewContents(particles=particles),
        )
        assert image.colour is not None
        return image.colour

    np.testing.assert_array_equal(draw(None), draw(make_particles([])))


def test_range_and_ids_do_not_show_particles(renderer: Renderer) -> None:
    show_plane(renderer, 2.0, (0.5, 0.5, 0.5))
    water = Water(physical_water=night_water())
    particles = make_particles([(0.0, 0.0, -1.0)], radius=0.05)
    image = renderer.draw(
        AT_ORIGIN, CAMERA, water, SHADOWLESS, contents=ViewContents(particles=particles)
    )
    assert image.range is not None
    assert image.ids is not None
    assert image.range[60, 80] == pytest.approx(2.0, rel=1e-4)
    assert set(np.unique(image.ids).tolist()) == {1}
