"""The spec of a scene: water, simulation, viewer, vehicles, objects.

.. code-block:: xml

    <UWSimScene>
      <oceanState> <fog> <density>0.1</density> ... </fog> </oceanState>
      <simParams> <offsetr> <x>M_PI</x> <y>0</y> <z>-M_PI_2</z> </offsetr> </simParams>
      <vehicle> <name>girona500</name> <file>data/scenes/g500ARM5.urdf</file> ... </vehicle>
      <object> <name>blackbox</name> <file>objects/blackbox_uib_trimesh.osg</file> ... </object>
      <rosInterfaces> ... </rosInterfaces>
    </UWSimScene>

The fields have the order of the original grammar. Positions and angles have the numbers and the
frame of the file, L; the properties that return a `Pose` apply the one of UWSim's two Euler orders
that is valid for the element. For a value that the original leaves uninitialised, the default is
that of its macro library.
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
    def place(self) -> Geodetic:
        """The position on the ellipsoid."""
        return Geodetic(latitude=math.radians(self.lat), longitude=math.radians(self.lon))


@dataclass(frozen=True, kw_only=True)
class NetTracingScriptSpec(Spec):
    """A ``<netTracingScript>``: the events of each packet are published on ``/network/trace``.

    As std_msgs/String: time [s], device, event, sender and number of the packet, its size.
    """

    class_name: str = element(default="", original=REQUIRED_BY_DTD)
    """The name of a plug-in of the original: read and not used."""
    lib_path: str = ""
    """The library of the plug-in: read and not used."""
    log_to_file: str = ""
    """The log file: read and not used, as a scene writes no files."""
    log_to_console: bool = True
    """The log to the console: read and not used."""
    async_log: bool = True
    """The asynchronous log: read and not used."""


@dataclass(frozen=True, kw_only=True)
class SceneSpec(Spec):
    """A ``<UWSimScene>``."""

    ocean_state: OceanStateSpec = element(default=OceanStateSpec())
    """The surface and the water."""
    sim_params: SimParamsSpec = element(default=SimParamsSpec())
    """Frames, window, physics, light."""
    camera: ViewerCameraSpec | None = element(
        default=None, original=Original(is_window_setting=True)
    )
    """The viewer's camera."""
    ned_origin: NedOriginSpec | None = None
    """The position of the scene on Earth."""
    net_tracing_script: NetTracingScriptSpec | None = None
    """The trace of the network simulation."""
    custom_comms_channels: tuple[CustomCommsChannelSpec, ...] = element(
        "CustomCommsChannel", default=()
    )
    """The channels with given delays."""
    acoustic_comms_channels: tuple[AcousticCommsChannelSpec, ...] = element(
        "AcousticCommsChannel", default=()
    )
    """The acoustic channels."""
    vehicles: tuple[VehicleSpec, ...] = element("vehicle", default=())
    """The robots."""
    objects: tuple[ObjectSpec, ...] = element("object", default=())
    """The objects in the water."""
    ros_interfaces: tuple[InterfaceSpec, ...] = element(choice=INTERFACES, default=())
    """The topics in and out."""
    vary: tuple[VariationSpec, ...] = element(namespaced=True, choice=DISTRIBUTIONS, default=())
    """The values that are drawn anew for each seed."""
    forces: tuple[ForceSpec, ...] = element(
        namespaced=True, default=(),
        choice={f"{{{NAMESPACE}}}{name}": spec for name, spec in FORCES.items()},
    )  # fmt: skip
    """Forces on bodies besides those of the water."""
    path: str = dataclasses.field(default="", compare=False, metadata={"path": True})
    """The file from which it was read."""
    is_original: bool = dataclasses.field(default=False, compare=False, metadata={"path": True})
    """True if it names the original's DTD; labelled boxes then replace missing models."""

    expansion: Expansion = dataclasses.field(
        default=Expansion(), compare=False, metadata={"path": True}
    )
    """The xacro expansion; the caller's arguments apply to its robots, too."""

    @property
    def nominal_scene(self) -> SceneSpec:
        """The same scene without variations: as in the file, for any seed."""
        return dataclasses.replace(self, vary=())

    @cached_property
    def world_from_localized(self) -> Pose:
        """The pose of L in W: the offset in ``simParams``."""
        return Pose.from_xyz(self.sim_params.offsetp, self.sim_params.offsetr)

    @property
    def earth_origin(self) -> Geodetic | None:
        """The position on Earth of W's origin: x east, y north; None if the scene gives none."""
        return None if self.ned_origin is None else self.ned_origin.place

    @property
    def is_dynamic(self) -> bool:
        """True if a vehicle is simulated."""
        return any(vehicle.dynamics is not None for vehicle in self.vehicles)

    @property
    def requests_uwsim_physics(self) -> bool:
        """True if the original's physics is requested: ``enablePhysics``, nothing in water."""
        return self.sim_params.enable_physics and not self.is_dynamic

    @property
    def has_uwsim_physics(self) -> bool:
        """True if objects move by the original's physics."""
        return self.requests_uwsim_physics and any(
            physics.is_loose for physics in self.solid_objects.values()
        )

    @property
    def solid_objects_in_water(self) -> dict[int, PhysicsSpec]:
        """The solid objects in simulated water, by number.

        Objects with ``<physics>`` or ``u:solid`` 1, and ``terrain``; nothing with ``u:solid`` 0.
        """
        is_dynamic = self.is_dynamic
        return {
            i: spec.solid
            for i, spec in enumerate(self.objects)
            if spec.has_contacts(in_water=is_dynamic)
        }

    @property
    def solid_objects(self) -> dict[int, PhysicsSpec]:
        """The objects with contacts, by number: `solid_objects_in_water`; all in UWSim's physics.

        If nothing is solid, all are, and fixed, as the original ends on a request for contacts.
        Never those with ``u:solid`` 0.
        """
        objects = {i: spec for i, spec in enumerate(self.objects) if spec.is_solid is not False}
        if self.requests_uwsim_physics:
            return {i: spec.solid for i, spec in objects.items()}
        if solids := self.solid_objects_in_water:
            return solids
        return {
            i: dataclasses.replace(spec.solid, is_kinematic=True) for i, spec in objects.items()
        }


def with_integrator(scene: SceneSpec, integrator: Integrator | None) -> SceneSpec:
    """Return the scene with the chosen integrator, if any.

    Raises:
        BadSetting: there is none of that name.
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
    """Return whether a vehicle or object is to be set on the ground."""
    floors = [vehicle.on_floor for vehicle in scene.vehicles]
    floors += [spec.on_floor for spec in scene.objects]
    return any(floor is not None for floor in floors)
