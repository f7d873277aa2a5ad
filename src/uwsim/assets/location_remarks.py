"""Remarks about files that are found elsewhere than their names state, and missing packages."""

from __future__ import annotations

import filecmp
from pathlib import Path

from .find import is_absolute, parent_folders, plain_name, searched_folders
from .packages import UWSIM_PACKAGE, package_folders, package_of, same_named_folders


def package_remark(
    name: str, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> str:
    """Return a remark that states where the package of a name is, or that it is not found.

    Args:
        name: the name of a file that is not found, in a scene or robot file.
        named_by: the file that names it.
        data_path: the user's folders.
    """
    in_package = package_of(name)
    if in_package is None or in_package[0] == UWSIM_PACKAGE:
        return ""
    package = in_package[0]
    folder = next(package_folders(package, parent_folders(named_by), data_path), None)
    if folder is None:
        return (
            f"package {package[:200]!r} is not found; --data-path DIR adds its folder, or a "
            "workspace that has it"
        )
    return f"package {package!r} is {folder}, which has no {in_package[1][:200]!r}"


def describe_search(
    name: str, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> str:
    """Return the text that states where a missing file was searched."""
    remark = package_remark(name, named_by=named_by, data_path=data_path)
    folders = searched_folders(named_by=named_by, data_path=data_path)
    return remark or f"searched: {', '.join(str(path) for path in folders if path.is_dir())}"


def states_location(name: str) -> bool:
    """Return whether a name states a folder or a package, so that a file may be found elsewhere."""
    return package_of(name) is not None or is_absolute(plain_name(name))


def location_remark(
    name: str, path: Path | None, *, named_by: Path | None = None, data_path: tuple[Path, ...] = ()
) -> str:
    """Return a remark if a file was found elsewhere than its name states; otherwise "".

    Args:
        name: the name of the file in a scene or robot file.
        path: the path of the file; None if it is not found.
        named_by: the file that names it.
        data_path: the user's folders.
    """
    if path is None:
        return ""
    if (in_package := package_of(name)) is not None:
        if in_package[0] == UWSIM_PACKAGE:
            return ""
        folders = same_named_folders(in_package[0], parent_folders(named_by), data_path)
        for folder in folders:
            if _is_different_file(other := folder / in_package[1], path):
                return f"package {in_package[0]!r} exists twice; {path} is used, not {other}"
        if folders:
            return ""
        return f"{package_remark(name, named_by=named_by, data_path=data_path)}; {path} is used"
    file_name = plain_name(name)
    if is_absolute(file_name) and Path(file_name).expanduser() != path:
        return f"{file_name[:200]!r} is a path of another computer; {path} is used"
    return ""


def _is_different_file(other: Path, path: Path) -> bool:
    try:
        return other != path and other.is_file() and not filecmp.cmp(other, path, shallow=False)
    except (OSError, ValueError):
        return False
