"""Reads a scene file into a `SceneSpec`, or reports every error."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from pathlib import Path

from ..errors import AssetError, Diagnostic, SceneError, choices
from ..schema import Diagnostics, Document, check_head, diagnostic_at, read
from .checks.angles import check_angles
from .checks.forces import check_forces
from .checks.looks import check_looks
from .checks.models import MAX_FILES, Library, check_models
from .checks.names import check_left_out, check_names
from .checks.sizes import check_sizes
from .checks.water import check_water
from .legacy import upgrade
from .spec import SceneSpec
from .unsupported import not_simulated
from .urdf.reader import read_robot, read_urdf
from .urdf.robot import RobotSpec, VisualSpec
from .variation import check_variations
from .xacro import parse_expanded

ROOT = "UWSimScene"
"""Name of the root element."""


def read_scene(
    path: Path | str,
    *,
    data_path: tuple[Path, ...] = (),
    arguments: Mapping[str, str] | None = None,
) -> SceneSpec:
    """Read a scene file.

    Args:
        path: the file.
        data_path: further folders in which included files are looked for.
        arguments: values of xacro arguments of the scene and its robots, by name.

    Raises:
        SceneError: with every error of the file.
    """
    path = Path(path)
    diagnostics = Diagnostics(path)
    document = parse_expanded(path, error=SceneError, data_path=data_path, arguments=arguments)
    scene = read_document(document, diagnostics)
    diagnostics.check(SceneError)
    assert scene is not None
    return scene


def read_document(document: Document, diagnostics: Diagnostics) -> SceneSpec | None:
    """Read a scene that is already parsed; None when its errors leave nothing to build on."""
    check_head(document, ROOT, diagnostics)
    if document.root.tag != ROOT:
        return None
    upgrade(document.root, diagnostics)
    if diagnostics.strict:
        for node in document.root.iter("ProfilingSonar", "ProfilingSonarROS"):
            diagnostics.error(node, f"<{node.tag}> is not in the original grammar")
    scene = read(
        SceneSpec,
        document.root,
        diagnostics,
        given={
            "path": str(document.path),
            "is_original": document.has_doctype,
            "expansion": document.expansion,
        },
    )
    if scene is not None:
        check_sizes(scene, diagnostics)
        check_variations(scene, diagnostics)
    return scene


def check_scene(
    path: Path,
    *,
    strict: bool = False,
    library: Library | None = None,
    further: Callable[[SceneSpec], list[Diagnostic]] | None = None,
    settled: Callable[[SceneSpec], SceneSpec] | None = None,
    data_path: tuple[Path, ...] = (),
    arguments: Mapping[str, str] | None = None,
) -> list[Diagnostic]:
    """Return the errors and warnings of a scene file and the robots it names.

    Args:
        path: the scene file.
        strict: also hold it against the order of the original grammar.
        library: finds robots and models; without it they are not looked at.
        further: finds what only other rooms can know, in a scene without errors.
        settled: puts what stands on the floor there, as far as that can be done.
        data_path: further folders in which included files are looked for.
        arguments: values of xacro arguments of the scene and its robots, by name.
    """
    diagnostics = Diagnostics(path, strict=strict)
    try:
        document = parse_expanded(path, error=SceneError, data_path=data_path, arguments=arguments)
    except SceneError as error:
        return list(error.diagnostics)
    scene = read_document(document, diagnostics)
    others: list[Diagnostic] = []
    if scene is not None:
        robots, others = _robots(scene, document, library, diagnostics, data_path)
        stand_ins = [
            index
            for index in robots
            if library and library.find(scene.vehicles[index].file, document.path) is None
        ]
        check_names(scene, robots, diagnostics, stand_ins)
        check_looks(scene if settled is None else settled(scene), robots, diagnostics)
        check_angles(scene, diagnostics)
        check_water(scene.ocean_state, diagnostics)
        check_forces(scene, robots, diagnostics)
        if library is not None:
            check_models(scene, document, library, diagnostics)
        not_simulated(document.root, diagnostics)
        is_wrong = diagnostics.any or any(each.severity == "error" for each in others)
        if not is_wrong:  # else a robot that has the argument may be missing
            others += unused_arguments(scene, robots.values())
        if further is not None and not diagnostics.any:
            others += further(scene)
    return [*document.expansion.warnings, *diagnostics.all(), *others]


def unused_arguments(scene: SceneSpec, robots: Iterable[RobotSpec]) -> list[Diagnostic]:
    """Warn of each xacro argument from outside that no file of a scene has."""
    known = [*scene.expansion.declared, *(n for robot in robots for n in robot.expansion.declared)]
    return [
        diagnostic_at(
            scene,
            f"no <xacro:arg> is called {name[:60]!r}, so that its value has no effect."
            f"{choices(name, sorted(set(known)), called='Arguments')}",
            severity="warning",
        )
        for name, _ in scene.expansion.arguments
        if name not in known
    ]


def scene_warnings(scene: SceneSpec, robots: Mapping[int, RobotSpec]) -> list[Diagnostic]:
    """Warn of what is left out of a scene with its settings and of its angles.

    Args:
        scene: the scene, perhaps changed since its file was read; lines are those of the file.
        robots: the robot of each vehicle, by its number.
    """
    diagnostics = Diagnostics(scene.path or "the scene")
    check_left_out(scene, robots, diagnostics)
    check_angles(scene, diagnostics)
    check_forces(scene, robots, diagnostics)
    expanded = [scene.expansion, *(robot.expansion for robot in robots.values())]
    return [
        *dict.fromkeys(warning for each in expanded for warning in each.warnings),
        *(each for each in diagnostics.all() if each.severity == "warning"),
        *unused_arguments(scene, robots.values()),
    ]


def check_robot(
    path: Path,
    *,
    library: Library | None = None,
    data_path: tuple[Path, ...] = (),
    arguments: Mapping[str, str] | None = None,
) -> list[Diagnostic]:
    """Return the errors and warnings of a robot file."""
    diagnostics = Diagnostics(path)
    try:
        robot = read_robot(path, diagnostics, data_path, arguments)
    except SceneError as error:
        return list(error.diagnostics)
    if robot is not None and library is not None:
        for name, shape in itertools.islice(_meshes(robot).items(), MAX_FILES):
            if why := library.unreadable(name, path):
                diagnostics.error(shape, why)
            elif not library.has_model(name, path):
                remark = library.package_remark(name, path)
                message = f"there is no model {name!r}, nor a stand-in: a labelled box"
                diagnostics.warning(shape, f"{message}; {remark}" if remark else message)
            elif remark := library.model_place_remark(name, path):
                diagnostics.warning(shape, remark)
            elif why := library.doubtful_size(name, shape.scale, path):
                diagnostics.warning(shape, why)
            for said in library.model_remarks(name, path):
                diagnostics.warning(shape, said)
    warnings = () if robot is None else robot.expansion.warnings
    return [*warnings, *diagnostics.all()]


def _robots(
    scene: SceneSpec,
    document: Document,
    library: Library | None,
    diagnostics: Diagnostics,
    data_path: tuple[Path, ...],
) -> tuple[dict[int, RobotSpec], list[Diagnostic]]:
    """The robot of each vehicle by its number, and the diagnostics of their files."""
    robots: dict[int, RobotSpec] = {}
    found: list[Diagnostic] = []
    if library is None:
        return robots, found
    by_file: dict[str, RobotSpec | None] = {}
    arguments = dict(document.expansion.arguments)
    for index, vehicle in enumerate(scene.vehicles):
        if vehicle.file not in by_file and len(by_file) < MAX_FILES:
            by_file[vehicle.file] = None
            try:
                path = library.find_robot(vehicle.file, document.path)
            except AssetError as error:
                diagnostics.error(vehicle, str(error))
                continue
            if path is None:
                searched = library.searched(vehicle.file, document.path)
                name = vehicle.file.strip().rpartition("/")[2]
                near = diagnostics.near(name, library.bundled_robots())
                diagnostics.error(
                    vehicle,
                    f"robot file {vehicle.file!r} is nowhere, and no bundled robot is called "
                    f"so.{near} {searched[0].upper()}{searched[1:]}",
                )
                continue
            if library.find(vehicle.file, document.path) is None:
                what = f"robot file {vehicle.file!r} is nowhere; the bundled {path.name} is used"
                diagnostics.warning(vehicle, what)
            elif remark := library.place_remark(vehicle.file, document.path):
                diagnostics.warning(vehicle, remark)
            found += check_robot(path, library=library, data_path=data_path, arguments=arguments)
            with suppress(SceneError):
                by_file[vehicle.file] = read_urdf(path, data_path=data_path, arguments=arguments)
        if (robot := by_file.get(vehicle.file)) is not None:
            robots[index] = robot
    return robots, found


def _meshes(robot: RobotSpec) -> dict[str, VisualSpec]:
    """The mesh files of a robot, each with the shape that names it first."""
    first: dict[str, VisualSpec] = {}
    for link in robot.links:
        for shape in (*link.visuals, *link.collisions):
            if shape.kind == "mesh":
                first.setdefault(shape.file, shape)
    return first
