"""Surfaces with maps and a finish, through the renderer."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.rendering.materials.brdf import FloatArray, reflected_share
from tests.rendering.models import block, placed, plate
from tests.rendering.physical.photographs import AT_ORIGIN, SHADOWLESS, camera_of, photograph
from uwsim.assets.images import PixelImage
from uwsim.assets.mesh import Material, Model, Texture
from uwsim.base.geometry import Pose, rotation_from_xyz
from uwsim.optics import HenyeyGreenstein, Medium
from uwsim.rendering.lights.lamp import Lamp
from uwsim.rendering.physical.physical_water import Daylight, PhysicalWater
from uwsim.rendering.physical.view import ViewContents
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.water import Light, Water

CAMERA = camera_of(120.0, 81, 61)
CLEAR = Medium(absorption=(1e-6,) * 3, scattering=(1e-6,) * 3, phase_function=HenyeyGreenstein(0.9))
NIGHT = Daylight(irradiance=0.0)
DISTANCE = 2.0
"""The distance between camera and plate [m]."""
LAMP_PLACE = np.array([0.7, 0.3, 0.0])
"""The position of the lamp in the camera's frame [m]."""
LAMP = Lamp(
    world_from_lamp=Pose(LAMP_PLACE, np.eye(3)), half_angle=1.2, softness=0.0, intensity=0.5,
    casts_shadow=False,
)  # fmt: skip


def clear_water(daylight: Daylight = NIGHT, exposure: float = 1.0) -> PhysicalWater:
    """Return water without an effect on images, in which surfaces show their own radiance."""
    return PhysicalWater(
        medium=CLEAR, daylight=daylight, transfer="linear", has_blur=False, has_lamp_veil=False,
        exposure=exposure,
    )  # fmt: skip


def one_colour(name: str, red: float, green: float, blue: float, alpha: float = 1.0) -> Texture:
    """Return a texture of 4 x 4 equal texels, with alpha if it is below 1."""
    values = [red, green, blue] if alpha == 1.0 else [red, green, blue, alpha]
    pixels = np.tile(np.rint(np.array(values) * 255.0).astype(np.uint8), (4, 4, 1))
    return Texture(name=name, image=PixelImage(pixels))


def normal_texture(normal: FloatArray) -> Texture:
    """Return a normal map of one normal."""
    red, green, blue = (0.5 * normal / np.linalg.norm(normal) + 0.5).tolist()
    return one_colour("normal", red, green, blue)


def with_material(model: Model, material: Material | None, **changes: object) -> Model:
    """Return a model whose meshes have a material."""
    meshes = tuple(replace(mesh, material=material, **changes) for mesh in model.meshes)  # type: ignore[arg-type]
    return replace(model, meshes=meshes)


def show(renderer: Renderer, model: Model, rotation: FloatArray | None = None) -> None:
    """Show nothing but a model in front of the camera."""
    renderer.clear()
    matrix = placed(z=-DISTANCE)
    matrix[:3, :3] = np.eye(3) if rotation is None else rotation
    renderer.place(renderer.add(model, 1), matrix)


def rays() -> FloatArray:
    """Return the positions on the plate that pixels show, (h, w, 3) [m]."""
    columns, rows = np.meshgrid(np.arange(81), np.arange(61))
    x = (columns - CAMERA.cx) / CAMERA.fx
    y = -(rows - CAMERA.cy) / CAMERA.fy
    return DISTANCE * np.stack([x, y, -np.ones_like(x)], axis=-1)


def unit(vectors: FloatArray) -> FloatArray:
    """Return vectors with unit length."""
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


TILT = np.array([0.35, -0.2, 1.0])


@pytest.mark.parametrize("is_physical", [False, True])
def test_a_tilted_normal_map_looks_like_a_tilted_plane(
    renderer: Renderer, is_physical: bool
) -> None:
    daylight = Daylight(elevation=0.9, azimuth=2.6, sky_share=0.3)
    physical_water = clear_water(daylight) if is_physical else None
    water = Water(fog=0.02, physical_water=physical_water)

    def draw(model: Model) -> FloatArray:
        show(renderer, model)
        image = renderer.draw(
            AT_ORIGIN,
            CAMERA,
            water,
            SHADOWLESS,
            targets={"colour"},
            contents=ViewContents(lamps=(LAMP,)),
        )
        assert image.colour is not None
        return image.colour.astype(np.float64)

    grey = (0.6, 0.5, 0.4)
    finish = Material(roughness=0.6)
    geometric = with_material(
        plate(9.0, 9.0, grey), finish, normals=np.tile(unit(TILT).astype(np.float32), (4, 1))
    )
    mapped = with_material(plate(9.0, 9.0, grey), replace(finish, normal_map=normal_texture(TILT)))
    flat = with_material(plate(9.0, 9.0, grey), finish)
    assert np.abs(draw(mapped) - draw(geometric)).max() <= 1.0
    assert np.abs(draw(mapped) - draw(flat)).mean() > 4.0


