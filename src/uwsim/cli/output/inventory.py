"""The content of a scene as plain values, for ``uwsim info`` and its ``--json``.

Lengths are in metres and angles in radians unless a name states another unit; positions and z are
in the file's frame L, as everywhere in files and on topics.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ...devices import DEVICES
from ...devices.ardupilot import ArduPilotSpec
from ...devices.lamp import LampSpec
from ...devices.sway import SwaySpec
from ...errors import Diagnostic
from ...forces import TetherSpec
from ...scene.hydrodynamics import FinSpec, VehicleHydrodynamics
from ...scene.mounts import MountFrames
from ...scene.object import ObjectSpec
from ...scene.pointing import describe_direction, directional_parts
from ...scene.spec import SceneSpec
from ...scene.unsupported import READ_ONLY
from ...scene.urdf.robot import JointSpec, RobotSpec
from ...scene.variation import draw
from ...scene.vehicle import VehicleSpec
from ...schema import format_tag
from ...sensors import SENSORS
from ...sensors.virtual_camera import VirtualCameraSpec
from ...simulation import Simulation
from ...simulation.scenery.below import surfaces_below_vehicle
from .topic_rows import topic_rows
from .water_fields import list_water

Fields = dict[str, Any]


def inventory(
    scene: SceneSpec, simulation: Simulation, diagnostics: Sequence[Diagnostic]
) -> Fields:
    """Return the content of a scene: its parts, warnings, and elements that are not simulated."""
    warnings = [entry.message for entry in diagnostics if entry.severity == "warning"]
    model_scene = simulation.world.model.scene
    sensors = _sensors(model_scene, simulation.world.model.robots)
    directions = {f"{entry['name']!r} {entry['points']}" for entry in sensors}
    return {
        "file": scene.path,
        "frame": _frame(scene),
        "water": list_water(model_scene, simulation.world.model.optical_water),
        "vehicles": [_vehicle(model_scene, i, simulation) for i in range(len(scene.vehicles))],
        "cameras": _cameras(scene, simulation.world.model.robots),
        "sensors": sensors,
        "objects": [_object(model_scene, scene_object) for scene_object in model_scene.objects],
        "tethers": [
            _tether(force) for force in model_scene.forces if isinstance(force, TetherSpec)
        ],
        "topics": topic_rows(scene, simulation),
        "services": list(simulation.bus.services.names),
        "varies": [
            {"path": entry.path, "unit": entry.unit, "drawn_from": entry.drawn_from}
            for entry in draw(scene, 0)
        ],
        "not_simulated": [
            message.partition(": ")[2] for message in warnings if _is_read_only(message)
        ],
        "warnings": [
            message
            for message in warnings
            if not _is_read_only(message) and message not in directions
        ],
    }


def _is_read_only(warning: str) -> bool:
    return warning.startswith(READ_ONLY)


def _frame(scene: SceneSpec) -> Fields:
    up = scene.world_from_localized.rotation[2]  # z of W in L, (3,)
    axis = int(np.argmax(np.abs(up)))
    sign = "+" if up[axis] > 0.0 else "-"
    is_straight = abs(float(up[axis])) > 1.0 - 1e-6
    return {
        "up": f"{sign}{'xyz'[axis]}" if is_straight else _round(up),
        "offset": list(scene.sim_params.offsetp),
        "rotation": list(scene.sim_params.offsetr),
    }


def _vehicle(scene: SceneSpec, index: int, simulation: Simulation) -> Fields:
    spec = scene.vehicles[index]
    robot = simulation.world.model.robots[index]
    actuators = simulation.world.vehicles.actuators(spec.name)
    dynamics = simulation.world.model.dynamics.get(index)
    return {
        "name": spec.name,
        "file": spec.file,
        "position": list(spec.position),
        "orientation": list(spec.orientation),
        "dynamics": spec.dynamics,
        "moves": _motion(scene, spec),
        "links": [link.name for link in robot.links],
        "joints": [_joint(joint) for joint in robot.movable_joints],
        "thrusters": list(actuators.thrusters) if actuators is not None else [],
        "fins": [] if dynamics is None else [_fin(fin) for fin in dynamics.fins],
        "drag_laws": {} if dynamics is None else _drag_laws(dynamics),
        "lamps": len(spec.parts_of(LampSpec)),
        "below": _surfaces_below(scene, spec, simulation),
    }


def _motion(scene: SceneSpec, spec: VehicleSpec) -> str:
    if spec.dynamics is not None:
        ports = [str(part.udp_port) for part in spec.parts_of(ArduPilotSpec)]
        autopilot = f"; ArduPilot at UDP port {', '.join(ports)} with --ardupilot" if ports else ""
        return f"simulated in water ({spec.dynamics}){autopilot}"
    if spec.parts_of(SwaySpec):
        return "sways, kinematically"
    if spec.tf is not None:
        return f"kinematic: follows the frame {spec.tf.tf_id!r} of /tf"
    if spec.fdm > 0:
        return f"kinematic: goes where UDP datagrams at port {spec.fdm} put it"
    is_reported = any(
        getattr(interface, "vehicle_name", None) == spec.name and interface.subscribes
        for interface in scene.ros_interfaces
    )
    return "kinematic: goes where messages put it" if is_reported else "stands still"


def _drag_laws(dynamics: VehicleHydrodynamics) -> dict[str, str]:
    """Return the quadratic drag law of each link; links without drag are left out."""
    return {
        body.link: "matrix" if len(body.quadratic_damping) == 36 else body.drag_law
        for body in dynamics.bodies
        if any(body.quadratic_damping)
    }


def _fin(fin: FinSpec) -> Fields:
    return {
        "name": fin.name,
        "link": fin.link,
        "area": fin.area,
        "limits": list(fin.limits),
        "rate": fin.rate,
    }


def _joint(joint: JointSpec) -> Fields:
    return {
        "name": joint.name,
        "kind": joint.kind,
        "lower": joint.lower if joint.has_stops else None,
        "upper": joint.upper if joint.has_stops else None,
        "unit": "m" if joint.kind == "prismatic" else "rad",
        "mimics": joint.mimic.joint if joint.mimic is not None else None,
    }


def _surfaces_below(scene: SceneSpec, spec: VehicleSpec, simulation: Simulation) -> list[Fields]:
    """Return the surfaces below the vehicle's origin from top to bottom; the last is the floor."""
    origin = simulation.world.bodies.find(spec.name).world_from_body.position
    localized_from_world = scene.world_from_localized.inverse()
    surfaces = []
    for surface in surfaces_below_vehicle(simulation.world, spec.name):
        point = np.array([[origin[0], origin[1], surface.height]])  # W, (1, 3) [m]
        position = localized_from_world.transform(point)[0]
        distance = float(origin[2]) - surface.height
        surfaces.append({"name": surface.name, "distance": distance, "position": _round(position)})
    return surfaces


