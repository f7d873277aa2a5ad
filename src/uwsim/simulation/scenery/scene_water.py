"""Physical water of a scene: its medium, its light, and the exposure of its cameras."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Protocol

import numpy as np
import numpy.typing as npt

from ...devices.lamp import MountedLamp
from ...devices.led_array import Led
from ...devices.structured_light_projector import MountedProjector
from ...model.scene_model import SceneModel
from ...optics import find_water
from ...rendering.caustics.ripples import Ripples
from ...rendering.physical.daylight_field import compute_light_field
from ...rendering.physical.physical_water import Daylight, PhysicalWater
from ...rendering.water import Water
from .automatic_exposure import MIN_RADIANCE, LightSources, compute_exposure


def make_water(model: SceneModel) -> Water:
    """Return the water of a scene, with its physical law if it has one."""
    ocean = model.scene.ocean_state
    water = Water.from_ocean_state(ocean, model.compatibility)
    spec, medium = ocean.water, model.optical_water
    if spec is None or medium is None:
        return water
    physical_water = PhysicalWater(
        medium=medium,
        daylight=Daylight(
            elevation=min(spec.sun.elevation, 0.5 * math.pi),
            azimuth=spec.sun.azimuth,
            irradiance=spec.sun.irradiance,
            sky_share=spec.sun.sky_share,
        ),
        transfer=spec.transfer,
        has_blur=spec.blur,
        blur_margin=spec.blur_margin,
        has_lamp_veil=spec.lamp_veil,
        ripples=_make_ripples(model),
        has_caustics=spec.caustics,
        has_light_shafts=spec.light_shafts,
        has_surface=spec.surface,
        has_mirror=spec.mirror,
        visibility=spec.sky.visibility,
    )
    return set_exposure(replace(water, physical_water=physical_water), model)


class LitScene(Protocol):
    """The light sources of a scene."""

    @property
    def mounted_lamps(self) -> tuple[MountedLamp | Led, ...]:
        """The lamps and signal lamps."""

    @property
    def mounted_projector(self) -> tuple[MountedProjector, npt.NDArray[np.uint8]] | None:
        """The projector, and its pattern; None: none."""


def set_exposure(water: Water, model: SceneModel, scene: LitScene | None = None) -> Water:
    """Return water with the exposure of a scene; see `PhysicalWaterSpec.exposure`.

    Args:
        water: the water.
        model: the compiled scene.
        scene: the light sources of the scene; None: none.
    """
    spec, physical_water = model.scene.ocean_state.water, water.physical_water
    if spec is None or physical_water is None:
        return water
    exposure = spec.exposure
    if exposure is None:
        sources = LightSources() if scene is None else find_light_sources(scene)
        depth, light_rate = _find_start_depth(model), model.scene.sim_params.light_rate
        exposure = compute_exposure(physical_water, depth, light_rate, sources)
    return replace(water, physical_water=replace(physical_water, exposure=exposure))


def find_light_sources(scene: LitScene) -> LightSources:
    """Return the light sources of a scene at full brightness."""
    projector = None if scene.mounted_projector is None else scene.mounted_projector[0].spec
    return LightSources(
        lamps=tuple(lamp.spec for lamp in scene.mounted_lamps),
        has_laser=projector is not None and projector.laser,
        has_projector_lamp=projector is not None and not projector.laser,
    )


def choose_water(water: Water, fog: float | None, model: SceneModel) -> Water:
    """Return the water of a view with a fog density instead of the scene's.

    A view without fog shows physical water as the purest one, so that distant vehicles are visible.

    Args:
        water: the water of the scene.
        fog: the fog density [1/m]; None: the density of the scene.
        model: the compiled scene.
    """
    if fog is None:
        return water
    physical_water = water.physical_water
    if physical_water is None or fog > 0.0:
        return replace(water, fog=fog)
    depth = _find_start_depth(model)
    medium, levels = find_water("clear"), []
    for field_medium in (physical_water.medium, medium):
        field = compute_light_field(field_medium, physical_water.daylight)
        beam, diffuse = field.compute_irradiance(depth)
        levels.append(max(float((beam + diffuse).max()), MIN_RADIANCE))
    exposure = physical_water.exposure * levels[0] / levels[1]
    return replace(water, physical_water=replace(physical_water, medium=medium, exposure=exposure))


def _make_ripples(model: SceneModel) -> Ripples | None:
    """Return the ripples of a scene; those of a light wind if it has only waves."""
    ocean = model.scene.ocean_state
    if ocean.water is None or ocean.water.ripples is None:
        return Ripples() if ocean.waves else None
    spec, rotation = ocean.water.ripples, model.scene.world_from_localized.rotation
    wind = rotation[:, 0] * math.cos(spec.direction) + rotation[:, 1] * math.sin(spec.direction)
    return Ripples(wind_speed=spec.wind_speed, direction=math.atan2(float(wind[1]), float(wind[0])))


def _find_start_depth(model: SceneModel) -> float:
    """Return the depth of the first vehicle's start [m]; 0 without vehicles."""
    scene = model.scene
    if not scene.vehicles:
        return 0.0
    start = scene.world_from_localized @ scene.vehicles[0].localized_from_base
    return scene.ocean_state.ocean_surface_height - float(start.position[2])
