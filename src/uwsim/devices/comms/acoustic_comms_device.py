"""An acoustic modem.

.. code-block:: xml

    <AcousticCommsDevice>
      <dccommsId>modem0</dccommsId> <channelId>0</channelId> <relativeTo>base_link</relativeTo>
      <mac>1</mac> <symbolsPerSecond>500</symbolsPerSecond> <codingEff>2</codingEff>
      <range>3500</range> <frequency>25</frequency> <K>1.5</K>
      <macProtocol> <name>CSMA</name> <maxDistance>3500</maxDistance> </macProtocol>
      <txPacketBuilder> <className>VariableLengthPacketBuilder</className> </txPacketBuilder>
      <rxPacketBuilder> <className>VariableLengthPacketBuilder</className> </rxPacketBuilder>
      <u:sourceLevel>175</u:sourceLevel>
    </AcousticCommsDevice>
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

from ...messages import Pose
from ...network import BitErrors, EnergyModel, LinkBudget, ModemSettings, WaterChannel
from ...schema import REQUIRED_BY_DTD, Spec, element
from ...world import DeviceWorld
from ..device import DeviceSpec, DeviceTopic, DeviceVehicle
from .comms_channels import acoustic_channel
from .comms_device import (
    CommsDevice,
    CommsMeshSpec,
    MacProtocolSpec,
    PacketBuilderSpec,
    packet_topics,
)


@dataclass(frozen=True, kw_only=True)
class EnergyModelSpec(Spec):
    """An ``<energyModel>``; without energy a device neither sends nor receives."""

    energy_level: float = element(minimum=0)
    """Energy at the start [J]."""
    turn_on_energy: float = element(default=0.0, original=REQUIRED_BY_DTD, minimum=0)
    """Energy to switch on, once at the start [J]."""
    turn_off_energy: float = element(default=0.0, original=REQUIRED_BY_DTD, minimum=0)
    """Read and not used: nothing is switched off [J]."""
    p_t_consume: float = element("pTConsume", default=0.660, original=REQUIRED_BY_DTD, minimum=0)
    """Power while sending [W]."""
    p_r_consume: float = element("pRConsume", default=0.395, original=REQUIRED_BY_DTD, minimum=0)
    """Power while receiving [W]."""
    p_idle: float = element("pIdle", default=0.0, original=REQUIRED_BY_DTD, minimum=0)
    """Power the rest of the time [W]."""
    p_t: float = element("pT", default=0.2818, original=REQUIRED_BY_DTD, minimum=0)
    """Power into the water: read and not used; ``u:sourceLevel`` gives the source level [W]."""

    def bind(self) -> EnergyModel:
        """Make the model."""
        return EnergyModel(
            level=self.energy_level,
            turn_on=self.turn_on_energy,
            sending=self.p_t_consume,
            receiving=self.p_r_consume,
            idle=self.p_idle,
        )


@dataclass(frozen=True, kw_only=True)
class AcousticCommsDeviceSpec(DeviceSpec):
    """An ``<AcousticCommsDevice>``; it is half duplex."""

    message_type: ClassVar[type] = Pose
    is_left_out: ClassVar[bool] = True

    dccomms_id: str
    """Its name, which begins its topics ``/tx``, ``/rx`` and ``/energy``."""
    channel_id: int
    """Its ``<AcousticCommsChannel>``."""
    relative_to: str
    """The link it rides on."""
    mac: int = element(minimum=0, maximum=65535)
    """Its address."""
    symbols_per_second: float = element(minimum=1e-3, maximum=1e9)
    """How fast it sends [symbol/s]."""
    coding_eff: float = element(default=1.0, minimum=1e-3, maximum=1e3)
    """Bits per symbol [1]."""
    bit_error_rate: float = element(default=0.0, minimum=0, maximum=1)
    """Probability that a bit is damaged, besides what the noise does [1]."""
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
    range: float = element(default=100.0, minimum=0)
    """Longest distance it reaches, however loud it is [m]."""
    frequency: float = element(default=25.0, minimum=1e-3, maximum=1e4)
    """Carrier [kHz]."""
    l: float = element("L", default=0.0, minimum=-300.0, maximum=300.0)  # noqa: E741  (the dialect's letter)
    """Constant loss [dB]."""
    k: float = element("K", default=2.0, minimum=0.0, maximum=10.0)
    """Spreading: 1 cylindrical, 2 spherical [1]."""
    energy_model: EnergyModelSpec | None = None
    """Energy model."""
    preamble: float = element(default=0.0, minimum=0, maximum=1e6)
    """Length of the preamble of each packet [s]."""
    mac_protocol: MacProtocolSpec | None = None
    """Medium access protocol."""
    tx_packet_builder: PacketBuilderSpec | None = element(default=None, original=REQUIRED_BY_DTD)
    """Packs what is sent."""
    rx_packet_builder: PacketBuilderSpec | None = element(default=None, original=REQUIRED_BY_DTD)
    """Unpacks what is received."""
    log_level: str = "off"
    """Read and not used."""
    disable: bool = False
    """Whether only its body is made."""
    source_level: float | None = element(
        namespaced=True, default=None, minimum=-300.0, maximum=300.0
    )
    """How loud it is at 1 m [dB re 1 uPa]; without it noise damages nothing within the range."""

    @property
    def name(self) -> str:
        """Its name."""
        return self.dccomms_id

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """Its topics, besides that of its interface."""
        if self.disable:
            return ()
        return packet_topics(self.name, has_energy=self.energy_model is not None)

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> CommsDevice:
        """Mount it and let it take part; raises UnknownName if there is no such link."""
        settings = None if self.disable else self._settings(world, vehicle.name)
        return CommsDevice(self, world, vehicle, settings)

    def _settings(self, world: DeviceWorld, vehicle: str) -> ModemSettings:
        name = acoustic_channel(self.channel_id)
        found = world.network.channels.get(name)
        water = found if isinstance(found, WaterChannel) else WaterChannel()
        bit_rate = self.symbols_per_second * self.coding_eff
        settings = ModemSettings(
            name=f"{vehicle}/{self.dccomms_id}",
            address=self.mac,
            sends_on=name,
            listens_to=name,
            channel=water,
            errors=BitErrors(
                rate=self.bit_error_rate, budget=self._budget(water), bit_rate=bit_rate
            ),
            bit_rate=bit_rate,
            preamble=self.preamble,
            max_range=self.range,
            queue_size=self.tx_fifo_size,
            energy=None if self.energy_model is None else self.energy_model.bind(),
        )
        mac = self.mac_protocol or MacProtocolSpec()
        return replace(settings, mac=mac.bind(water, settings.airtime))

    def _budget(self, water: WaterChannel) -> LinkBudget | None:
        if self.source_level is None:
            return None
        return LinkBudget.in_water(
            water,
            source_level=self.source_level,
            frequency=1000.0 * self.frequency,
            spreading=self.k,
            constant_loss=self.l,
        )
