"""Search for the robot files of a scene, and reading of them."""

from __future__ import annotations

from pathlib import Path

from ..assets import bundled_robot, find, package_remark, searched_folders
from ..errors import AssetNotFound
from ..scene.spec import SceneSpec
from ..scene.urdf.reader import read_urdf
from ..scene.urdf.robot import RobotSpec


def find_file(name: str, named_by: str, data_path: tuple[Path, ...]) -> Path:
    """Return the path of a file that the file ``named_by`` names; raise AssetNotFound."""
    folder = Path(named_by).parent if named_by else None
    path = find(name, named_by=folder, data_path=data_path)
    if path is None:
        remark = package_remark(name, named_by=folder, data_path=data_path)
        search_path = searched_folders(named_by=folder, data_path=data_path)
        folders = ", ".join(str(folder) for folder in search_path if folder.is_dir())
        reason = f"not found; {remark}" if remark else f"in none of the folders searched: {folders}"
        raise AssetNotFound(f"{name!r} is {reason}.", name=name)
    return path


def find_robot(name: str, named_by: str, data_path: tuple[Path, ...]) -> Path:
    """Return the path of a robot file, or of the bundled robot file with the same file name.

    Raises:
        AssetNotFound: there is neither; the error message lists the folders searched.
    """
    try:
        return find_file(name, named_by, data_path)
    except AssetNotFound:
        path = bundled_robot(name)
        if path is None:
            raise
        return path


def substitute_robots(scene: SceneSpec, data_path: tuple[Path, ...] = ()) -> dict[str, Path]:
    """Return the bundled robot file for each robot file that is not found, by its name."""
    named_by = Path(scene.path).parent if scene.path else None
    replacements = {
        vehicle.file: bundled_robot(vehicle.file)
        for vehicle in scene.vehicles
        if find(vehicle.file, named_by=named_by, data_path=data_path) is None
    }
    return {name: path for name, path in replacements.items() if path is not None}


def read_robots(scene: SceneSpec, data_path: tuple[Path, ...]) -> dict[int, RobotSpec]:
    """Find and read the URDF of every vehicle; return the robots by vehicle index.

    Raises:
        AssetNotFound: a file is not found; the error message lists the folders searched.
        SceneError: a file is invalid.
    """
    arguments = dict(scene.expansion.arguments)
    return {
        index: read_urdf(
            find_robot(vehicle.file, scene.path, data_path),
            data_path=data_path,
            arguments=arguments,
        )
        for index, vehicle in enumerate(scene.vehicles)
    }
