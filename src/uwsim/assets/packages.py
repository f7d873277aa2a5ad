"""ROS packages: the folders that a package's name stands for, in ``package://NAME/...``.

A package is a folder called NAME, or one whose ``package.xml`` gives that name. It is looked for

1. above the file that names it, and beside each of these folders, also as a workspace has it:
   ``src/NAME``, ``share/NAME``, ``install/NAME/share/NAME``;
2. in and below every data path;
3. below the folders of ``ROS_PACKAGE_PATH``, and as ``share/NAME`` in those of
   ``AMENT_PREFIX_PATH``;
4. where the file lies in a package or in a workspace, in all folders of the workspace.

Below a folder, those in another package count, too, after all others: Gazebo's models usually are
``PACKAGE/models/NAME/model.config``.

The package ``uwsim`` is the original's, whose files are also looked for without its name.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

PREFIXES = ("package://", "model://")
"""Beginnings of the names that a package, or a model of Gazebo, is part of."""
OURS = "uwsim"
"""The package whose files are those of this program and of the original."""
LAYOUTS = (".", "src", "share", "install/share", "devel/share", "install/{0}/share", "{0}/share")
"""Where a folder has a package: below these, as a folder of its name."""
BUILT = ("build", "devel", "install", ".catkin_tools", ".catkin_workspace")
"""What tells a workspace from another folder with a ``src``."""
LEFT_OUT = frozenset({"build", "log", "logs", "node_modules", "__pycache__", "site-packages"})
"""Folders without packages of their own."""
WORKSPACE_DEPTH = 5
"""Deepest folder that is looked at below a workspace or a data path: ``src/GROUP/REPOSITORY/X``."""
REPOSITORY_DEPTH = 3
"""Deepest folder that is looked at below the two folders above a package: ``GROUP/X`` beside it."""
MAX_FOLDERS = 4000
"""Most folders that are looked at below one, and as many again in the packages there."""
FILE_SCHEME = re.compile(rf"file:/*(?=(?:{'|'.join(PREFIXES)}))")
"""What some robot files write before the name of a package, as ``file:///$(find NAME)/...``."""
NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]*")
DECLARED = re.compile(rb"<name>\s*([A-Za-z0-9_.-]+)\s*</name>")
MODEL_FILE = "model.config"
"""The file that makes a folder a model of Gazebo."""
HEAD = 65536
"""Bytes of a ``package.xml`` in which its name is looked for."""


def without_file_scheme(name: str) -> str:
    """Return a name without blanks, and without ``file:`` and slashes before ``package://``."""
    name = name.strip()
    found = FILE_SCHEME.match(name)
    return name[found.end() :] if found else name


def package_of(name: str) -> tuple[str, str] | None:
    """Split a name into its package and the path in it; None where it has no package.

    Slashes before the package (``package:///NAME``) are left out.
    """
    name = without_file_scheme(name)
    for prefix in PREFIXES:
        if name.startswith(prefix):
            package, _, path = name.removeprefix(prefix).lstrip("/").partition("/")
            return package, path.lstrip("/")
    return None


def package_folders(
    package: str, above: Iterable[Path], data_path: Iterable[Path] = ()
) -> Iterator[Path]:
    """Give every folder that a package's name may stand for, the likeliest first.

    Args:
        package: its name.
        above: the folder of the file that names it, and those above it, from the inside.
        data_path: folders that the user gave.
    """
    seen: set[Path] = set()
    for folders in _places(package, list(above), data_path):
        yield from _fresh(folders, seen)


def same_named_folders(
    package: str, above: Iterable[Path], data_path: Iterable[Path] = ()
) -> list[Path]:
    """Return the folders of a package in the first place that has it; more than one are doubtful.

    Args:
        package: its name.
        above: the folder of the file that names it, and those above it, from the inside.
        data_path: folders that the user gave.
    """
    places = (list(_fresh(place, set())) for place in _places(package, list(above), data_path))
    return next((folders for folders in places if folders), [])


def _places(package: str, above: list[Path], data_path: Iterable[Path]) -> Iterator[Iterable[Path]]:
    """Give the folders that may be the package, place by place, in the order of search."""
    if not NAME.fullmatch(package):
        return
    for folder in above:
        yield _in(package, folder, 0)
    for folder in (*data_path, *_entries("ROS_PACKAGE_PATH")):
        yield _in(package, folder.absolute(), WORKSPACE_DEPTH)
    for prefix in _entries("AMENT_PREFIX_PATH"):
        yield [prefix / "share" / package]
    enclosing = next((i for i, folder in enumerate(above) if _declared(folder)), len(above))
    for i, folder in enumerate(above):
        is_near = enclosing < i <= enclosing + 2
        depth = WORKSPACE_DEPTH if _is_workspace(folder) else REPOSITORY_DEPTH * is_near
        yield _in(package, folder, depth)


