"""The spec of a vehicle: robot, pose, sensors and devices.

.. code-block:: xml

    <vehicle>
      <name>girona500</name> <file>data/scenes/g500ARM5.urdf</file>
      <position> <x>0</x> <y>0</y> <z>0</z> </position>
      <virtualCamera> <name>bowtech1</name> ... </virtualCamera>
      <u:dynamics>g500_physical</u:dynamics>
    </vehicle>

The fields are in the order of UWSim's grammar, as in `spec`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal, TypeVar

from ..base.geometry import UNIT_SCALE, ZERO, Pose, Triple
from ..devices import DEVICES
from ..devices.echo import SimulatedDevicesSpec
from ..devices.fdm import FdmSpec
from ..devices.tf import TfSpec
from ..schema import CLAMPED_NUMBER, MAX_DISTANCE, Spec, element
from ..schema.names import prefixed_name
from ..sensors import SENSORS
from .accepted_warnings import VehicleWarning
from .on_floor import OnFloorSpec

T = TypeVar("T")

ORIGINAL_PARTS = (
    "virtualCamera", "structuredLightProjector", "rangeSensor", "objectPicker", "imu",
    "pressureSensor", "gpsSensor", "dvlSensor", "virtualRangeImage", "multibeamSensor",
    "ProfilingSonar", "simulatedDevices", "echo", "ForceSensor", "DredgeTool", "CustomCommsDevice",
    "AcousticCommsDevice", "LedArray",
)  # fmt: skip
"""The parts that the original UWSim allows in a vehicle, in the order of its grammar."""
_PART_TABLE: dict[str, type] = {**SENSORS, **DEVICES, "simulatedDevices": SimulatedDevicesSpec}
PARTS: dict[str, type] = {
    tag: _PART_TABLE[tag]
    for tag in (*ORIGINAL_PARTS, *(tag for tag in _PART_TABLE if tag not in ORIGINAL_PARTS))
}
"""The spec of each element that is a sensor or device; extensions of UWSim last."""


@dataclass(frozen=True, kw_only=True)
class VehicleSpec(Spec):
    """A ``<vehicle>``: a robot with its sensors and devices.

    Forces move a vehicle with ``dynamics``; without, it is kinematic.
    """

    name: str
    """The name, which topics and measures refer to, and the prefix of its frames."""
    file: str
    """The URDF file of the robot."""
    fdm: int = element(default=-1, minimum=-1, maximum=65535)
    """The UDP port to which a flight dynamics model sends poses; -1 and 0 are off. A benchmark
    opens no port; a simulation in Python opens it at its ``udp_address``."""
    tf: TfSpec | None = None
    """The ROS frame that the vehicle follows; without it none."""
    vr: bool = False
    """True if the vehicle is a ghost, visible in the viewer and not to cameras."""
    joint_values: tuple[float, ...] = element(item="joint", default=())
    """The values of the movable joints that mimic no other, in the order of the tree [rad or m]."""
    position: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """The position of the base in the frame of the scene file, L [m]."""
    orientation: Triple = element(default=ZERO, parts="rpy")
    """The orientation of the base in the frame of the scene file, L, in UWSim's order for vehicles:
    Rx Ry Rz [rad]."""
    scale_factor: Triple = element(
        default=UNIT_SCALE, minimum=1e-6, maximum=1e6, original=CLAMPED_NUMBER
    )
    """The scale of the whole vehicle along x, y, z of its base: of the meshes, and of the positions
    of links and mounted parts; it must be 1 for a vehicle with dynamics [1]."""
    parts: tuple[object, ...] = element("", choice=PARTS, default=())
    """The sensors and devices, in the order of `PARTS`."""
    dynamics: str | None = element(namespaced=True, default=None)
    """The name of the hydrodynamic model, for example g500_physical; without it the vehicle is
    kinematic: commands and the current move it."""
    hydrodynamics: tuple[tuple[str, str], ...] = field(default=(), metadata={"not_in_file": True})
    """The path and the value of each number of the hydrodynamic model that ``--set`` or ``u:vary``
    changes."""
    velocity_loop: Literal["water", "ground"] = element(namespaced=True, default="water")
    """The velocity that the autopilot controls: relative to the water, or over ground."""
    on_floor: OnFloorSpec | None = element(namespaced=True, default=None)
    """The placement on the ground at the start; without it the vehicle begins at its position."""
    accepts: tuple[VehicleWarning, ...] = element("accept", namespaced=True, default=())
    """The warnings of `uwsim check` that do not apply, because the value is intended; the
    section *Plausibility warnings* of the reference lists the names."""

    def all_parts(self) -> Iterator[tuple[str, object]]:
        """Yield the element name and the spec of every part, in the order of the grammar."""
        if self.fdm > 0:
            yield "fdm", FdmSpec(port=self.fdm)
        if self.tf is not None:
            yield "tf", self.tf
        for part in self.parts:
            yield (
                next(prefixed_name(tag) for tag, spec in PARTS.items() if isinstance(part, spec)),
                part,
            )
        for box in self.parts_of(SimulatedDevicesSpec):
            yield from (("echo", part) for part in box.echo)

    @property
    def sensor_names(self) -> tuple[str, ...]:
        """The names of all sensors and devices that have a name."""
        names = (getattr(part, "name", None) for _, part in self.all_parts())
        return tuple(name for name in names if name is not None)

    def parts_of(self, kind: type[T]) -> tuple[T, ...]:
        """Return the sensors or devices of one kind."""
        return tuple(part for part in self.parts if isinstance(part, kind))

    @property
    def localized_from_base(self) -> Pose:
        """The pose of the base in L at the start, without its scale."""
        return Pose.from_xyz(self.position, self.orientation)
