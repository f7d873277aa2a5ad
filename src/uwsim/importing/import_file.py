"""The import of a file: a folder with a scene that ``uwsim check`` and ``uwsim run`` accept."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..assets.packages import MODEL_FILE
from ..base.files.staging import stage_directory
from ..errors import BadSetting
from ..scene.writer import write_scene
from .graph_file import GRAPH_SUFFIXES, import_graph
from .mesh_files import MeshFiles
from .output.hydrodynamics_file import UUV_OBJECTS, make_hydrodynamics, write_hydrodynamics
from .output.objects import ObjectWriter
from .output.robot_file import write_robot
from .output.scene_file import SceneParts
from .plugins.buoyancy import read_water
from .plugins.coefficients import Water
from .plugins.context import PluginContext, label_of
from .plugins.fins import LIFT_DRAG
from .plugins.sensors import PLUGIN_KINDS
from .plugins.thrusters import GAZEBO_THRUSTER, UUV_THRUSTERS, propeller_joints
from .report import ImportReport, Place, Status
from .robot import Connections, NameTable, make_robot
from .sdf.flat_model import FlatModel
from .sdf.frames import ModelFrames
from .sdf.models import SdfReader
from .sdf.search import ModelSearch, environment_folders, model_file
from .sdf.spec import FramedPose, Model, SdfWorld
from .sdf.values import text_of

SCENE_FILE = "scene.xml"
"""The name of the written scene."""
SDF_SUFFIXES = (".sdf", ".world", ".config")
"""The suffixes of files of SDF."""
DETACHABLE_JOINT = "detachable-joint"
"""The plug-in of a joint that can open."""
READ_PLUGINS = (
    "hydrodynamics", GAZEBO_THRUSTER, LIFT_DRAG, "liftdragplugin", "ardupilotplugin",
    DETACHABLE_JOINT, *UUV_OBJECTS, *UUV_THRUSTERS, *PLUGIN_KINDS,
)  # fmt: skip
"""The plug-ins of models that are read."""
NEEDLESS_PLUGINS = {
    "imu": "the sensor needs no plug-in",
    "dvl": "the sensor needs no plug-in",
    "sensors": "the sensors need no plug-in",
    "navsat": "the sensor needs no plug-in",
    "physics": "the simulator has its own engine",
    "user-commands": "the simulator has its own commands",
    "scene-broadcaster": "the simulator has its own viewer",
    "odometry-publisher": "the scene publishes the odometry of each vehicle",
    "joint-state-publisher": "the scene publishes the joints of each vehicle",
    "pose-publisher": "the scene publishes the odometry of each vehicle",
    "joint-position-controller": "the joint has a servo; its gains are not imported",
    "ardupilotplugin": "its limits of thrust alone; see <u:ardupilot> in docs/ardupilot.md",
}
"""The reasons why plug-ins without a counterpart are not missed."""


@dataclass(frozen=True, kw_only=True)
class ImportRequest:
    """The file of an import, and the folder that is written."""

    file: Path
    """The file, or the folder of a model."""
    out: Path
    """The new folder."""
    folders: tuple[Path, ...] = ()
    """The folders in which models and meshes are searched."""


@dataclass(frozen=True, kw_only=True)
class Import:
    """An import that has been written."""

    scene: Path
    """The scene file."""
    report: ImportReport
    """The fate of each element."""


def import_file(request: ImportRequest) -> Import:
    """Import a file of SDF, VRML, X3D or OpenSceneGraph into a new folder.

    Raises:
        BadSetting: the folder exists, or the file is of another kind.
        SceneError: the file, or one that it includes, is invalid; it has every mistake in it.
        AssetError: a scene graph cannot be read.
    """
    if request.out.exists():
        raise BadSetting(f"{request.out} exists; an import is written into a new folder.")
    path = _find_file(request.file)
    report = ImportReport()
    folders = (*request.folders, *environment_folders())
    if path.suffix.lower() in GRAPH_SUFFIXES:
        with stage_directory(request.out) as folder:
            scene = import_graph(path, MeshFiles(folder, folders, report), report)
            (folder / SCENE_FILE).write_text(write_scene(scene), encoding="utf-8")
    else:
        _import_sdf(path, request.out, folders, report)
    return Import(scene=request.out / SCENE_FILE, report=report)


def _import_sdf(path: Path, out: Path, folders: tuple[Path, ...], report: ImportReport) -> None:
    """Write the scene of a file of SDF."""
    world = SdfReader(search=ModelSearch(folders), report=report).read(path)
    water = read_water(world, report)
    _report_world_plugins(world, report)
    models = _place_models(world, path)
    with stage_directory(out) as folder:
        writer = _Writer(folder, MeshFiles(folder, folders, report), report, water)
        for model in models:
            writer.add(model)
        scene = writer.parts.make_scene(water, world.earth_origin)
        (folder / SCENE_FILE).write_text(write_scene(scene), encoding="utf-8")


def _find_file(path: Path) -> Path:
    """Return the SDF file of a path: itself, or the file of a model's folder."""
    if path.is_dir() or path.name == MODEL_FILE:
        file = model_file(path if path.is_dir() else path.parent)
        if file is None:
            raise BadSetting(f"{path}: it is no model; expected a {MODEL_FILE} or model.sdf.")
        return file
    if not path.exists():
        raise BadSetting(f"{path}: there is no such file.")
    if path.suffix.lower() not in (*SDF_SUFFIXES, *GRAPH_SUFFIXES):
        expected = ", ".join((*SDF_SUFFIXES, *GRAPH_SUFFIXES))
        raise BadSetting(f"{path}: files of type {path.suffix or 'none'} are not imported; "
                         f"expected {expected}, or the folder of a model.")  # fmt: skip
    return path


