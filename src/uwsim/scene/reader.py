"""Reads a scene file into a `SceneSpec`, or reports every error."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Protocol

from ..errors import AssetError, Diagnostic, SceneError
from ..schema import Diagnostics, Document, check_head, read
from ..xacro import parse_expanded
from .checks.angles import check_angles
from .checks.comms import comms_devices
from .checks.looks import check_looks
from .checks.names import check_left_out, check_names
from .checks.sizes import check_sizes
from .legacy import upgrade
from .spec import SceneSpec
from .unsupported import not_simulated
from .urdf.reader import read_robot, read_urdf
from .urdf.robot import RobotSpec, VisualSpec
from .variation import check_variations

ROOT = "UWSimScene"
"""Name of the root element."""
MAX_FILES = 200
"""So many different robots and models of a scene, and meshes of a robot, are looked for."""


class Library(Protocol):
    """Look-up of the files that a scene names, implemented by ``uwsim.assets``."""

    def find(self, name: str, named_by: Path) -> Path | None:
        """The file ``name``, which the file ``named_by`` names; None when it is nowhere."""

    def find_robot(self, name: str, named_by: Path) -> Path | None:
        """The robot file ``name``, or else ours of the same file name; None without either."""

    def has_model(self, name: str, named_by: Path) -> bool:
        """Whether there is a model of that name, or a stand-in."""

    def unreadable(self, name: str, named_by: Path) -> str:
        """Why the file of a model cannot be read here; empty if it can, or is not there."""

    def searched(self, named_by: Path) -> str:
        """The folders that were searched."""


def read_scene(path: Path | str, *, data_path: tuple[Path, ...] = ()) -> SceneSpec:
    """Read a scene file; what it includes is looked for in the folders of ``data_path``, too.

    Raises:
        SceneError: with every error of the file.
    """
    path = Path(path)
    diagnostics = Diagnostics(path)
    scene = read_document(parse_expanded(path, error=SceneError, data_path=data_path), diagnostics)
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
        given={"path": str(document.path), "is_original": document.has_doctype},
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
) -> list[Diagnostic]:
    """Return the errors and warnings of a scene file and the robots it names.

    Args:
        path: the scene file.
        strict: also hold it against the order of the original grammar.
        library: finds robots and models; without it they are not looked at.
        further: finds what only other rooms can know, in a scene without errors.
        settled: puts what stands on the floor there, as far as that can be done.
        data_path: further folders in which included files are looked for.
    """
    diagnostics = Diagnostics(path, strict=strict)
    try:
        document = parse_expanded(path, error=SceneError, data_path=data_path)
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
        if library is not None:
            _check_models(scene, document, library, diagnostics)
        not_simulated(document.root, diagnostics)
        if further is not None and not diagnostics.any:
            others += further(scene)
    return [*diagnostics.all(), *others]


def scene_warnings(scene: SceneSpec, robots: Mapping[int, RobotSpec]) -> list[Diagnostic]:
    """Warn of what is left out of a scene with its settings and of its angles.

    Args:
        scene: the scene, perhaps changed since its file was read; lines are those of the file.
        robots: the robot of each vehicle, by its number.
    """
    diagnostics = Diagnostics(scene.path or "the scene")
    check_left_out(scene, robots, diagnostics)
    check_angles(scene, diagnostics)
    return [each for each in diagnostics.all() if each.severity == "warning"]


def check_robot(
    path: Path, *, library: Library | None = None, data_path: tuple[Path, ...] = ()
) -> list[Diagnostic]:
    """Return the errors and warnings of a robot file."""
    diagnostics = Diagnostics(path)
    try:
        robot = read_robot(path, diagnostics, data_path)
    except SceneError as error:
        return list(error.diagnostics)
    if robot is not None and library is not None:
        for name, shape in itertools.islice(_meshes(robot).items(), MAX_FILES):
            if why := library.unreadable(name, path):
                diagnostics.error(shape, why)
            elif not library.has_model(name, path):
                diagnostics.warning(
                    shape, f"there is no model {name!r}, nor a stand-in: a labelled box"
                )
    return diagnostics.all()


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
    for index, vehicle in enumerate(scene.vehicles):
        if vehicle.file not in by_file and len(by_file) < MAX_FILES:
            by_file[vehicle.file] = None
            try:
                path = library.find_robot(vehicle.file, document.path)
            except AssetError as error:
                diagnostics.error(vehicle, str(error))
                continue
            if path is None:
                searched = library.searched(document.path)
                diagnostics.error(
                    vehicle,
                    f"robot file {vehicle.file!r} is nowhere, and no bundled robot is called so; "
                    f"searched: {searched}",
                )
                continue
            if library.find(vehicle.file, document.path) is None:
                what = f"robot file {vehicle.file!r} is nowhere; the bundled {path.name} is used"
                diagnostics.warning(vehicle, what)
            found += check_robot(path, library=library, data_path=data_path)
            with suppress(SceneError):
                by_file[vehicle.file] = read_urdf(path, data_path=data_path)
        if (robot := by_file.get(vehicle.file)) is not None:
            robots[index] = robot
    return robots, found


def _check_models(
    scene: SceneSpec, document: Document, library: Library, diagnostics: Diagnostics
) -> None:
    """Report models of objects and devices that are not found, or cannot be read."""
    first: dict[str, object] = {}
    for device in (each for vehicle in scene.vehicles for each in comms_devices(vehicle)):
        if device.mesh is not None:
            first.setdefault(device.mesh.path, device.mesh)
    for thing in scene.objects:
        first.setdefault(thing.file, thing)
        if thing.physics is not None and thing.physics.collision_shape:
            first.setdefault(thing.physics.collision_shape, thing)
    for name, spec in itertools.islice(first.items(), MAX_FILES):
        if why := library.unreadable(name, document.path):
            diagnostics.error(spec, why)
        elif not library.has_model(name, document.path):
            _lost(f"model {name!r}", spec, document, library, diagnostics)


def _meshes(robot: RobotSpec) -> dict[str, VisualSpec]:
    """The mesh files of a robot, each with the shape that names it first."""
    first: dict[str, VisualSpec] = {}
    for link in robot.links:
        for shape in (*link.visuals, *link.collisions):
            if shape.kind == "mesh":
                first.setdefault(shape.file, shape)
    return first


def _lost(
    what: str, spec: object, document: Document, library: Library, diagnostics: Diagnostics
) -> None:
    """Report a missing file: an error, but in a scene of the original a warning.

    The archive with the original's models is no longer to be had, so that a scene with the
    original's DOCTYPE is not at error for naming what lay in it.
    """
    say = diagnostics.warning if document.has_doctype else diagnostics.error
    searched = library.searched(document.path)
    say(spec, f"{what} is nowhere and has no stand-in; searched: {searched}")
