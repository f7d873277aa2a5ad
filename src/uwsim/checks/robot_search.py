"""The robot files of a scene, looked for."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from ..assets import bundled_robot, bundled_robots, find, place_remark, searched_for
from ..errors import AssetError, Diagnostic, SceneError
from ..scene.spec import SceneSpec
from ..scene.urdf.reader import read_urdf
from ..scene.urdf.robot import RobotSpec
from ..scene.vehicle import VehicleSpec
from ..schema import Diagnostics, diagnostic_at

MAX_FILES = 200
"""Number of different robots and models of a scene, and meshes of a robot, that are looked for."""


class RobotSearch:
    """Finds and reads the robots of a scene, and collects what is remarkable about their places.

    Args:
        scene: spec of the scene.
        data_path: folders in which files are looked for.
        diagnostics: of the scene's file.
    """

    def __init__(
        self, scene: SceneSpec, data_path: tuple[Path, ...], diagnostics: Diagnostics
    ) -> None:
        self.robots: dict[int, RobotSpec] = {}
        """The robot of each vehicle that has one, by its number."""
        self.files: list[Path] = []
        """The files, each once."""
        self.stand_ins: set[int] = set()
        """Numbers of the vehicles whose robot stands for another: what theirs has is not known."""
        self.found: list[Diagnostic] = []
        """The robots that are nowhere, or elsewhere than the scene states."""
        self._named_by, self._data_path = Path(scene.path), data_path
        arguments = dict(scene.expansion.arguments)
        robots: dict[str, RobotSpec | None] = {}
        for index, vehicle in enumerate(scene.vehicles):
            name = vehicle.file
            if name not in robots and len(robots) < MAX_FILES:
                robots[name] = None
                path = self._find(vehicle, diagnostics)
                if path is None:
                    continue
                self.files.append(path)
                with suppress(SceneError):
                    robots[name] = read_urdf(path, data_path=data_path, arguments=arguments)
            if (robot := robots.get(name)) is not None:
                self.robots[index] = robot
                if find(name, named_by=self._named_by, data_path=data_path) is None:
                    self.stand_ins.add(index)

    def _find(self, vehicle: VehicleSpec, diagnostics: Diagnostics) -> Path | None:
        """Return the file of a vehicle's robot, or else the bundled one of the same file name."""
        name, data_path, named_by = vehicle.file, self._data_path, self._named_by
        try:
            path = find(name, named_by=named_by, data_path=data_path)
        except AssetError as error:
            self.found.append(diagnostic_at(vehicle, str(error)))
            return None
        if path is not None:
            if remark := place_remark(name, path, named_by=named_by, data_path=data_path):
                self.found.append(diagnostic_at(vehicle, remark, severity="warning"))
            return path
        path = bundled_robot(name)
        if path is not None:
            what = f"robot file {name!r} is nowhere; the bundled {path.name} is used"
            self.found.append(diagnostic_at(vehicle, what, severity="warning"))
            return path
        searched = searched_for(name, named_by=named_by, data_path=data_path)
        near = diagnostics.near(name.strip().rpartition("/")[2], bundled_robots())
        message = f"robot file {name!r} is nowhere, and no bundled robot is called so.{near}"
        message = f"{message} {searched[0].upper()}{searched[1:]}"
        self.found.append(diagnostic_at(vehicle, message))
        return None
