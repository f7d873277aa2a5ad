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
"""Of the vehicle, at its pose in the file."""
LookAt = tuple[float, float, float] | Direction | None
"""What ``<u:lookAt>`` may say: a point in L [m], a direction of the vehicle, or nothing."""


OPTICAL_AXES = (math.pi, 0.0, 0.0)
"""Of the frame in ROS of a sensor that looks along -z: z ahead, x to the right, y down [rad]."""
SCAN_AXES = (0.0, 0.5 * math.pi, 0.0)
"""Of the frame in ROS of a fan about x with its zero along -z: x ahead, turned about z [rad]."""


@dataclass(frozen=True, kw_only=True)
class SensorSpec(Spec):
    """A sensor of a vehicle."""

    frame_rpy: ClassVar[tuple[float, float, float]] = (0.0, 0.0, 0.0)
    """Axes of its frame in ROS, in the sensor: fixed-axis roll, pitch, yaw [rad]."""
    is_pure: ClassVar[bool] = False
    """Whether a sample changes nothing in the sensor, so that it need not be taken for nobody."""

    name: str
    """Its name, by which interfaces and benchmarks find it."""
    relative_to: str
    """The link it is mounted on; its pose is given in the kinematic frame of that link."""


class Mounted(Protocol):
    """A part with a pose on a link."""

    @property
    def relative_to(self) -> str:
        """The link."""

    @property
    def position(self) -> tuple[float, float, float]:
        """In the link's frame [m]."""

    @property
    def orientation(self) -> tuple[float, float, float]:
        """Fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""


@runtime_checkable
class MountedSensor(Mounted, Protocol):
    """The spec of a sensor that is mounted."""

    frame_rpy: ClassVar[tuple[float, float, float]]
    """Axes of its frame in ROS, in the sensor: fixed-axis roll, pitch, yaw [rad]."""

    @property
    def name(self) -> str:
        """Its name."""


@runtime_checkable
class Looking(Mounted, Protocol):
    """A mounted part with a viewing direction."""

    @property
    def look_at(self) -> LookAt:
        """Point or direction it looks at at the start, instead of ``orientation``."""


class Carrier(Protocol):
    """A vehicle that carries sensors."""

    @property
    def name(self) -> str:
        """Its name in the scene."""

    @property
    def compiled_vehicle(self) -> CompiledVehicle:
        """The vehicle as compiled code reads it."""

    def mount(self, spec: Mounted, *, visual: bool = False) -> Mount:
        """Fix something to its link, or to the link's visual frame: a frame that moves with it.

        Raises:
            UnknownName: the vehicle has no such link.
        """

    def moving_mount(self, spec: Mounted, *, visual: bool = False) -> MovingBody:
        """Fix something to its link, or to the link's visual frame, whose motion is read.

        Raises:
            UnknownName: the vehicle has no such link.
        """


@runtime_checkable
class Sensor(Protocol):
    """A bound sensor."""

    @property
    def state(self) -> Record:
        """All that changes of it as time goes by; `Simulation.save` keeps it."""

    def sample(self, time: float) -> object:
        """Measure now, at ``time`` [s]: a message of its spec's ``message_type``, None for none."""


class CompiledSensor(abc.ABC):
    """A bound sensor whose samples compiled code takes; messages are made from their numbers."""

    sampler: Sampler
    """What takes the numbers of a sample."""

    @abc.abstractmethod
    def message(self, time: float, values: Array) -> object:
        """Make the message of a sample taken at ``time`` [s]; None for none.

        Args:
            time: when it was taken [s].
            values: the numbers of the sample, (n,); they are overwritten by the next.
        """

    def sample(self, time: float) -> Any:
        """Measure now, at ``time`` [s]: a message, None for none."""
        return self.message(time, self.sampler.take(time))


def follow_mount(
    mount: Mount,
    function: Callable[[int, int, float], None],
    parameters: npt.NDArray[np.void],
    n_values: int,
    memory_owners: tuple[object, ...],
) -> Sampler:
    """Return what takes the samples of a sensor that reads nothing that moves but its mount.

    Args:
        mount: where it is.
        function: of the module's level, which takes a sample; see `uwsim.base.numerics.calls`.
        parameters: what the function reads, (1,).
        n_values: how many numbers it writes.
        memory_owners: what the parameters have the addresses of, besides the mount.
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
    """The spec of a sensor that is simulated: what has no ``bind`` is read and does nothing."""

    message_type: ClassVar[type]
    """Type of its messages."""

    @property
    def name(self) -> str:
        """Its name in the scene."""

    def bind(self, world: SensorWorld, vehicle: Carrier) -> Sensor:
        """Mount it on its vehicle; raises UnknownName if there is no such link."""


def measured_by(spec: type) -> type | None:
    """Return the type of the messages of a sensor or device; None if it is not simulated."""
    return getattr(spec, "message_type", None) if hasattr(spec, "bind") else None