def test_the_middle_of_a_tilted_plate_has_the_light_of_a_tilted_normal_map(
    renderer: Renderer,
) -> None:
    angle = 0.3
    water = clear_water(Daylight(elevation=0.9, azimuth=0.4))
    tilt = np.array([math.sin(angle), 0.0, math.cos(angle)])
    material = Material(normal_map=normal_texture(tilt))
    show(renderer, with_material(plate(4.0, 4.0), material))
    mapped = photograph(renderer, water, CAMERA)[30, 40]
    show(renderer, with_material(plate(4.0, 4.0), Material()), rotation_from_xyz(0.0, angle, 0.0))
    turned = photograph(renderer, water, CAMERA)[30, 40]
    np.testing.assert_allclose(mapped, turned, atol=1.0 / 255.0)


@pytest.mark.parametrize("is_mirrored", [False, True])
def test_the_red_of_a_normal_map_points_towards_greater_u(
    renderer: Renderer, is_mirrored: bool
) -> None:
    material = Material(normal_map=normal_texture(np.array([0.5, 0.0, 1.0])))
    uvs = plate(1.0, 1.0).meshes[0].uvs.copy()
    uvs[:, 0] = 1.0 - uvs[:, 0] if is_mirrored else uvs[:, 0]
    show(renderer, with_material(plate(9.0, 9.0), material, uvs=uvs))
    right = replace(LAMP, world_from_lamp=Pose(np.array([1.5, 0.0, 0.0]), np.eye(3)))
    left = replace(LAMP, world_from_lamp=Pose(np.array([-1.5, 0.0, 0.0]), np.eye(3)))
    from_right, from_left = (
        photograph(renderer, clear_water(), CAMERA, (lamp,))[30, 40, 0] for lamp in (right, left)
    )
    assert (from_right > 1.5 * from_left) != is_mirrored
    assert (from_left > 1.5 * from_right) == is_mirrored


def test_the_scale_of_a_normal_map_multiplies_its_tilt(renderer: Renderer) -> None:
    images = []
    for tilt, scale in ((0.2, 2.0), (0.4, 1.0)):
        normal_map = normal_texture(np.array([tilt, 0.0, 1.0]))
        material = Material(normal_map=normal_map, normal_scale=scale)
        show(renderer, with_material(plate(9.0, 9.0), material))
        images.append(photograph(renderer, clear_water(), CAMERA, (LAMP,)))
    np.testing.assert_allclose(images[0], images[1], atol=1.0 / 255.0)


@pytest.mark.parametrize("metallic", [0.0, 1.0])
@pytest.mark.parametrize("roughness", [0.15, 0.3, 0.6, 1.0])
def test_lamplight_is_reflected_as_by_the_reference(
    renderer: Renderer, roughness: float, metallic: float
) -> None:
    stored, albedo = 188.0 / 255.0, 0.5029  # of sRGB
    show(renderer, plate(9.0, 9.0))
    white = photograph(renderer, clear_water(exposure=2.0), CAMERA, (LAMP,))
    material = Material(roughness=roughness, metallic=metallic)
    show(renderer, with_material(plate(9.0, 9.0, (stored,) * 3), material))
    exposure = 0.02 if metallic and roughness < 0.5 else 1.0
    image = photograph(renderer, clear_water(exposure=exposure), CAMERA, (LAMP,))
    points = rays()
    expected = reflected_share(
        np.broadcast_to([0.0, 0.0, 1.0], points.shape),
        unit(LAMP_PLACE - points),
        unit(-points),
        albedo=albedo,
        roughness=roughness,
        metallic=metallic,
    )
    share = (image / white)[..., 0]
    peak = np.unravel_index(expected.argmax(), expected.shape)
    if roughness < 0.5 and (metallic or roughness < 0.2):
        assert np.abs(np.subtract(np.unravel_index(share.argmax(), share.shape), peak)).max() <= 1
    is_bright = expected > 0.02 * expected.max()
    np.testing.assert_allclose(share[is_bright], expected[is_bright], rtol=0.03)
    assert (share > 0.5 * share.max()).sum() == pytest.approx(
        (expected > 0.5 * expected.max()).sum(), rel=0.02, abs=3
    )


def test_the_sun_is_reflected_as_by_the_reference(renderer: Renderer) -> None:
    daylight = Daylight(elevation=0.5 * math.pi, sky_share=0.0)
    water = clear_water(daylight, exposure=0.01)
    material = Material(roughness=0.4, metallic=1.0)
    show(renderer, with_material(plate(9.0, 9.0), material))
    image = photograph(renderer, water, CAMERA)[..., 0]
    show(renderer, plate(9.0, 9.0))
    white = photograph(renderer, clear_water(daylight), CAMERA)[..., 0]
    points = rays()
    up = np.broadcast_to([0.0, 0.0, 1.0], points.shape)
    expected = reflected_share(up, up, unit(-points), albedo=1.0, roughness=0.4, metallic=1.0)
    np.testing.assert_allclose(image / white, expected, rtol=0.03, atol=0.02)


