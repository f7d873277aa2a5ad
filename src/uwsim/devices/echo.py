"""A device that publishes a fixed text: the example of a device of the original UWSim.

.. code-block:: xml

    <echo> <name>g500_echo</name> <info>I am here</info> </echo>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..errors import UnknownName
from ..messages import String
from ..schema import REQUIRED_BY_DTD, Spec, element
from ..world import DeviceWorld
from .device import Device, DeviceSpec, DeviceVehicle


@dataclass(frozen=True, kw_only=True)
class EchoSpec(DeviceSpec):
    """An ``<echo>``."""

    is_left_out: ClassVar[bool] = True
    message_type: ClassVar[type] = String

    name: str
    """The name of the device."""
    info: str = element(default="", original=REQUIRED_BY_DTD)
    """The text; an empty text disables the device."""

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> Echo:
        """Create the device; raise UnknownName if the text is empty."""
        if not self.info:
            raise UnknownName("echo with a text", self.name, ())
        return Echo(self.info)


class Echo(Device):
    """A fixed text."""

    def __init__(self, text: str) -> None:
        self._text = text

    def sample(self, time: float) -> String:
        """Return the text."""
        return String(data=self._text)


@dataclass(frozen=True, kw_only=True)
class SimulatedDevicesSpec(Spec):
    """A ``<simulatedDevices>``: an optional wrapper around devices."""

    OCCURS_ONCE: ClassVar[bool] = True

    echo: tuple[EchoSpec, ...] = ()
    """The echo devices."""
