"""An acoustic modem, whose packets travel at the speed of sound.

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
from .comms_channels import acoustic_channel_name
from .comms_device import CommsDevice, MacProtocolSpec, MeshSpec, PacketBuilderSpec, packet_topics


@dataclass(frozen=True, kw_only=True)
class EnergyModelSpec(Spec):
    """An ``<energyModel>``: the energy of a device, without which it neither sends nor receives."""

    energy_level: float = element(minimum=0)
    """The energy at the start [J]."""
    turn_on_energy: float = element(default=0.0, original=REQUIRED_BY_DTD, minimum=0)
    """The energy to switch on, once at the start [J]."""
    turn_off_energy: float = element(default=0.0, original=REQUIRED_BY_DTD, minimum=0)
    """The energy to switch off [J]: read but not used; a device is never switched off."""
    p_t_consume: float = element("pTConsume", default=0.660, original=REQUIRED_BY_DTD, minimum=0)
    """The power while sending [W]."""
    p_r_consume: float = element("pRConsume", default=0.395, original=REQUIRED_BY_DTD, minimum=0)
    """The power while receiving [W]."""
    p_idle: float = element("pIdle", default=0.0, original=REQUIRED_BY_DTD, minimum=0)
    """The power while idle [W]."""
    p_t: float = element("pT", default=0.2818, original=REQUIRED_BY_DTD, minimum=0)
    """The acoustic power [W]: read but not used; ``u:sourceLevel`` gives the source level."""

    def bind(self) -> EnergyModel:
        """Create the energy model."""
        return EnergyModel(
            initial_energy=self.energy_level,
            turn_on_energy=self.turn_on_energy,
            sending_power=self.p_t_consume,
            receiving_power=self.p_r_consume,
            idle_power=self.p_idle,
        )


@dataclass(frozen=True, kw_only=True)
class AcousticCommsDeviceSpec(DeviceSpec):
    """An ``<AcousticCommsDevice>``: an acoustic modem, which is half duplex."""

    message_type: ClassVar[type] = Pose
    is_left_out: ClassVar[bool] = True

    dccomms_id: str
    """The name of the device, which begins its topics ``/tx``, ``/rx`` and ``/energy``."""
    channel_id: int
    """The id of the ``<AcousticCommsChannel>`` of the device."""
    relative_to: str
    """The link on which the device is mounted."""
    mac: int = element(minimum=0, maximum=65535)
    """The address of the device."""
    symbols_per_second: float = element(minimum=1e-3, maximum=1e9)
    """The symbol rate [symbol/s]."""
    coding_eff: float = element(default=1.0, minimum=1e-3, maximum=1e3)
    """The number of bits per symbol [1]."""
    bit_error_rate: float = element(default=0.0, minimum=0, maximum=1)
    """The probability of a bit error, in addition to the errors that noise causes [1]."""
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
    range: float = element(default=100.0, minimum=0)
    """The greatest range, whatever the source level [m]."""
    frequency: float = element(default=25.0, minimum=1e-3, maximum=1e4)
    """The carrier frequency [kHz]."""
    l: float = element("L", default=0.0, minimum=-300.0, maximum=300.0)  # noqa: E741  (the dialect's letter)
    """The constant part of the transmission loss [dB]."""
    k: float = element("K", default=2.0, minimum=0.0, maximum=10.0)
    """The spreading factor: 1 cylindrical, 2 spherical [1]."""
    energy_model: EnergyModelSpec | None = None
    """The energy model."""
    preamble: float = element(default=0.0, minimum=0, maximum=1e6)
    """The length of the preamble of each packet [s]."""
    mac_protocol: MacProtocolSpec | None = None
    """The medium access protocol."""
    tx_packet_builder: PacketBuilderSpec | None = element(default=None, original=REQUIRED_BY_DTD)
    """The packet builder of the transmitter."""
    rx_packet_builder: PacketBuilderSpec | None = element(default=None, original=REQUIRED_BY_DTD)
    """The packet builder of the receiver."""
    log_level: str = "off"
    """The log level: read but not used."""
    disable: bool = False
    """True if only the mesh of the device is created."""
    source_level: float | None = element(
        namespaced=True, default=None, minimum=-300.0, maximum=300.0
    )
    """The source level at 1 m [dB re 1 uPa]; without it noise causes no bit errors in range."""

    @property
    def name(self) -> str:
        """The name of the device."""
        return self.dccomms_id

    @property
    def topics(self) -> tuple[DeviceTopic, ...]:
        """The topics of the device, besides those of ``<rosInterface>`` elements."""
        if self.disable:
            return ()
        return packet_topics(self.name, has_energy=self.energy_model is not None)

    def bind(self, world: DeviceWorld, vehicle: DeviceVehicle) -> CommsDevice:
        """Mount the device, and connect it to a channel; raise UnknownName without the link."""
        settings = None if self.disable else self._modem_settings(world, vehicle.name)
        return CommsDevice(self, world, vehicle, settings)

    def _modem_settings(self, world: DeviceWorld, vehicle: str) -> ModemSettings:
        name = acoustic_channel_name(self.channel_id)
        channel = world.network.channels.get(name)
        water = channel if isinstance(channel, WaterChannel) else WaterChannel()
        bit_rate = self.symbols_per_second * self.coding_eff
        settings = ModemSettings(
            name=f"{vehicle}/{self.dccomms_id}",
            address=self.mac,
            sends_on=name,
            listens_to=name,
            channel=water,
            errors=BitErrors(
                rate=self.bit_error_rate, budget=self._link_budget(water), bit_rate=bit_rate
            ),
            bit_rate=bit_rate,
            preamble=self.preamble,
            max_range=self.range,
            queue_size=self.tx_fifo_size,
            energy=None if self.energy_model is None else self.energy_model.bind(),
        )
        mac = self.mac_protocol or MacProtocolSpec()
        return replace(settings, mac=mac.bind(water, settings.airtime))

    def _link_budget(self, water: WaterChannel) -> LinkBudget | None:
        if self.source_level is None:
            return None
        return LinkBudget.from_water(
            water,
            source_level=self.source_level,
            frequency=1000.0 * self.frequency,
            spreading=self.k,
            constant_loss=self.l,
        )
