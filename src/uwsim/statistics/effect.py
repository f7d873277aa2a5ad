"""Effect sizes: the size of a difference in standardised units."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from .paired import doubled_ranks


def cohens_d(differences: Sequence[float]) -> float | None:
    r"""Return the effect size :math:`d_z = \bar d / s_d` of paired differences.

    :math:`\bar d` is the mean and :math:`s_d` the standard deviation of the differences (Cohen
    1988, section 2.3.5). The result is None for fewer than two differences, and for equal
    differences, whose standard deviation is 0.
    """
    n = len(differences)
    if n < 2:
        return None
    mean = math.fsum(differences) / n
    std = math.hypot(*(d - mean for d in differences)) / math.sqrt(n - 1)
    return mean / std if std > 1e-14 * abs(mean) else None


def hedges_g(differences: Sequence[float]) -> float | None:
    r"""Return the effect size :math:`g = J(n-1)\, d_z` of n paired differences (Hedges 1981).

    .. math:: J(m) = \frac{\Gamma(m/2)}{\sqrt{m/2}\;\Gamma((m-1)/2)}

    The factor J corrects :math:`d_z` (`cohens_d`), which is on average too large for few
    differences. It is 0.56 for three differences, 0.80 for five, 0.91 for ten. The result is None
    for fewer than three differences, and for equal differences.
    """
    d = cohens_d(differences)
    m = len(differences) - 1
    if d is None or m < 2:
        return None
    return d * math.exp(math.lgamma(m / 2) - math.lgamma((m - 1) / 2)) / math.sqrt(m / 2)


def vargha_delaney(first_sample: Sequence[float], second_sample: Sequence[float]) -> float | None:
    r"""Return the effect size :math:`A = P(X_1 > X_2) + P(X_1 = X_2)/2` (Vargha and Delaney 2000).

    The probability is over all pairs of a value of the first and a value of the second sample,
    whatever their seeds. A is 0.5 if there is no difference; 0.56, 0.64 and 0.71 (or 0.44, 0.36 and
    0.29) are a small, a medium and a large difference. The result is None if a sample is empty.
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

    It is :math:`(W^+ - W^-)/(W^+ + W^-)`, with the sums :math:`W^+` and :math:`W^-` of the ranks of
    positive and of negative differences by Wilcoxon's method. The result is None if all differences
    are zero.
    """
    values = np.array([d for d in differences if d != 0.0])
    if not len(values):
        return None
    ranks = doubled_ranks(np.abs(values))
    return float((ranks * np.sign(values)).sum() / ranks.sum())
