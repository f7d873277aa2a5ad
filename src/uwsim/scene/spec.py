"""The spec of a scene: water, simulation, viewer, vehicles, objects.

.. code-block:: xml

    <UWSimScene>
      <oceanState> <fog> <density>0.1</density> ... </fog> </oceanState>
      <simParams> <offsetr> <x>M_PI</x> <y>0</y> <z>-M_PI_2</z> </offsetr> </simParams>
      <vehicle> <name>girona500</name> <file>data/scenes/g500ARM5.urdf</file> ... </vehicle>
      <object> <name>blackbox</name> <file>objects/blackbox_uib_trimesh.osg</file> ... </object>
      <rosInterfaces> ... </rosInterfaces>
    </UWSimScene>

The format comes from the original UWSim (written in C++), to which this program adds elements with
the prefix ``u:``. The fields are in the order of UWSim's grammar. Positions and angles are the
numbers of the file, in its frame L (the localized world), which `SceneSpec.world_from_localized`
relates to the world frame W. UWSim uses two orders of Euler angles; the properties that return a
`Pose` apply the order of their element. Where UWSim leaves a value uninitialised, the default here
is that of its macro library.

Forces move a vehicle with ``u:dynamics``: it *has dynamics*. Without that element a vehicle is
*kinematic*: only commands and the current move it. An object is *solid* if it has contacts, and
*loose* if it is also free to move. If no vehicle has dynamics, ``<enablePhysics>`` requests the
physics of the original UWSim: gravity and contacts move loose objects, without water.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from functools import cached_property
from typing import get_args

from ..base.geodesy import Geodetic
from ..base.geometry import Pose
from ..devices.comms.comms_channels import AcousticCommsChannelSpec, CustomCommsChannelSpec
from ..errors import BadSetting
from ..forces import FORCES, ForceSpec
from ..schema import NAMESPACE, REQUIRED_BY_DTD, Expansion, Original, Spec, element
from ..topics import INTERFACES, InterfaceSpec
from .object import ObjectSpec, PhysicsSpec
from .ocean_state import OceanStateSpec
from .sim_params import Integrator, SimParamsSpec, ViewerCameraSpec
from .variation import DISTRIBUTIONS, VariationSpec
from .vehicle import VehicleSpec


@dataclass(frozen=True, kw_only=True)
class NedOriginSpec(Spec):
    """A ``<nedOrigin>``: the position on Earth of the origin of W, for ``<fdm>`` and GPS."""

    lat: float = element(
        default=0.0,
        minimum=-90,
        maximum=90,
        original=Original(allows_trailing_text=True, is_required=True),
    )
    """The latitude [deg]."""
    lon: float = element(
        default=0.0,
        minimum=-360,
        maximum=360,
        original=Original(allows_trailing_text=True, is_required=True),
    )
    """The longitude [deg]."""

    @property
    def geodetic_position(self) -> Geodetic:
        """The position on the Earth's ellipsoid."""
        return Geodetic(latitude=math.radians(self.lat), longitude=math.radians(self.lon))


@dataclass(frozen=True, kw_only=True)
class NetTracingScriptSpec(Spec):
    """A ``<netTracingScript>``: the events of each packet are published on ``/network/trace``.

    Each event is a std_msgs/String: time [s], device, event, sender, packet number, packet size.
    """

    class_name: str = element(default="", original=REQUIRED_BY_DTD)
    """The name of a plug-in of the original UWSim: read but not used."""
    lib_path: str = ""
    """The library of the plug-in: read but not used."""
    log_to_file: str = ""
    """The log file: read but not used, as a scene writes no files."""
    log_to_console: bool = True
    """The log to the console: read but not used."""
    async_log: bool = True
    """The asynchronous log: read but not used."""


