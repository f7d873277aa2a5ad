"""The fields of a template that the compiled code of an alignment reads."""

from __future__ import annotations

from typing import NamedTuple

from .pyramid import Grey
from .template import Runs


class Patch(NamedTuple):
    """The fields of a `template.Template` that the iterations of an alignment read."""

    runs: Runs
    """The first and one-past-last column of the patch in each row, (h, 2)."""
    values: Grey
    """The pixels, with zero mean and unit variance inside the patch, (h, w)."""
    slope_u: Grey
    """The derivative of the pixels with respect to the normalised coordinate u, (h, w)."""
    slope_v: Grey
    """The derivative of the pixels with respect to the normalised coordinate v, (h, w)."""
    mean: float
    """The mean of the pixels before the normalisation [grey level]."""
    contrast: float
    """The standard deviation of the pixels before the normalisation [grey level]."""
