"""The scene of an imported world: vehicles, objects, topics, water and the viewer's camera."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from ...base.geometry import xyz_from_rotation
from ...currents.constant import ConstantSpec
from ...scene.object import ObjectSpec
from ...scene.ocean_state import OceanStateSpec
from ...scene.sim_params import SimParamsSpec, ViewerCameraSpec
from ...scene.spec import NedOriginSpec, SceneSpec
from ...scene.vehicle import VehicleSpec
from ...sensors.virtual_camera import VirtualCameraSpec
from ...sensors.virtual_range_image import VirtualRangeImageSpec
from ...topics.arm_to_ros_joint_state import ArmToROSJointStateSpec
from ...topics.depth_images import RangeImageSensorToROSImageSpec
from ...topics.interface import InterfaceSpec
from ...topics.pat_to_ros_odom import PATToROSOdomSpec
from ...topics.ros_joint_state_to_arm import ROSJointStateToArmSpec
from ...topics.ros_twist_to_pat import ROSCmdVelToPATSpec
from ...topics.sensor_topic import SensorToROSSpec
from ...topics.thruster_commands import ROSThrustersToPATSpec
from ...topics.virtual_camera_to_ros_image import VirtualCameraToROSImageSpec
from ..plugins.coefficients import Water
from ..plugins.context import PluginContext
from ..plugins.sensors import ImportedSensor, read_sensors
from ..plugins.thrusters import triple
from .hydrodynamics_file import ImportedHydrodynamics

SURFACE_MARGIN = 2.0
"""The height of the surface above the highest vehicle, in water without a stated surface [m]."""
VIEW_DISTANCE = 4.0
"""The distance of the viewer's camera, in sizes of the first vehicle or object."""


@dataclass(kw_only=True)
class SceneParts:
    """The parts of a scene, which are added one by one."""

    vehicles: list[VehicleSpec] = field(default_factory=list)
    objects: list[ObjectSpec] = field(default_factory=list)
    interfaces: list[InterfaceSpec] = field(default_factory=list)
    currents: list[tuple[float, float, float]] = field(default_factory=list)

    def add_vehicle(
        self, name: str, context: PluginContext, hydrodynamics: ImportedHydrodynamics | None
    ) -> None:
        """Add a vehicle at its pose, with its sensors and topics.

        Args:
            name: the name of the vehicle and of its files.
            context: its robot.
            hydrodynamics: its hydrodynamics; None for a vehicle that nothing moves.
        """
        robot = context.robot
        root = robot.links[robot.root]
        world_from_base = context.model.world_from_model @ root.model_from_frame
        sensors = read_sensors(context)
        self.vehicles.append(
            VehicleSpec(
                name=name,
                file=f"{name}.urdf",
                position=triple(world_from_base.position),
                orientation=triple(np.array(xyz_from_rotation(world_from_base.rotation))),
                parts=tuple(sensor.spec for sensor in sensors),
                dynamics=None if hydrodynamics is None else name,
            )
        )
        if hydrodynamics is not None and any(hydrodynamics.current):
            self.currents.append(hydrodynamics.current)
        self.interfaces += _vehicle_topics(name, context, hydrodynamics)
        for sensor in sensors:
            self.interfaces.append(_sensor_topic(name, sensor))

    def make_scene(self, water: Water, earth_origin: tuple[float, float] | None) -> SceneSpec:
        """Return the scene."""
        current = tuple(ConstantSpec(velocity=velocity) for velocity in self.currents[:1])
        origin = None
        if earth_origin is not None:
            origin = NedOriginSpec(lat=earth_origin[0], lon=earth_origin[1])
        return SceneSpec(
            ocean_state=OceanStateSpec(
                ocean_surface_height=self._surface(water), density=water.density, currents=current
            ),
            sim_params=SimParamsSpec(),
            camera=self._camera(),
            ned_origin=origin,
            vehicles=tuple(self.vehicles),
            objects=tuple(self.objects),
            ros_interfaces=tuple(self.interfaces),
        )

    def _surface(self, water: Water) -> float:
        """Return the height of the surface: that of the file, or one above all vehicles."""
        if water.surface is not None:
            return water.surface
        top = max((vehicle.position[2] for vehicle in self.vehicles), default=-SURFACE_MARGIN)
        return max(0.0, round(top + SURFACE_MARGIN, 3))

    def _camera(self) -> ViewerCameraSpec | None:
        """Return a camera that looks at the first vehicle, else at the first object."""
        targets = [vehicle.position for vehicle in self.vehicles[:1]] or [
            entry.position for entry in self.objects[:1]
        ]
        if not targets:
            return None
        x, y, z = targets[0]
        offset = VIEW_DISTANCE
        return ViewerCameraSpec(
            position=(x - 0.7 * offset, y - 0.5 * offset, z + 0.3 * offset), look_at=targets[0]
        )


def _vehicle_topics(
    name: str, context: PluginContext, hydrodynamics: ImportedHydrodynamics | None
) -> Iterator[InterfaceSpec]:
    yield PATToROSOdomSpec(topic=f"/{name}/odom", vehicle_name=name, rate=50.0)
    if hydrodynamics is not None and hydrodynamics.vehicle.thrusters:
        yield ROSThrustersToPATSpec(topic=f"/{name}/thrusters", vehicle_name=name)
        yield ROSCmdVelToPATSpec(topic=f"/{name}/cmd_vel", vehicle_name=name)
    if any(joint.kind != "fixed" for joint in context.robot.joints):
        yield ArmToROSJointStateSpec(topic=f"/{name}/joint_states", vehicle_name=name)
        yield ROSJointStateToArmSpec(topic=f"/{name}/joint_commands", vehicle_name=name)


def _sensor_topic(vehicle: str, sensor: ImportedSensor) -> InterfaceSpec:
    name = sensor.spec.name
    topic = sensor.topic or f"/{vehicle}/{name}"
    topic = topic if topic.startswith("/") else f"/{vehicle}/{topic}"
    if isinstance(sensor.spec, VirtualCameraSpec):
        return VirtualCameraToROSImageSpec(
            camera_name=name, image_topic=topic, info_topic=f"{topic}_info", rate=sensor.rate
        )
    if isinstance(sensor.spec, VirtualRangeImageSpec):
        return RangeImageSensorToROSImageSpec(
            camera_name=name, image_topic=topic, info_topic=f"{topic}_info", rate=sensor.rate
        )
    return SensorToROSSpec(name=name, topic=topic, rate=sensor.rate)
