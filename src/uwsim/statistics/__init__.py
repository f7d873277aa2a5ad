"""Confidence intervals, paired tests, effect sizes and power analysis.

Pure numbers in, pure numbers out; nothing here knows of benchmarks. Where chance is needed it comes
from a named stream of its own, so that equal values always have equal intervals.
``docs/statistics.md`` says what each number means and when not to trust it.
"""

from __future__ import annotations

from .effect import cohens_d, hedges_g, rank_biserial, vargha_delaney
from .holm import holm
from .interval import Interval, mean_interval
from .median import Median, fewest_for_median, median_interval
from .paired import fewest_for, mcnemar, sign_flip, signed_rank, smallest_p
from .power import power, repeats_needed
from .rate import Rate, rate

__all__ = [
    "Interval",
    "Median",
    "Rate",
    "cohens_d",
    "fewest_for",
    "fewest_for_median",
    "hedges_g",
    "holm",
    "mcnemar",
    "mean_interval",
    "median_interval",
    "power",
    "rank_biserial",
    "rate",
    "repeats_needed",
    "sign_flip",
    "signed_rank",
    "smallest_p",
    "vargha_delaney",
]
