"""What a scene file says of a vehicle: a robot, where it stands, its sensors and devices.

.. code-block:: xml

    <vehicle>
      <name>girona500</name> <file>data/scenes/g500ARM5.urdf</file>
      <position> <x>0</x> <y>0</y> <z>0</z> </position>
      <virtualCamera> <name>bowtech1</name> ... </virtualCamera>
      <u:dynamics>g500_physical</u:dynamics>
    </vehicle>

The fields stand in the order of the original grammar, as in `spec`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from ..devices.acoustic_comms_device import AcousticCommsDeviceSpec
from ..devices.custom_comms_device import CustomCommsDeviceSpec
from ..devices.dredge_tool import DredgeToolSpec
from ..devices.echo import EchoSpec, SimulatedDevicesSpec
from ..devices.force_sensor import ForceSensorSpec
from ..devices.lamp import LampSpec
from ..devices.led_array import LedArraySpec
from ..devices.object_picker import ObjectPickerSpec
from ..devices.sway import SwaySpec
from ..devices.thruster_fault import ThrusterFaultSpec
from ..geometry import ONE, ZERO, Pose, Triple
from ..schema import MAX_DISTANCE, element, fields_of
from ..sensors.dvl_sensor import DvlSensorSpec
from ..sensors.gps_sensor import GpsSensorSpec
from ..sensors.imu import ImuSpec
from ..sensors.multibeam_sensor import MultibeamSensorSpec
from ..sensors.pressure_sensor import PressureSensorSpec
from ..sensors.profiling_sonar import ProfilingSonarSpec
from ..sensors.range_sensor import RangeSensorSpec
from ..sensors.structured_light_projector import StructuredLightProjectorSpec
from ..sensors.virtual_camera import VirtualCameraSpec
from ..sensors.virtual_range_image import VirtualRangeImageSpec
from .doubts import VehicleDoubt
from .on_floor import OnFloorSpec


@dataclass(frozen=True, kw_only=True)
class TfSpec:
    """A ``<tf>``: the vehicle follows a ROS frame."""

    tf_id: str
    """The frame it follows."""
    position: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """Of the vehicle in that frame [m]."""
    orientation: Triple = element(default=ZERO, parts="rpy")
    """Of the vehicle in that frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""


@dataclass(frozen=True, kw_only=True)
class VehicleSpec:
    """A ``<vehicle>``: a robot and its sensors; dynamic if and only if ``dynamics`` is given."""

    name: str
    """Its name: node, topic target, prefix of its frames."""
    file: str
    """Its URDF file."""
    fdm: int = -1
    """UDP port on which a flight dynamics model sends poses; -1 is off."""
    tf: TfSpec | None = None
    """The ROS frame it follows."""
    vr: bool = False
    """Whether it is a ghost: drawn in the viewer, unseen by cameras."""
    joint_values: tuple[float, ...] = element(item="joint", default=())
    """Of the movable joints that mimic no other, in the order of the tree [rad or m]."""
    position: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """Of its base in the file's frame [m]."""
    orientation: Triple = element(default=ZERO, parts="rpy")
    """Of its base in the file's frame, in UWSim's vehicle order: Rx Ry Rz [rad]."""
    scale_factor: Triple = element(default=ONE, minimum=1e-6, maximum=1e6)
    """Scale of the whole vehicle along x, y, z of its base: of its meshes, the distances of its
    links, and what is mounted on them; a simulated vehicle has none [1]."""
    virtual_cameras: tuple[VirtualCameraSpec, ...] = element("virtualCamera", default=())
    """Colour cameras."""
    structured_light_projectors: tuple[StructuredLightProjectorSpec, ...] = element(
        "structuredLightProjector", default=()
    )
    """Lasers and lamps."""
    range_sensors: tuple[RangeSensorSpec, ...] = element("rangeSensor", default=())
    """Single rays."""
    object_pickers: tuple[ObjectPickerSpec, ...] = element("objectPicker", default=())
    """Pickers."""
    imus: tuple[ImuSpec, ...] = element("imu", default=())
    """Attitude."""
    pressure_sensors: tuple[PressureSensorSpec, ...] = element("pressureSensor", default=())
    """Depth."""
    gps_sensors: tuple[GpsSensorSpec, ...] = element("gpsSensor", default=())
    """Position at the surface."""
    dvl_sensors: tuple[DvlSensorSpec, ...] = element("dvlSensor", default=())
    """Velocity over ground."""
    virtual_range_images: tuple[VirtualRangeImageSpec, ...] = element(
        "virtualRangeImage", default=()
    )
    """Depth cameras."""
    multibeam_sensors: tuple[MultibeamSensorSpec, ...] = element("multibeamSensor", default=())
    """Fans of beams."""
    profiling_sonars: tuple[ProfilingSonarSpec, ...] = element("ProfilingSonar", default=())
    """Stepping sonars; not in the original grammar, though in its users' files."""
    simulated_devices: SimulatedDevicesSpec | None = None
    """An optional wrapper around devices."""
    echos: tuple[EchoSpec, ...] = element("echo", default=())
    """Echo devices."""
    force_sensors: tuple[ForceSensorSpec, ...] = element("ForceSensor", default=())
    """Wrench of contacts."""
    dredge_tools: tuple[DredgeToolSpec, ...] = element("DredgeTool", default=())
    """Uncover buried objects."""
    custom_comms_devices: tuple[CustomCommsDeviceSpec, ...] = element(
        "CustomCommsDevice", default=()
    )
    """Links described by delays."""
    acoustic_comms_devices: tuple[AcousticCommsDeviceSpec, ...] = element(
        "AcousticCommsDevice", default=()
    )
    """Acoustic modems."""
    led_array: LedArraySpec | None = element("LedArray", default=None)
    """Signal lamps."""
    dynamics: str | None = element(namespaced=True, default=None)
    """Name of the hydrodynamic model, for example g500_physical; without it the vehicle is moved
    by commands alone."""
    velocity_loop: Literal["water", "ground"] = element(namespaced=True, default="water")
    """What the velocity loop of a simulated vehicle measures its speed against."""
    sways: tuple[SwaySpec, ...] = element("sway", namespaced=True, default=())
    """Sinusoids about its place, for a vehicle that nobody steers."""
    faults: tuple[ThrusterFaultSpec, ...] = element("fault", namespaced=True, default=())
    """Thrusters of a simulated vehicle that fail; of several on one the greatest loss counts."""
    lamps: tuple[LampSpec, ...] = element("lamp", namespaced=True, default=())
    """Lamps that light what cameras see."""
    on_floor: OnFloorSpec | None = element(namespaced=True, default=None)
    """Whether it begins on the ground."""
    accepts: tuple[VehicleDoubt, ...] = element("accept", namespaced=True, default=())
    """Warnings of `uwsim check` that do not apply here, because the value is intended; the
    section *Doubts* of the reference lists the names."""

    def parts(self) -> Iterator[tuple[str, object]]:
        """Element name and spec of everything it carries, in the order of the grammar."""
        for field in fields_of(VehicleSpec):
            held = getattr(self, field.name)
            if field.kind == "spec" and held is not None:
                yield from ((field.shown, part) for part in (held if field.repeated else (held,)))
        if self.simulated_devices is not None:
            yield from (("echo", part) for part in self.simulated_devices.echo)

    @property
    def localized_from_base(self) -> Pose:
        """Where its base stands in L at the start, without its scale."""
        return Pose.from_xyz(self.position, self.orientation)
