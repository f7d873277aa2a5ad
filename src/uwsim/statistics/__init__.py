"""Statistics: confidence intervals, paired tests, effect sizes and power analysis.

The functions are computations on numbers, without knowledge of benchmarks. Random numbers come from
named streams, so that equal data always give equal results. ``docs/statistics.md`` defines each
quantity, and states when it can mislead.
"""

from __future__ import annotations

from .effect import cohens_d, hedges_g, rank_biserial, vargha_delaney
from .holm import holm
from .interval import Interval, mean_interval
from .median import Median, median_interval, min_values_for_median
from .paired import mcnemar, min_p_value, min_pairs, sign_flip, signed_rank
from .power import power, repeats_needed
from .rate import Rate, rate

__all__ = [
    "Interval",
    "Median",
    "Rate",
    "cohens_d",
    "hedges_g",
    "holm",
    "mcnemar",
    "mean_interval",
    "median_interval",
    "min_p_value",
    "min_pairs",
    "min_values_for_median",
    "power",
    "rank_biserial",
    "rate",
    "repeats_needed",
    "sign_flip",
    "signed_rank",
    "vargha_delaney",
]
