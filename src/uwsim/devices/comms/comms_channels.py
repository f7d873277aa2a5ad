"""Channels of the communication network, on which devices send and receive.

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

MAX_DELAY_MS = 1e9
"""The longest delay that a file may contain [ms]."""


@dataclass(frozen=True, kw_only=True)
class CustomCommsChannelSpec(Spec):
    """A ``<CustomCommsChannel>``: delay = minPropTime + propTimeIncPerMeter * distance."""

    id: int
    """The number by which devices choose the channel."""
    prop_time_inc_per_meter: float = element(default=0.66667, minimum=0, maximum=MAX_DELAY_MS)
    """The delay per distance [ms/m]."""
    min_prop_time: float = element(default=0.0, minimum=0, maximum=MAX_DELAY_MS)
    """The delay at distance zero [ms]."""
    log_level: str = "off"
    """The log level: read but not used."""

    @property
    def name(self) -> str:
        """The name of the channel in the network."""
        return custom_channel_name(self.id)

    def bind(self) -> DelayChannel:
        """Create the channel."""
        return DelayChannel(
            minimum=1e-3 * self.min_prop_time, per_metre=1e-3 * self.prop_time_inc_per_meter
        )


@dataclass(frozen=True, kw_only=True)
class AcousticCommsChannelSpec(Spec):
    """An ``<AcousticCommsChannel>``: sound in water, along straight lines.

    Its noise and absorption apply to the devices that have ``u:sourceLevel``.
    """

    id: int
    """The number by which devices choose the channel."""
    bandwidth: float = element(default=4096.0, minimum=1e-3, maximum=1e9)
    """The bandwidth in which receivers collect noise [Hz]."""
    temperature: float = element(default=25.0, minimum=-4.0, maximum=50.0)
    """The temperature of the water, for the speed of sound and the absorption [degC]."""
    salinity: float = element(default=35.0, minimum=0.0, maximum=50.0)
    """The salinity of the water, for the speed of sound and the absorption [g/kg]."""
    noise_lvl: float = element(default=0.0, minimum=-300.0, maximum=300.0)
    """The spectral noise level, to which the noise of the sea is added [dB re 1 uPa2/Hz]."""
    log_level: str = "off"
    """The log level: read but not used."""
    shipping: float | None = element(namespaced=True, default=None, minimum=0.0, maximum=1.0)
    """The shipping density, from 0 (few ships) to 1 [1]. Without it and ``u:windSpeed`` the sea
    makes no noise."""
    wind_speed: float | None = element(namespaced=True, default=None, minimum=0.0, maximum=100.0)
    """The wind speed at the surface, for its noise [m/s]; 0 if only ``u:shipping`` is given."""
    absorption: Literal["francoisGarrison", "thorp"] = element(
        namespaced=True, default="francoisGarrison"
    )
    """The formula of the absorption; that of Thorp ignores temperature and salinity."""

    @property
    def name(self) -> str:
        """The name of the channel in the network."""
        return acoustic_channel_name(self.id)

    def bind(self) -> WaterChannel:
        """Create the channel."""
        return WaterChannel(
            temperature=self.temperature,
            salinity=self.salinity,
            bandwidth=self.bandwidth,
            noise_level=self.noise_lvl,
            sea=self._sea_noise(),
            absorption=self.absorption,
        )

    def _sea_noise(self) -> Sea | None:
        if self.shipping is None and self.wind_speed is None:
            return None
        return Sea(shipping=self.shipping or 0.0, wind_speed=self.wind_speed or 0.0)


def custom_channel_name(id: int) -> str:
    """Return the name of a ``<CustomCommsChannel>`` in the network."""
    return f"custom/{id}"


def acoustic_channel_name(id: int) -> str:
    """Return the name of an ``<AcousticCommsChannel>`` in the network."""
    return f"acoustic/{id}"
