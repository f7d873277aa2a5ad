"""Search of files in an ordered list of folders.

The search for a name reads, in this order:

1. the folder of the file that names it and the parent folders below the home folder;
2. the current folder, every data path, ``~/.uwsim/data`` and ``~/.uwsim``;
3. for the name without its first folders: the folder of that file and every data path;
4. the folder of this Python package.

All steps but 3 include `SUBFOLDERS`. By step 3, a copied scene finds the files next to it.

``package://NAME/PATH`` is the file PATH of the package NAME (`packages`). Where there is no such
package, and for the package ``uwsim``, the search is for PATH. For an absolute path of another
computer, it is for the last two or more parts of the path, then for the last one as in step 3.

A file that another file names must be in one of these folders after links are resolved; other paths
are an error.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path, PureWindowsPath

from ..base.files.input_files import is_inside
from ..errors import AssetError
from .packages import UWSIM_PACKAGE, environment_folders, package_folders, package_of

SUBFOLDERS = ("", "data", "data/scenes", "data/vehicles", "objects", "terrain", "robot", "textures")
"""The sub-folders in which every folder is searched."""

ROBOT_FOLDERS = ("data/scenes", "data/vehicles")
"""The folders of the bundled robots in the package."""

PACKAGE = Path(__file__).resolve().parent.parent
"""The folder of the package, whose own files are in ``data`` below it."""


def plain_name(name: str) -> str:
    """Return the name without blanks and without ``file://`` or ``package://PACKAGE/``."""
    in_package = package_of(name)
    return name.strip().removeprefix("file://") if in_package is None else in_package[1]


def is_absolute(name: str) -> bool:
    """Return whether a name without ``file://`` is an absolute path, of this or another system."""
    return name.startswith(("/", "~")) or bool(PureWindowsPath(name).drive)


def roots(*, named_by: Path | None = None, data_path: tuple[Path, ...] = ()) -> list[Path]:
    """Return the folders that are searched with their `SUBFOLDERS`, in order, each once.

    Args:
        named_by: The file that names the file, or its folder.
        data_path: The user's folders.
    """
    folders = [*parent_folders(named_by), Path()]
    home = Path("~/.uwsim").expanduser()
    folders += [*data_path, home / "data", home, PACKAGE]
    return list(dict.fromkeys(folders))


def parent_folders(named_by: Path | None) -> list[Path]:
    """Return the folder of a file, and the folders above it that are searched, innermost first."""
    if named_by is None:
        return []
    start = named_by.absolute()
    start = start if start.is_dir() else start.parent
    return [start, *(folder for folder in start.parents if not _contains_home(folder))]


