"""An exposure: all that a scene needs to take one image of a camera."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array, Intrinsics, Pose
from ..base.numerics.jit import njit
from ..base.numerics.linear import product, rotate_back
from .lens_image import map_lens
from .response import CameraResponse, Light, Pixels, weigh_grey
from .shutter import Shutter, find_motion, move_pose
from .vignetting import compute_falloff


@dataclass(frozen=True, eq=False, kw_only=True)
class Exposure:
    """One image of a camera."""

    world_from_camera: Pose
    """The pose of the camera at the time of the image; OpenGL axes."""
    intrinsics: Intrinsics
    """The pinhole and the lens."""
    response: CameraResponse
    """The electrons and numbers."""
    shutter: Shutter
    """The times of the rows."""
    vignetting: tuple[float, ...] | None
    """The coefficients of `compute_falloff`."""
    velocity: Array
    """The velocity of the camera in W, (3,) [m/s]."""
    angular_velocity: Array
    """The angular velocity of the camera in W, (3,) [rad/s]."""
    vehicle: str
    """The name of the vehicle, whose parts and lamps move with the camera."""
    key: int
    """The key of the noise."""
    is_grey: bool
    """True if the image is grey."""
    is_polished: bool
    """True if the scene is drawn with soft shadows, highlights and smooth edges."""


@dataclass(frozen=True, eq=False, kw_only=True)
class PlainExposure:
    """One image of a camera without a response, which takes no time."""

    world_from_camera: Pose
    """The pose of the camera; OpenGL axes."""
    intrinsics: Intrinsics
    """The pinhole and the lens."""
    std: float
    """The standard deviation of the noise of each channel, 0..1."""
    rng: np.random.Generator
    """The camera's random stream."""
    is_grey: bool
    """True if the image is grey: its weighted channels are truncated before they are added."""
    is_polished: bool
    """True if the scene is drawn with soft shadows, highlights and smooth edges."""


@dataclass(frozen=True, eq=False)
class Displacement:
    """The motion of a vehicle as a rigid body, from its present pose to another time."""

    vehicle: str
    """The name of the vehicle."""
    matrix: Array
    """The transform of points in W, (4, 4)."""
    time: float
    """The time from the present pose [s]."""
    duration: float
    """The time from one image of the exposure to the next, over which near particles streak [s]."""
    velocity: Array
    """The velocity of the camera in W, (3,) [m/s]."""
    angular_velocity: Array
    """The angular velocity of the camera in W, (3,) [rad/s]."""


DrawLight = Callable[[Pose, Displacement | None], Light]
"""A function that draws the light at a pose of the camera, (h, w, channels), while a vehicle is
displaced."""


def take_image(
    exposure: Exposure,
    draw_light: DrawLight,
    draw_depth: Callable[[Pose, Intrinsics], Array],
    scene_exposure: float,
) -> Pixels:
    """Take an image: draw the light at the times of the shutter, and count its electrons.

    Args:
        exposure: the image.
        draw_light: draws light.
        draw_depth: draws planar depths (h, w) [m] of a pinhole.
        scene_exposure: the ratio of full scale to light in the scene.
    """
    camera = exposure.intrinsics
    times = np.zeros(1)
    if exposure.velocity.any() or exposure.angular_velocity.any():
        times = exposure.shutter.choose_times(
            camera.height, _find_pixel_motion(exposure, draw_depth)
        )
    light = _average_light(exposure, draw_light, times)
    if exposure.is_grey:
        light = weigh_grey(light)
    falloff = compute_falloff(camera, exposure.vignetting)
    return exposure.response.expose(light, falloff, exposure.key, exposure=scene_exposure)


def _find_pixel_motion(
    exposure: Exposure, draw_depth: Callable[[Pose, Intrinsics], Array]
) -> float:
    """Find the greatest motion in the image [px/s]; a lens counts by its pinhole."""
    camera = exposure.intrinsics
    pinhole = camera if camera.lens is None else map_lens(camera).pinhole
    rotation = exposure.world_from_camera.rotation
    return find_motion(
        np.ascontiguousarray(draw_depth(exposure.world_from_camera, pinhole), dtype=np.float64),
        pinhole,
        rotate_back(rotation, exposure.velocity),
        rotate_back(rotation, exposure.angular_velocity),
    )


def _average_light(exposure: Exposure, draw_light: DrawLight, times: Array) -> Light:
    """Average the light of the times, row by row."""
    pose = exposure.world_from_camera
    if len(times) == 1:
        return draw_light(pose, None)
    weights = exposure.shutter.compute_weights(exposure.intrinsics.height, times)
    total: Light | None = None
    for time, row_weights in zip(times.tolist(), weights, strict=True):
        if not row_weights.any():
            continue
        moved_pose = move_pose(pose, exposure.velocity, exposure.angular_velocity, time)
        matrix = product(moved_pose.matrix, pose.inverse().matrix)
        displacement = Displacement(
            exposure.vehicle,
            matrix,
            time=time,
            duration=float(times[1] - times[0]),
            velocity=exposure.velocity,
            angular_velocity=exposure.angular_velocity,
        )
        light = draw_light(moved_pose, displacement)
        total = np.zeros_like(light) if total is None else total
        _add_rows(light, row_weights, total)
    assert total is not None
    return total


@njit
def _add_rows(light: Light, weights: npt.NDArray[np.float32], total: Light) -> None:
    """Add the rows of light times their weights."""
    for row in range(light.shape[0]):
        if weights[row] > 0:
            total[row] += weights[row] * light[row]
