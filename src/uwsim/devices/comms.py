"""Radio and sound links: devices and channels of UWSim-NET.

.. code-block:: xml

    <CustomCommsChannel> <id>0</id> <minPropTime>1</minPropTime> </CustomCommsChannel>
    <CustomCommsDevice>
      <dccommsId>rf0</dccommsId> <txChannelId>0</txChannelId> <rxChannelId>0</rxChannelId>
      <relativeTo>base_link</relativeTo> <mac>1</mac> <bitrate>1000</bitrate>
      <txPacketBuilder> <className>VariableLengthPacketBuilder</className> </txPacketBuilder>
      <rxPacketBuilder> <className>VariableLengthPacketBuilder</className> </rxPacketBuilder>
    </CustomCommsDevice>
"""

from __future__ import annotations

from dataclasses import dataclass

from ..schema import REQUIRED, Original, element


@dataclass(frozen=True, kw_only=True)
class CustomCommsChannelSpec:
    """A ``<CustomCommsChannel>``: delay = minPropTime + propTimeIncPerMeter * distance."""

    id: int
    """Number by which devices choose the channel."""
    prop_time_inc_per_meter: float = 0.66667
    """Delay per distance [ms/m]."""
    min_prop_time: float = 0.0
    """Delay at distance zero [ms]."""
    log_level: str = "off"
    """What is logged."""


@dataclass(frozen=True, kw_only=True)
class AcousticCommsChannelSpec:
    """An ``<AcousticCommsChannel>``."""

    id: int
    """Number by which devices choose the channel."""
    bandwidth: float = 4096.0
    """Bandwidth [Hz]."""
    temperature: float = 25.0
    """Of the water [degC]."""
    salinity: float = 35.0
    """Of the water [g/kg]."""
    noise_lvl: float = 0.0
    """Noise level [dB]."""
    log_level: str = "off"
    """What is logged."""


@dataclass(frozen=True, kw_only=True)
class MacProtocolSpec:
    """A ``<macProtocol>``: who may send when."""

    name: str = element(default="", original=REQUIRED)
    """Name of the protocol; empty for none."""
    max_distance: float = element(default=0.0, original=Original(lenient=True))
    """Longest distance between two devices [m]."""
    max_backoff_slots: int = 4
    """Longest wait after a collision [slots]."""


@dataclass(frozen=True, kw_only=True)
class JitterSpec:
    """A ``<jitter>`` of the delay."""

    tx: float = 0.0
    """When sending [ms]."""
    rx: float = element(default=0.0, original=REQUIRED)
    """When receiving [ms]."""


@dataclass(frozen=True, kw_only=True)
class RateErrorModelSpec:
    """A ``<rateErrorModel>``: how likely a piece is lost."""

    error_unit: str = element(default="bit", original=REQUIRED)
    """What is lost: bit, byte or packet."""
    error_rate_expr: str = element(default="0.01*m", original=REQUIRED)
    """Its probability as a formula in the distance m [m]."""


@dataclass(frozen=True, kw_only=True)
class PacketBuilderSpec:
    """A ``<txPacketBuilder>`` or ``<rxPacketBuilder>``."""

    class_name: str
    """Name of the class that packs."""
    lib_path: str = ""
    """Library that holds it, when it is not built in."""


@dataclass(frozen=True, kw_only=True)
class EnergyModelSpec:
    """An ``<energyModel>`` of an acoustic device."""

    energy_level: float
    """Energy at the start [J]."""
    turn_on_energy: float = element(default=0.0, original=REQUIRED)
    """Energy to switch on [J]."""
    turn_off_energy: float = element(default=0.0, original=REQUIRED)
    """Energy to switch off [J]."""
    p_t_consume: float = element("pTConsume", default=0.660, original=REQUIRED)
    """Power while sending [W]."""
    p_r_consume: float = element("pRConsume", default=0.395, original=REQUIRED)
    """Power while receiving [W]."""
    p_idle: float = element("pIdle", default=0.0, original=REQUIRED)
    """Power while idle [W]."""
    p_t: float = element("pT", default=0.2818, original=REQUIRED)
    """Power into the water [W]."""