def _round(values: npt.NDArray[np.float64]) -> list[float]:
    """Round numbers to a micrometre, without a negative zero."""
    return [round(float(value), 6) + 0.0 for value in values]


def _cameras(scene: SceneSpec, robots: Mapping[int, RobotSpec]) -> list[Fields]:
    """Return all cameras; if several on existing links have one name, the last has the topics."""
    cameras = [
        (index, spec)
        for index, vehicle in enumerate(scene.vehicles)
        for spec in vehicle.parts_of(VirtualCameraSpec)
    ]
    last_cameras = {
        spec.name: (index, spec)
        for index, spec in cameras
        if robots[index].link(spec.relative_to) is not None
    }
    return [
        _camera(
            scene.vehicles[entry[0]],
            entry[1],
            _image_topics(scene, entry[1].name) if last_cameras.get(entry[1].name) == entry else [],
        )
        for entry in cameras
    ]


def _sensors(scene: SceneSpec, robots: Mapping[int, RobotSpec]) -> list[Fields]:
    """Return all sensors and lamps that have a direction and whose links exist."""
    elements: dict[type, str] = {spec: element for element, spec in (SENSORS | DEVICES).items()}
    sensors = []
    for index, vehicle in enumerate(scene.vehicles):
        frames = MountFrames(vehicle, robots[index], scene.world_from_localized)
        sensors += [
            {
                "name": str(getattr(spec, "name", "")),
                "kind": format_tag(elements[type(spec)]).strip("<>"),
                "vehicle": vehicle.name,
                "link": spec.relative_to,
                "points": describe_direction(spec, frames),
            }
            for spec in directional_parts(vehicle)
            if robots[index].link(spec.relative_to) is not None
        ]
    return sensors


def _image_topics(scene: SceneSpec, camera: str) -> list[str]:
    return [
        interface.image_topic
        for interface in scene.ros_interfaces
        if getattr(interface, "camera_name", None) == camera and hasattr(interface, "image_topic")
    ]


def _camera(vehicle: VehicleSpec, camera: VirtualCameraSpec, topics: list[str]) -> Fields:
    return {
        "name": camera.name,
        "vehicle": vehicle.name,
        "link": camera.relative_to,
        "width": camera.resw,
        "height": camera.resh,
        "fovy_deg": camera.fovy if camera.parameters is None else None,
        "std": camera.std,
        "topics": topics,
    }


def _object(scene: SceneSpec, scene_object: ObjectSpec) -> Fields:
    solid = scene.solid_objects.get(scene.objects.index(scene_object))
    kind = "seen only" if solid is None else "loose" if solid.is_loose else "solid, fixed"
    if kind == "loose" and not (
        scene.has_original_physics or any(v.dynamics for v in scene.vehicles)
    ):
        kind = "solid, fixed"
    return {
        "name": scene_object.name,
        "file": scene_object.file,
        "position": list(scene_object.position),
        "kind": kind,
    }


def _tether(spec: TetherSpec) -> Fields:
    return {
        "name": spec.name,
        "ends": [end.body or list(end.position) for end in (spec.start, spec.end)],
        "length": spec.length,
        "segments": spec.segments,
        "break_load": spec.break_load,
        "max_length": None if spec.winch is None else spec.winch.max_length,
    }
