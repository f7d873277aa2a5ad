"""Optics of water: phase functions, media, and what they do to images and lamps."""

from .fournier_forand import FournierForand
from .henyey_greenstein import HenyeyGreenstein
from .medium import Medium, find_coefficient_errors
from .named_waters import WATERS, NamedWater, find_water
from .phase_fit import (
    SmallAngleTerms,
    fit_backward_cubic,
    fit_encircled_terms,
    fit_transform_terms,
)
from .phase_function import PhaseFunction
from .phase_table import PhaseTable

__all__ = [
    "WATERS",
    "FournierForand",
    "HenyeyGreenstein",
    "Medium",
    "NamedWater",
    "PhaseFunction",
    "PhaseTable",
    "SmallAngleTerms",
    "find_coefficient_errors",
    "find_water",
    "fit_backward_cubic",
    "fit_encircled_terms",
    "fit_transform_terms",
]
