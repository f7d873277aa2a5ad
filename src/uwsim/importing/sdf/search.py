"""Search of the files that SDF files include, on this computer alone."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ...assets.find import parent_folders
from ...assets.packages import MODEL_FILE, package_folders, package_of
from ...errors import FileError
from ...schema import parse
from .values import attribute_of, children_of

VARIABLES = (
    "GZ_SIM_RESOURCE_PATH",
    "IGN_GAZEBO_RESOURCE_PATH",
    "SDF_PATH",
    "GAZEBO_MODEL_PATH",
    "GAZEBO_RESOURCE_PATH",
)
"""The environment variables in which Gazebo has folders of models."""
MAX_FILES = 500
"""The greatest number of files that an import reads."""
MAX_INCLUDE_DEPTH = 16
"""The deepest chain of files that include each other."""


def environment_folders() -> tuple[Path, ...]:
    """Return the folders of Gazebo's environment variables that exist."""
    words = [word for name in VARIABLES for word in os.environ.get(name, "").split(os.pathsep)]
    folders = dict.fromkeys(Path(word) for word in words if Path(word).is_absolute())
    return tuple(folder for folder in folders if folder.is_dir())


@dataclass(frozen=True)
class ModelSearch:
    """The search of included models.

    Args:
        data_path: the folders of models: a model NAME is NAME/model.config in one of them.
    """

    data_path: tuple[Path, ...]

    def find(self, uri: str, named_by: Path) -> Path | None:
        """Return the SDF file of an included model; None if it is not on this computer.

        Args:
            uri: ``model://NAME``, ``package://NAME/...``, the name of a folder, or of a file.
            named_by: the file that includes it.
        """
        for path in self._candidates(uri, named_by):
            if path.is_dir():
                if (file := model_file(path)) is not None:
                    return file
            elif path.is_file():
                return path
        return None

    def _candidates(self, uri: str, named_by: Path) -> Iterator[Path]:
        in_package = package_of(uri)
        if in_package is not None:
            name, rest = in_package
            yield from (folder / name / rest for folder in self.data_path)
            folders = package_folders(name, parent_folders(named_by), self.data_path)
            yield from (folder / rest for folder in folders)
            return
        name = uri.removeprefix("file://")
        if "://" in name:
            return
        yield named_by.parent / name
        if not Path(name).is_absolute():
            yield from (folder / name for folder in self.data_path)
            yield named_by.parent.parent / name


def model_file(folder: Path) -> Path | None:
    """Return the SDF file that the ``model.config`` of a folder names, of the highest version."""
    config = folder / MODEL_FILE
    if not config.is_file():
        default = folder / "model.sdf"
        return default if default.is_file() else None
    try:
        root = parse(config).root
    except FileError:
        return None
    versions: list[tuple[tuple[int, ...], str]] = []
    for node in children_of(root, "sdf"):
        words = (attribute_of(node, "version") or "0").split(".")
        version = tuple(int(word) if word.isdecimal() else 0 for word in words[:3])
        versions.append((version, (node.text or "").strip()))
    names = [name for _, name in sorted(versions, key=lambda item: item[0])]
    file = folder / (names[-1] if names else "model.sdf")
    return file if file.is_file() and file.resolve().is_relative_to(folder.resolve()) else None
