"""Search for hydrodynamics sets by name: bundled files, and files next to a scene."""

from __future__ import annotations

from contextlib import suppress
from importlib.resources import files
from pathlib import Path

from ...errors import UnknownName

MAX_HEAD_BYTES = 65536
"""The number of bytes of a file within which its root element must begin."""


def vehicle_sets() -> dict[str, Path]:
    """Return the path of each bundled hydrodynamics set, by name."""
    return {path.stem: path for path in sorted(bundled_folder().glob("*.xml"))}


def find_vehicle(name: str, named_by: Path | None = None) -> Path:
    """Return the path of a hydrodynamics set: ``name.xml`` next to a scene, or a bundled file.

    Args:
        name: the name of the set.
        named_by: the path of the scene that names the set; None: only bundled sets.

    Raises:
        UnknownName: there is no such set.
    """
    if named_by is not None and name == Path(name).name:
        path = named_by.parent / f"{name}.xml"
        with suppress(OSError, ValueError):  # the name is not a valid file name
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
