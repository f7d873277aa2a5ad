"""Meshes of robots that are likely not in metres."""

from __future__ import annotations

import re
from pathlib import Path

from ..errors import AssetError
from . import load_model
from .find import find

MAX_LENGTH = 100.0
"""No robot is longer [m]; one of 0.1 m in millimetres is as long."""
COLLADA_UNIT = re.compile(rb"<unit\b[^>]*\bmeter\s*=\s*[\"']\s*([0-9.eE+-]+)")
"""What a ``.dae`` file says of its unit, near its beginning."""
HEAD = 65536
"""Bytes in which a unit is looked for."""


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
        path = find(name, named_by=named_by, data_path=data_path)
    except AssetError:
        return ""
    if scale == (1.0, 1.0, 1.0) and path is not None and (unit := _unit(path)) not in (None, 1.0):
        return (
            f"the mesh {name!r} says that its unit is {unit:g} m; it is read in metres: "
            f'scale="{unit:g} {unit:g} {unit:g}" if it is too large or too small'
        )
    size = [
        abs(factor) * (high - low)
        for factor, low, high in zip(scale, model.box.lower, model.box.upper, strict=True)
    ]
    if max(size) <= MAX_LENGTH:
        return ""
    longest = " x ".join(f"{side:.4g}" for side in size)
    return f'the mesh {name!r} is {longest} m; if it is in millimetres: scale="0.001 0.001 0.001"'


def _unit(path: Path) -> float | None:
    """The unit of a Collada file [m]; None for other files, and for those that do not say it."""
    if path.suffix.lower() != ".dae":
        return None
    with path.open("rb") as file:
        said = COLLADA_UNIT.search(file.read(HEAD))
    try:
        return float(said[1]) if said else None
    except ValueError:
        return None
