"""The materials, images and buffers that a mesh file names, if they are in allowed folders.

A file is searched next to the mesh by its name and by the last part of the name, because exporters
write paths of the author's computer. A path outside the allowed folders is an error; a missing file
is not.
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
from .materials import is_broken, open_image

NON_IMAGE_FORMATS = (".mtl", ".bin", ".glb", ".gltf", ".obj")
"""The suffixes of files that a mesh file names and that are no images."""
OPTIONS = re.compile(
    r"\A\s*(?:-(?:(?:blendu|blendv|boost|texres|clamp|cc|bm|imfchan|type)\s+\S+|mm\s+\S+\s+\S+"
    r"|[ost](?:\s+[-+.\d][-+.\de]*){0,3})\s+)+",
    re.IGNORECASE,
)
"""The options before the name of an image in an .mtl file, with values; they are not applied."""


class References:
    """The resolver with which trimesh opens the files that a mesh file names.

    The readers of trimesh suppress errors: they are stored here, and raised by `check`.

    Args:
        folders: The folders to search.
        allowed_folders: The folders that may contain the file.
        read: The reader of a file, by its path and its name.
    """

    def __init__(
        self,
        folders: Iterable[Path],
        allowed_folders: Iterable[Path],
        read: Callable[[Path, PurePosixPath], bytes],
    ) -> None:
        self._folders, self._read = tuple(folders), read
        self._allowed_folders = tuple(allowed_folders)
        self._errors: list[AssetError] = []
        self._images: dict[str, Path] = {}
        self.were_requested = False
        """True if a file was requested."""

    def get(self, name: str) -> bytes:
        """Return the bytes of a file."""
        self.were_requested = True
        try:
            return self._read_named(name)
        except AssetError as error:
            self._errors.append(error)
            raise

    __getitem__ = get

    def image(self, name: str) -> Any:
        """Return an image before its decoding; None if it cannot be opened."""
        try:
            return open_image(self.get(name))
        except Exception:  # Pillow raises whatever its readers raise
            return None

    def check(self) -> None:
        """Raise the first error, if any file was rejected."""
        for error in self._errors:
            raise error

    def broken_images(self, *, is_decoded: bool) -> list[str]:
        """Return the names of the images that were read and cannot be opened or decoded."""
        return [
            name for name, path in self._images.items() if is_broken(path, is_decoded=is_decoded)
        ]

    def _read_named(self, name: str) -> bytes:
        texts = dict.fromkeys((name, OPTIONS.sub("", name, count=1), unquote(name)))
        paths = [PurePosixPath(text.strip().replace("\\", "/")) for text in texts]
        for place in (p for name in paths for p in (name, PurePosixPath(name.name))):
            for folder in self._folders:
                path = folder / place
                if place.is_absolute() or not path.exists():
                    continue
                if is_inside(path, self._allowed_folders):
                    if place.suffix.lower() not in NON_IMAGE_FORMATS:
                        self._images[name] = path
                    return self._read(path, place)
        if any(_path_exists(folder / path) for folder in self._folders for path in paths):
            raise AssetError(
                f"names the file {name[:200]!r} outside its folder; --data-path adds a folder"
            )
        raise FileNotFoundError(name)


def _path_exists(path: Path) -> bool:
    """Return whether a file exists, also through a folder that does not: ``x/../file``."""
    return path.exists() or Path(os.path.normpath(path)).exists()