@pytest.mark.parametrize("metallic", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("roughness", [0.0, 0.2, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("tilt", [0.0, 0.9, 1.4])
def test_a_white_surface_reflects_what_it_receives_in_even_light(
    renderer: Renderer, roughness: float, metallic: float, tilt: float
) -> None:
    water = replace(clear_water(), isotropic_radiance=(0.5, 0.5, 0.5))
    material = Material(roughness=roughness, metallic=metallic)
    show(
        renderer,
        with_material(plate(40.0, 40.0, two_sided=True), material),
        rotation_from_xyz(tilt, 0.0, 0.0),
    )
    image = photograph(renderer, water, CAMERA)
    np.testing.assert_allclose(image, 0.5, rtol=0.004)


def test_occlusion_darkens_daylight_and_not_lamplight(renderer: Renderer) -> None:
    daylight = Daylight(sky_share=1.0)
    finish_map = one_colour("finish", 0.4, 1.0, 0.0)
    images = {}
    for name, texture in (("plain", None), ("occluded", finish_map)):
        show(renderer, with_material(plate(9.0, 9.0), Material(finish_map=texture)))
        images[name] = (
            photograph(renderer, clear_water(daylight), CAMERA),
            photograph(renderer, clear_water(), CAMERA, (LAMP,)),
        )
    np.testing.assert_allclose(images["occluded"][0], 0.4 * images["plain"][0], rtol=0.01)
    np.testing.assert_allclose(images["occluded"][1], images["plain"][1], atol=1e-4)


def test_the_finish_map_multiplies_roughness_and_metal(renderer: Renderer) -> None:
    grey = (0.7, 0.6, 0.5)
    mapped = Material(metallic=1.0, finish_map=one_colour("finish", 1.0, 0.4, 0.6))
    show(renderer, with_material(plate(9.0, 9.0, grey), mapped))
    water = clear_water(Daylight(elevation=1.2), exposure=0.2)
    image = photograph(renderer, water, CAMERA, (LAMP,))
    show(renderer, with_material(plate(9.0, 9.0, grey), Material(roughness=0.4, metallic=0.6)))
    expected = photograph(renderer, water, CAMERA, (LAMP,))
    np.testing.assert_allclose(image, expected, rtol=1e-3, atol=1e-3)


def test_emission_is_seen_at_night(renderer: Renderer) -> None:
    material = Material(emission=(0.5, 0.25, 0.0), emission_map=one_colour("glow", 1.0, 1.0, 1.0))
    show(renderer, with_material(plate(9.0, 9.0, (0.0, 0.0, 0.0)), material))
    image = photograph(renderer, clear_water(), CAMERA)
    np.testing.assert_allclose(image[30, 40], [0.5, 0.25, 0.0], atol=0.002)


@pytest.mark.parametrize("targets", [{"ids"}, {"colour", "range", "ids"}])
def test_holes_show_what_is_behind_them(renderer: Renderer, targets: set[str]) -> None:
    pixels = np.full((8, 8, 4), 255, np.uint8)
    pixels[:, :4, 3] = 0  # the left half
    texture = Texture(name="net", image=PixelImage(pixels))
    net = with_material(plate(9.0, 9.0, texture=texture), Material(alpha_cutoff=0.5))
    show(renderer, net)
    renderer.place(renderer.add(block((0.5, 0.5, 0.5)), 2), placed(x=-0.5, z=-DISTANCE - 1.0))
    renderer.place(renderer.add(block((0.5, 0.5, 0.5)), 3), placed(x=0.5, z=-DISTANCE - 1.0))
    image = renderer.draw(AT_ORIGIN, CAMERA, Water(), Light(), targets=targets)
    assert image.ids is not None
    assert set(np.unique(image.ids)) == {0, 1, 2}
    if image.range is not None:
        assert image.range[image.ids == 2].min() > DISTANCE + 0.5


def test_a_finish_without_maps_changes_no_byte_of_uwsims_images(renderer: Renderer) -> None:
    texture = one_colour("base", 0.5, 0.4, 0.3)
    images = []
    for material in (None, Material(roughness=0.2, metallic=1.0, emission=(1.0, 1.0, 1.0))):
        show(renderer, with_material(plate(9.0, 9.0, texture=texture), material))
        image = renderer.draw(
            AT_ORIGIN, CAMERA, Water(), Light(), contents=ViewContents(lamps=(LAMP,))
        )
        assert image.colour is not None
        images.append(image.colour.tobytes())
    assert images[0] == images[1]


def test_equal_views_of_maps_give_equal_bytes(renderer: Renderer) -> None:
    material = Material(
        roughness=0.4, normal_map=normal_texture(TILT), finish_map=one_colour("f", 0.9, 0.5, 0.2)
    )
    model = with_material(plate(9.0, 9.0), material)
    images = []
    for _ in range(2):
        show(renderer, model)
        images.append(photograph(renderer, clear_water(Daylight()), CAMERA, (LAMP,)).tobytes())
    assert images[0] == images[1]
