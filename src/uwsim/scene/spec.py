"""The spec of a scene: water, simulation, viewer, vehicles, objects.

.. code-block:: xml

    <UWSimScene>
      <oceanState> <fog> <density>0.1</density> ... </fog> </oceanState>
      <simParams> <offsetr> <x>M_PI</x> <y>0</y> <z>-M_PI_2</z> </offsetr> </simParams>
      <vehicle> <name>girona500</name> <file>data/scenes/g500ARM5.urdf</file> ... </vehicle>
      <object> <name>blackbox</name> <file>objects/blackbox_uib_trimesh.osg</file> ... </object>
      <rosInterfaces> ... </rosInterfaces>
    </UWSimScene>

The fields stand in the order of the original grammar. Positions and angles keep the numbers and
the frame of the file, L; the properties that return a `Pose` know which of UWSim's two Euler
orders holds where. Where the original leaves a value uninitialised, the default is that of its
own macro library.
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
    """A ``<nedOrigin>``: where on Earth the origin of W is, for ``<fdm>`` and GPS."""

    lat: float = element(
        default=0.0,
        minimum=-90,
        maximum=90,
        original=Original(allows_trailing_text=True, is_required=True),
    )
    """Latitude [deg]."""
    lon: float = element(
        default=0.0,
        minimum=-360,
        maximum=360,
        original=Original(allows_trailing_text=True, is_required=True),
    )
    """Longitude [deg]."""

    @property
    def place(self) -> Geodetic:
        """The place on the ellipsoid."""
        return Geodetic(latitude=math.radians(self.lat), longitude=math.radians(self.lon))


@dataclass(frozen=True, kw_only=True)
class NetTracingScriptSpec(Spec):
    """A ``<netTracingScript>``: what becomes of each packet is published on ``/network/trace``.

    As std_msgs/String: time [s], device, what happens, sender and number of the packet, its size.
    """

    class_name: str = element(default="", original=REQUIRED_BY_DTD)
    """Name of a plug-in of the original: read and not used."""
    lib_path: str = ""
    """Library that holds it: read and not used."""
    log_to_file: str = ""
    """Read and not used: a scene writes no files."""
    log_to_console: bool = True
    """Read and not used."""
    async_log: bool = True
    """Read and not used."""


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
    """Where on Earth the scene lies."""
    net_tracing_script: NetTracingScriptSpec | None = None
    """Watches the network simulation."""
    custom_comms_channels: tuple[CustomCommsChannelSpec, ...] = element(
        "CustomCommsChannel", default=()
    )
    """Channels described by delays."""
    acoustic_comms_channels: tuple[AcousticCommsChannelSpec, ...] = element(
        "AcousticCommsChannel", default=()
    )
    """Acoustic channels."""
    vehicles: tuple[VehicleSpec, ...] = element("vehicle", default=())
    """The robots."""
    objects: tuple[ObjectSpec, ...] = element("object", default=())
    """Everything else."""
    ros_interfaces: tuple[InterfaceSpec, ...] = element(choice=INTERFACES, default=())
    """Topics in and out."""
    vary: tuple[VariationSpec, ...] = element(namespaced=True, choice=DISTRIBUTIONS, default=())
    """Values that are drawn anew for each seed."""
    forces: tuple[ForceSpec, ...] = element(
        namespaced=True, default=(),
        choice={f"{{{NAMESPACE}}}{name}": spec for name, spec in FORCES.items()},
    )  # fmt: skip
    """Forces on bodies besides those of the water."""
    path: str = dataclasses.field(default="", compare=False, metadata={"path": True})
    """The file it was read from."""
    is_original: bool = dataclasses.field(default=False, compare=False, metadata={"path": True})
    """Whether it names the original's DTD: models that are nowhere are then labelled boxes."""

    expansion: Expansion = dataclasses.field(
        default=Expansion(), compare=False, metadata={"path": True}
    )
    """What is known of its xacro: the arguments from outside hold for its robots, too."""

    @property
    def nominal(self) -> SceneSpec:
        """The same without variations: as the file says, whatever the seed."""
        return dataclasses.replace(self, vary=())

    @cached_property
    def world_from_localized(self) -> Pose:
        """W from L: the offset in ``simParams``."""
        return Pose.from_xyz(self.sim_params.offsetp, self.sim_params.offsetr)

    @property
    def earth_origin(self) -> Geodetic | None:
        """Where on Earth the origin of W is: x east, y north; None if the scene does not say."""
        return None if self.ned_origin is None else self.ned_origin.place

    @property
    def is_dynamic(self) -> bool:
        """Whether a vehicle is simulated."""
        return any(vehicle.dynamics is not None for vehicle in self.vehicles)

    @property
    def is_original_physics(self) -> bool:
        """Whether the original's physics is asked for: ``enablePhysics``, nothing in water."""
        return self.sim_params.enable_physics and not self.is_dynamic

    @property
    def has_uwsim_physics(self) -> bool:
        """Whether objects move by the original's physics."""
        return self.is_original_physics and any(
            physics.is_loose for physics in self.solid_objects.values()
        )

    @property
    def simulated_solids(self) -> dict[int, PhysicsSpec]:
        """What can be touched besides vehicles in simulated water, by number.

        Objects with ``<physics>`` or ``u:solid`` 1, and ``terrain``; nothing with ``u:solid`` 0.
        """
        is_dynamic = self.is_dynamic
        return {
            i: thing.solid
            for i, thing in enumerate(self.objects)
            if thing.is_touched(in_water=is_dynamic)
        }

    @property
    def solid_objects(self) -> dict[int, PhysicsSpec]:
        """What can be touched, by number: `simulated_solids`; by the original's physics all.

        All, too, and fixed, where nothing is solid: there the original ends when asked for
        contacts. Nothing with ``u:solid`` 0.
        """
        objects = {i: thing for i, thing in enumerate(self.objects) if thing.is_solid is not False}
        if self.is_original_physics:
            return {i: thing.solid for i, thing in objects.items()}
        if solids := self.simulated_solids:
            return solids
        return {
            i: dataclasses.replace(thing.solid, is_kinematic=True) for i, thing in objects.items()
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
    changed = dataclasses.replace(scene.sim_params, integrator=integrator)
    return dataclasses.replace(scene, sim_params=changed)


def stands_on_floor(scene: SceneSpec) -> bool:
    """Whether anything is to be set on the ground."""
    floors = [vehicle.on_floor for vehicle in scene.vehicles]
    floors += [thing.on_floor for thing in scene.objects]
    return any(floor is not None for floor in floors)
