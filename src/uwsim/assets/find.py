"""Where files are: the folders that a name is looked for in, in order.

A name is looked for as given; beside the file that names it and in each of that file's parent
folders; in every data path; in ``~/.uwsim/data``; in the package. Each of these also under
``data``, ``data/scenes``, ``objects``, ``terrain``, ``robot`` and ``textures``.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

UNDER = ("", "data", "data/scenes", "objects", "terrain", "robot", "textures")
"""Sub-folders that every folder is searched under."""

PACKAGE = Path(__file__).resolve().parent.parent
"""The package itself; its own files lie in ``data`` below it."""


def plain_name(name: str) -> str:
    """The name without blanks and without ``file://`` or ``package://PACKAGE/``."""
    name = name.strip()
    if name.startswith("file://"):
        return name.removeprefix("file://")
    if name.startswith("package://"):
        return name.removeprefix("package://").partition("/")[2]
    return name


def roots(*, beside: Path | None = None, data_path: tuple[Path, ...] = ()) -> list[Path]:
    """The folders that are searched together with their sub-folders `UNDER`, in order, each once.

    Args:
        beside: The file that names the file, or its folder.
        data_path: Folders the user gave.
    """
    folders = [Path()]
    if beside is not None:
        start = beside.absolute()
        start = start if start.is_dir() else start.parent
        folders += [start, *start.parents]
    folders += [*data_path, Path("~/.uwsim/data").expanduser(), PACKAGE]
    return list(dict.fromkeys(folders))


def folders_searched(*, beside: Path | None = None, data_path: tuple[Path, ...] = ()) -> list[Path]:
    """Every folder a relative name is looked for in, in order, each once; arguments as `roots`."""
    found = roots(beside=beside, data_path=data_path)
    return list(dict.fromkeys(root / under for root in found for under in UNDER))


def find(name: str, *, beside: Path | None = None, data_path: tuple[Path, ...] = ()) -> Path | None:
    """The file called ``name``, or None when it is in none of the folders searched."""
    return next(candidates(name, beside=beside, data_path=data_path), None)


def candidates(
    name: str, *, beside: Path | None = None, data_path: tuple[Path, ...] = ()
) -> Iterator[Path]:
    """Every file called ``name``, in the order of search."""
    wanted = Path(plain_name(name)).expanduser()
    if wanted.is_absolute():
        if _is_file(wanted):
            yield wanted
        return
    for folder in folders_searched(beside=beside, data_path=data_path):
        if _is_file(folder / wanted):
            yield folder / wanted


def _is_file(path: Path) -> bool:
    """Whether there is a file; names no file system can have are simply not there."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False