def searched_folders(
    *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> list[Path]:
    """Return all folders searched for a relative name, in order, each once (see `roots`)."""
    folders = roots(named_by=named_by, data_path=data_path)
    return list(dict.fromkeys(root / subfolder for root in folders for subfolder in SUBFOLDERS))


def _contains_home(folder: Path) -> bool:
    """Return whether a folder contains the user's home; its sub-folders are not searched then."""
    return folder == folder.parent or Path.home().is_relative_to(folder)


def find(
    name: str, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> Path | None:
    """Return the file called ``name``, or None when it is in none of the folders searched.

    Raises:
        AssetError: a file (``named_by``) names a file outside of these folders.
    """
    return next(candidates([name], named_by=named_by, data_path=data_path), None)


def bundled_robot(name: str) -> Path | None:
    """Return the bundled robot file with the file name in a path; None if there is none."""
    file_name = plain_name(name).replace("\\", "/").rpartition("/")[2]
    paths = (PACKAGE / folder / file_name for folder in ROBOT_FOLDERS)
    return next((path for path in paths if file_name and _has_kind(path, Path.is_file)), None)


def bundled_robots() -> tuple[str, ...]:
    """Return the file names of the bundled robots, in alphabetical order."""
    return tuple(
        sorted(path.name for folder in ROBOT_FOLDERS for path in (PACKAGE / folder).glob("*.urdf"))
    )


def candidates(
    names: Sequence[str], *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> Iterator[Path]:
    """Yield every file that has one of the names, name by name, in the order of search.

    Raises:
        AssetError: a file (``named_by``) names only files outside of these folders.
    """
    folders = roots(named_by=named_by, data_path=data_path)
    allowed_folders = [*folders, *environment_folders()]
    outside_name, has_match = "", False
    for name, path in _places(names, folders, named_by, data_path):
        if named_by is None or is_inside(path, allowed_folders):
            has_match = True
            yield path
        else:
            outside_name = outside_name or name
    if outside_name and not has_match:
        raise AssetError(
            f"{outside_name[:200]!r} is outside the searched folders, so that it is not read; "
            "--data-path adds a folder.",
            name=outside_name,
        )


def _places(
    names: Sequence[str], roots: Sequence[Path], named_by: Path | None, data_path: tuple[Path, ...]
) -> Iterator[tuple[str, Path]]:
    """Yield the name and the path of every file, in the package or else in the folders."""
    in_package = package_of(names[0]) if names else None
    is_package = False
    if in_package is not None:
        tails = [(name, package_of(name)) for name in names]
        for folder in package_folders(in_package[0], parent_folders(named_by), data_path):
            is_package = True
            files = ((name, folder / tail[1]) for name, tail in tails if tail is not None)
            yield from ((name, path) for name, path in files if _has_kind(path, Path.is_file))
        if is_package and in_package[0] != UWSIM_PACKAGE:
            return
    yield from _paths(
        names, roots, _near_folders(named_by, data_path), is_named=named_by is not None
    )


def _near_folders(named_by: Path | None, data_path: tuple[Path, ...]) -> list[Path]:
    """Return the folders that are searched for a name without its first folders."""
    if named_by is None:
        return list(data_path)
    return [named_by if named_by.is_dir() else named_by.parent, *data_path]


def _paths(
    names: Sequence[str], roots: Sequence[Path], near_folders: Sequence[Path], *, is_named: bool
) -> Iterator[tuple[str, Path]]:
    """Yield the name and the path of every file in folders.

    Args:
        names: the names to search.
        roots: the folders that are searched with their `SUBFOLDERS`.
        near_folders: the folders that are searched for names without their first folders.
        is_named: True if a file names the files, and not the user.
    """
    n_roots = len(roots) - (roots[-1] == PACKAGE)
    groups = {"roots": roots[:n_roots], "near": near_folders, "package": roots[n_roots:]}
    folders: dict[tuple[str, Path], list[Path]] = {}  # by the folder in the name

    def files(name: Path, group: str) -> Iterator[Path]:
        if (group, name.parent) not in folders:
            paths = (root / sub / name.parent for root in groups[group] for sub in SUBFOLDERS)
            folders[group, name.parent] = [path for path in paths if _has_kind(path, Path.is_dir)]
        for folder in folders[group, name.parent]:
            if _has_kind(folder / name.name, Path.is_file):
                yield folder / name.name

    for name in names:
        file_name = plain_name(name)
        requested_path = Path(file_name).expanduser()
        if is_absolute(file_name):
            is_here = _has_kind(requested_path, Path.is_file)
            yield from ((name, path) for path in [requested_path] if is_here)
            if is_named and not is_here:
                yield from ((name, path) for tail in _tails(file_name) for path in files(*tail))
            continue
        yield from ((name, path) for path in files(requested_path, "roots"))
        if ".." not in requested_path.parts:
            for n in range(1, len(requested_path.parts)):
                tail = Path(*requested_path.parts[n:])
                yield from ((name, path) for path in files(tail, "near"))
        yield from ((name, path) for path in files(requested_path, "package"))


def _tails(name: str) -> list[tuple[Path, str]]:
    """Return the ends of an absolute path, longest first, each with the group that is searched."""
    parts = [part for part in name.replace("\\", "/").split("/")[1:] if part]
    if not parts or ".." in parts:
        return []
    long_tails = [(Path(*parts[n:]), "roots") for n in range(len(parts) - 1)]
    return [*long_tails, (Path(parts[-1]), "near")]


def _has_kind(path: Path, kind: Callable[[Path], bool]) -> bool:
    """Return whether a path is of a kind; False for a name that no file system can have."""
    try:
        return kind(path)
    except (OSError, ValueError):
        return False