def environment_folders() -> list[Path]:
    """Return the folders in which the environment variables of ROS have packages."""
    shares = [prefix / "share" for prefix in _entries("AMENT_PREFIX_PATH")]
    return [*_entries("ROS_PACKAGE_PATH"), *shares]


def _entries(variable: str) -> list[Path]:
    words = os.environ.get(variable, "").split(os.pathsep)
    return [Path(word) for word in words if Path(word).is_absolute()]


def _fresh(folders: Iterable[Path], seen: set[Path]) -> Iterator[Path]:
    """Give those that are folders, each once."""
    for folder in folders:
        if folder not in seen and _is_folder(folder):
            seen.add(folder)
            yield folder


def _in(package: str, folder: Path, depth: int) -> Iterator[Path]:
    """Give the folders of a package that are this folder, or in it, to a depth."""
    if folder.name == package or _declared(folder) == package:
        yield folder
    yield from (folder / layout.format(package) / package for layout in LAYOUTS)
    if depth > 0:
        yield from _packages_below(folder, depth).get(package, ())


def _is_workspace(folder: Path) -> bool:
    is_built = _is_folder(folder / "src") and any((folder / name).exists() for name in BUILT)
    return folder.name == "src" or is_built


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except (OSError, ValueError):
        return False


def _declared(folder: Path) -> str:
    """Return the name in the ``package.xml`` of a folder; empty without one."""
    try:
        with (folder / "package.xml").open("rb") as file:
            found = DECLARED.search(file.read(HEAD))
    except (OSError, ValueError):
        return ""
    return found[1].decode() if found else folder.name


@dataclass(frozen=True)
class _Index:
    """The packages below a folder, and when what was looked at had last changed."""

    stamps: dict[Path, int]
    packages: dict[str, tuple[Path, ...]]

    def is_current(self) -> bool:
        return all(_stamp(path) == stamp for path, stamp in self.stamps.items())


_indices: dict[tuple[Path, int], _Index] = {}


def _packages_below(root: Path, depth: int) -> dict[str, tuple[Path, ...]]:
    """Return name -> folders below a folder, those with a ``package.xml`` of that name first."""
    index = _indices.get((root, depth))
    if index is None or not index.is_current():
        index = _indices[root, depth] = _walk(root, depth)
    return index.packages


def _walk(root: Path, depth: int) -> _Index:
    """Look at the folders below one, level by level, in alphabetical order; packages at last."""
    stamps: dict[Path, int] = {}
    declared: dict[str, list[Path]] = {}
    named: dict[str, list[Path]] = {}
    inside: list[list[Path]] = []
    level = [root]
    for _ in range(depth):
        below, packages = [], []
        for child in _new_children(level, stamps, MAX_FOLDERS):
            named.setdefault(child.name, []).append(child)
            if name := _declared(child):
                stamps[child / "package.xml"] = _stamp(child / "package.xml")
                declared.setdefault(name, []).append(child)
                packages.append(child)
            else:
                below.append(child)
        inside.append(packages)
        level = below
    models, others = _walk_packages(inside, stamps)
    stamps[root] = _stamp(root)
    groups = (declared, named, models)
    names = dict.fromkeys(name for group in groups for name in group)
    found = {
        name: tuple(path for group in groups for path in group.get(name, ())) for name in names
    }
    return _Index(stamps, {**{name: tuple(paths) for name, paths in others.items()}, **found})


def _walk_packages(
    packages: Iterable[list[Path]], stamps: dict[Path, int]
) -> tuple[dict[str, list[Path]], dict[str, list[Path]]]:
    """Look at the folders in packages, down to the level of the deepest.

    Args:
        packages: by their level.
        stamps: when each folder had last changed; those looked at are added.

    Returns:
        Models of Gazebo and other folders, by their names.
    """
    models: dict[str, list[Path]] = {}
    others: dict[str, list[Path]] = {}
    most = len(stamps) + MAX_FOLDERS
    level: list[Path] = []
    for beside in packages:
        below = list(islice(_new_children(level, stamps, most), most - len(stamps)))
        for child in below:
            group = models if os.path.isfile(child / MODEL_FILE) else others
            group.setdefault(child.name, []).append(child)
        level = [*below, *beside]
    return models, others


def _new_children(level: Iterable[Path], stamps: dict[Path, int], most: int) -> Iterator[Path]:
    """Give the folders in those of a level, and stamp them, until there are ``most`` stamps."""
    for folder in level:
        for child in _children(folder) if len(stamps) < most else ():
            if child not in stamps:
                stamps[child] = _stamp(child)
                yield child


def _children(folder: Path) -> list[Path]:
    """Return the folders in one that may have packages, in alphabetical order."""
    try:
        names = sorted(entry.name for entry in os.scandir(folder) if entry.is_dir())
    except OSError:
        return []
    return [folder / name for name in names if name not in LEFT_OUT and name[0] != "."]


def _stamp(path: Path) -> int:
    try:
        return path.stat().st_mtime_ns
    except OSError:
        return 0
