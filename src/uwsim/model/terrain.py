"""The sea floors of a scene that are charts: objects with ``<u:bathymetry>``."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import cast

import numpy as np

from ..acoustics import MaterialName
from ..base.geometry import Array
from ..bathymetry.height_grid import HeightGrid
from ..rays import HeightRays
from ..scene.object import ObjectSpec
from ..scene.spec import SceneSpec
from .robots import find_file


def height_grid(
    scene: SceneSpec, spec: ObjectSpec, data_path: tuple[Path, ...]
) -> HeightGrid | None:
    """Return the height grid of an object in W; None if the object is no chart.

    Raises:
        AssetNotFound: the file is not found.
        AssetError: the file is invalid, or does not fit the scene.
    """
    if spec.bathymetry is None:
        return None
    path = find_file(spec.file, scene.path, data_path)
    world_from_object = scene.world_from_localized @ spec.localized_from_object
    x, y, z = (world_from_object.position - scene.world_from_localized.position).tolist()
    sediment = spec.bathymetry.sediment
    sediment_path = None
    if sediment is not None:
        sediment_path = find_file(sediment.file, scene.path, data_path)
    return spec.bathymetry.read(
        path,
        name=spec.file,
        origin=scene.earth_origin,
        shift=(x, y, z),
        sediment_path=sediment_path,
    )


def floor_materials(spec: ObjectSpec) -> tuple[MaterialName, ...]:
    """Return the materials of a chart, by the class of a cell."""
    assert spec.bathymetry is not None
    if spec.bathymetry.sediment is None:
        return (spec.acoustic_material or "sand",)
    return tuple(cast("MaterialName", name) for name in spec.bathymetry.sediment.names)


def height_grids(scene: SceneSpec, data_path: tuple[Path, ...]) -> Mapping[int, HeightGrid]:
    """Return the height grids of a scene in W, by the index of their object."""
    grids = {i: height_grid(scene, spec, data_path) for i, spec in enumerate(scene.objects)}
    return {i: grid for i, grid in grids.items() if grid is not None}


def object_from_world(scene: SceneSpec, spec: ObjectSpec) -> Array:
    """Return the transform of W to the frame of an object at its pose in the file, (4, 4)."""
    world_from_object = scene.world_from_localized @ spec.localized_from_object
    return world_from_object.inverse().matrix


def height_rays(grid: HeightGrid, surface: int) -> HeightRays:
    """Return a height grid in W for ray casting, whose hits have a surface index."""
    origin = np.array([grid.west, grid.south, 0.0])
    return HeightRays(grid.heights, origin, grid.spacing, surface, grid.classes)
