"""The uniform block ``Surface``: the water's surface, the sky and the air in an image."""

from __future__ import annotations

import math

import moderngl
import numpy as np

from ...base.geometry import Array, Intrinsics, Pose
from ...base.numerics.linear import product
from ..physical.daylight_field import REFRACTIVE_INDEX, compute_light_field
from ..physical.physical_water import PhysicalWater
from ..program import Block
from ..projection import projection
from .ripples import N_USES, SIZE
from .sky import Sky
from .wave_grids import N_POINTS, WaveGrids

SURFACE = Block(
    "Surface",
    7,
    {
        "clip_from_offset": "mat4",
        "world_from_ray": "mat4",
        "eye": "vec4",
        "grids": "vec4[4]",
        "roughness": "vec4",
        "ripples": "vec4",
        "ripple_origin": "vec4",
        "ripple_turn": "vec4",
        "bounds": "vec4",
        "sky_sun": "vec4",
        "sky_sun_light": "vec4",
        "sky_light": "vec4",
        "water_light": "vec4",
        "image_size": "vec4",
        "air": "vec4",
    },
)
CONTRAST_LOSS = math.log(50.0)
"""The optical depth at which the contrast is 2 %."""
SUN_RADIUS = 0.00465
"""The angular radius of the sun [rad]."""
RIPPLE_ANGLE, RIPPLE_SCALE = 0.55, 0.43
"""The turn [rad] and the relative size of the tile of ripples in its second use."""


class SurfaceBlock:
    """The buffer of the uniform block ``Surface`` (``shaders/surface_block.glsl``)."""

    def __init__(self, context: moderngl.Context) -> None:
        self._values = np.zeros((), dtype=SURFACE.dtype)
        self._buffer = context.buffer(reserve=SURFACE.dtype.itemsize, dynamic=True)

    def fill(
        self,
        water: PhysicalWater,
        sky: Sky,
        grids: WaveGrids,
        *,
        height: float,
        ripple_variance: float,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        light_rate: float,
    ) -> None:
        """Write the values of an image and bind the buffer.

        Args:
            water: the water and its light.
            sky: the sky.
            grids: the grids of waves in use.
            height: the height of the camera above the still surface [m].
            ripple_variance: the variance of the slopes of ripples along one axis [1].
            world_from_camera: the pose of the camera; OpenGL axes.
            intrinsics: the pinhole of the camera.
            light_rate: the factor on daylight.
        """
        values, rotation = self._values, world_from_camera.rotation
        camera_from_world = np.eye(4)
        camera_from_world[:3, :3] = rotation.T
        world_from_ray = np.eye(4)
        world_from_ray[:3, :3] = rotation
        values["clip_from_offset"] = product(
            projection(intrinsics).clip_from_camera, camera_from_world
        ).T
        values["world_from_ray"] = world_from_ray.T
        eye = world_from_camera.position
        values["eye"] = height, intrinsics.near, 0.0, len(grids.frames)
        for level, frame in enumerate(grids.frames):
            offset, size = eye[:2] - frame.origin, frame.n_points
            values["grids"][level] = (
                *(offset / frame.spacing + 0.5) / size,
                1.0 / (frame.spacing * size),
                frame.spacing,
            )
            values["roughness"][level] = frame.roughness
        values["ripples"] = (
            math.sqrt(ripple_variance / N_USES),
            ripple_variance / N_USES,
            1.0 / SIZE,
            SIZE / N_POINTS,
        )
        values["ripple_origin"] = *np.mod(eye[:2], 5.0 * SIZE), 0.0, 0.0
        cosine, sine = math.cos(RIPPLE_ANGLE) / RIPPLE_SCALE, math.sin(RIPPLE_ANGLE) / RIPPLE_SCALE
        turned_place = cosine * eye[0] - sine * eye[1], sine * eye[0] + cosine * eye[1]
        values["ripple_turn"] = *np.mod(turned_place, SIZE), cosine, sine
        values["bounds"] = grids.max_elevation, grids.slope_variance, 0.0, 0.0
        values["sky_sun"] = *sky.towards_sun, SUN_RADIUS
        values["sky_sun_light"][:3] = light_rate * sky.sun_irradiance
        field = compute_light_field(water.medium, water.daylight)
        values["sky_sun_light"][3] = float(field.towards_sun[2])
        values["sky_light"][:3] = light_rate * sky.irradiance
        values["water_light"][:3] = light_rate * field.reflectance * field.total
        values["image_size"][:2] = intrinsics.width, intrinsics.height
        pixel = 1.0 / math.sqrt(intrinsics.fx * intrinsics.fy)
        values["air"] = CONTRAST_LOSS / water.visibility, REFRACTIVE_INDEX, pixel, 0.0
        self._buffer.write(values.tobytes())
        self._buffer.bind_to_uniform_block(SURFACE.binding)

    def turn(self, rotation: Array) -> None:
        """Write another rotation from the camera frame to W, for bodies of another view."""
        self._values["world_from_ray"][:3, :3] = rotation.T
        self._buffer.write(self._values.tobytes())
        self._buffer.bind_to_uniform_block(SURFACE.binding)