def _place_models(world: SdfWorld, path: Path) -> list[FlatModel]:
    """Return the models of a world at their poses."""
    world_model = Model(
        name="world",
        pose=FramedPose(),
        placement_frame="",
        canonical_link="",
        is_static=False,
        is_merged=False,
        links=(),
        joints=(),
        frames=world.frames,
        models=world.models,
        plugins=(),
        file=path,
        place=Place(file=str(path), line=1),
    )
    frames = ModelFrames(world_model)
    return [
        FlatModel(child, frames.nested_pose(name, child.model.place.line))
        for name, child in frames.child_frames.items()
    ]


def _report_world_plugins(world: SdfWorld, report: ImportReport) -> None:
    for plugin in world.plugins:
        if plugin.kind != "buoyancy":
            reason = NEEDLESS_PLUGINS.get(plugin.kind, "it has no counterpart")
            report.add("left out", f"plugin {plugin.kind}", plugin.place, reason)


@dataclass(eq=False)
class _Writer:
    """The writer of models into the folder of a scene."""

    folder: Path
    meshes: MeshFiles
    report: ImportReport
    water: Water

    def __post_init__(self) -> None:
        self.parts = SceneParts()
        self._names = NameTable()
        self._names.add("scene")
        self._objects = ObjectWriter(self.meshes, self._names, self.report)

    def add(self, model: FlatModel) -> None:
        """Add a model as objects or as a vehicle."""
        place, label = model.model.place, f"model {model.model.name}"
        if not model.links:
            self.report.add("left out", label, place, "it has no links")
            return
        if model.model.is_static:
            objects = list(self._objects.static_objects(model, model.model.name or "object"))
            self.parts.objects += objects
            status: Status = "imported" if objects else "left out"
            reason = f"{len(objects)} fixed objects" if objects else "nothing of it is visible"
            self.report.add(status, label, place, reason)
            self._report_plugins(model, only_unread=False)
            return
        name = self._names.add(model.model.name or "model")
        if _is_loose(model):
            spec = self._objects.loose_object(model, name, self.water)
            if spec is not None:
                self.parts.objects.append(spec)
                self.report.add("imported", label, place, f"loose object {name}")
                self._report_plugins(model, only_unread=True)
                return
        self._add_vehicle(model, name)

    def _add_vehicle(self, model: FlatModel, name: str) -> None:
        attachments = tuple(_attachments(model))
        connections = Connections(propellers=propeller_joints(model), attachments=attachments)
        robot = make_robot(model, name, connections, self.report)
        assert robot is not None  # the model has links
        context = PluginContext(model, robot, self.report)
        place, label = model.model.place, f"model {model.model.name}"
        write_robot(robot, self.folder / f"{name}.urdf", self.meshes)
        hydrodynamics = None
        if robot.is_fixed:
            self.report.add("changed", label, place, f"vehicle {name} without dynamics: a joint "
                            "fixes it to the world")  # fmt: skip
        else:
            hydrodynamics = make_hydrodynamics(name, context, self.water, self.meshes)
            write_hydrodynamics(hydrodynamics.vehicle, self.folder / f"{name}.xml")
            self.report.add("imported", label, place, f"vehicle {name}")
        self.parts.add_vehicle(name, context, hydrodynamics)
        self._report_plugins(model, only_unread=True)

    def _report_plugins(self, model: FlatModel, *, only_unread: bool) -> None:
        for plugin in model.plugins:
            kind = plugin.plugin.kind
            if kind in NEEDLESS_PLUGINS:
                reason = NEEDLESS_PLUGINS[kind]
            elif kind == DETACHABLE_JOINT and only_unread:
                self.report.add("changed", label_of(plugin), plugin.plugin.place,
                                "a fixed joint, which does not open")  # fmt: skip
                continue
            elif only_unread and kind in READ_PLUGINS:
                continue
            else:
                reason = (
                    "it has no counterpart" if only_unread else "fixed objects have no plug-ins"
                )
            self.report.add("left out", label_of(plugin), plugin.plugin.place, reason)


def _is_loose(model: FlatModel) -> bool:
    """Return whether a model is one body without joints, sensors and plug-ins of the water."""
    link = next(iter(model.links.values()))
    has_plugins = any(plugin.plugin.kind in READ_PLUGINS for plugin in model.plugins)
    has_shapes = bool(link.visuals or link.collisions)
    return (
        len(model.links) == 1 and has_shapes and not (model.joints or link.sensors or has_plugins)
    )


def _attachments(model: FlatModel) -> list[tuple[str, str]]:
    """Return the links that plug-ins attach to others."""
    pairs = []
    for plugin in model.plugins:
        node = plugin.plugin.node
        if plugin.plugin.kind != DETACHABLE_JOINT or text_of(node, "child_model") != "__model__":
            continue
        parent = model.find_link(text_of(node, "parent_link"), plugin.scope)
        child = model.find_link(text_of(node, "child_link"), plugin.scope)
        if parent is not None and child is not None:
            pairs.append((parent, child))
    return pairs
