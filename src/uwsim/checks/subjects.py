"""The subjects of rules: a scene, a robot or a benchmark whose files could be read."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import Diagnostic, UwsimError
from ..model.collision.scene_shapes import solid_objects_in_water
from ..model.dynamics import NameResolution
from ..model.placement import set_on_floor
from ..model.resolved_scene import ResolvedScene
from ..scene.hydrodynamics.spec import VehicleHydrodynamics
from ..scene.hydrodynamics.vehicle_file import read_vehicle_into
from ..scene.hydrodynamics.vehicle_sets import find_vehicle
from ..scene.object import PhysicsSpec
from ..scene.spec import SceneSpec, has_floor_placement
from ..scene.urdf.robot import RobotSpec
from ..schema import Diagnostics, Document, Spec, diagnostic_at
from ..topics.thruster_commands import AutopilotTopicSpec
from ..world import TIMESTEP, Stage
from .robot_search import FileSearch, RobotSearch

if TYPE_CHECKING:
    from ..benchmark.plugin_tables import Tables
    from ..benchmark.spec import BenchmarkSpec
    from ..model.scene_model import SceneModel

MAX_VEHICLES = 50
"""The greatest number of vehicles of a scene that are checked."""
MAX_LOOSE_OBJECTS = 200
"""The greatest number of loose objects (which forces can move) that are checked."""


class Subject:
    """A file that rules check, with methods that make diagnostics about it.

    Args:
        path: the path of the file; empty for a spec that a program made.
        diagnostics: the diagnostics of the reader, to which diagnostics of rules are added.
        data_path: the folders that are searched for files.
    """

    def __init__(
        self, path: str, diagnostics: Diagnostics, data_path: tuple[Path, ...] = ()
    ) -> None:
        self.diagnostics, self.data_path = diagnostics, data_path
        self.file_search = FileSearch(named_by=Path(path) if path else None, data_path=data_path)
        """The arguments of the search for the files that the file names."""

    def error(self, source: object, message: str, element: str = "") -> Diagnostic:
        """Make an error, which makes the file invalid.

        Args:
            source: the line of the file, or the spec, that has the error; None for the whole file.
            message: the message.
            element: the element in the spec whose line is stated, if it is there.
        """
        if isinstance(source, Spec):
            return diagnostic_at(source, message, element, file=self.diagnostics.file)
        line = source if isinstance(source, int) else None
        return Diagnostic(file=self.diagnostics.file, line=line, message=message)

    def warning(self, source: object, message: str, element: str = "") -> Diagnostic:
        """Make a warning, with the arguments of `error`; the file remains valid."""
        return replace(self.error(source, message, element), severity="warning")

    def note(self, source: object, message: str, element: str = "") -> Diagnostic:
        """Make a note, with the arguments of `error`: it informs, and nothing has to be changed."""
        return replace(self.error(source, message, element), severity="note")


class CheckedRobot(Subject):
    """A robot file."""

    def __init__(
        self, spec: RobotSpec, diagnostics: Diagnostics, data_path: tuple[Path, ...]
    ) -> None:
        super().__init__(diagnostics.file, diagnostics, data_path)
        self.spec = spec
        """The spec of the robot."""


class CheckedScene(Subject):
    """A scene file, or the scene of a run with its settings.

    Args:
        spec: the spec of the scene.
        data_path: the folders that are searched for files.
        document: the document of the file; None for the scene of a run.
        diagnostics: the diagnostics of the reader; None for the scene of a run.
        parts: the robots and the hydrodynamics of the vehicles, by index of the vehicle; None to
            search for them.
        timestep: the length of a physics step [s].
    """

    def __init__(
        self,
        spec: SceneSpec,
        data_path: tuple[Path, ...],
        *,
        document: Document | None = None,
        diagnostics: Diagnostics | None = None,
        parts: tuple[Mapping[int, RobotSpec], Mapping[int, VehicleHydrodynamics]] | None = None,
        timestep: float = TIMESTEP,
    ) -> None:
        super().__init__(spec.path, diagnostics or Diagnostics(spec.path or "the scene"), data_path)
        self.spec, self.document, self.timestep = spec, document, timestep
        self.is_run, self._known_parts = document is None, parts

    @cached_property
    def robot_search(self) -> RobotSearch:
        """The search for the robot files; at the first access the files are found and read."""
        return RobotSearch(self.spec, self.file_search, self.diagnostics)

    @property
    def robots(self) -> Mapping[int, RobotSpec]:
        """The robot of each vehicle whose robot file could be read, by index of the vehicle."""
        return self._known_parts[0] if self._known_parts else self.robot_search.robots

    @property
    def resolved_scene(self) -> ResolvedScene:
        """The scene with the robots that could be read."""
        return ResolvedScene(scene=self.spec, robots=self.robots, data_path=self.data_path)

    def has_substitute_robot(self, index: int) -> bool:
        """Return whether a bundled robot replaces a vehicle's robot file, which is not found."""
        name = self.spec.vehicles[index].file
        return not self._known_parts and name in self.robot_search.substituted_files

    @cached_property
    def names(self) -> NameResolution:
        """The resolution of the names in the hydrodynamics of the scene."""
        return NameResolution(self.resolved_scene, is_thorough=True)

    def thruster_names(self, index: int) -> list[str] | None:
        """Return the names of a vehicle's thrusters; None if its hydrodynamics are invalid.

        The scene may have errors, unlike where `dynamics` is used.
        """
        vehicle = self.spec.vehicles[index]
        if vehicle.dynamics is None:
            return []
        named_by = Path(self.spec.path) if self.spec.path else None
        try:
            path = find_vehicle(vehicle.dynamics, named_by)
            dynamics = read_vehicle_into(path, None, Diagnostics(path))
        except UwsimError:  # reported where the dynamics are checked
            return None
        return None if dynamics is None else [thruster.name for thruster in dynamics.thrusters]

    @property
    def dynamics(self) -> Mapping[int, VehicleHydrodynamics]:
        """The hydrodynamics of each vehicle with dynamics, by index of the vehicle."""
        return self._known_parts[1] if self._known_parts else self.names.dynamics

    @property
    def is_valid(self) -> bool:
        """True if the file has no errors and anything to simulate; the scene of a run is valid."""
        scene = self.spec
        return self.is_run or (
            not self.diagnostics.has_errors
            and (
                bool(scene.ocean_state.currents or scene.vehicles or scene.has_original_physics)
                or has_floor_placement(scene)
                or any(isinstance(spec, AutopilotTopicSpec) for spec in scene.ros_interfaces)
            )
        )

    def extend(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Add diagnostics to those of the reader; for a run only warnings."""
        self.diagnostics.extend(
            item for item in diagnostics if not self.is_run or item.severity == "warning"
        )

    @cached_property
    def placed_scene(self) -> SceneSpec:
        """The scene with every body placed on its floor; unchanged if that fails."""
        if len(self.robots) == len(self.spec.vehicles):
            with suppress(UwsimError):  # reported where floors are checked
                return set_on_floor(self.resolved_scene)
        return self.spec

    @property
    def checked_vehicles(self) -> list[int]:
        """The indices of the first `MAX_VEHICLES` vehicles whose robot could be read."""
        return sorted(self.robots)[:MAX_VEHICLES]

    @cached_property
    def loose_objects(self) -> dict[int, PhysicsSpec]:
        """The first `MAX_LOOSE_OBJECTS` loose objects (which forces can move), by index."""
        solids = solid_objects_in_water(self.spec, self.dynamics).items()
        loose_solids = ((index, physics) for index, physics in solids if physics.is_loose)
        return dict(itertools.islice(loose_solids, MAX_LOOSE_OBJECTS))


class CheckedBenchmark(Subject):
    """A benchmark file.

    Args:
        spec: the spec of the benchmark.
        diagnostics: the diagnostics of the file.
        tables: the available measures, triggers, updaters and algorithms.
        is_whole: True if the file was read without an error.
    """

    def __init__(
        self, spec: BenchmarkSpec, diagnostics: Diagnostics, tables: Tables, *, is_whole: bool
    ) -> None:
        super().__init__(spec.path, diagnostics)
        self.spec, self.tables, self.is_whole = spec, tables, is_whole
        self.model: SceneModel
        """The compiled scene; set for rules with `Need.MODEL`."""
        self.stage: Stage
        """The access of scene updaters to the opened scene; set for rules with `Need.MODEL`."""
