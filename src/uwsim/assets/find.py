"""Search of files in an ordered list of folders.

A name is looked for next to the file that names it and in each of that file's parent folders, but
the home folder and what is above it; as given; in every data path; in ``~/.uwsim/data`` and
``~/.uwsim``; in the package. Each of these also under ``data``, ``data/scenes``, ``data/vehicles``,
``objects``, ``terrain``, ``robot`` and ``textures``. Before the package the name is looked for
without its first folders, too, next to the file that names it and in every data path: what
``data/scenes/x.urdf`` names lies next to its scene, wherever that was copied to.

``package://NAME/PATH`` is the file PATH of the package NAME (`packages`). Where there is no such
package, and for the package ``uwsim``, PATH is looked for as above. An absolute path of another
computer is looked for by its last parts: the last alone next to the file and in the data paths, two
or more of them wherever a name is.

What a file names lies under one of these folders, links followed: a path that leads elsewhere is an
error, wherever it leads.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path, PureWindowsPath

from ..base.files.input_files import is_inside
from ..errors import AssetError
from .packages import OURS, environment_folders, package_folders, package_of

UNDER = ("", "data", "data/scenes", "data/vehicles", "objects", "terrain", "robot", "textures")
"""Sub-folders that every folder is searched under."""

ROBOTS = ("data/scenes", "data/vehicles")
"""Where our own robots lie in the package."""

PACKAGE = Path(__file__).resolve().parent.parent
"""The package itself; its own files lie in ``data`` below it."""


def plain_name(name: str) -> str:
    """The name without blanks and without ``file://`` or ``package://PACKAGE/``."""
    in_package = package_of(name)
    return name.strip().removeprefix("file://") if in_package is None else in_package[1]


def is_absolute(name: str) -> bool:
    """Whether a name without ``file://`` is an absolute path, of this or another system."""
    return name.startswith(("/", "~")) or bool(PureWindowsPath(name).drive)


def roots(*, named_by: Path | None = None, data_path: tuple[Path, ...] = ()) -> list[Path]:
    """The folders that are searched together with their sub-folders `UNDER`, in order, each once.

    Args:
        named_by: The file that names the file, or its folder.
        data_path: Folders the user gave.
    """
    folders = [*above(named_by), Path()]
    home = Path("~/.uwsim").expanduser()
    folders += [*data_path, home / "data", home, PACKAGE]
    return list(dict.fromkeys(folders))


def above(named_by: Path | None) -> list[Path]:
    """The folder of a file, and those above it that are searched, from the inside."""
    if named_by is None:
        return []
    start = named_by.absolute()
    start = start if start.is_dir() else start.parent
    return [start, *(folder for folder in start.parents if not _holds_homes(folder))]


