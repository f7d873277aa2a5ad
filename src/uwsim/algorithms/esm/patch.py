"""The fields of a template that compiled code reads."""

from __future__ import annotations

from typing import NamedTuple

from .pyramid import Grey
from .template import Runs


class Patch(NamedTuple):
    """The fields of a `template.Template` that the iterations read."""

    runs: Runs
    values: Grey
    slope_u: Grey
    slope_v: Grey
    mean: float
    contrast: float
