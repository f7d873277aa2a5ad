"""A network simulator: packets between acoustic modems, or over links with a given delay."""

from .channel import AbsorptionModel, Channel, DelayChannel, Path, Sea, WaterChannel
from .energy import EnergyModel
from .events import NANOSECONDS, nanoseconds
from .link_budget import LinkBudget, bpsk_error_rate
from .mac import Mac, mac_kind
from .modem import Modem, ModemSettings
from .network import Network
from .packet import BROADCAST_ADDRESS, Counts, Packet
from .packet_errors import BitErrors, ErrorModel, RateErrors, Unit

__all__ = [
    "BROADCAST_ADDRESS",
    "NANOSECONDS",
    "AbsorptionModel",
    "BitErrors",
    "Channel",
    "Counts",
    "DelayChannel",
    "EnergyModel",
    "ErrorModel",
    "LinkBudget",
    "Mac",
    "Modem",
    "ModemSettings",
    "Network",
    "Packet",
    "Path",
    "RateErrors",
    "Sea",
    "Unit",
    "WaterChannel",
    "bpsk_error_rate",
    "mac_kind",
    "nanoseconds",
]
