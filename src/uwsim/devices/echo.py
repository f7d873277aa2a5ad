"""Publishes a fixed text: the original's example of a device.

.. code-block:: xml

    <echo> <name>g500_echo</name> <info>I am here</info> </echo>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..schema import REQUIRED, element


@dataclass(frozen=True, kw_only=True)
class EchoSpec:
    """An ``<echo>``."""

    name: str
    """Its name."""
    info: str = element(default="", original=REQUIRED)
    """The text; an empty one switches the device off."""


@dataclass(frozen=True, kw_only=True)
class SimulatedDevicesSpec:
    """A ``<simulatedDevices>``: an optional wrapper around devices."""

    STANDS_ONCE: ClassVar[bool] = True

    echo: tuple[EchoSpec, ...] = ()
    """Echo devices."""
