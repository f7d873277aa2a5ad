"""Warnings about stand-ins for missing files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from ..base.terminal import warn

if TYPE_CHECKING:
    from ..scene.spec import SceneSpec


def warn_of_stand_ins(scene: SceneSpec, data_path: tuple[Path, ...]) -> None:
    """Warn of bundled robots of a scene that replace missing files."""
    from ..model.robots import robot_stand_ins

    for name, path in robot_stand_ins(scene, data_path).items():
        place = f"{scene.path}: " if scene.path else ""
        warn(f"{place}robot file {name!r} is not found; the bundled {path.name} is used")
