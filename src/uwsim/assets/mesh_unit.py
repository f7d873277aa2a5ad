"""Remarks about meshes of robots that are likely not in metres."""

from __future__ import annotations

from pathlib import Path

from ..errors import AssetError
from . import load_model
from .conventions import robot_scale

MAX_LENGTH = 100.0
"""The greatest length of a mesh in metres [m]; a mesh of 0.1 m in millimetres has this length."""


def mesh_unit_remark(
    name: str,
    scale: tuple[float, float, float],
    *,
    named_by: Path | None = None,
    data_path: tuple[Path, ...] = (),
) -> str:
    """Return a remark if the mesh of a robot is likely not in metres; otherwise "".

    Args:
        name: the name of the mesh in the robot file.
        scale: the scale of the mesh in the robot file [1].
        named_by: the robot file.
        data_path: further folders to search.
    """
    try:
        model = load_model(name, named_by=named_by, data_path=data_path)
    except AssetError:
        return ""
    if model.asset is not None and (invalid_unit := model.asset.invalid_unit):
        return (
            f"the mesh {name!r} states the unit {invalid_unit}; expected a length in metres: it is "
            "read in metres"
        )
    unit = model.unit
    if unit != 1.0 and all(abs(abs(factor) / unit - 1.0) < 0.02 for factor in scale):
        return (
            f"the mesh {name!r} states the unit {unit:g} m, which is applied; its scale applies it "
            'again; expected scale="1 1 1"'
        )
    size = [
        abs(factor) * (high - low)
        for factor, low, high in zip(
            robot_scale(model, scale), model.box.lower, model.box.upper, strict=True
        )
    ]
    if max(size) <= MAX_LENGTH:
        return ""
    size_text = " x ".join(f"{side:.4g}" for side in size)
    return f'the mesh {name!r} is {size_text} m; if it is in millimetres: scale="0.001 0.001 0.001"'
