"""The interface of devices: each is bound to the scene and its vehicle, and acts in each step.

.. code-block:: text

    apply_commands -> step_devices -> advect_kinematic -> step_physics -> animate -> ...
"""

from __future__ import annotations

import abc
from dataclasses import dataclass
from typing import ClassVar, Protocol

from ..sensors.sensor import Carrier
from ..vehicle import Vehicle
from ..world import Stage


class DeviceVehicle(Vehicle, Carrier, Protocol):
    """A vehicle as its devices see it: they are mounted on its links, and act on it."""


@dataclass(frozen=True, kw_only=True)
class DeviceSpec(abc.ABC):
    """A device that is simulated; the spec of one that is not has no ``bind``."""

    is_left_out: ClassVar[bool] = False
    """Whether the scene goes without it where what it names is not there, as in the original."""

    @abc.abstractmethod
    def bind(self, stage: Stage, vehicle: DeviceVehicle) -> Device:
        """Find what the device acts on; raises UnknownName if there is none."""


class Device:
    """A bound device; each kind implements one of these methods."""

    STATE: ClassVar[tuple[str, ...]] = ()
    """Names of the attributes that change as time goes by; `Simulation.save` keeps them."""

    def step(self, time: float) -> None:
        """Act before the forces, in the step that begins at ``time`` [s]."""

    def animate(self, time: float) -> None:
        """Move what the device animates to its pose at ``time`` [s], the end of the step."""
