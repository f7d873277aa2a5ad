"""A link described by delays and error rates, for example a radio or an optical modem.

.. code-block:: xml

    <CustomCommsDevice>
      <dccommsId>rf0</dccommsId> <txChannelId>0</txChannelId> <rxChannelId>0</rxChannelId>
      <relativeTo>base_link</relativeTo> <mac>1</mac> <bitrate>1000</bitrate>
      <rateErrorModel>
        <errorUnit>packet</errorUnit> <errorRateExpr>0.01*m</errorRateExpr>
      </rateErrorModel>
      <txPacketBuilder> <className>VariableLengthPacketBuilder</className> </txPacketBuilder>
      <rxPacketBuilder> <className>VariableLengthPacketBuilder</className> </rxPacketBuilder>
    </CustomCommsDevice>
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import ClassVar

from ...base import expression
from ...messages import Pose
from ...network import BitErrors, DelayChannel, ErrorModel, ModemSettings, RateErrors, Unit
from ...schema import REQUIRED_BY_DTD, Spec, element
from ...world import DeviceWorld
from ..device import DeviceSpec, DeviceTopic, DeviceVehicle
from .comms_channels import MAX_MS, custom_channel
from .comms_device import (
    CommsDevice,
    CommsMeshSpec,
    MacProtocolSpec,
    PacketBuilderSpec,
    packet_topics,
)


@dataclass(frozen=True, kw_only=True)
class JitterSpec(Spec):
    """A ``<jitter>``: delays that vary, uniformly distributed from 0."""

    tx: float = element(default=0.0, minimum=0, maximum=MAX_MS)
    """Largest delay when sending [ms]."""
    rx: float = element(default=0.0, original=REQUIRED_BY_DTD, minimum=0, maximum=MAX_MS)
    """Largest delay when receiving [ms]."""


@dataclass(frozen=True, kw_only=True)
class RateErrorModelSpec(Spec):
    """A ``<rateErrorModel>``: how likely a part of a packet, and so the packet, is damaged."""

    error_unit: Unit = element(default="bit", original=REQUIRED_BY_DTD)
    """What the rate is of."""
    error_rate_expr: str = element(default="0.01*m", original=REQUIRED_BY_DTD)
    """Its probability as a formula in the distance m [m], in the language of scores."""

    def parse(self) -> Callable[[float], float]:
        """Return the rate as a function of the distance [m]; where it has no value it is 1.

        Raises:
            ScoreError: the formula is wrong; shows where.
        """
        parsed = expression.parse(self.error_rate_expr, ["m"], kind="variable")

        def rate(metres: float) -> float:
            value = parsed.evaluate({"m": metres})
            return 1.0 if value is None else value

        return rate

    def bind(self) -> ErrorModel:
        """Make the model."""
        return RateErrors(rate=self.parse(), unit=self.error_unit)


@dataclass(frozen=True, kw_only=True)
class CustomCommsDeviceSpec(DeviceSpec):
    """A ``<CustomCommsDevice>``; half duplex where it sends on the channel it listens to."""

    message_type: ClassVar[type] = Pose
    is_left_out: ClassVar[bool] = True

    dccomms_id: str
    """Its name, which begins its topics ``/tx`` and ``/rx``."""
    tx_channel_id: int
    """The ``<CustomCommsChannel>`` it sends on."""
    rx_channel_id: int
    """The ``<CustomCommsChannel>`` it listens to."""
    relative_to: str
    """The link it rides on."""
    mac: int = element(minimum=0, maximum=65535)
    """Its address."""
    mac_protocol: MacProtocolSpec | None = None
    """Medium access protocol."""
    bitrate: float = element(default=1000.0, original=REQUIRED_BY_DTD, minimum=1e-3, maximum=1e12)
    """How fast it sends [bit/s]."""
    tx_fifo_size: int = element(default=500000, minimum=0)
    """Size of the transmission queue [byte]."""
    tf_id: str = ""
    """Name of its frame; ``<vehicle>/<device>`` when empty."""
    relative_tf_id: str = ""
    """Name of the frame it rides on; ``<vehicle>/<relativeTo>`` when empty."""
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Position of the device in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Orientation of the device in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    mesh: CommsMeshSpec | None = None
    """Its body."""
    intrinsic_delay: float = element(default=0.0, minimum=0, maximum=MAX_MS)
    """Between the order to send a packet and its sending [ms]."""
    pr_time_inc_per_meter: float = 0.0
    """Allowed by the grammar and never read by the original [ms/m]."""
    jitter: JitterSpec | None = None
    """Variation of the delay."""
    max_distance: float = element(default=99999999.0, minimum=0)
    """Longest distance it reaches [m]."""
    min_distance: float = element(default=0.0, minimum=0)
    """Shortest distance it reaches [m]."""
    rate_error_model: RateErrorModelSpec | None = None
    """How likely a piece is damaged; without it nothing is."""
    tx_packet_builder: PacketBuilderSpec | None = element(default=None, original=REQUIRED_BY_DTD)
    """Packs what is sent."""
    rx_packet_builder: PacketBuilderSpec | None = element(default=None, original=REQUIRED_BY_DTD)
    """Unpacks what is received."""
    log_level: str = "off"
    """Read and not used."""
    disable: bool = False
    """Whether only its body is made."""

    @property
    def name(self) -> str:
        """Its name."""
        return self.dccomms_id

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """Its topics, besides that of its interface."""
        return () if self.disable else packet_topics(self.name)

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> CommsDevice:
        """Mount it and let it take part; raises UnknownName if there is no such link."""
        settings = None if self.disable else self._settings(world, vehicle.name)
        return CommsDevice(self, world, vehicle, settings)

    def _settings(self, world: DeviceWorld, vehicle: str) -> ModemSettings:
        sends_on = custom_channel(self.tx_channel_id)
        channel = world.network.channels.get(sends_on, DelayChannel())
        jitter, model = self.jitter or JitterSpec(), self.rate_error_model
        settings = ModemSettings(
            name=f"{vehicle}/{self.dccomms_id}",
            address=self.mac,
            sends_on=sends_on,
            listens_to=custom_channel(self.rx_channel_id),
            channel=channel,
            errors=BitErrors() if model is None else model.bind(),
            bit_rate=self.bitrate,
            min_range=self.min_distance,
            max_range=self.max_distance,
            queue_size=self.tx_fifo_size,
            send_delay=1e-3 * self.intrinsic_delay,
            send_jitter=1e-3 * jitter.tx,
            receive_jitter=1e-3 * jitter.rx,
        )
        mac = self.mac_protocol or MacProtocolSpec()
        return replace(settings, mac=mac.bind(channel, settings.airtime))
