"""The interface of sensors: name, link, pose on the link."""

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
"""The directions of a vehicle, at its pose in the file."""
LookAt = tuple[float, float, float] | Direction | None
"""The content of ``<u:lookAt>``: a point in L [m], a direction of the vehicle, or nothing."""


OPTICAL_AXES = (math.pi, 0.0, 0.0)
"""The ROS frame's axes of a sensor that looks along -z: z ahead, x to the right, y down [rad]."""
SCAN_AXES = (0.0, 0.5 * math.pi, 0.0)
"""The ROS frame's axes of a fan about x with its zero along -z: x ahead, angles about z [rad]."""


@dataclass(frozen=True, kw_only=True)
class SensorSpec(Spec):
    """A sensor of a vehicle."""

    frame_rpy: ClassVar[tuple[float, float, float]] = (0.0, 0.0, 0.0)
    """The axes of its ROS frame, in the sensor's: fixed-axis roll, pitch, yaw [rad]."""
    is_pure: ClassVar[bool] = False
    """True if a sample changes nothing in the sensor, so that it is not taken without
    subscribers."""

    name: str
    """The name, which interfaces and benchmarks refer to."""
    relative_to: str
    """The link on which it is mounted; its pose is given in the kinematic frame of that link."""


class MountedPart(Protocol):
    """A part with a pose on a link."""

    @property
    def relative_to(self) -> str:
        """The link."""

    @property
    def position(self) -> tuple[float, float, float]:
        """The position in the link's frame [m]."""

    @property
    def orientation(self) -> tuple[float, float, float]:
        """The orientation, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""


@runtime_checkable
class MountedSensor(MountedPart, Protocol):
    """The spec of a mounted sensor."""

    frame_rpy: ClassVar[tuple[float, float, float]]
    """The axes of its ROS frame, in the sensor's: fixed-axis roll, pitch, yaw [rad]."""

    @property
    def name(self) -> str:
        """The name."""


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
        """The vehicle for compiled code."""

    def mount(self, spec: MountedPart, *, visual: bool = False) -> Mount:
        """Fix a part to its link, or to the link's visual frame; return a frame that moves with it.

        Raises:
            UnknownName: the vehicle has no such link.
        """

    def moving_mount(self, spec: MountedPart, *, visual: bool = False) -> MovingBody:
        """Fix a part to its link, or to the link's visual frame; return a body with its motion.

        Raises:
            UnknownName: the vehicle has no such link.
        """


@runtime_checkable
class Sensor(Protocol):
    """A bound sensor."""

    @property
    def state(self) -> Record:
        """The part of the sensor that changes with time; `Simulation.save` stores it."""

    def sample(self, time: float) -> object:
        """Measure at ``time`` [s]; return a message of its spec's ``message_type``, or None."""


class CompiledSensor(abc.ABC):
    """A bound sensor that compiled code samples; messages are built from the values."""

    sampler: Sampler
    """The sampler."""

    @abc.abstractmethod
    def message(self, time: float, values: Array) -> object:
        """Return the message of a sample at ``time`` [s], or None.

        Args:
            time: when it was taken [s].
            values: the numbers of the sample, (n,); they are overwritten by the next.
        """

    def sample(self, time: float) -> Any:
        """Measure at ``time`` [s]; return a message, or None."""
        return self.message(time, self.sampler.take(time))


def follow_mount(
    mount: Mount,
    function: Callable[[int, int, float], None],
    parameters: npt.NDArray[np.void],
    n_values: int,
    memory_owners: tuple[object, ...],
) -> Sampler:
    """Return the sampler of a sensor that depends on no other motion than its mount's.

    Args:
        mount: mount of the sensor.
        function: function of a module that takes a sample; see `uwsim.base.numerics.calls`.
        parameters: input of the function, (1,).
        n_values: number of values that it writes.
        memory_owners: objects whose addresses the parameters contain, besides the mount.
    """
    return Sampler(
        function=function_address(function),
        parameters=parameters,
        n_values=n_values,
        prepare=lambda _: mount.prepare(),
        is_alone=lambda _: mount.is_compiled,
        memory_owners=(mount, *memory_owners),
    )


@runtime_checkable
class BindsSensor(Protocol):
    """The spec of a simulated sensor; one without ``bind`` is read and not simulated."""

    message_type: ClassVar[type]
    """The type of its messages."""

    @property
    def name(self) -> str:
        """The name in the scene."""

    def bind(self, world: SensorWorld, vehicle: Carrier) -> Sensor:
        """Mount it on its vehicle; raise UnknownName if there is no such link."""


def find_message_type(spec: type) -> type | None:
    """Return the type of the messages of a sensor or device; None if it is not simulated."""
    return getattr(spec, "message_type", None) if hasattr(spec, "bind") else None
