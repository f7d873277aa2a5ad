"""How robot files and scene files take what a Collada file states of its unit and axes.

Robot files as RViz and Gazebo, which apply the unit; scene files as UWSim, whose OpenSceneGraph
turns the vertical axis to z (`collada_asset`). Other formats state neither.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ..base.numerics.linear import product
from .mesh import Model

Scale = tuple[float, float, float]


def robot_scale(model: Model, scale: Scale) -> Scale:
    """Return the scale of a robot's mesh, that of its unit included [m].

    Args:
        model: the mesh, in its own unit.
        scale: of the mesh in the robot file [1].
    """
    if model.asset is None or model.asset.unit == 1.0:
        return scale
    x, y, z = (model.asset.unit * factor for factor in scale)
    return x, y, z


@lru_cache(maxsize=64)
def with_z_up(model: Model) -> Model:
    """Return the model of a scene file with its vertical axis along z, as UWSim shows it."""
    if model.asset is None or model.asset.up_axis == "Z":
        return model
    turn = model.asset.z_up_from_file
    meshes = tuple(
        replace(mesh, vertices=_turned(mesh.vertices, turn), normals=_turned(mesh.normals, turn))
        for mesh in model.meshes
    )
    return replace(model, meshes=meshes, asset=replace(model.asset, up_axis="Z"))


def _turned(vectors: np.ndarray, turn: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(product(vectors.astype(np.float64), turn.T).astype(np.float32))
