"""What rules read: a scene, a robot or a benchmark, as far as its files could be read."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import Diagnostic, UwsimError
from ..model.collision.scene_shapes import simulated_solids
from ..model.dynamics import NameResolution
from ..model.placement import set_on_floor
from ..model.resolved_scene import ResolvedScene
from ..scene.hydrodynamics.spec import VehicleHydrodynamics
from ..scene.object import PhysicsSpec
from ..scene.spec import SceneSpec, stands_on_floor
from ..scene.urdf.robot import RobotSpec
from ..schema import Diagnostics, Document, Spec, diagnostic_at
from ..topics.thruster_commands import AutopilotTopicSpec
from ..world import TIMESTEP, Stage
from .robot_search import RobotSearch, Where

if TYPE_CHECKING:
    from ..benchmark.plugin_tables import Tables
    from ..benchmark.spec import BenchmarkSpec
    from ..model.scene_model import SceneModel

MAX_VEHICLES = 50
"""Number of vehicles of a scene whose numbers are checked."""
MAX_LOOSE = 200
"""Number of free objects that are checked."""


class Subject:
    """One file, and how rules report about it.

    Args:
        path: of the file; empty for what a program made.
        diagnostics: what the reader has reported; receives what rules report by line.
        data_path: folders in which files are looked for.
    """

    def __init__(
        self, path: str, diagnostics: Diagnostics, data_path: tuple[Path, ...] = ()
    ) -> None:
        self.diagnostics, self.data_path = diagnostics, data_path
        self.where = Where(named_by=Path(path) if path else None, data_path=data_path)
        """From where the files are looked for that the file names."""

    def error(self, place: object, message: str, element: str = "") -> Diagnostic:
        """Make an error at a line, or at the first ``element`` in a spec, else at the spec."""
        if isinstance(place, Spec):
            return diagnostic_at(place, message, element, file=self.diagnostics.file)
        line = place if isinstance(place, int) else None
        return Diagnostic(file=self.diagnostics.file, line=line, message=message)

    def warning(self, place: object, message: str, element: str = "") -> Diagnostic:
        """Make a warning at such a place; the file stays valid."""
        return replace(self.error(place, message, element), severity="warning")


class CheckedRobot(Subject):
    """A robot file."""

    def __init__(
        self, spec: RobotSpec, diagnostics: Diagnostics, data_path: tuple[Path, ...]
    ) -> None:
        super().__init__(diagnostics.file, diagnostics, data_path)
        self.spec = spec
        """What was read."""


class CheckedScene(Subject):
    """A scene file, or a scene with its settings.

    Args:
        spec: what was read.
        data_path: folders in which files are looked for.
        document: of the file; None for a scene that is about to run.
        diagnostics: what the reader has reported; None for a scene that is about to run.
        found: the robots and the hydrodynamics of its vehicles; None looks for them.
        timestep: length of a step [s].
    """

    def __init__(
        self,
        spec: SceneSpec,
        data_path: tuple[Path, ...],
        *,
        document: Document | None = None,
        diagnostics: Diagnostics | None = None,
        found: tuple[Mapping[int, RobotSpec], Mapping[int, VehicleHydrodynamics]] | None = None,
        timestep: float = TIMESTEP,
    ) -> None:
        super().__init__(spec.path, diagnostics or Diagnostics(spec.path or "the scene"), data_path)
        self.spec, self.document, self.timestep = spec, document, timestep
        self.is_run, self._found = document is None, found

    @cached_property
    def robot_search(self) -> RobotSearch:
        """The files of its robots, found and read."""
        return RobotSearch(self.spec, self.where, self.diagnostics)

    @property
    def robots(self) -> Mapping[int, RobotSpec]:
        """The robot of each vehicle that has one, by its number."""
        return self._found[0] if self._found else self.robot_search.robots

    @property
    def resolved(self) -> ResolvedScene:
        """The same with the robots that it has."""
        return ResolvedScene(scene=self.spec, robots=self.robots, data_path=self.data_path)

    def has_stand_in(self, index: int) -> bool:
        """Whether the robot of a vehicle stands for one that is not found."""
        name = self.spec.vehicles[index].file
        return not self._found and name in self.robot_search.stand_ins

    @cached_property
    def names(self) -> NameResolution:
        """The names in it that belong to its hydrodynamics, looked up."""
        return NameResolution(self.resolved, is_thorough=True)

    @property
    def dynamics(self) -> Mapping[int, VehicleHydrodynamics]:
        """The hydrodynamics of each vehicle that is simulated, by its number."""
        return self._found[1] if self._found else self.names.dynamics

    @property
    def is_valid(self) -> bool:
        """Whether it has no errors and something is simulated; what is about to run is valid."""
        scene = self.spec
        return self.is_run or (
            not self.diagnostics.has_errors
            and (
                bool(scene.ocean_state.currents or scene.vehicles or scene.has_uwsim_physics)
                or stands_on_floor(scene)
                or any(isinstance(each, AutopilotTopicSpec) for each in scene.ros_interfaces)
            )
        )

    def extend(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Keep what rules report by line; of a scene that is about to run the warnings alone."""
        self.diagnostics.extend(
            each for each in diagnostics if not self.is_run or each.severity == "warning"
        )

    @cached_property
    def placed(self) -> SceneSpec:
        """The scene with everything placed on its floor; unchanged where that fails."""
        if len(self.robots) == len(self.spec.vehicles):
            with suppress(UwsimError):  # reported where floors are checked
                return set_on_floor(self.resolved)
        return self.spec

    @property
    def checked_vehicles(self) -> list[int]:
        """Numbers of the first `MAX_VEHICLES` vehicles that have a robot."""
        return sorted(self.robots)[:MAX_VEHICLES]

    @cached_property
    def loose_objects(self) -> dict[int, PhysicsSpec]:
        """The first `MAX_LOOSE` objects that forces move, by number."""
        solids = simulated_solids(self.spec, self.dynamics).items()
        loose = ((index, physics) for index, physics in solids if physics.is_loose)
        return dict(itertools.islice(loose, MAX_LOOSE))


class CheckedBenchmark(Subject):
    """A benchmark file.

    Args:
        spec: what was read.
        diagnostics: of its file.
        tables: what parts and algorithms there are.
        is_whole: whether it was read without an error.
    """

    def __init__(
        self, spec: BenchmarkSpec, diagnostics: Diagnostics, tables: Tables, *, is_whole: bool
    ) -> None:
        super().__init__(spec.path, diagnostics)
        self.spec, self.tables, self.is_whole = spec, tables, is_whole
        self.model: SceneModel
        """Its scene, compiled; for rules that need the model."""
        self.stage: Stage
        """The same, opened."""
