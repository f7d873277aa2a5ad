"""The light sources of devices as the renderer needs them."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ...base.geometry import Pose
from ...base.numerics.linear import product
from ...cameras.exposure import Displacement
from ...devices.lamp import MountedLamp
from ...devices.led_array import Led
from ...devices.structured_light_projector import MountedProjector
from ...rendering.lights.lamp import Lamp
from ...rendering.lights.projector import Projector
from ...scene.spec import SceneSpec


def make_lamp(lamp: MountedLamp | Led, displacement: Displacement | None = None) -> Lamp:
    """Return the renderer's lamp at the present brightness of a mounted one.

    Its pose is the present one, or where its vehicle is displaced to.
    """
    spec = lamp.spec
    world_from_lamp = lamp.world_from_lamp
    if displacement is not None and lamp.link.partition("/")[0] == displacement.vehicle:
        matrix = product(displacement.matrix, world_from_lamp.matrix)
        world_from_lamp = Pose(matrix[:3, 3], matrix[:3, :3])
    return Lamp(
        world_from_lamp=world_from_lamp,
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


def has_sun_shadows(scene: SceneSpec) -> bool:
    """Return whether vehicles and objects cast the sun's shadow."""
    sun_shadow = scene.sim_params.sun_shadow
    return not scene.is_original if sun_shadow is None else sun_shadow
