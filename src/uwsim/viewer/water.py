"""The entries of the head for water and light."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from statistics import NormalDist
from typing import Any

from ..optics import Medium
from ..rendering.physical.blur_plan import N_NODES
from ..rendering.physical.physical_water import PhysicalWater
from ..rendering.water import AMBIENT_SHARE, SPECULAR_BRIGHTNESS, SUN_COLOURS, SUN_DIRECTIONS
from ..simulation.live_scene import LiveScene
from ..simulation.scenery.scene_water import choose_water
from .optics import describe_optics
from .pack import Blob

Json = dict[str, Any]


def describe_water(world: LiveScene, blob: Blob, media: Iterable[Medium] = ()) -> Json:
    """Return the fields ``water``, ``suns``, ``ambient`` and ``specular`` of the head.

    Args:
        world: the scene.
        blob: the binary part of the pack, to which arrays are appended.
        media: the media of physical water besides the present one.
    """
    water, light = world.scenery.state.water, world.scenery.state.light
    return {
        "water": {
            "fog": water.fog,
            "fog_colour": list(water.fog_colour),
            "colour": list(water.colour),
            "attenuation": list(water.attenuation),
            "surface_height": water.surface_height,
            "clip": water.fog_distance == "clip",
            "follows_light": water.follows_light,
            "light_rate": light.rate,
            "sun": light.sun,
            "shadows": light.shadows,
            **_describe_physical_water(world, blob, media),
        },
        "suns": {
            name: {"direction": list(SUN_DIRECTIONS[name]), "colour": list(SUN_COLOURS[name])}
            for name in SUN_DIRECTIONS
        },
        "ambient": AMBIENT_SHARE,
        "specular": SPECULAR_BRIGHTNESS,
    }


def describe_medium(world: LiveScene, medium: Medium, blob: Blob) -> Json:
    """Return the entry of a medium in the scene's light (`uwsim.viewer.optics`)."""
    water = _find_water(world, medium, fog=None)
    clear_exposure = _find_water(world, medium, fog=0.0).exposure
    return describe_optics(water, clear_exposure, world.scenery.mounted_lamps, blob)


def _find_water(world: LiveScene, medium: Medium, fog: float | None) -> PhysicalWater:
    """Return the water of views with another medium than that of the scene, and with a fog."""
    water = world.scenery.state.water
    assert water.physical_water is not None
    water = replace(water, physical_water=replace(water.physical_water, medium=medium))
    physical_water = choose_water(water, fog, world.model).physical_water
    assert physical_water is not None
    return physical_water


def _describe_physical_water(world: LiveScene, blob: Blob, media: Iterable[Medium]) -> Json:
    water = world.scenery.state.water.physical_water
    if water is None:
        return {"media": None, "clear": None, "nodes": None}
    clear_water = _find_water(world, water.medium, fog=0.0)
    normal = NormalDist()
    nodes = [abs(normal.inv_cdf((i + 0.5) / N_NODES)) for i in range(N_NODES)]
    return {
        "media": [
            describe_medium(world, medium, blob) for medium in dict.fromkeys([water.medium, *media])
        ],
        "clear": describe_optics(
            clear_water, clear_water.exposure, world.scenery.mounted_lamps, blob
        ),
        "nodes": nodes,
    }
