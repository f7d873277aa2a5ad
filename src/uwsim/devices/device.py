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
from ..sensors.sensor import Carrier, Mounted
from ..vehicle import Vehicle
from ..world import DeviceWorld


class DeviceVehicle(Vehicle, Carrier, Protocol):
    """A vehicle as its devices see it: they are mounted on its links, and act on it."""

    def hold(self, thing: int, link: str) -> None:
        """Fix an object, by its number, to a link of the vehicle, where it is now."""

    def let_go(self, thing: int) -> None:
        """Release an object that is held."""

    def wrench_sampler(
        self, spec: Mounted, *, at_joint: bool = False, visual: bool = False
    ) -> Sampler:
        """Return a sampler of a wrench at a link, in the frame of a part on the link.

        It takes 6 numbers: force [N] and torque about the part [N m] in the last step. They are
        those of the contacts on the link, and 0 where the scene has no physics. At the joint they
        are what the link, and all beyond it, does to the joint that carries it, with the water on
        these links. They are 0 for a vehicle that is not simulated.

        Args:
            spec: the part.
            at_joint: whether to measure the wrench at the joint, not that of the contacts.
            visual: whether the pose of the part is given in the link's visual frame.

        Raises:
            UnknownName: the vehicle has no such link.
        """


@dataclass(frozen=True, kw_only=True)
class DeviceTopic:
    """A topic that a device has without any interface."""

    name: str
    """Of the topic."""
    is_heard: bool = False
    """Whether the device listens to it; else it publishes."""
    rate: float | None = None
    """How often it publishes; None: when there is something [Hz]."""


@dataclass(frozen=True, kw_only=True)
class DeviceSpec(Spec, abc.ABC):
    """A device that is simulated; the spec of one that is not has no ``bind``."""

    is_left_out: ClassVar[bool] = False
    """Whether the scene goes without it where what it names is not there, as in the original."""
    is_pure: ClassVar[bool] = False
    """Whether a sample changes nothing in the device, so that it need not be taken for nobody."""

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """Its topics, besides those of interfaces."""
        return ()

    @abc.abstractmethod
    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> Device:
        """Find what the device acts on; raises UnknownName if there is none."""


class Device:
    """A bound device; each kind implements one of these methods."""

    state: Record = NoState()
    """All that changes of it as time goes by; `Simulation.save` keeps it."""

    def step(self, time: float) -> None:
        """Act before the forces, in the step that begins at ``time`` [s]."""

    def rests_until(self, time: float) -> float:
        """Return the time before which it does nothing new, after the step at ``time`` [s].

        Until then several steps may be taken at once, for all of which it is asked once.
        """
        rests = type(self).step is Device.step and type(self).animate is Device.animate
        return math.inf if rests else time

    def animate(self, time: float) -> None:
        """Move what the device animates to its pose at ``time`` [s], the end of the step."""
