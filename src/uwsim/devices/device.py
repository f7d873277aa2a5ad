"""The interface of devices: each is bound to the scene and its vehicle, and acts in each step.

.. code-block:: text

    apply_commands -> step_devices -> advect_kinematic -> step_physics -> animate -> ...
"""

from __future__ import annotations

import abc
import math
from dataclasses import dataclass
from typing import ClassVar, Protocol

from ..base.record import NoState, Record
from ..base.sampling import Sampler
from ..schema import Spec
from ..sensors.sensor import Carrier, MountedPart
from ..vehicle import Vehicle
from ..world import DeviceWorld


class DeviceVehicle(Vehicle, Carrier, Protocol):
    """A vehicle as an interface for its devices: they are mounted on its links and act on it."""

    def hold(self, object_index: int, link: str) -> None:
        """Fix an object, by its index, to a link of the vehicle at its present pose."""

    def release(self, object_index: int) -> None:
        """Release a held object."""

    def wrench_sampler(
        self, spec: MountedPart, *, at_joint: bool = False, visual: bool = False
    ) -> Sampler:
        """Return a sampler of a wrench at a link, in the frame of a part on the link.

        A sample has 6 numbers: force [N] and torque about the part [N m] in the last step. They are
        those of the contacts on the link, and 0 if the scene has no physics. At the joint they are
        the wrench of the link, all beyond it, and the water on these links, on the joint that
        carries it. They are 0 for a vehicle that is not simulated.

        Args:
            spec: the spec of the part.
            at_joint: measure the wrench at the joint instead of that of the contacts.
            visual: the pose of the part is relative to the link's visual frame.

        Raises:
            UnknownName: the vehicle has no such link.
        """


@dataclass(frozen=True, kw_only=True)
class DeviceTopic:
    """A topic that a device has without an interface."""

    name: str
    """The name of the topic."""
    is_subscribed: bool = False
    """True if the device subscribes to the topic; otherwise it publishes on it."""
    rate: float | None = None
    """The rate of publication [Hz]; None: at events."""


@dataclass(frozen=True, kw_only=True)
class DeviceSpec(Spec, abc.ABC):
    """The spec of a simulated device; that of a device that is not simulated has no ``bind``."""

    is_left_out: ClassVar[bool] = False
    """True if a device whose names are unknown is left out without an error, as in the original."""
    is_pure: ClassVar[bool] = False
    """True if a sample does not change the device, so none is taken without a subscriber."""

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topics of the device, besides those of interfaces."""
        return ()

    @abc.abstractmethod
    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> Device:
        """Resolve the names of the spec; raises UnknownName if one is unknown."""


class Device:
    """A bound device; each kind implements one of these methods."""

    state: Record = NoState()
    """The record of all that changes with time; `Simulation.save` stores it."""

    def step(self, time: float) -> None:
        """Act before the forces, in the step that begins at ``time`` [s]."""

    def idle_until(self, time: float) -> float:
        """Return the time until which the device is idle, after the step at ``time`` [s].

        The simulation may run the steps until then together, without another call of the device.
        """
        is_idle = type(self).step is Device.step and type(self).animate is Device.animate
        return math.inf if is_idle else time

    def animate(self, time: float) -> None:
        """Set the poses that the device controls to those at ``time`` [s], the end of the step."""