def folders_searched(
    *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> list[Path]:
    """Every folder a relative name is looked for in, in order, each once; arguments as `roots`."""
    found = roots(named_by=named_by, data_path=data_path)
    return list(dict.fromkeys(root / under for root in found for under in UNDER))


def _holds_homes(folder: Path) -> bool:
    """Whether a folder is the user's home or above it, which is not searched recursively."""
    return folder == folder.parent or Path.home().is_relative_to(folder)


def find(
    name: str, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> Path | None:
    """The file called ``name``, or None when it is in none of the folders searched.

    Raises:
        AssetError: it lies elsewhere, and a file (``named_by``) names it.
    """
    return next(candidates([name], named_by=named_by, data_path=data_path), None)


def bundled_robot(name: str) -> Path | None:
    """The bundled robot file of that file name, in whatever folder; None if there is none."""
    wanted = plain_name(name).replace("\\", "/").rpartition("/")[2]
    own = (PACKAGE / folder / wanted for folder in ROBOTS)
    return next((path for path in own if wanted and _is(path, Path.is_file)), None)


def bundled_robots() -> tuple[str, ...]:
    """The file names of the bundled robots, in alphabetical order."""
    return tuple(
        sorted(path.name for folder in ROBOTS for path in (PACKAGE / folder).glob("*.urdf"))
    )


def candidates(
    names: Sequence[str], *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> Iterator[Path]:
    """Every file that has one of the names: those of the first name in the order of search, ...

    Raises:
        AssetError: the only ones lie elsewhere, and a file (``named_by``) names them.
    """
    searched = roots(named_by=named_by, data_path=data_path)
    allowed = [*searched, *environment_folders()]
    elsewhere, found = "", False
    for name, path in _places(names, searched, named_by, data_path):
        if named_by is None or is_inside(path, allowed):
            found = True
            yield path
        else:
            elsewhere = elsewhere or name
    if elsewhere and not found:
        raise AssetError(
            f"{elsewhere[:200]!r} is outside the folders that are searched, so that it is not "
            "read; --data-path adds a folder.",
            name=elsewhere,
        )


def _places(
    names: Sequence[str], roots: Sequence[Path], named_by: Path | None, data_path: tuple[Path, ...]
) -> Iterator[tuple[str, Path]]:
    """Name and path of every file there is: in its package, else in the folders."""
    in_package = package_of(names[0]) if names else None
    is_package = False
    if in_package is not None:
        tails = [(name, package_of(name)) for name in names]
        for folder in package_folders(in_package[0], above(named_by), data_path):
            is_package = True
            files = ((name, folder / tail[1]) for name, tail in tails if tail is not None)
            yield from ((name, path) for name, path in files if _is(path, Path.is_file))
        if is_package and in_package[0] != OURS:
            return
    yield from _paths(names, roots, _near(named_by, data_path), is_named=named_by is not None)


def _near(named_by: Path | None, data_path: tuple[Path, ...]) -> list[Path]:
    """The folders in which a name is looked for without its first folders."""
    if named_by is None:
        return list(data_path)
    return [named_by if named_by.is_dir() else named_by.parent, *data_path]


def _paths(
    names: Sequence[str], roots: Sequence[Path], near: Sequence[Path], *, is_named: bool
) -> Iterator[tuple[str, Path]]:
    """Name and path of every file there is; ``is_named`` in a file, not by the user."""
    own = len(roots) - (roots[-1] == PACKAGE)  # where a bundled file names it, it is found there
    groups = {"own": roots[:own], "near": near, "package": roots[own:]}
    present: dict[tuple[str, Path], list[Path]] = {}  # by the folder within the name: where it is

    def files(name: Path, group: str) -> Iterator[Path]:
        if (group, name.parent) not in present:
            places = (root / under / name.parent for root in groups[group] for under in UNDER)
            present[group, name.parent] = [place for place in places if _is(place, Path.is_dir)]
        for place in present[group, name.parent]:
            if _is(place / name.name, Path.is_file):
                yield place / name.name

    for name in names:
        plain = plain_name(name)
        wanted = Path(plain).expanduser()
        if is_absolute(plain):
            is_here = _is(wanted, Path.is_file)
            yield from ((name, path) for path in [wanted] if is_here)
            if is_named and not is_here:
                yield from ((name, path) for tail in _tails(plain) for path in files(*tail))
            continue
        yield from ((name, path) for path in files(wanted, "own"))
        if ".." not in wanted.parts:
            for n in range(1, len(wanted.parts)):
                tail = Path(*wanted.parts[n:])
                yield from ((name, path) for path in files(tail, "near"))
        yield from ((name, path) for path in files(wanted, "package"))


def _tails(name: str) -> list[tuple[Path, str]]:
    """The last parts of an absolute path, the most first, and the folders for each."""
    parts = [part for part in name.replace("\\", "/").split("/")[1:] if part]
    if not parts or ".." in parts:
        return []
    longer = [(Path(*parts[n:]), "own") for n in range(len(parts) - 1)]
    return [*longer, (Path(parts[-1]), "near")]


def _is(path: Path, kind: Callable[[Path], bool]) -> bool:
    """Whether the path is of that kind; a name that no file system can have does not exist."""
    try:
        return kind(path)
    except (OSError, ValueError):
        return False
