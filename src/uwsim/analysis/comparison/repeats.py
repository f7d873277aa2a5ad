"""The number of repeats that a comparison needs, before any result exists."""

from __future__ import annotations

from ...statistics import min_pairs

ALPHA = 0.05
"""The significance level: the greatest p, corrected by Holm, of a difference that is shown."""


def min_repeats(n_results: int, n_levels: int) -> tuple[int, int]:
    """Return the least number of seeds for the sweep as a whole, and for single levels.

    K results have K (K - 1) / 2 pairs. Holm's correction counts one test for each pair over the
    sweep, and one for each pair and level at single levels. With m tests, 2/2^n, the smallest p
    of n repeats, has to be 0.05/m at most.
    """
    n_pairs = max(1, n_results * (n_results - 1) // 2)
    return min_pairs(ALPHA / n_pairs), min_pairs(ALPHA / (n_pairs * max(1, n_levels)))
