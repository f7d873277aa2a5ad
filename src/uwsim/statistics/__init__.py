"""Statistics: intervals, paired tests, effect sizes, power, times to success, ranks.

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
from .ranking import (
    Rank,
    Strength,
    bradley_terry,
    count_wins,
    paired_p,
    paired_ranks,
    seeds_to_rank,
)
from .rate import Rate, rate
from .survival import (
    LogRank,
    SuccessCurve,
    TrialTime,
    log_rank,
    paired_log_rank,
    success_curve,
)

__all__ = [
    "Interval",
    "LogRank",
    "Median",
    "Rank",
    "Rate",
    "Strength",
    "SuccessCurve",
    "TrialTime",
    "bradley_terry",
    "cohens_d",
    "count_wins",
    "hedges_g",
    "holm",
    "log_rank",
    "mcnemar",
    "mean_interval",
    "median_interval",
    "min_p_value",
    "min_pairs",
    "min_values_for_median",
    "paired_log_rank",
    "paired_p",
    "paired_ranks",
    "power",
    "rank_biserial",
    "rate",
    "repeats_needed",
    "seeds_to_rank",
    "sign_flip",
    "signed_rank",
    "success_curve",
    "vargha_delaney",
]
