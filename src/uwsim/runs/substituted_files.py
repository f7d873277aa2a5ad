"""Warnings about bundled files that replace missing files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from ..base.terminal import warn

if TYPE_CHECKING:
    from ..scene.spec import SceneSpec


def warn_of_substituted_files(scene: SceneSpec, data_path: tuple[Path, ...]) -> None:
    """Warn of bundled robots of a scene that replace missing files."""
    from ..model.robots import substitute_robots

    for name, path in substitute_robots(scene, data_path).items():
        place = f"{scene.path}: " if scene.path else ""
        warn(f"{place}robot file {name!r} is not found; the bundled {path.name} is used")
