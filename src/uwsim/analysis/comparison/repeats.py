"""The number of repeats that a comparison needs, known before any result exists."""

from __future__ import annotations

from ...statistics import min_pairs

ALPHA = 0.05
"""The significance level: the greatest p, after Holm's correction, that shows a difference."""


def min_repeats(n_results: int, n_levels: int) -> tuple[int, int]:
    """Return the minimum number of repeats for the sweep as a whole, and for single levels.

    K results have K (K - 1) / 2 pairs. Over the sweep, Holm's correction counts one test for each
    pair; at single levels, one test for each pair and level. With m tests, the smallest p of n
    repeats, which is 2/2^n, must be 0.05/m at most.
    """
    n_pairs = max(1, n_results * (n_results - 1) // 2)
    return min_pairs(ALPHA / n_pairs), min_pairs(ALPHA / (n_pairs * max(1, n_levels)))
