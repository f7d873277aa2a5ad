"""Meshes of robots that are likely not in metres."""

from __future__ import annotations

from pathlib import Path

from ..errors import AssetError
from . import load_model
from .conventions import robot_scale

MAX_LENGTH = 100.0
"""No robot is longer [m]; one of 0.1 m in millimetres is as long."""


def doubtful_size(
    name: str,
    scale: tuple[float, float, float],
    *,
    named_by: Path | None = None,
    data_path: tuple[Path, ...] = (),
) -> str:
    """Say why the mesh of a robot is likely not in metres; empty if it may be, or is not there.

    Args:
        name: of the mesh, as the robot file calls it.
        scale: of the mesh in the robot file [1].
        named_by: the robot file.
        data_path: further folders to search.
    """
    try:
        model = load_model(name, named_by=named_by, data_path=data_path)
    except AssetError:
        return ""
    if model.asset is not None and (wrong := model.asset.wrong_unit):
        return (
            f"the mesh {name!r} states {wrong} as its unit; expected a length in metres: "
            "it is read in metres"
        )
    unit = 1.0 if model.asset is None else model.asset.unit
    if unit != 1.0 and all(abs(abs(factor) / unit - 1.0) < 0.02 for factor in scale):
        return (
            f"the mesh {name!r} states that its unit is {unit:g} m, which is applied, and its "
            'scale is the same again; expected scale="1 1 1"'
        )
    size = [
        abs(factor) * (high - low)
        for factor, low, high in zip(
            robot_scale(model, scale), model.box.lower, model.box.upper, strict=True
        )
    ]
    if max(size) <= MAX_LENGTH:
        return ""
    longest = " x ".join(f"{side:.4g}" for side in size)
    return f'the mesh {name!r} is {longest} m; if it is in millimetres: scale="0.001 0.001 0.001"'
