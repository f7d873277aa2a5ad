"""How many repeats a comparison needs, before any result is known."""

from __future__ import annotations

from ...statistics import min_pairs

ALPHA = 0.05
"""A difference is called one when its p, corrected by Holm, is not above this."""


def fewest_repeats(n_results: int, n_levels: int) -> tuple[int, int]:
    """Return the least number of seeds for the sweep as a whole, and for single levels.

    K results make K (K - 1) / 2 pairs. Holm's correction counts a test for each pair over the
    sweep, and one for each pair and level level by level; with m tests each needs 2/2^n, the
    smallest p of n pairs, to be 0.05/m at most.
    """
    pairs = max(1, n_results * (n_results - 1) // 2)
    return min_pairs(ALPHA / pairs), min_pairs(ALPHA / (pairs * max(1, n_levels)))
