"""Search of the folders of ROS packages, which files name as ``package://NAME/...``.

A package is a folder called NAME, or one whose ``package.xml`` states that name. The search reads

1. the folders above the file that names it, and in each of these the layouts of a workspace:
   ``src/NAME``, ``share/NAME``, ``install/NAME/share/NAME``;
2. every data path and the folders below it;
3. the folders below those of ``ROS_PACKAGE_PATH``, and ``share/NAME`` in those of
   ``AMENT_PREFIX_PATH``;
4. if the file is in a package or in a workspace, all folders of the workspace.

Folders in another package come after all others: Gazebo's models usually are
``PACKAGE/models/NAME/model.config``.

The package ``uwsim`` is that of the original UWSim, whose files are also found without its name.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

PREFIXES = ("package://", "model://")
"""The beginnings of names in a ROS package or a model of Gazebo."""
UWSIM_PACKAGE = "uwsim"
"""The name of the package of the original UWSim, whose files are also part of this program."""
LAYOUTS = (".", "src", "share", "install/share", "devel/share", "install/{0}/share", "{0}/share")
"""The folders below a root that may contain the folder of a package."""
BUILD_NAMES = ("build", "devel", "install", ".catkin_tools", ".catkin_workspace")
"""The entries that distinguish a workspace from another folder with a ``src``."""
IGNORED_FOLDERS = frozenset(
    {"build", "log", "logs", "node_modules", "__pycache__", "site-packages"}
)
"""The folders without packages of their own."""
WORKSPACE_DEPTH = 5
"""The depth of search below a workspace or a data path: ``src/GROUP/REPOSITORY/X``."""
REPOSITORY_DEPTH = 3
"""The depth of search below the two folders above a package: ``GROUP/X`` beside it."""
MAX_FOLDERS = 4000
"""The greatest number of folders that are read below a root, and again in the packages there."""
FILE_SCHEME = re.compile(rf"file:/*(?=(?:{'|'.join(PREFIXES)}))")
"""The scheme of some robot files before a package's name, as ``file:///$(find NAME)/...``."""
NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]*")
NAME_ELEMENT = re.compile(rb"<name>\s*([A-Za-z0-9_.-]+)\s*</name>")
MODEL_FILE = "model.config"
"""The file that makes a folder a model of Gazebo."""
MAX_HEAD_BYTES = 65536
"""The number of bytes of a ``package.xml`` that are searched for its name."""


def strip_file_scheme(name: str) -> str:
    """Return a name without blanks, and without ``file:`` and slashes before ``package://``."""
    name = name.strip()
    match = FILE_SCHEME.match(name)
    return name[match.end() :] if match else name


def package_of(name: str) -> tuple[str, str] | None:
    """Split a name into its package and the path in it; None where it has no package.

    Slashes before the package (``package:///NAME``) are removed.
    """
    name = strip_file_scheme(name)
    for prefix in PREFIXES:
        if name.startswith(prefix):
            package, _, path = name.removeprefix(prefix).lstrip("/").partition("/")
            return package, path.lstrip("/")
    return None


def package_folders(
    package: str, parents: Iterable[Path], data_path: Iterable[Path] = ()
) -> Iterator[Path]:
    """Yield every folder that may be the package of a name, in the order of the search.

    Args:
        package: the name of the package.
        parents: the folder of the file that names it, and the folders above, innermost first.
        data_path: the user's folders.
    """
    known_folders: set[Path] = set()
    for folders in _candidate_groups(package, list(parents), data_path):
        yield from _new_folders(folders, known_folders)


def same_named_folders(
    package: str, parents: Iterable[Path], data_path: Iterable[Path] = ()
) -> list[Path]:
    """Return the folders of a package in the first step of the search that finds any.

    Several folders are ambiguous.

    Args:
        package: the name of the package.
        parents: the folder of the file that names it, and the folders above, innermost first.
        data_path: the user's folders.
    """
    groups = (
        list(_new_folders(group, set()))
        for group in _candidate_groups(package, list(parents), data_path)
    )
    return next((folders for folders in groups if folders), [])


def _candidate_groups(
    package: str, parents: list[Path], data_path: Iterable[Path]
) -> Iterator[Iterable[Path]]:
    """Yield the folders that may be the package, step by step, in the order of the search."""
    if not NAME.fullmatch(package):
        return
    for folder in parents:
        yield _package_folders_in(package, folder, 0)
    for folder in (*data_path, *_entries("ROS_PACKAGE_PATH")):
        yield _package_folders_in(package, folder.absolute(), WORKSPACE_DEPTH)
    for prefix in _entries("AMENT_PREFIX_PATH"):
        yield [prefix / "share" / package]
    package_index = next(
        (i for i, folder in enumerate(parents) if _declared_name(folder)), len(parents)
    )
    for i, folder in enumerate(parents):
        is_near = package_index < i <= package_index + 2
        depth = WORKSPACE_DEPTH if _is_workspace(folder) else REPOSITORY_DEPTH * is_near
        yield _package_folders_in(package, folder, depth)


def environment_folders() -> list[Path]:
    """Return the folders in which the environment variables of ROS have packages."""
    shares = [prefix / "share" for prefix in _entries("AMENT_PREFIX_PATH")]
    return [*_entries("ROS_PACKAGE_PATH"), *shares]


