"""Optics of water: phase functions, media, and what they do to images and lamps."""

from .conversions import Quantity, View, WaterEstimate, convert_water
from .fournier_forand import FournierForand
from .henyey_greenstein import HenyeyGreenstein
from .lamp_light import (
    Lamp,
    compute_lamp_irradiance,
    compute_lamp_veil,
    compute_target_radiance,
)
from .medium import PETZOLD_AVERAGE, Medium, find_coefficient_errors
from .named_waters import WATERS, NamedWater, find_water
from .phase_function import PhaseFunction
from .phase_mixture import PhaseMixture
from .phase_table import PhaseTable
from .transmission import (
    compute_ambient_veil,
    compute_direct,
    compute_full_field,
    compute_led_halo,
    compute_led_signal,
    compute_modulation_transfer,
)
from .water_file import WaterFile, read_water, write_water

__all__ = [
    "PETZOLD_AVERAGE",
    "WATERS",
    "FournierForand",
    "HenyeyGreenstein",
    "Lamp",
    "Medium",
    "NamedWater",
    "PhaseFunction",
    "PhaseMixture",
    "PhaseTable",
    "Quantity",
    "View",
    "WaterEstimate",
    "WaterFile",
    "compute_ambient_veil",
    "compute_direct",
    "compute_full_field",
    "compute_lamp_irradiance",
    "compute_lamp_veil",
    "compute_led_halo",
    "compute_led_signal",
    "compute_modulation_transfer",
    "compute_target_radiance",
    "convert_water",
    "find_coefficient_errors",
    "find_water",
    "read_water",
    "write_water",
]
