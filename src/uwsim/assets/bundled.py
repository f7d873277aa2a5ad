"""Paths of scenes and benchmarks by name: files of the user, or bundled files."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

from ..errors import AssetNotFound, did_you_mean


def bundled_files(kind: str, suffix: str = ".xml") -> dict[str, Path]:
    """Return the paths of the bundled files in a folder of ``data``, by name without suffix."""
    folder = Path(str(resources.files("uwsim"))) / "data" / kind
    return {
        path.stem: path for path in sorted(folder.glob(f"*{suffix}"), key=lambda file: file.stem)
    }


def resolve_bundled(file: Path) -> Path:
    """Return a file if it exists, or else the bundled scene or benchmark of that name."""
    if file.exists():
        return file
    return {**bundled_files("scenes"), **bundled_files("benchmarks")}.get(str(file), file)


def scene_file(
    name: str, data_path: tuple[Path, ...] = (), *, named_by: Path | None = None
) -> Path:
    """Find a scene: a file as given, in the search folders, or a bundled one by its bare name.

    A scene that a file names (``named_by``) is in a folder that is searched.

    Raises:
        AssetNotFound: there is no such scene; the error message lists folders and the nearest name.
    """
    return _resolve_file(name, "scenes", data_path, named_by)


def benchmark_file(name: str, data_path: tuple[Path, ...] = ()) -> Path:
    """Find a benchmark, as `scene_file` finds a scene."""
    return _resolve_file(name, "benchmarks", data_path)


def _resolve_file(
    name: str, kind: str, data_path: tuple[Path, ...], named_by: Path | None = None
) -> Path:
    from .find import find, searched_folders

    files = bundled_files(kind)
    if name in files and not Path(name).is_file():
        return files[name]
    path = find(name, named_by=named_by, data_path=data_path)
    if path is not None:
        return path
    folders = searched_folders(named_by=named_by, data_path=data_path)
    raise AssetNotFound(
        f"{name!r} is neither a file nor one of the bundled {kind} ({', '.join(files)})."
        f"{did_you_mean(name, files)} "
        f"Folders searched: {', '.join(str(folder) for folder in folders if folder.is_dir())}."
    )