def _entries(variable: str) -> list[Path]:
    words = os.environ.get(variable, "").split(os.pathsep)
    return [Path(word) for word in words if Path(word).is_absolute()]


def _new_folders(folders: Iterable[Path], known_folders: set[Path]) -> Iterator[Path]:
    """Yield the folders that exist, each once."""
    for folder in folders:
        if folder not in known_folders and _is_folder(folder):
            known_folders.add(folder)
            yield folder


def _package_folders_in(package: str, folder: Path, depth: int) -> Iterator[Path]:
    """Yield the folders of a package that are this folder, or in it, to a depth."""
    if folder.name == package or _declared_name(folder) == package:
        yield folder
    yield from (folder / layout.format(package) / package for layout in LAYOUTS)
    if depth > 0:
        yield from _packages_below(folder, depth).get(package, ())


def _is_workspace(folder: Path) -> bool:
    is_built = _is_folder(folder / "src") and any((folder / name).exists() for name in BUILD_NAMES)
    return folder.name == "src" or is_built


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except (OSError, ValueError):
        return False


def _declared_name(folder: Path) -> str:
    """Return the name in the ``package.xml`` of a folder; empty without one."""
    try:
        with (folder / "package.xml").open("rb") as file:
            match = NAME_ELEMENT.search(file.read(MAX_HEAD_BYTES))
    except (OSError, ValueError):
        return ""
    return match[1].decode() if match else folder.name


@dataclass(frozen=True)
class _Index:
    """The packages below a folder, and the modification times of the files and folders read."""

    stamps: dict[Path, int]
    packages: dict[str, tuple[Path, ...]]

    def is_current(self) -> bool:
        return all(_stamp(path) == stamp for path, stamp in self.stamps.items())


_indices: dict[tuple[Path, int], _Index] = {}


def _packages_below(root: Path, depth: int) -> dict[str, tuple[Path, ...]]:
    """Return the folders of packages below a root by name, those with a ``package.xml`` first."""
    index = _indices.get((root, depth))
    if index is None or not index.is_current():
        index = _indices[root, depth] = _walk(root, depth)
    return index.packages


def _walk(root: Path, depth: int) -> _Index:
    """Read the folders below a root by level, in alphabetical order; those in packages last."""
    stamps: dict[Path, int] = {}
    declared_folders: dict[str, list[Path]] = {}
    named_folders: dict[str, list[Path]] = {}
    packages_by_level: list[list[Path]] = []
    parents = [root]
    for _ in range(depth):
        subfolders, packages = [], []
        for child in _new_children(parents, stamps, MAX_FOLDERS):
            named_folders.setdefault(child.name, []).append(child)
            if name := _declared_name(child):
                stamps[child / "package.xml"] = _stamp(child / "package.xml")
                declared_folders.setdefault(name, []).append(child)
                packages.append(child)
            else:
                subfolders.append(child)
        packages_by_level.append(packages)
        parents = subfolders
    models, rest = _walk_packages(packages_by_level, stamps)
    stamps[root] = _stamp(root)
    groups = (declared_folders, named_folders, models)
    names = dict.fromkeys(name for group in groups for name in group)
    folders = {
        name: tuple(path for group in groups for path in group.get(name, ())) for name in names
    }
    return _Index(stamps, {name: tuple(paths) for name, paths in rest.items()} | folders)


def _walk_packages(
    packages: Iterable[list[Path]], stamps: dict[Path, int]
) -> tuple[dict[str, list[Path]], dict[str, list[Path]]]:
    """Read the folders in packages, down to the level of the deepest package.

    Args:
        packages: the folders of packages, by their level.
        stamps: the modification time of each folder, to which visited folders are added.

    Returns:
        Models of Gazebo and other folders, by their names.
    """
    models: dict[str, list[Path]] = {}
    folders: dict[str, list[Path]] = {}
    limit = len(stamps) + MAX_FOLDERS
    parents: list[Path] = []
    for packages_here in packages:
        subfolders = list(islice(_new_children(parents, stamps, limit), limit - len(stamps)))
        for child in subfolders:
            group = models if os.path.isfile(child / MODEL_FILE) else folders
            group.setdefault(child.name, []).append(child)
        parents = [*subfolders, *packages_here]
    return models, folders


def _new_children(parents: Iterable[Path], stamps: dict[Path, int], limit: int) -> Iterator[Path]:
    """Yield the subfolders of folders, and add their time stamps, until there are ``limit``."""
    for folder in parents:
        for child in _children(folder) if len(stamps) < limit else ():
            if child not in stamps:
                stamps[child] = _stamp(child)
                yield child


def _children(folder: Path) -> list[Path]:
    """Return the sub-folders that may have packages, in alphabetical order."""
    try:
        names = sorted(entry.name for entry in os.scandir(folder) if entry.is_dir())
    except OSError:
        return []
    return [folder / name for name in names if name not in IGNORED_FOLDERS and name[0] != "."]


def _stamp(path: Path) -> int:
    try:
        return path.stat().st_mtime_ns
    except OSError:
        return 0
