"""File names in specs, which remain valid when a file is written to another folder."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ..assets.find import find
from ..errors import AssetError, BadSetting
from .element import Element
from .tree import walk

FILE_FIELDS = frozenset({"bag", "file", "image_name", "plugin", "scene"})
"""The fields that name files, relative to the folder of the scene or benchmark."""


def move_file_names(root: Element[Any], old_path: str, new_path: Path) -> None:
    """Change the names of files so that a file at ``new_path`` finds the same files.

    Names that are found from both places, as those of bundled files, are unchanged.

    Raises:
        BadSetting: a file is outside the folders that are searched from ``new_path``.
    """
    old_file = Path(old_path) if old_path else None
    outside_names = []
    for element, field, name in list(file_names(root)):
        try:
            target = find(name, named_by=old_file)
        except AssetError:
            continue  # reported when the scene is checked
        if target is None or _finds(name, new_path, target):
            continue
        new_name = os.path.relpath(target.absolute(), new_path.absolute().parent)
        if not _finds(new_name, new_path, target):
            outside_names.append(f"{element.label}: {field} {name!r}")
        elif field == "plugin":
            names = [new_name if other == name else other for other in element._values[field]]
            element.set(**{field: names})
        else:
            element.set(**{field: new_name})
    if outside_names:
        raise BadSetting(
            f"{new_path}: files are outside the folders that are searched from there: "
            f"{', '.join(outside_names[:5])}. Write the file to a folder beside or below them."
        )


def file_names(root: Element[Any]) -> Iterator[tuple[Element[Any], str, str]]:
    """Yield each name of a file with its element and the name of its field."""
    for element in walk(root):
        for field in FILE_FIELDS & element._fields.keys():
            value = element._values[field]
            for name in value if isinstance(value, tuple) else (value,):
                if isinstance(name, str) and name:
                    yield element, field, name


def copy_tables(root: Element[Any], old_path: str, new_path: Path) -> list[Path]:
    """Copy the CSV files that a benchmark names beside its new file, and return the copies.

    A benchmark searches them in its own folder only.
    """
    copies: list[Path] = []
    for element, field, name in list(file_names(root)):
        target = find(name, named_by=Path(old_path) if old_path else None)
        if target is None or target.suffix.lower() != ".csv" or _finds(name, new_path, target):
            continue
        copy = new_path.parent / target.name
        shutil.copyfile(target, copy)
        element.set(**{field: copy.name})
        copies.append(copy)
    return copies


def _finds(name: str, named_by: Path, target: Path) -> bool:
    """Return whether a name in a file refers to a target."""
    try:
        found_path = find(name, named_by=named_by)
        return found_path is not None and found_path.samefile(target)
    except (AssetError, OSError):
        return False
