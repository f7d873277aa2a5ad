"""The light of images, and exposures of a moving camera, through the renderer."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.rendering.physical.photographs import AT_ORIGIN, SHADOWLESS, camera_of, show_stripes
from uwsim.base.geometry import Array, Intrinsics, Pose
from uwsim.cameras import CameraResponse, Shutter
from uwsim.cameras.exposure import Displacement, Exposure, take_image
from uwsim.optics import Medium
from uwsim.rendering.physical.physical_water import PhysicalWater
from uwsim.rendering.renderer import Renderer
from uwsim.rendering.smoothing import find_means
from uwsim.rendering.water import Light, Water

VACUUM = Medium.from_beam_attenuation((1e-9,) * 3, (0.0,) * 3)
WATER = Water(
    physical_water=PhysicalWater(
        medium=VACUUM, isotropic_radiance=(1.0,) * 3, transfer="linear", has_blur=False
    )
)
CAMERA = camera_of(300.0, 161, 81)
DISTANCE = 2.0


def test_light_is_the_stored_value_before_exposure_and_curve(renderer: Renderer) -> None:
    show_stripes(renderer, DISTANCE, (-0.2, 0.3))
    medium = Medium.from_beam_attenuation((0.5, 0.3, 0.2), (0.3, 0.2, 0.1))
    water = PhysicalWater(
        medium=medium, isotropic_radiance=(0.4,) * 3, transfer="linear", exposure=1.7
    )
    images = [
        renderer.draw(
            AT_ORIGIN, CAMERA, Water(physical_water=water), SHADOWLESS,
            targets={"colour"}, colour=colour,
        ).colour
        for colour in ("linear16", "light")
    ]  # fmt: skip
    stored, light = images
    assert stored is not None
    assert light is not None
    assert light.dtype == np.float32
    np.testing.assert_allclose(light[..., :3] * 1.7, stored[..., :3] / 65535.0, atol=1e-5)


def test_the_fog_law_has_no_light(renderer: Renderer) -> None:
    with pytest.raises(ValueError, match="physical water"):
        renderer.draw(AT_ORIGIN, CAMERA, Water(), Light(), targets={"colour"}, colour="light")


def expose(renderer: Renderer, shutter: Shutter, velocity: Array, rate: Array) -> np.ndarray:
    """Return the light of an image of a moving camera, relative to white, (h, w)."""

    def draw_light(pose: Pose, displacement: Displacement | None) -> np.ndarray:
        """Draw with 4 x 4 samples a pixel, so that edges are not at whole pixels."""
        fine_camera = CAMERA.with_size(4 * CAMERA.width, 4 * CAMERA.height)
        image = renderer.draw(
            pose, fine_camera, WATER, SHADOWLESS, targets={"colour"}, colour="light"
        )
        assert image.colour is not None
        return find_means(image.colour.view(np.float32), 4)

    def draw_depth(pose: Pose, camera: Intrinsics) -> Array:
        image = renderer.draw(pose, camera, WATER, SHADOWLESS, targets={"range"})
        return image.depth.astype(float)

    response = CameraResponse(
        has_noise=False, output="linear12", black_level=0.0, exposure_time=shutter.exposure_time
    )
    exposure = Exposure(
        world_from_camera=AT_ORIGIN, intrinsics=CAMERA, response=response, shutter=shutter,
        vignetting=(0.0, 0.0, 0.0), velocity=velocity, angular_velocity=rate, vehicle="v",
        key=1, is_grey=True, is_polished=False,
    )  # fmt: skip
    return take_image(exposure, draw_light, draw_depth, 0.5) / (0.5 * 4095.0)


def edge_profile(row: np.ndarray) -> tuple[float, float]:
    """Return the place of an edge and its width, of a uniform blur, from its first moments [px]."""
    weights = np.diff(row)
    weights = weights / weights.sum()
    places = np.arange(len(weights)) + 0.5
    mean = float((weights * places).sum())
    variance = float((weights * (places - mean) ** 2).sum())
    return mean, math.sqrt(12.0 * variance)


@pytest.mark.parametrize("speed", [0.7, 1.3])
def test_the_blur_of_an_edge_is_the_path_of_the_camera(renderer: Renderer, speed: float) -> None:
    """The width is v t f / d, of a global shutter; the edge is at its place at mid-exposure."""
    show_stripes(renderer, DISTANCE, (0.001, 10.0))
    shutter, zero = Shutter(exposure_time=0.1), np.zeros(3)
    image = expose(renderer, shutter, np.array([speed, 0.0, 0.0]), zero)
    at_rest = expose(renderer, shutter, zero, zero)
    place, width = edge_profile(image[40])
    assert width == pytest.approx(speed * 0.1 * 300.0 / DISTANCE, rel=0.06)
    assert place == pytest.approx(edge_profile(at_rest[40])[0], abs=0.15)


def test_a_rolling_shutter_shears_an_upright_edge(renderer: Renderer) -> None:
    """Each row is later by the row time, so an edge moves by v f / d of it."""
    show_stripes(renderer, DISTANCE, (0.001, 10.0))
    shutter = Shutter(mode="rolling", row_time=5e-4, exposure_time=0.005)
    image = expose(renderer, shutter, np.array([2.0, 0.0, 0.0]), np.zeros(3))
    places = np.array([edge_profile(row)[0] for row in image])
    slope = np.polyfit(np.arange(81), places, 1)[0]
    assert slope == pytest.approx(-2.0 * 300.0 / DISTANCE * 5e-4, rel=0.02)
    assert places[40] == pytest.approx(80.15, abs=0.2)
    residuals = places - np.polyval(np.polyfit(np.arange(81), places, 1), np.arange(81))
    assert np.abs(residuals).max() < 0.5


def test_a_turn_blurs_as_it_turns(renderer: Renderer) -> None:
    show_stripes(renderer, DISTANCE, (0.001, 10.0))
    image = expose(renderer, Shutter(exposure_time=0.05), np.zeros(3), np.array([0.0, 0.8, 0.0]))
    assert edge_profile(image[40])[1] == pytest.approx(0.8 * 0.05 * 300.0, rel=0.06)
