"""The interface of devices, which are bound to a scene and a vehicle, and act in each step.

.. code-block:: text

    apply_commands -> step_devices -> drift_kinematic_vehicles -> step_physics -> animate -> ...
"""

from __future__ import annotations

import abc
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Protocol

from ..base.record import NoState, Record
from ..base.sampling import Sampler
from ..schema import Spec
from ..sensors.sensor import Carrier, MountedPart
from ..vehicle import Vehicle
from ..world import DeviceWorld


class DeviceVehicle(Vehicle, Carrier, Protocol):
    """The interface of a vehicle for the devices that are mounted on its links and act on it."""

    def hold(self, object_index: int, link: str) -> None:
        """Fix an object, given by its index, at its present pose to a link of the vehicle."""

    def release(self, object_index: int) -> None:
        """Release the held object with an index."""

    def wrench_sampler(
        self, spec: MountedPart, *, at_joint: bool = False, visual: bool = False
    ) -> Sampler:
        """Return a sampler of a wrench at a link, in the frame of a part on the link.

        A sample has 6 numbers: the force [N] and the torque about the part's origin [N m] in the
        last step. The wrench is the sum of all contacts on the link. With ``at_joint`` it is the
        wrench that the link, all links beyond it and the water around these exert on the joint that
        carries the link. It is 0 for a kinematic vehicle, and in a scene without physics.

        Args:
            spec: the spec of the part.
            at_joint: True to measure the wrench on the joint instead of that of the contacts.
            visual: True if the pose of the part is relative to the link's visual frame.

        Raises:
            UnknownName: the vehicle has no such link.
        """


@dataclass(frozen=True, kw_only=True)
class DeviceTopic:
    """A topic that a device subscribes to or publishes itself, without a ``<rosInterface>``."""

    name: str
    """The name of the topic."""
    is_subscribed: bool = False
    """True if the device subscribes to the topic; otherwise it publishes on it."""
    rate: float | None = None
    """The rate of publication [Hz]; None: messages are published at events."""
    message_type: type | None = None
    """The type of the messages; None: not checked."""
    element: str = ""
    """The element of the device that names the topic; empty: the device derives the name."""
    relayed_topic: str = ""
    """The topic whose messages the device publishes on this one; empty: its own messages."""


@dataclass(frozen=True, kw_only=True)
class DeviceSpec(Spec, abc.ABC):
    """The base of the specs of devices."""

    is_left_out: ClassVar[bool] = False
    """True if the device is left out without an error if `bind` raise UnknownName, as in the
    original UWSim."""
    is_pure: ClassVar[bool] = False
    """True if a sample does not change the device's state. Without subscribers, no samples are then
    taken."""

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topics of the device, besides those of ``<rosInterface>`` elements."""
        return ()

    def complete(self, parts: Sequence[object]) -> DeviceSpec:
        """Return the spec with the values that follow from other parts of its vehicle."""
        return self

    @abc.abstractmethod
    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> Device:
        """Create the device; raise UnknownName if a name in the spec is unknown."""


class Device:
    """A device that is bound to a scene; subclasses override `step` or `animate`, or neither."""

    state: Record = NoState()
    """The state of the device, which `Simulation.save` stores."""

    def step(self, time: float) -> None:
        """Act before forces are computed, in the step that begins at ``time`` [s]."""

    def idle_until(self, time: float) -> float:
        """Return the time until which the device is idle, after the step at ``time`` [s].

        The simulation may take all steps until then without another call of `step` or `animate`.
        """
        is_idle = type(self).step is Device.step and type(self).animate is Device.animate
        return math.inf if is_idle else time

    def animate(self, time: float) -> None:
        """Set what the device controls at ``time`` [s], the end of the step, such as a pose."""
