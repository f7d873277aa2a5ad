"""The unit and axes of Collada files, as they apply in robot files and in scene files.

Robot files apply the unit, as RViz and Gazebo do. Scene files rotate the vertical axis to z, as
UWSim's OpenSceneGraph does (`collada_asset`). Other formats state neither.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ..base.numerics.linear import product
from .mesh import Model

Scale = tuple[float, float, float]


def robot_scale(model: Model, scale: Scale) -> Scale:
    """Return the scale of a robot's mesh, times the unit of the mesh [m].

    Args:
        model: the mesh, in its own unit.
        scale: the scale of the mesh in the robot file [1].
    """
    x, y, z = (model.unit * factor for factor in scale)
    return x, y, z


@lru_cache(maxsize=64)
def with_z_up(model: Model) -> Model:
    """Return the model of a scene file with its vertical axis along z, as UWSim shows it."""
    if model.asset is None or model.asset.up_axis == "Z":
        return model
    rotation = model.asset.z_up_from_file
    meshes = tuple(
        replace(
            mesh, vertices=_rotate(mesh.vertices, rotation), normals=_rotate(mesh.normals, rotation)
        )
        for mesh in model.meshes
    )
    return replace(model, meshes=meshes, asset=replace(model.asset, up_axis="Z"))


def _rotate(vectors: np.ndarray, rotation: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(product(vectors.astype(np.float64), rotation.T).astype(np.float32))
