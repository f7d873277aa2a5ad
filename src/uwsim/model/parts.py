"""The visible parts of a scene: 3-D models, each with its link or object and its pose on that."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..assets import load_model, paint_model, primitive, rounded_cylinder, unknown_model
from ..assets.bending import BentLine, bend_model
from ..assets.conventions import robot_scale, with_z_up
from ..assets.dock_shape import DockShape, shape_dock
from ..assets.mesh import Model
from ..assets.netting import weave_net
from ..assets.weathering import weather_model
from ..base.files.input_files import record_inputs
from ..base.geometry import Pose
from ..base.numerics.linear import product
from ..bathymetry.height_grid import HeightGrid
from ..devices.comms.acoustic_comms_device import AcousticCommsDeviceSpec
from ..devices.comms.custom_comms_device import CustomCommsDeviceSpec
from ..devices.led_array import COLOURS, LedArraySpec
from ..errors import AssetNotFound
from ..forces import DrawnSegments
from ..scene.object import ObjectSpec
from ..scene.spec import SceneSpec
from ..scene.urdf.robot import VisualSpec
from ..scene.vehicle import VehicleSpec
from .body_names import segment_body
from .resolved_scene import ResolvedScene
from .terrain import height_grid, object_from_world
from .terrain_model import terrain_model

CommsDeviceSpec = CustomCommsDeviceSpec | AcousticCommsDeviceSpec
MIN_EDGE = 1e-4
"""The minimum edge of a box, cylinder or sphere, as some robot files have flat shapes [m]."""


SEGMENT_OVERLAP = 1.005
"""The length of the cylinder that shows a segment, in segments: a stretched tether has no gaps [1].
"""


@dataclass(frozen=True, eq=False)
class Part:
    """A visible 3-D model on a link or an object."""

    id: int
    """The number in segmentation images, from 1."""
    name: str
    """The name: ``vehicle/link``, ``vehicle/device``, or the name of an object."""
    model: Model
    """The meshes and textures."""
    vehicle: int | None
    """The index of the vehicle; None for an object and for a segment of a force."""
    link: str
    """The link of the vehicle; empty for an object; `segment_body` for a segment of a force."""
    object: int | None
    """The index of the object; None for a link and for a segment of a force."""
    frame_from_mesh: npt.NDArray[np.float64]
    """The pose of the mesh frame in the frame of the link or object, (4, 4) [m]. It includes the
    scale of the mesh or object, but not the scale of the vehicle."""
    is_hidden: bool
    """True if the part is a ghost (``<vr>``): visible in the viewer, but not to virtual cameras."""
    grid: HeightGrid | None = None
    """The chart of the sea floor in W, of which the model may be a coarse mesh; None: a mesh."""


def parts_of(resolved_scene: ResolvedScene) -> list[Part]:
    """Return the visible parts of a scene; parts of one link or object share number and name."""
    scene, data_path = resolved_scene.scene, resolved_scene.data_path
    parts: list[Part] = []
    load = object_models(scene, data_path)
    number = 0
    for index, vehicle in enumerate(scene.vehicles):
        robot = resolved_scene.robots[index]
        for link in robot.links:
            number += bool(link.visuals)
            for visual in link.visuals:
                model, link_from_mesh = placed_visual(visual, Path(robot.path).parent, data_path)
                parts.append(
                    Part(
                        id=number,
                        name=f"{vehicle.name}/{link.name}",
                        model=model,
                        vehicle=index,
                        link=link.name,
                        object=None,
                        frame_from_mesh=link_from_mesh,
                        is_hidden=bool(vehicle.vr),
                    )
                )
        for device in comms_devices(vehicle):
            if device.mesh is not None and robot.link(device.relative_to) is not None:
                number += 1
                model = load(device.mesh.path)
                parts.append(_device_part(number, index, vehicle, device, model))
        for array in vehicle.parts_of(LedArraySpec):
            if robot.link(array.relative_to) is not None:
                leds = _led_parts(number + 1, index, vehicle, array)
                number += len(leds)
                parts += leds
    for index, spec in enumerate(scene.objects):
        number += 1
        with record_inputs() as files:
            grid = height_grid(scene, spec, data_path)
        if grid is None:
            model, object_from_mesh = placed_model(scene, spec, load(spec.file))
        else:
            model = terrain_model(grid, spec.file, files)
            object_from_mesh = object_from_world(scene, spec)
        parts.append(
            Part(
                id=number,
                name=spec.name,
                model=_weathered_model(model, spec),
                grid=grid,
                vehicle=None,
                link="",
                object=index,
                frame_from_mesh=object_from_mesh,
                is_hidden=False,
            )
        )
    for index, force in enumerate(scene.forces):
        if force.drawn_segments is not None:
            number += 1
            parts += _segment_parts(number, index, force.name, force.drawn_segments)
    return parts


def _segment_parts(number: int, index: int, name: str, segments: DrawnSegments) -> list[Part]:
    """Return a cylinder along z with round ends for each segment that a force places."""
    radius, length = segments.radius, SEGMENT_OVERLAP * segments.length
    model = rounded_cylinder(radius, length, segments.colour)
    return [
        Part(
            id=number,
            name=name,
            model=model,
            vehicle=None,
            link=segment_body(index, segment),
            object=None,
            frame_from_mesh=np.eye(4),
            is_hidden=False,
        )
        for segment in range(segments.n)
    ]


def _led_parts(number: int, index: int, vehicle: VehicleSpec, array: LedArraySpec) -> list[Part]:
    balls = []
    for i, (colour, position) in enumerate(array.positions.items()):
        frame_from_mesh = np.eye(4)
        frame_from_mesh[:3, 3] = position
        balls.append(
            Part(
                id=number + i,
                name=f"{vehicle.name}/{array.name}/{colour}",
                model=primitive("sphere", (array.radio,), COLOURS[colour]),
                vehicle=index,
                link=array.relative_to,
                object=None,
                frame_from_mesh=frame_from_mesh,
                is_hidden=bool(vehicle.vr),
            )
        )
    return balls


def _device_part(
    number: int, index: int, vehicle: VehicleSpec, device: CommsDeviceSpec, model: Model
) -> Part:
    assert device.mesh is not None
    link_from_device = Pose.from_rpy(device.position, device.orientation).matrix
    return Part(
        id=number,
        name=f"{vehicle.name}/{device.name}",
        model=model,
        vehicle=index,
        link=device.relative_to,
        object=None,
        frame_from_mesh=product(link_from_device, np.diag([*device.mesh.scale_factor, 1.0])),
        is_hidden=bool(vehicle.vr),
    )


def placed_model(
    scene: SceneSpec, spec: ObjectSpec, model: Model
) -> tuple[Model, npt.NDArray[np.float64]]:
    """Return the model of an object, and ``object_from_mesh`` with its scale, (4, 4) [m].

    The model of a ``<u:course>`` is bent along it, that of a ``<u:net>`` repeated for its twines,
    and that of a ``<u:dock>`` gets its dimensions, in the frame of the object.
    """
    object_from_mesh = product(np.diag([*spec.scale_factor, 1.0]), spec.object_from_mesh.matrix)
    course, dock = spec.course, spec.dock
    if dock is not None:
        shape = DockShape(
            funnel_length=dock.funnel_length,
            length=dock.length,
            entrance=(dock.entrance_width, dock.entrance_height),
            throat=(dock.width, dock.height),
        )
        return shape_dock(model, object_from_mesh, shape), np.eye(4)
    if spec.net is not None:
        return weave_net(model, object_from_mesh, spec.net.twines), np.eye(4)
    if course is None:
        return model, object_from_mesh
    world_from_object = scene.world_from_localized @ spec.localized_from_object
    burial = (course.burial_depth, course.buried_share, course.buried_stretches)
    line = BentLine(course.line, burial, -world_from_object.rotation[2])
    return bend_model(model, object_from_mesh, line), np.eye(4)


def _weathered_model(model: Model, spec: ObjectSpec) -> Model:
    weathering = spec.weathering
    if weathering is None:
        return model
    return weather_model(model, weathering.pattern, weathering.strength)


def placed_visual(
    visual: VisualSpec, named_by: Path, data_path: tuple[Path, ...]
) -> tuple[Model, npt.NDArray[np.float64]]:
    """Return the model of a link's shape, and ``link_from_mesh`` with its scale, (4, 4) [m]."""
    model, scale = visual_model(visual, named_by, data_path)
    link_from_visual = Pose.from_rpy(visual.position, visual.rpy).matrix
    return model, product(link_from_visual, np.diag([*scale, 1.0]))


