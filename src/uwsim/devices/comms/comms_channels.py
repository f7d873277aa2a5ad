"""Channels of the communication network: what devices send on and listen to.

.. code-block:: xml

    <CustomCommsChannel> <id>0</id> <minPropTime>1</minPropTime> </CustomCommsChannel>
    <AcousticCommsChannel>
      <id>0</id> <temperature>12</temperature> <salinity>35</salinity>
      <u:shipping>0.5</u:shipping> <u:windSpeed>5</u:windSpeed>
    </AcousticCommsChannel>
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ...network import DelayChannel, Sea, WaterChannel
from ...schema import Spec, element

MAX_MS = 1e9
"""Longest delay in a file [ms]."""


@dataclass(frozen=True, kw_only=True)
class CustomCommsChannelSpec(Spec):
    """A ``<CustomCommsChannel>``: delay = minPropTime + propTimeIncPerMeter * distance."""

    id: int
    """Number by which devices choose the channel."""
    prop_time_inc_per_meter: float = element(default=0.66667, minimum=0, maximum=MAX_MS)
    """Delay per distance [ms/m]."""
    min_prop_time: float = element(default=0.0, minimum=0, maximum=MAX_MS)
    """Delay at distance zero [ms]."""
    log_level: str = "off"
    """Read and not used."""

    @property
    def name(self) -> str:
        """Its name in the network."""
        return custom_channel(self.id)

    def bind(self) -> DelayChannel:
        """Make the channel."""
        return DelayChannel(
            minimum=1e-3 * self.min_prop_time, per_metre=1e-3 * self.prop_time_inc_per_meter
        )


@dataclass(frozen=True, kw_only=True)
class AcousticCommsChannelSpec(Spec):
    """An ``<AcousticCommsChannel>``: sound in water, along straight lines.

    Its noise and absorption count for the devices that have ``u:sourceLevel``.
    """

    id: int
    """Number by which devices choose the channel."""
    bandwidth: float = element(default=4096.0, minimum=1e-3, maximum=1e9)
    """In which receivers hear noise [Hz]."""
    temperature: float = element(default=25.0, minimum=-4.0, maximum=50.0)
    """Temperature of the water, for the speed of sound and the absorption [degC]."""
    salinity: float = element(default=35.0, minimum=0.0, maximum=50.0)
    """Salinity of the water, for the speed of sound and the absorption [g/kg]."""
    noise_lvl: float = element(default=0.0, minimum=-300.0, maximum=300.0)
    """Level of the noise in 1 Hz, to which that of the sea is added [dB re 1 uPa2/Hz]."""
    log_level: str = "off"
    """Read and not used."""
    shipping: float | None = element(namespaced=True, default=None, minimum=0.0, maximum=1.0)
    """From 0, few ships, to 1; without it and ``u:windSpeed`` the sea makes no noise [1]."""
    wind_speed: float | None = element(namespaced=True, default=None, minimum=0.0, maximum=100.0)
    """At the surface, for its noise; 0 where only ``u:shipping`` is given [m/s]."""
    absorption: Literal["francoisGarrison", "thorp"] = element(
        namespaced=True, default="francoisGarrison"
    )
    """Formula of the absorption; Thorp's ignores temperature and salinity."""

    @property
    def name(self) -> str:
        """Its name in the network."""
        return acoustic_channel(self.id)

    def bind(self) -> WaterChannel:
        """Make the channel."""
        return WaterChannel(
            temperature=self.temperature,
            salinity=self.salinity,
            bandwidth=self.bandwidth,
            noise_level=self.noise_lvl,
            sea=self._sea(),
            absorption=self.absorption,
        )

    def _sea(self) -> Sea | None:
        if self.shipping is None and self.wind_speed is None:
            return None
        return Sea(shipping=self.shipping or 0.0, wind_speed=self.wind_speed or 0.0)


def custom_channel(id: int) -> str:
    """Return the name of a ``<CustomCommsChannel>`` in the network."""
    return f"custom/{id}"


def acoustic_channel(id: int) -> str:
    """Return the name of an ``<AcousticCommsChannel>`` in the network."""
    return f"acoustic/{id}"
