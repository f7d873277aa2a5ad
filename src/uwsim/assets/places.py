"""Sentences about places: of files found elsewhere than their name states, and of lost packages."""

from __future__ import annotations

import filecmp
from pathlib import Path

from .find import above, folders_searched, is_absolute, plain_name
from .packages import OURS, package_folders, package_of, same_named_folders


def package_remark(
    name: str, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> str:
    """Say that the package of a name is not found, or where it is; empty without a package.

    Args:
        name: of a file that is not found, as a scene or robot file has it.
        named_by: the file that names it.
        data_path: folders that the user gave.
    """
    in_package = package_of(name)
    if in_package is None or in_package[0] == OURS:
        return ""
    package = in_package[0]
    folder = next(package_folders(package, above(named_by), data_path), None)
    if folder is None:
        return (
            f"package {package[:200]!r} is not found; --data-path DIR adds its folder, or a "
            "workspace that has it"
        )
    return f"package {package!r} is {folder}, which has no {in_package[1][:200]!r}"


def searched_for(
    name: str, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> str:
    """Say where a file that is not found was looked for: its package, or the folders there are."""
    remark = package_remark(name, named_by=named_by, data_path=data_path)
    folders = folders_searched(named_by=named_by, data_path=data_path)
    return remark or f"searched: {', '.join(str(path) for path in folders if path.is_dir())}"


def may_be_elsewhere(name: str) -> bool:
    """Whether a name states a place, so that its file may be found in another."""
    return package_of(name) is not None or is_absolute(plain_name(name))


def place_remark(
    name: str,
    path: Path | None,
    *,
    named_by: Path | None = None,
    data_path: tuple[Path, ...] = (),
) -> str:
    """Say that a file was found elsewhere than its name states; empty where it is there.

    Args:
        name: of the file, as a scene or robot file has it.
        path: where it was found; None if it is nowhere.
        named_by: the file that names it.
        data_path: folders that the user gave.
    """
    if path is None:
        return ""
    if (in_package := package_of(name)) is not None:
        if in_package[0] == OURS:
            return ""
        folders = same_named_folders(in_package[0], above(named_by), data_path)
        for folder in folders:
            if _differs(other := folder / in_package[1], path):
                return f"package {in_package[0]!r} is there twice; {path} is used, not {other}"
        if folders:
            return ""
        return f"{package_remark(name, named_by=named_by, data_path=data_path)}; {path} is used"
    plain = plain_name(name)
    if is_absolute(plain) and Path(plain).expanduser() != path:
        return f"{plain[:200]!r} is a path of another computer; {path} is used"
    return ""


def _differs(other: Path, path: Path) -> bool:
    """Whether there is another file, with other content."""
    try:
        return other != path and other.is_file() and not filecmp.cmp(other, path, shallow=False)
    except (OSError, ValueError):
        return False