def visual_model(
    visual: VisualSpec, named_by: Path, data_path: tuple[Path, ...]
) -> tuple[Model, tuple[float, float, float]]:
    """Load or create the coloured model of a link's shape; return it with its scale [1].

    A labelled box of fixed size replaces a mesh that is not found.
    """
    scale = visual.scale
    if visual.kind == "mesh":
        try:
            model = load_model(visual.file, named_by=named_by, data_path=data_path)
            scale = robot_scale(model, scale)
        except AssetNotFound:  # reported by `uwsim check`
            return unknown_model(visual.file), (1.0, 1.0, 1.0)
    else:
        width, depth, height = (max(edge, MIN_EDGE) for edge in visual.size)
        sizes = {"cylinder": (0.5 * width, height), "sphere": (0.5 * width,)}
        model = primitive(visual.kind, sizes.get(visual.kind, (width, depth, height)))
    return (model if visual.colour is None else paint_model(model, visual.colour)), scale


def object_models(scene: SceneSpec, data_path: tuple[Path, ...]) -> Callable[[str], Model]:
    """Return a function that loads the model of an object by its file name, each file once.

    In a scene of the original UWSim, a labelled box replaces a file that is not found.
    """
    named_by = Path(scene.path).parent if scene.path else None

    @functools.cache
    def load(name: str) -> Model:
        try:
            return with_z_up(load_model(name, named_by=named_by, data_path=data_path))
        except AssetNotFound:
            if not scene.is_original:
                raise
            return unknown_model(name)

    return load


def comms_devices(vehicle: VehicleSpec) -> Iterator[CommsDeviceSpec]:
    """Yield the communication devices of a vehicle."""
    yield from vehicle.parts_of(CustomCommsDeviceSpec)
    yield from vehicle.parts_of(AcousticCommsDeviceSpec)
