"""The search for the robot files of the vehicles in a scene."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import TypedDict

from ..assets import bundled_robot, bundled_robots, describe_search, find, location_remark
from ..errors import AssetError, Diagnostic, SceneError
from ..scene.spec import SceneSpec
from ..scene.urdf.reader import read_urdf
from ..scene.urdf.robot import RobotSpec
from ..scene.vehicle import VehicleSpec
from ..schema import Diagnostics, diagnostic_at

MAX_FILES = 200
"""The greatest number of robots and models of a scene, and meshes of a robot, that are searched."""


class FileSearch(TypedDict):
    """The keyword arguments of the functions that search for a file (`uwsim.assets.find`)."""

    named_by: Path | None
    """The file that names the file; None for a spec without a file."""
    data_path: tuple[Path, ...]
    """The folders that are searched."""


class RobotSearch:
    """The robots of a scene, found and read.

    Args:
        scene: the scene.
        file_search: the arguments of the search for files that the scene names.
        diagnostics: the diagnostics of the scene's reader, which limit the number of suggestions.
    """

    def __init__(self, scene: SceneSpec, file_search: FileSearch, diagnostics: Diagnostics) -> None:
        self.robots: dict[int, RobotSpec] = {}
        """The robot of each vehicle whose robot file could be read, by index of the vehicle."""
        self.files: list[Path] = []
        """The robot files that were found, each once."""
        self.diagnostics: list[Diagnostic] = []
        """Errors and warnings about robot files that are not found, or not at the stated path."""
        self.substituted_files: set[str] = set()
        """The names of robot files that are not found, and that bundled robots replace."""
        self._file_search, self._diagnostics = file_search, diagnostics
        robots: dict[str, RobotSpec | None] = {}
        for index, vehicle in enumerate(scene.vehicles):
            if vehicle.file not in robots and len(robots) < MAX_FILES:
                robots[vehicle.file] = self._read(vehicle, dict(scene.expansion.arguments))
            if (robot := robots.get(vehicle.file)) is not None:
                self.robots[index] = robot

    def _read(self, vehicle: VehicleSpec, arguments: dict[str, str]) -> RobotSpec | None:
        """Read a vehicle's robot file, or else the bundled robot with the same file name."""
        name, remark = vehicle.file, ""
        try:
            if path := find(name, **self._file_search):
                remark = location_remark(name, path, **self._file_search)
            elif path := bundled_robot(name):
                self.substituted_files.add(name)
                remark = f"robot file {name!r} is not found; the bundled {path.name} is used"
            else:
                self.diagnostics.append(diagnostic_at(vehicle, self._missing_message(name)))
                return None
        except AssetError as error:
            self.diagnostics.append(diagnostic_at(vehicle, str(error)))
            return None
        if remark:
            self.diagnostics.append(diagnostic_at(vehicle, remark, severity="warning"))
        self.files.append(path)
        with suppress(SceneError):  # reported where the file is checked
            return read_urdf(path, data_path=self._file_search["data_path"], arguments=arguments)
        return None

    def _missing_message(self, name: str) -> str:
        search_text = describe_search(name, **self._file_search)
        suggestion = self._diagnostics.suggest(name.strip().rpartition("/")[2], bundled_robots())
        return (
            f"robot file {name!r} is not found, and no bundled robot has this name.{suggestion} "
            f"{search_text[0].upper()}{search_text[1:]}"
        )
