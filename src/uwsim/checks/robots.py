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
    """Return the errors and warnings of a robot file: its reader's, and those of the rules."""
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
    where = robot.where
    for name, shape in itertools.islice(_meshes(robot.spec).items(), MAX_FILES):
        if why := assets.model_read_error(name, **where):
            yield robot.error(shape, why)
        elif not assets.has_model(name, **where):
            remark = assets.package_remark(name, **where)
            message = f"there is no model {name!r}, nor a stand-in: a labelled box"
            yield robot.warning(shape, f"{message}; {remark}" if remark else message)
        elif why := assets.model_location_remark(name, **where) or mesh_unit_remark(
            name, shape.scale, **where
        ):
            yield robot.warning(shape, why)
        for remark in assets.model_remarks(name, **where):
            yield robot.warning(shape, remark)


def _meshes(robot: RobotSpec) -> dict[str, VisualSpec]:
    """The mesh files of a robot, each with the shape that names it first."""
    first: dict[str, VisualSpec] = {}
    for link in robot.links:
        for shape in (*link.visuals, *link.collisions):
            if shape.kind == "mesh":
                first.setdefault(shape.file, shape)
    return first


def robot_places(scene: CheckedScene) -> Iterable[Diagnostic]:
    """Return that robot files are nowhere, or elsewhere than the scene states."""
    return scene.robot_search.found


def robot_files(scene: CheckedScene, rules: Iterable[Rule[CheckedRobot]]) -> Iterator[Diagnostic]:
    """Report what is wrong in the robot files, and else the arguments that no file has."""
    arguments = dict(scene.spec.expansion.arguments)
    is_wrong = scene.diagnostics.has_errors
    for path in scene.robot_search.files:
        found = check_robot(path, rules, data_path=scene.data_path, arguments=arguments)
        is_wrong = is_wrong or any(each.severity == "error" for each in found)
        yield from found
    if not is_wrong:  # else a robot that has the argument may be missing
        yield from unused_arguments(scene)


def unused_arguments(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of each xacro argument from outside that no file of a scene has."""
    expansions = [scene.spec.expansion, *(robot.expansion for robot in scene.robots.values())]
    known = [name for each in expansions for name in each.declared_arguments]
    for name, _ in scene.spec.expansion.arguments:
        if name not in known:
            near = choices(name, sorted(set(known)), heading="Arguments")
            yield scene.warning(
                scene.spec,
                f"no <xacro:arg> is called {name[:60]!r}, so that its value has no effect.{near}",
            )


def macro_warnings(scene: CheckedScene) -> Iterable[Diagnostic]:
    """Return the warnings of the expansion of macros; in a run those of robots too, each once."""
    if not scene.is_run:
        return scene.spec.expansion.warnings
    expansions = [scene.spec.expansion, *(robot.expansion for robot in scene.robots.values())]
    return dict.fromkeys(warning for each in expansions for warning in each.warnings)
