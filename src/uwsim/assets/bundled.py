"""Paths of the files named on the command line: as given, or bundled under a bare name."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

from ..errors import AssetNotFound, did_you_mean


def bundled(kind: str, suffix: str = ".xml") -> dict[str, Path]:
    """Return the bundled files of a kind, ``scenes`` or ``benchmarks``: bare name -> path."""
    folder = Path(str(resources.files("uwsim"))) / "data" / kind
    return {
        path.stem: path for path in sorted(folder.glob(f"*{suffix}"), key=lambda file: file.stem)
    }


def bundled_or(file: Path) -> Path:
    """Return the bundled scene or benchmark of that bare name, where there is no such file."""
    if file.exists():
        return file
    return {**bundled("scenes"), **bundled("benchmarks")}.get(str(file), file)


def scene_file(
    name: str, data_path: tuple[Path, ...] = (), *, named_by: Path | None = None
) -> Path:
    """Find a scene: a file as given, in the search folders, or a bundled one by its bare name.

    One that a file names (``named_by``) lies in a folder that is searched.

    Raises:
        AssetNotFound: there is none; names the folders searched and the nearest bundled name.
    """
    return _file(name, "scenes", data_path, named_by)


def benchmark_file(name: str, data_path: tuple[Path, ...] = ()) -> Path:
    """Find a benchmark, as `scene_file` finds a scene."""
    return _file(name, "benchmarks", data_path)


def _file(name: str, kind: str, data_path: tuple[Path, ...], named_by: Path | None = None) -> Path:
    from .find import find, folders_searched

    known = bundled(kind)
    if name in known and not Path(name).is_file():
        return known[name]
    found = find(name, named_by=named_by, data_path=data_path)
    if found is not None:
        return found
    folders = folders_searched(named_by=named_by, data_path=data_path)
    raise AssetNotFound(
        f"{name!r} is neither a file nor one of the bundled {kind} ({', '.join(known)})."
        f"{did_you_mean(name, known)} "
        f"Folders searched: {', '.join(str(folder) for folder in folders if folder.is_dir())}."
    )
