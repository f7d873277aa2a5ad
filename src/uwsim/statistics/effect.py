"""Effect sizes: the size of a difference in standardised units."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from .paired import doubled_ranks


def cohens_d(differences: Sequence[float]) -> float | None:
    r"""Return Cohen's (1988, section 2.3.5) :math:`d_z = \bar d / s_d` of paired differences.

    None for fewer than two differences, and for equal ones, which have no spread.
    """
    n = len(differences)
    if n < 2:
        return None
    mean = math.fsum(differences) / n
    std = math.hypot(*(d - mean for d in differences)) / math.sqrt(n - 1)
    return mean / std if std > 1e-14 * abs(mean) else None


def hedges_g(differences: Sequence[float]) -> float | None:
    r"""Return Hedges' (1981) :math:`g = J(n-1)\, d_z`, an unbiased estimate.

    .. math:: J(m) = \frac{\Gamma(m/2)}{\sqrt{m/2}\;\Gamma((m-1)/2)}

    J is 0.56 for three differences, 0.80 for five, 0.91 for ten: :math:`d_z` of few differences is
    too large. None for fewer than three differences, and for equal ones.
    """
    d = cohens_d(differences)
    m = len(differences) - 1
    if d is None or m < 2:
        return None
    return d * math.exp(math.lgamma(m / 2) - math.lgamma((m - 1) / 2)) / math.sqrt(m / 2)


def vargha_delaney(first_sample: Sequence[float], second_sample: Sequence[float]) -> float | None:
    r"""Return Vargha and Delaney's (2000) :math:`A = P(X_1 > X_2) + P(X_1 = X_2)/2`.

    The probability is over all pairs of a value of the first and one of the second sample; seeds
    are not paired. 0.5 is no difference; 0.56, 0.64 and 0.71 (or 0.44, 0.36, 0.29) are a small, a
    medium and a large one. None when a sample is empty.
    """
    if not len(first_sample) or not len(second_sample):
        return None
    sorted_values = np.sort(np.asarray(second_sample, dtype=np.float64))
    values = np.asarray(first_sample, dtype=np.float64)
    n_below = np.searchsorted(sorted_values, values, side="left")
    n_not_above = np.searchsorted(sorted_values, values, side="right")
    return float((n_below + n_not_above).sum()) / (2 * len(first_sample) * len(second_sample))


def rank_biserial(differences: Sequence[float]) -> float | None:
    r"""Return the matched-pairs rank-biserial correlation (Kerby 2014), -1 to 1.

    :math:`(W^+ - W^-)/(W^+ + W^-)` of Wilcoxon's signed ranks: the share of the rank sum that is of
    positive differences, minus that of negative ones. None when all differences are zero.
    """
    values = np.array([d for d in differences if d != 0.0])
    if not len(values):
        return None
    ranks = doubled_ranks(np.abs(values))
    return float((ranks * np.sign(values)).sum() / ranks.sum())
