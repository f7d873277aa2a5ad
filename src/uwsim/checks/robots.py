"""Rules about robot files, and about the robots of a scene."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from .. import assets
from ..assets.mesh_unit import mesh_unit_remark
from ..errors import Diagnostic, SceneError, choices
from ..scene.urdf.reader import read_robot
from ..scene.urdf.robot import RobotSpec, VisualSpec
from ..schema import Diagnostics
from .robot_search import MAX_FILES
from .rule import Rule
from .subjects import CheckedRobot, CheckedScene


def check_robot(
    path: Path,
    rules: Iterable[Rule[CheckedRobot]],
    *,
    data_path: tuple[Path, ...] = (),
    arguments: Mapping[str, str] | None = None,
) -> list[Diagnostic]:
    """Return the errors and warnings about a robot file, from its reader and from the rules."""
    diagnostics = Diagnostics(path)
    try:
        spec = read_robot(path, diagnostics, data_path, arguments)
    except SceneError as error:
        return list(error.diagnostics)
    if spec is None:
        return diagnostics.to_list()
    robot = CheckedRobot(spec, diagnostics, data_path)
    for rule in rules:
        diagnostics.extend(rule.apply(robot))
    return [*spec.expansion.warnings, *diagnostics.to_list()]


def mesh_files(robot: CheckedRobot) -> Iterator[Diagnostic]:
    """Report meshes that are not found, cannot be read, or are likely not in metres."""
    file_search = robot.file_search
    for name, shape in itertools.islice(_meshes(robot.spec).items(), MAX_FILES):
        if text := assets.model_read_error(name, **file_search):
            yield robot.error(shape, text)
        elif not assets.has_model(name, **file_search):
            remark = assets.package_remark(name, **file_search)
            message = f"there is no model {name!r}, nor a stand-in: a labelled box replaces it"
            yield robot.warning(shape, f"{message}; {remark}" if remark else message)
        elif (text := assets.model_location_remark(name, **file_search)) or (
            text := mesh_unit_remark(name, shape.scale, **file_search)
        ):
            yield robot.warning(shape, text)
        for remark in assets.model_remarks(name, **file_search):
            yield robot.warning(shape, remark)


def _meshes(robot: RobotSpec) -> dict[str, VisualSpec]:
    """Return the mesh files of a robot, each with the first shape that names it."""
    shapes: dict[str, VisualSpec] = {}
    for link in robot.links:
        for shape in (*link.visuals, *link.collisions):
            if shape.kind == "mesh":
                shapes.setdefault(shape.file, shape)
    return shapes


def robot_locations(scene: CheckedScene) -> Iterable[Diagnostic]:
    """Return the diagnostics of robot files that are not found, or not at the stated path."""
    return scene.robot_search.diagnostics


def robot_files(scene: CheckedScene, rules: Iterable[Rule[CheckedRobot]]) -> Iterator[Diagnostic]:
    """Report the errors in the robot files; if there are none, also the unused arguments."""
    arguments = dict(scene.spec.expansion.arguments)
    has_errors = scene.diagnostics.has_errors
    for path in scene.robot_search.files:
        diagnostics = check_robot(path, rules, data_path=scene.data_path, arguments=arguments)
        has_errors = has_errors or any(item.severity == "error" for item in diagnostics)
        yield from diagnostics
    if not has_errors:  # else a robot that has the argument may be missing
        yield from unused_arguments(scene)


def unused_arguments(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of each xacro argument of the user that no file of a scene declares."""
    expansions = [scene.spec.expansion, *(robot.expansion for robot in scene.robots.values())]
    names = [name for expansion in expansions for name in expansion.declared_arguments]
    for name, _ in scene.spec.expansion.arguments:
        if name not in names:
            suggestion = choices(name, sorted(set(names)), heading="Arguments")
            yield scene.warning(
                scene.spec,
                f"no <xacro:arg> is called {name[:60]!r}: its value has no effect.{suggestion}",
            )


def macro_warnings(scene: CheckedScene) -> Iterable[Diagnostic]:
    """Return the warnings of the macro expansion of a scene; in a run also of its robots."""
    if not scene.is_run:
        return scene.spec.expansion.warnings
    expansions = [scene.spec.expansion, *(robot.expansion for robot in scene.robots.values())]
    return dict.fromkeys(warning for expansion in expansions for warning in expansion.warnings)
