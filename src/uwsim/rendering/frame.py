"""The uniform block ``Frame``: camera, water and sunlight, which are constant in an image."""

from __future__ import annotations

import moderngl
import numpy as np

from ..base.geometry import Array, Intrinsics, Pose
from ..base.numerics.linear import product, rotate_back
from .lights.sun_shadow import SunShadow
from .program import Block
from .water import (
    AMBIENT_SHARE,
    SPECULAR_BRIGHTNESS,
    SUN_COLOURS,
    Light,
    Water,
    find_sun_direction,
)

FRAME = Block(
    "Frame",
    0,
    {
        "clip_from_camera": "mat4",
        "shadow_from_camera": "mat4",
        "up": "vec4",
        "sun": "vec4",
        "sunlight": "vec4",
        "ambient_specular": "vec4",
        "water_colour": "vec4",
        "attenuation": "vec4",
        "fog": "vec4",
        "clip_fog": "vec4",
        "background": "vec4",
    },
)


class Frame:
    """The buffer of the uniform block ``Frame`` (``shaders/frame.glsl``)."""

    def __init__(self, context: moderngl.Context) -> None:
        self._values = np.zeros((), dtype=FRAME.dtype)
        self._buffer = context.buffer(reserve=FRAME.dtype.itemsize, dynamic=True)

    def fill(
        self,
        world_from_camera: Pose,
        intrinsics: Intrinsics,
        clip_from_camera: Array,
        water: Water,
        light: Light,
        shadow: SunShadow,
    ) -> None:
        """Write the values of an image and bind the buffer.

        Args:
            world_from_camera: the pose of the camera; OpenGL axes.
            intrinsics: the pinhole of the camera.
            clip_from_camera: the projection matrix, (4, 4).
            water: the water between surfaces and camera.
            light: the light of the scene.
            shadow: the shadow map of the sun.
        """
        values, rotation = self._values, world_from_camera.rotation
        water = water.scale_by_light(light)
        near, far = intrinsics.near, intrinsics.far
        height = world_from_camera.position[2] - water.surface_height
        values["clip_from_camera"] = clip_from_camera.T  # OpenGL counts columns first
        values["shadow_from_camera"] = product(
            shadow.texture_from_world, world_from_camera.matrix
        ).T
        values["up"] = *rotation[2], height
        values["sun"] = *rotate_back(rotation, find_sun_direction(water, light)), shadow.lift
        values["sunlight"][:3] = [light.rate * colour for colour in SUN_COLOURS[light.sun]]
        values["ambient_specular"][:2] = (
            light.rate * AMBIENT_SHARE,
            light.rate * SPECULAR_BRIGHTNESS,
        )
        values["water_colour"][:3] = water.colour
        optics = water.physical_water
        values["attenuation"][:3] = water.attenuation if optics is None else optics.beam_attenuation
        values["fog"] = *water.fog_colour, water.fog**2
        values["clip_fog"][:2] = (far + near) / (far - near), -2.0 * far * near / (far - near)
        values["background"][:3] = water.far_colour
        self._buffer.write(values.tobytes())
        self._buffer.bind_to_uniform_block(FRAME.binding)
