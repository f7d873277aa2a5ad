"""Hydrodynamics files by name: the bundled ones, and those next to a scene."""

from __future__ import annotations

from contextlib import suppress
from importlib.resources import files
from pathlib import Path

from ...errors import UnknownName

HEAD = 65536
"""Bytes of a file in which its root element begins."""


def vehicle_sets() -> dict[str, Path]:
    """The bundled sets: name -> file."""
    return {path.stem: path for path in sorted(bundled_folder().glob("*.xml"))}


def find_vehicle(name: str, named_by: Path | None = None) -> Path:
    """Find the hydrodynamics file of a set: ``name.xml`` next to the scene, or a bundled one.

    Raises:
        UnknownName: there is none.
    """
    if named_by is not None and name == Path(name).name:
        own = named_by.parent / f"{name}.xml"
        with suppress(OSError, ValueError):  # no name of a file
            if own.is_file():
                return own
    known = vehicle_sets()
    if name not in known:
        raise UnknownName("hydrodynamics set", name, dict.fromkeys([*_own_sets(named_by), *known]))
    return known[name]


def bundled_folder() -> Path:
    """The folder of the bundled hydrodynamics files; ``<include>`` searches it last."""
    return Path(str(files("uwsim"))) / "data" / "vehicles"


def _own_sets(named_by: Path | None) -> list[str]:
    """Names of the hydrodynamics files next to a scene."""
    found = []
    with suppress(OSError):
        found_here = [] if named_by is None else sorted(named_by.parent.glob("*.xml"))
        for path in filter(Path.is_file, found_here):
            with path.open("rb") as file:
                if b"<hydrodynamics" in file.read(HEAD):
                    found.append(path.stem)
    return found