@dataclass(frozen=True, kw_only=True)
class CommsMeshSpec:
    """A ``<mesh>`` that shows where a device is."""

    path: str
    """The file."""
    scale_factor: tuple[float, float, float] = (1.0, 1.0, 1.0)
    """Scale along x, y, z [1]."""


@dataclass(frozen=True, kw_only=True)
class CustomCommsDeviceSpec:
    """A ``<CustomCommsDevice>``: a link described by delays and error rates."""

    dccomms_id: str
    """Its name."""
    tx_channel_id: int
    """Channel it sends on."""
    rx_channel_id: int
    """Channel it listens to."""
    relative_to: str
    """The link it rides on."""
    mac: int
    """Its address."""
    mac_protocol: MacProtocolSpec | None = None
    """Who may send when."""
    bitrate: float = element(default=1000.0, original=REQUIRED)
    """How fast it sends [bit/s]."""
    tx_fifo_size: int = 500000
    """How much waits to be sent at most [byte]."""
    tf_id: str = ""
    """Name of its frame; ``<vehicle>/<device>`` when empty."""
    relative_tf_id: str = ""
    """Name of the frame it rides on; ``<vehicle>/<relativeTo>`` when empty."""
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Of the device in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Of the device in the link's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    mesh: CommsMeshSpec | None = None
    """Its body."""
    intrinsic_delay: float = 0.0
    """Delay of the device itself [ms]."""
    pr_time_inc_per_meter: float = 0.0
    """Allowed by the grammar and never read by the original [ms/m]."""
    jitter: JitterSpec | None = None
    """Variation of the delay."""
    max_distance: float = 99999999.0
    """Longest distance it reaches [m]."""
    min_distance: float = 0.0
    """Shortest distance it reaches [m]."""
    rate_error_model: RateErrorModelSpec | None = None
    """How likely a piece is lost."""
    tx_packet_builder: PacketBuilderSpec | None = element(default=None, original=REQUIRED)
    """Packs what is sent."""
    rx_packet_builder: PacketBuilderSpec | None = element(default=None, original=REQUIRED)
    """Unpacks what is received."""
    log_level: str = "off"
    """What is logged."""
    disable: bool = False
    """Whether only its body is made."""


@dataclass(frozen=True, kw_only=True)
class AcousticCommsDeviceSpec:
    """An ``<AcousticCommsDevice>``: an acoustic modem."""

    dccomms_id: str
    """Its name."""
    channel_id: int
    """Its channel."""
    relative_to: str
    """The link it rides on."""
    mac: int
    """Its address."""
    symbols_per_second: float = element(above=0)
    """How fast it sends [symbol/s]."""
    coding_eff: float = 1.0
    """Bits per symbol [1]."""
    bit_error_rate: float = 0.0
    """Probability that a bit is lost [1]."""
    tx_fifo_size: int = 500000
    """How much waits to be sent at most [byte]."""
    tf_id: str = ""
    """Name of its frame; ``<vehicle>/<device>`` when empty."""
    relative_tf_id: str = ""
    """Name of the frame it rides on; ``<vehicle>/<relativeTo>`` when empty."""
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Of the device in the link's frame [m]."""
    orientation: tuple[float, float, float] = element(default=(0.0, 0.0, 0.0), parts="rpy")
    """Of the device in the link's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    mesh: CommsMeshSpec | None = None
    """Its body."""
    range: float = 100.0
    """Longest distance it reaches [m]."""
    frequency: float = 25.0
    """Carrier [kHz]."""
    l: float = element("L", default=0.0)  # noqa: E741  (the dialect's letter)
    """Constant loss [dB]."""
    k: float = element("K", default=2.0)
    """Spreading: 1 cylindrical, 2 spherical [1]."""
    energy_model: EnergyModelSpec | None = None
    """What it consumes."""
    preamble: float = 0.0
    """Length of the preamble [s]."""
    mac_protocol: MacProtocolSpec | None = None
    """Who may send when."""
    tx_packet_builder: PacketBuilderSpec | None = element(default=None, original=REQUIRED)
    """Packs what is sent."""
    rx_packet_builder: PacketBuilderSpec | None = element(default=None, original=REQUIRED)
    """Unpacks what is received."""
    log_level: str = "off"
    """What is logged."""
    disable: bool = False
    """Whether only its body is made."""
