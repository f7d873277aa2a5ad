"""A device with a configured delay and error rate, for example a radio or an optical modem.

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
from .comms_channels import MAX_DELAY_MS, custom_channel_name
from .comms_device import CommsDevice, MacProtocolSpec, MeshSpec, PacketBuilderSpec, packet_topics


@dataclass(frozen=True, kw_only=True)
class JitterSpec(Spec):
    """A ``<jitter>``: random delays, uniformly distributed from 0."""

    tx: float = element(default=0.0, minimum=0, maximum=MAX_DELAY_MS)
    """The largest delay of sending [ms]."""
    rx: float = element(default=0.0, original=REQUIRED_BY_DTD, minimum=0, maximum=MAX_DELAY_MS)
    """The largest delay of receiving [ms]."""


@dataclass(frozen=True, kw_only=True)
class RateErrorModelSpec(Spec):
    """A ``<rateErrorModel>``: the probability of an error in each bit, byte or packet."""

    error_unit: Unit = element(default="bit", original=REQUIRED_BY_DTD)
    """The unit in which errors occur."""
    error_rate_expr: str = element(default="0.01*m", original=REQUIRED_BY_DTD)
    """The probability as a formula of the distance m [m], in the language of score formulas."""

    def parse(self) -> Callable[[float], float]:
        """Return the rate as a function of the distance [m]; 1 where the formula has no value.

        Raises:
            ScoreError: the formula is invalid; the error shows the position.
        """
        formula = expression.parse(self.error_rate_expr, ["m"], kind="variable")

        def rate(distance: float) -> float:
            value = formula.evaluate({"m": distance})
            return 1.0 if value is None else value

        return rate

    def bind(self) -> ErrorModel:
        """Create the error model."""
        return RateErrors(rate=self.parse(), unit=self.error_unit)


@dataclass(frozen=True, kw_only=True)
class CustomCommsDeviceSpec(DeviceSpec):
    """A ``<CustomCommsDevice>``, which is half duplex if it sends and receives on one channel."""

    message_type: ClassVar[type] = Pose
    is_left_out: ClassVar[bool] = True

    dccomms_id: str
    """The name of the device, which begins its topics ``/tx`` and ``/rx``."""
    tx_channel_id: int
    """The id of the ``<CustomCommsChannel>`` on which it sends."""
    rx_channel_id: int
    """The id of the ``<CustomCommsChannel>`` on which it receives."""
    relative_to: str
    """The link on which the device is mounted."""
    mac: int = element(minimum=0, maximum=65535)
    """The address of the device."""
    mac_protocol: MacProtocolSpec | None = None
    """The medium access protocol."""
    bitrate: float = element(default=1000.0, original=REQUIRED_BY_DTD, minimum=1e-3, maximum=1e12)
    """The bit rate [bit/s]."""
    tx_fifo_size: int = element(default=500000, minimum=0)
    """The size of the transmission queue [byte]."""
    tf_id: str = ""
    """The name of the device's frame; ``<vehicle>/<device>`` when empty."""
    relative_tf_id: str = ""
    """The name of the link's frame; ``<vehicle>/<relativeTo>`` when empty."""
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The position of the device in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """The orientation of the device in the link's frame, roll, pitch, yaw (Rz Ry Rx) [rad]."""
    mesh: MeshSpec | None = None
    """The mesh that shows the device."""
    intrinsic_delay: float = element(default=0.0, minimum=0, maximum=MAX_DELAY_MS)
    """The delay between the command to send a packet and its transmission [ms]."""
    pr_time_inc_per_meter: float = 0.0
    """A delay per distance [ms/m]: read but not used, as in the original UWSim."""
    jitter: JitterSpec | None = None
    """The random delays."""
    max_distance: float = element(default=99999999.0, minimum=0)
    """The greatest range [m]."""
    min_distance: float = element(default=0.0, minimum=0)
    """The smallest range [m]."""
    rate_error_model: RateErrorModelSpec | None = None
    """The error model; without it no packet has errors."""
    tx_packet_builder: PacketBuilderSpec | None = element(default=None, original=REQUIRED_BY_DTD)
    """The packet builder of the transmitter."""
    rx_packet_builder: PacketBuilderSpec | None = element(default=None, original=REQUIRED_BY_DTD)
    """The packet builder of the receiver."""
    log_level: str = "off"
    """The log level: read but not used."""
    disable: bool = False
    """True if only the mesh of the device is created."""

    @property
    def name(self) -> str:
        """The name of the device."""
        return self.dccomms_id

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topics of the device, besides those of ``<rosInterface>`` elements."""
        return () if self.disable else packet_topics(self.name)

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> CommsDevice:
        """Mount the device, and connect it to its channels; raise UnknownName without the link."""
        settings = None if self.disable else self._modem_settings(world, vehicle.name)
        return CommsDevice(self, world, vehicle, settings)

    def _modem_settings(self, world: DeviceWorld, vehicle: str) -> ModemSettings:
        sends_on = custom_channel_name(self.tx_channel_id)
        channel = world.network.channels.get(sends_on, DelayChannel())
        jitter, model = self.jitter or JitterSpec(), self.rate_error_model
        settings = ModemSettings(
            name=f"{vehicle}/{self.dccomms_id}",
            address=self.mac,
            sends_on=sends_on,
            listens_to=custom_channel_name(self.rx_channel_id),
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
