"""Files that a mesh file names: materials, images, buffers; only those in its folder are read.

A name is looked for next to the mesh, as given and by its last part alone: exporters write paths of
their author's machine. A path to a file out of the folders given is an error; where there is no
file, the mesh goes without it.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable
from pathlib import Path, PurePosixPath
from typing import Any
from urllib.parse import unquote

from ...base.files.input_files import is_inside
from ...errors import AssetError
from .looks import is_broken, opened

NO_IMAGES = (".mtl", ".bin", ".glb", ".gltf", ".obj")
"""Files that a mesh file names and that are no images."""
OPTIONS = re.compile(
    r"\A\s*(?:-(?:(?:blendu|blendv|boost|texres|clamp|cc|bm|imfchan|type)\s+\S+|mm\s+\S+\s+\S+"
    r"|[ost](?:\s+[-+.\d][-+.\de]*){0,3})\s+)+",
    re.IGNORECASE,
)
"""Options before the name of an image in an .mtl file, with their values; they are not applied."""


class References:
    """The resolver with which trimesh opens the files that a mesh file names.

    Its readers of formats swallow errors: what was refused is kept, and raised by `check`.

    Args:
        folders: The folders that a name is looked for in.
        within: The folders that it may lie in.
        read: Reads a file that was found, by its path and its name.
    """

    def __init__(
        self,
        folders: Iterable[Path],
        within: Iterable[Path],
        read: Callable[[Path, PurePosixPath], bytes],
    ) -> None:
        self._folders, self._within, self._read = tuple(folders), tuple(within), read
        self._refused: list[AssetError] = []
        self._images: dict[str, Path] = {}
        self.were_needed = False
        """Whether any file was asked for."""

    def get(self, name: str) -> bytes:
        """Return the bytes of a file."""
        self.were_needed = True
        try:
            return self._found(name)
        except AssetError as error:
            self._refused.append(error)
            raise

    __getitem__ = get

    def image(self, name: str) -> Any:
        """Return an image that is not decoded yet; None without it, which `check` may report."""
        try:
            return opened(self.get(name))
        except Exception:  # Pillow raises whatever its readers raise
            return None

    def check(self) -> None:
        """Raise the first error, if any file was refused."""
        for error in self._refused:
            raise error

    def broken_images(self, *, is_decoded: bool) -> list[str]:
        """Return the names of the images that were read and cannot be opened, or not decoded."""
        return [
            name for name, path in self._images.items() if is_broken(path, is_decoded=is_decoded)
        ]

    def _found(self, name: str) -> bytes:
        texts = dict.fromkeys((name, OPTIONS.sub("", name, count=1), unquote(name)))
        asked = [PurePosixPath(text.strip().replace("\\", "/")) for text in texts]
        for place in (each for full in asked for each in (full, PurePosixPath(full.name))):
            for folder in self._folders:
                path = folder / place
                if not place.is_absolute() and path.exists() and is_inside(path, self._within):
                    if place.suffix.lower() not in NO_IMAGES:
                        self._images[name] = path
                    return self._read(path, place)
        if any(_exists(folder / full) for folder in self._folders for full in asked):
            raise AssetError(
                f"names the file {name[:200]!r}, which is outside its folder; --data-path adds one"
            )
        raise FileNotFoundError(name)


def _exists(path: Path) -> bool:
    """Whether there is such a file, also by way of a folder that there is not: ``x/../file``."""
    return path.exists() or Path(os.path.normpath(path)).exists()
