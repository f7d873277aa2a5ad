"""The protocols and base classes of sensors: specs, mounts on links, samples and messages."""

from __future__ import annotations

import abc
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, Literal, Protocol, runtime_checkable

import numpy as np
import numpy.typing as npt

from ..base.geometry import Array
from ..base.numerics.calls import function_address
from ..base.record import Record
from ..base.sampling import Sampler
from ..schema import Spec
from ..world import CompiledVehicle, Mount, MovingBody, SensorWorld

Direction = Literal["forward", "aft", "starboard", "port", "down", "up"]
"""A direction relative to a vehicle at its pose in the scene file."""
LookAt = tuple[float, float, float] | Direction | None
"""The content of ``<u:lookAt>``: a point in L [m], a direction of the vehicle, or nothing."""


OPTICAL_AXES = (math.pi, 0.0, 0.0)
"""The roll, pitch, yaw of a ROS optical frame (z ahead, x right, y down) in the frame of a sensor
that looks along -z [rad]."""
SCAN_AXES = (0.0, 0.5 * math.pi, 0.0)
"""The roll, pitch, yaw of a ROS scan frame (x ahead, beam angles about z) in the frame of a sensor
whose beams are in the y-z plane, with the angle 0 along -z [rad]."""


@dataclass(frozen=True, kw_only=True)
class SensorSpec(Spec):
    """A sensor of a vehicle."""

    frame_rpy: ClassVar[tuple[float, float, float]] = (0.0, 0.0, 0.0)
    """The fixed-axis roll, pitch, yaw of the sensor's ROS frame in the sensor's own frame [rad]."""
    is_pure: ClassVar[bool] = False
    """True if a sample does not change the sensor's state. Without subscribers, no samples are then
    taken."""

    name: str
    """The name by which interfaces and benchmarks refer to the sensor."""
    relative_to: str
    """The link on which the sensor is mounted; its pose is relative to the link's kinematic
    frame."""


class MountedPart(Protocol):
    """A part with a pose on a link."""

    @property
    def relative_to(self) -> str:
        """The name of the link."""

    @property
    def position(self) -> tuple[float, float, float]:
        """The position in the link's frame [m]."""

    @property
    def orientation(self) -> tuple[float, float, float]:
        """The orientation in the link's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""


@runtime_checkable
class MountedSensor(MountedPart, Protocol):
    """The spec of a mounted sensor."""

    frame_rpy: ClassVar[tuple[float, float, float]]
    """The fixed-axis roll, pitch, yaw of the sensor's ROS frame in the sensor's own frame [rad]."""

    @property
    def name(self) -> str:
        """The name in the scene."""


@runtime_checkable
class DirectedPart(MountedPart, Protocol):
    """A mounted part with a viewing direction."""

    @property
    def look_at(self) -> LookAt:
        """The viewing target at the start, instead of ``orientation``: a point or a direction."""


class Carrier(Protocol):
    """A vehicle that carries sensors."""

    @property
    def name(self) -> str:
        """The name in the scene."""

    @property
    def compiled_vehicle(self) -> CompiledVehicle:
        """The interface of the vehicle for compiled code."""

    def mount(self, spec: MountedPart, *, visual: bool = False) -> Mount:
        """Fix a part to its link, or to the link's visual frame; return a frame that moves with it.

        Raises:
            UnknownName: the vehicle has no such link.
        """

    def moving_mount(self, spec: MountedPart, *, visual: bool = False) -> MovingBody:
        """Fix a part to its link, or to the link's visual frame; return a body that has a motion.

        Raises:
            UnknownName: the vehicle has no such link.
        """


@runtime_checkable
class Sensor(Protocol):
    """A sensor that is bound to a scene."""

    @property
    def state(self) -> Record:
        """The part of the sensor that changes with time; `Simulation.save` stores it."""

    def sample(self, time: float) -> object:
        """Measure at ``time`` [s]; return a message of the spec's ``message_type``, or None."""


class CompiledSensor(abc.ABC):
    """A sensor whose samples are taken by compiled code; `message` builds messages from them."""

    sampler: Sampler
    """The sampler that takes samples in compiled code."""

    @abc.abstractmethod
    def message(self, time: float, values: Array) -> object:
        """Return the message of a sample at ``time`` [s], or None.

        Args:
            time: the time of the sample [s].
            values: the numbers of the sample, (n,); the next sample overwrites them.
        """

    def sample(self, time: float) -> Any:
        """Measure at ``time`` [s]; return a message, or None."""
        return self.message(time, self.sampler.take(time))


def create_sampler(
    mount: Mount,
    function: Callable[[int, int, float], None],
    parameters: npt.NDArray[np.void],
    n_values: int,
    memory_owners: tuple[object, ...],
) -> Sampler:
    """Create the sampler of a sensor that depends on no motion except that of its mount.

    Args:
        mount: the frame of the sensor.
        function: the module's function that takes a sample; see `uwsim.base.numerics.calls`.
        parameters: the parameters of the function, a record, (1,).
        n_values: the number of values that the function writes.
        memory_owners: the objects whose addresses the parameters contain, besides the mount.
    """
    return Sampler(
        function=function_address(function),
        parameters=parameters,
        n_values=n_values,
        prepare=lambda _: mount.prepare(),
        can_skip_prepare=lambda _: mount.is_compiled,
        memory_owners=(mount, *memory_owners),
    )


@runtime_checkable
class BindsSensor(Protocol):
    """The spec of a sensor that is simulated; other specs have no ``bind``."""

    message_type: ClassVar[type]
    """The type of the sensor's messages."""

    @property
    def name(self) -> str:
        """The name in the scene."""

    def bind(self, world: SensorWorld, vehicle: Carrier) -> Sensor:
        """Mount the sensor on its vehicle; raise UnknownName if there is no such link."""


def find_message_type(spec: type) -> type | None:
    """Return the message type of the spec of a sensor or device; None if it is not simulated."""
    return getattr(spec, "message_type", None) if hasattr(spec, "bind") else None
