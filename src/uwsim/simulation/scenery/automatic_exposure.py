r"""The automatic exposure of a scene in physical water, constant during a run.

The exposure is 0.7 over the greatest of these radiances, in the brightest channel:

- a white board that faces up at the depth where the first vehicle starts, in daylight;
- open water at that depth, which a camera sees level in eight directions;
- a white board at :math:`d` = 4 m in the light of the strongest lamp, :math:`I h(2 d) / d^2`,
  and the veil :math:`V` of the lamp in front of it: without it, turbid water at night would be
  white in images;
- the same board in the light of a projector, :math:`h(2 d)` for a laser.

The veil is that of a camera 0.3 m beside the lamp which looks in the same direction: the greatest
of the centre of the image and of two rays towards the lamp, at 14 and 27 degrees. The lamps'
distances from the cameras of the scene are not used, so a camera does not change the exposure of
another one. A scene without any light has the exposure 1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...devices.lamp import LampSpec
from ...optics import Lamp, Medium, compute_full_field, compute_lamp_veil
from ...rendering.physical.daylight_field import compute_light_field, compute_open_water
from ...rendering.physical.physical_water import PhysicalWater

WHITE_LEVEL = 0.7
"""The linear value of the brightest of the boards and veils [1: full scale]."""
LAMP_DISTANCE = 4.0
"""The distance of a board in the light of the strongest lamp [m]."""
LAMP_OFFSET = 0.3
"""The distance of the lamp beside the camera, for its veil [m]."""
VEIL_PIXELS = (0.0, 0.25, 0.5)
"""The tangents of the rays on which the veil counts, from the optical axis towards the lamp."""
MIN_RADIANCE = 1e-6
"""The least radiance of the board [1]; a darker scene counts as unlit."""
UNLIT_EXPOSURE = 1.0
"""The exposure of a scene without light."""
N_DIRECTIONS = 8
"""The number of level directions in which open water counts."""


@dataclass(frozen=True, kw_only=True)
class LightSources:
    """The light sources of a scene at full brightness."""

    lamps: tuple[LampSpec, ...] = ()
    """The lamps and signal lamps."""
    has_laser: bool = False
    """True if a laser projects a pattern."""
    has_projector_lamp: bool = False
    """True if a lamp projects a pattern."""


def compute_exposure(
    water: PhysicalWater, depth: float, light_rate: float, sources: LightSources
) -> float:
    """Compute the automatic exposure.

    Args:
        water: the water and its daylight.
        depth: the depth at which the first vehicle starts [m].
        light_rate: the factor on daylight [1].
        sources: the light sources.
    """
    radiance = max(
        compute_daylight(water, depth, light_rate),
        max((compute_lamplight(water, lamp) for lamp in sources.lamps), default=0.0),
        compute_projected_light(water.medium, sources),
    )
    return WHITE_LEVEL / radiance if radiance > MIN_RADIANCE else UNLIT_EXPOSURE


def compute_daylight(water: PhysicalWater, depth: float, light_rate: float) -> float:
    """Compute the greatest radiance of a white board and of open water in daylight [1]."""
    field = compute_light_field(water.medium, water.daylight)
    beam, diffuse = field.compute_irradiance(depth)
    angles = [2.0 * math.pi * i / N_DIRECTIONS for i in range(N_DIRECTIONS)]
    directions = np.array([[math.cos(angle), math.sin(angle), 0.0] for angle in angles])
    open_water = compute_open_water(water, depth, directions, light_rate)
    return max(light_rate * float((beam + diffuse).max()), float(open_water.max()))


def compute_lamplight(water: PhysicalWater, lamp: LampSpec) -> float:
    """Compute the radiance of a white board in the light of a lamp, with the lamp's veil [1]."""
    medium, colour = water.medium, np.array(lamp.color)
    losses = compute_full_field(medium, 2.0 * LAMP_DISTANCE)
    board = lamp.intensity / LAMP_DISTANCE**2 * float(losses.max())
    if not water.has_lamp_veil:
        return board
    red, green, blue = (lamp.intensity * colour).tolist()
    source = Lamp(
        position=(LAMP_OFFSET, 0.0, 0.0),
        direction=(0.0, 0.0, 1.0),
        intensity=(red, green, blue),
        half_angle=math.radians(0.5 * lamp.fov),
        softness=lamp.softness,
    )
    rays = np.array([[x, 0.0, 1.0] for x in VEIL_PIXELS])
    rays /= np.sqrt((rays * rays).sum(axis=1))[:, None]
    lengths = np.full(len(rays), LAMP_DISTANCE)
    veil = compute_lamp_veil(medium, source, (0.0, 0.0, 0.0), rays, lengths)
    return board + math.pi * float(veil.max())


def compute_projected_light(medium: Medium, sources: LightSources) -> float:
    """Compute the radiance of a white board in the light of a projector [1]."""
    losses = float(compute_full_field(medium, 2.0 * LAMP_DISTANCE).max())
    if sources.has_laser:
        return losses
    return losses / LAMP_DISTANCE**2 if sources.has_projector_lamp else 0.0
