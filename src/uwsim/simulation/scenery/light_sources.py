"""The light sources of devices as the renderer needs them."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ...devices.lamp import MountedLamp
from ...devices.led_array import Led
from ...devices.structured_light_projector import MountedProjector
from ...rendering.lights.lamp import Lamp
from ...rendering.lights.projector import Projector


def make_lamp(lamp: MountedLamp | Led) -> Lamp:
    """Return the renderer's lamp at the present pose and brightness of a mounted one."""
    spec = lamp.spec
    return Lamp(
        world_from_lamp=lamp.world_from_lamp,
        half_angle=math.radians(spec.fov / 2.0),
        softness=spec.softness,
        colour=spec.color,
        intensity=lamp.intensity,
        casts_shadow=spec.shadow,
    )


def make_projector(projector: MountedProjector, pattern: npt.NDArray[np.uint8]) -> Projector:
    """Return the renderer's projector, with its pattern (h, w, 4), at its present pose."""
    return Projector(
        world_from_projector=projector.world_from_projector,
        fovy=math.radians(projector.spec.fov),
        pattern=pattern,
        is_laser=projector.spec.laser,
    )
