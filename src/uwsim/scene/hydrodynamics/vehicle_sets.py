"""Hydrodynamics files by name: the bundled ones, and those next to a scene."""

from __future__ import annotations

from contextlib import suppress
from importlib.resources import files
from pathlib import Path

from ...errors import UnknownName

MAX_HEAD_BYTES = 65536
"""The number of bytes of a file in which its root element begins."""


def vehicle_sets() -> dict[str, Path]:
    """Return the file of each bundled set, by name."""
    return {path.stem: path for path in sorted(bundled_folder().glob("*.xml"))}


def find_vehicle(name: str, named_by: Path | None = None) -> Path:
    """Find the hydrodynamics file of a set: ``name.xml`` next to the scene, or a bundled one.

    Raises:
        UnknownName: there is none.
    """
    if named_by is not None and name == Path(name).name:
        path = named_by.parent / f"{name}.xml"
        with suppress(OSError, ValueError):  # no name of a file
            if path.is_file():
                return path
    bundled_sets = vehicle_sets()
    if name not in bundled_sets:
        raise UnknownName(
            "hydrodynamics set", name, dict.fromkeys([*_sets_in_folder(named_by), *bundled_sets])
        )
    return bundled_sets[name]


def bundled_folder() -> Path:
    """Return the folder of the bundled hydrodynamics files; ``<include>`` searches it last."""
    return Path(str(files("uwsim"))) / "data" / "vehicles"


def _sets_in_folder(named_by: Path | None) -> list[str]:
    names = []
    with suppress(OSError):
        paths = [] if named_by is None else sorted(named_by.parent.glob("*.xml"))
        for path in filter(Path.is_file, paths):
            with path.open("rb") as file:
                if b"<hydrodynamics" in file.read(MAX_HEAD_BYTES):
                    names.append(path.stem)
    return names
