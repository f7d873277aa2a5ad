"""The settings of a measurement of the gap."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..errors import BadSetting

MAX_WINDOWS = 1000
"""The greatest number of windows."""
MAX_HORIZON = 600.0
"""The longest horizon [s]."""
MAX_HORIZONS = 8
"""The greatest number of horizons."""


@dataclass(frozen=True, kw_only=True)
class GapSettings:
    """The settings of a measurement of the gap."""

    n_windows: int = 60
    """The greatest number of windows, which begin at equal intervals."""
    horizons: tuple[float, ...] = (1.0, 5.0, 20.0)
    """The times after the beginning of a window at which the error is taken, ascending [s]."""
    seed: int = 0
    """The seed of the resamples of intervals and of the simulated sensors."""
    has_attribution: bool = True
    """The choice whether to search for the coefficient that explains the error."""

    def __post_init__(self) -> None:
        if not 2 <= self.n_windows <= MAX_WINDOWS:
            raise BadSetting(f"windows={self.n_windows}: expected 2 to {MAX_WINDOWS}.")
        horizons = self.horizons
        is_valid = 1 <= len(horizons) <= MAX_HORIZONS and all(map(math.isfinite, horizons))
        is_valid = is_valid and all(0.05 <= horizon <= MAX_HORIZON for horizon in horizons)
        if not is_valid or list(horizons) != sorted(set(horizons)):
            raise BadSetting(
                f"horizons={','.join(f'{horizon:g}' for horizon in horizons)}: expected up to "
                f"{MAX_HORIZONS} ascending times from 0.05 to {MAX_HORIZON:g} s, as 1,5,20."
            )
        if self.seed < 0:
            raise BadSetting(f"seed={self.seed}: expected 0 or more.")