@dataclass(frozen=True, kw_only=True)
class SceneSpec(Spec):
    """A ``<UWSimScene>``: the contents of a scene file."""

    ocean_state: OceanStateSpec = element(default=OceanStateSpec())
    """The water surface and the properties of the water."""
    sim_params: SimParamsSpec = element(default=SimParamsSpec())
    """The parameters of the simulation: frame of the file, window, physics, light."""
    camera: ViewerCameraSpec | None = element(
        default=None, original=Original(is_window_setting=True)
    )
    """The camera of the viewer."""
    ned_origin: NedOriginSpec | None = None
    """The position of the scene on Earth."""
    net_tracing_script: NetTracingScriptSpec | None = None
    """The publication of network events; without it events are not published."""
    custom_comms_channels: tuple[CustomCommsChannelSpec, ...] = element(
        "CustomCommsChannel", default=()
    )
    """The communication channels with configured delays."""
    acoustic_comms_channels: tuple[AcousticCommsChannelSpec, ...] = element(
        "AcousticCommsChannel", default=()
    )
    """The acoustic communication channels."""
    vehicles: tuple[VehicleSpec, ...] = element("vehicle", default=())
    """The vehicles, each with its robot, sensors and devices."""
    objects: tuple[ObjectSpec, ...] = element("object", default=())
    """The objects in the water."""
    ros_interfaces: tuple[InterfaceSpec, ...] = element(choice=INTERFACES, default=())
    """The topics on which the scene publishes and receives messages."""
    vary: tuple[VariationSpec, ...] = element(namespaced=True, choice=DISTRIBUTIONS, default=())
    """The values that are drawn at random for each seed."""
    forces: tuple[ForceSpec, ...] = element(
        namespaced=True, default=(),
        choice={f"{{{NAMESPACE}}}{name}": spec for name, spec in FORCES.items()},
    )  # fmt: skip
    """The forces on bodies besides those of the water."""
    path: str = dataclasses.field(default="", compare=False, metadata={"path": True})
    """The path of the file from which the scene was read."""
    is_original: bool = dataclasses.field(default=False, compare=False, metadata={"path": True})
    """True if the file names the DTD of the original UWSim: labelled boxes then replace missing
    models."""

    expansion: Expansion = dataclasses.field(
        default=Expansion(), compare=False, metadata={"path": True}
    )
    """The result of the xacro expansion; its arguments also apply to the robot files."""

    @property
    def nominal_scene(self) -> SceneSpec:
        """The scene without variations: with the values of the file for any seed."""
        return dataclasses.replace(self, vary=())

    @cached_property
    def world_from_localized(self) -> Pose:
        """The pose of L in W, from ``offsetp`` and ``offsetr`` of ``simParams``."""
        return Pose.from_xyz(self.sim_params.offsetp, self.sim_params.offsetr)

    @property
    def earth_origin(self) -> Geodetic | None:
        """The position on Earth of the origin of W (x east, y north); None if not given."""
        return None if self.ned_origin is None else self.ned_origin.geodetic_position

    @property
    def is_dynamic(self) -> bool:
        """True if at least one vehicle has dynamics (``u:dynamics``)."""
        return any(vehicle.dynamics is not None for vehicle in self.vehicles)

    @property
    def requests_original_physics(self) -> bool:
        """True if ``enablePhysics`` requests the physics of UWSim, and no vehicle has dynamics."""
        return self.sim_params.enable_physics and not self.is_dynamic

    @property
    def has_original_physics(self) -> bool:
        """True if the physics of the original UWSim moves at least one object."""
        return self.requests_original_physics and any(
            physics.is_loose for physics in self.solid_objects.values()
        )

    @property
    def solid_objects_in_water(self) -> dict[int, PhysicsSpec]:
        """The objects that vehicles with dynamics have contacts with, by index.

        These are objects with ``<physics>`` or ``u:solid`` 1 and, if a vehicle has dynamics, the
        object ``terrain``; but not objects with ``u:solid`` 0.
        """
        is_dynamic = self.is_dynamic
        return {
            i: spec.solid
            for i, spec in enumerate(self.objects)
            if spec.has_contacts(in_water=is_dynamic)
        }

    @property
    def solid_objects(self) -> dict[int, PhysicsSpec]:
        """The objects that can have contacts, by index.

        These are the `solid_objects_in_water`. If there are none, or in the physics of the original
        UWSim, these are all objects without ``u:solid`` 0. If there are none, they are fixed:
        contacts can be requested, where the original UWSim would crash.
        """
        objects = {i: spec for i, spec in enumerate(self.objects) if spec.is_solid is not False}
        if self.requests_original_physics:
            return {i: spec.solid for i, spec in objects.items()}
        if solids := self.solid_objects_in_water:
            return solids
        return {
            i: dataclasses.replace(spec.solid, is_kinematic=True) for i, spec in objects.items()
        }


def with_integrator(scene: SceneSpec, integrator: Integrator | None) -> SceneSpec:
    """Return the scene with another integrator; None: no change.

    Raises:
        BadSetting: there is no such integrator.
    """
    if integrator is None:
        return scene
    if integrator not in get_args(Integrator):
        raise BadSetting(
            f"The integrator is {integrator!r}; expected {' or '.join(get_args(Integrator))}."
        )
    sim_params = dataclasses.replace(scene.sim_params, integrator=integrator)
    return dataclasses.replace(scene, sim_params=sim_params)


def has_floor_placement(scene: SceneSpec) -> bool:
    """Return whether the scene has a vehicle or object with ``u:onFloor``."""
    floors = [vehicle.on_floor for vehicle in scene.vehicles]
    floors += [spec.on_floor for spec in scene.objects]
    return any(floor is not None for floor in floors)
