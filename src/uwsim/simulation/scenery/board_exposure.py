r"""The exposure of cameras in physical water for a white board that they look at.

A white board at a point P faces the camera, as a photographer exposes for a card. In each channel
it has the radiance

.. math:: L = J h + B (1 - h) + \sum_{lamps} (S + V)

with its light :math:`J` of sun and sky, the full field :math:`h` and the open water :math:`B` along
the line of sight, and the signal :math:`S` and veil :math:`V` of each lamp. The exposure is
:math:`0.7 / \max L`: turbid water makes images brighter by gain, until the veil limits it. Not
modelled: shadows on the board, the blur of its edges, and the limits of shutter and gain.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...base.geometry import Array
from ...optics import Lamp as PointLamp
from ...optics import compute_full_field
from ...optics.lamp_light import compute_lamp_veil, compute_target_radiance
from ...rendering.lights.lamp import Lamp
from ...rendering.physical.daylight_field import compute_light_field, compute_open_water
from ...rendering.physical.physical_water import PhysicalWater
from ...rendering.water import Water
from ...world import LineOfSight
from .automatic_exposure import MIN_RADIANCE, WHITE_LEVEL


def expose_board(
    water: Water, light_rate: float, lamps: Sequence[Lamp], sight: LineOfSight
) -> Water:
    """Return physical water with the exposure for a white board that faces the camera.

    Args:
        water: the water, which is physical.
        light_rate: the factor on daylight [1].
        lamps: the lamps that are on.
        sight: the line from the camera to the board, longer than 0.
    """
    physical_water = water.physical_water
    assert physical_water is not None
    radiance = compute_sunlit_board(physical_water, water.surface_height, light_rate, sight)
    for lamp in lamps:
        radiance = radiance + compute_lamplit_board(physical_water, lamp, sight)
    exposure = WHITE_LEVEL / max(float(radiance.max()), MIN_RADIANCE)
    return replace(water, physical_water=replace(physical_water, exposure=exposure))


def compute_sunlit_board(
    water: PhysicalWater, surface_height: float, light_rate: float, sight: LineOfSight
) -> Array:
    """Compute the radiance of a white board in daylight, as the camera sees it, (3,).

    Args:
        water: the water and its daylight.
        surface_height: the height of the surface in W [m].
        light_rate: the factor on daylight [1].
        sight: the line from the camera to the board, which faces the camera.
    """
    ray = (sight.point - sight.camera) / sight.length
    light = compute_board_light(water, surface_height, light_rate, sight)
    depth = surface_height - float(sight.camera[2])
    open_water = compute_open_water(water, depth, ray[None], light_rate)[0]
    full_field = compute_full_field(water.medium, sight.length)
    radiance: Array = light * full_field + open_water * (1.0 - full_field)
    return radiance


def compute_board_light(
    water: PhysicalWater, surface_height: float, light_rate: float, sight: LineOfSight
) -> Array:
    """Compute the light J of a white board in daylight, without water before it, (3,).

    Args:
        water: the water and its daylight.
        surface_height: the height of the surface in W [m].
        light_rate: the factor on daylight [1].
        sight: the line from the camera to the board, which faces the camera.
    """
    field = compute_light_field(water.medium, water.daylight)
    ray = (sight.point - sight.camera) / sight.length
    beam, diffuse = field.compute_irradiance(surface_height - float(sight.point[2]))
    upward = field.reflectance * (beam + diffuse)
    sun_share = max(-float(np.sum(ray * field.towards_sun)), 0.0) / float(field.towards_sun[2])
    upper_share = 0.5 - 0.5 * float(ray[2])
    light: Array = light_rate * (
        beam * sun_share + diffuse * upper_share + upward * (1.0 - upper_share)
    )
    return light


def compute_lamplit_board(water: PhysicalWater, lamp: Lamp, sight: LineOfSight) -> Array:
    """Compute the radiance of a white board in a lamp's light, with the lamp's veil, (3,).

    The unit is that of images: a white surface in the irradiance 1 has the radiance 1.
    """
    ray = (sight.point - sight.camera) / sight.length
    camera, point_lamp = sight.camera.tolist(), make_point_lamp(lamp)
    radiance = compute_target_radiance(
        water.medium, point_lamp, sight.point[None], -ray[None], camera
    )[0]
    if water.has_lamp_veil:
        radiance = (
            radiance
            + compute_lamp_veil(water.medium, point_lamp, camera, ray[None], [sight.length])[0]
        )
    board: Array = math.pi * radiance
    return board


def make_point_lamp(lamp: Lamp) -> PointLamp:
    """Return the lamp of the formulas of `optics` for a lamp of the renderer, in W."""
    x, y, z = lamp.world_from_lamp.position.tolist()
    axis_x, axis_y, axis_z = (-lamp.world_from_lamp.rotation[:, 2]).tolist()
    red, green, blue = lamp.colour
    return PointLamp(
        position=(x, y, z),
        direction=(axis_x, axis_y, axis_z),
        intensity=(lamp.intensity * red, lamp.intensity * green, lamp.intensity * blue),
        half_angle=lamp.half_angle,
        softness=lamp.softness,
    )
