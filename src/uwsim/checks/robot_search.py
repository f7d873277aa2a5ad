"""The robot files of a scene, looked for; and from where files are looked for."""

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
"""Number of different robots and models of a scene, and meshes of a robot, that are looked for."""


class Where(TypedDict):
    """From where a file is looked for."""

    named_by: Path | None
    data_path: tuple[Path, ...]


class RobotSearch:
    """The robots of a scene, found and read."""

    def __init__(self, scene: SceneSpec, where: Where, diagnostics: Diagnostics) -> None:
        self.robots: dict[int, RobotSpec] = {}
        """The robot of each vehicle that has one, by its number."""
        self.files: list[Path] = []
        """The files, each once."""
        self.found: list[Diagnostic] = []
        """The robots that are nowhere, or elsewhere than the scene states."""
        self.stand_ins: set[str] = set()
        """Names of files in whose place a bundled robot is read."""
        self._where, self._diagnostics = where, diagnostics
        robots: dict[str, RobotSpec | None] = {}
        for index, vehicle in enumerate(scene.vehicles):
            if vehicle.file not in robots and len(robots) < MAX_FILES:
                robots[vehicle.file] = self._read(vehicle, dict(scene.expansion.arguments))
            if (robot := robots.get(vehicle.file)) is not None:
                self.robots[index] = robot

    def _read(self, vehicle: VehicleSpec, arguments: dict[str, str]) -> RobotSpec | None:
        """Read a vehicle's robot, or else the bundled one of the same file name."""
        name, remark = vehicle.file, ""
        try:
            if path := find(name, **self._where):
                remark = location_remark(name, path, **self._where)
            elif path := bundled_robot(name):
                self.stand_ins.add(name)
                remark = f"robot file {name!r} is nowhere; the bundled {path.name} is used"
            else:
                self.found.append(diagnostic_at(vehicle, self._lost(name)))
                return None
        except AssetError as error:
            self.found.append(diagnostic_at(vehicle, str(error)))
            return None
        if remark:
            self.found.append(diagnostic_at(vehicle, remark, severity="warning"))
        self.files.append(path)
        with suppress(SceneError):  # reported where the file is checked
            return read_urdf(path, data_path=self._where["data_path"], arguments=arguments)
        return None

    def _lost(self, name: str) -> str:
        searched = describe_search(name, **self._where)
        near = self._diagnostics.suggest(name.strip().rpartition("/")[2], bundled_robots())
        return (
            f"robot file {name!r} is nowhere, and no bundled robot is called so.{near} "
            f"{searched[0].upper()}{searched[1:]}"
        )
