"""Paired tests: two values, or two outcomes, of the same seed and level."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ..base.rng import stream

MAX_EXACT_PAIRS = 20
"""The greatest number of differences of which all 2^n sign patterns are counted."""
N_SIGN_PATTERNS = 99_999
"""The number of sign patterns that are drawn for more differences."""
MAX_COUNTED_PAIRS = 200
"""The number of differences above which the limiting distribution agrees to all printed digits."""


def sign_flip(differences: Sequence[float]) -> float | None:
    r"""Return the two-sided p-value of the sign-flip test of a mean difference of zero.

    If neither of a pair is better, both signs of each difference are equally likely. p is the share
    of all :math:`2^n` sign patterns whose mean is at least as far from zero as the observed one
    (Fisher 1935, section 21; Pitman 1937): exact for any distribution, and never below
    :math:`2/2^n`. Beyond `MAX_EXACT_PAIRS` differences p is :math:`(b+1)/(m+1)` over
    `N_SIGN_PATTERNS` random patterns (Phipson and Smyth 2010), where b are at least as far. Beyond
    `MAX_COUNTED_PAIRS` it is that of Student's paired t-test.

    None without differences.
    """
    n = len(differences)
    if n == 0:
        return None
    values = np.sort(np.asarray(differences, dtype=np.float64))
    total = abs(math.fsum(differences))
    threshold = total - 1e-12 * math.fsum(map(abs, differences))
    if n <= MAX_EXACT_PAIRS:
        sums = values[:1]  # one sign of the first suffices: the distribution is symmetric
        for value in values[1:]:
            sums = np.concatenate([sums - value, sums + value])
        return float(np.mean(np.abs(sums) >= threshold))
    if n > MAX_COUNTED_PAIRS:
        return _student_p(values)
    sums = np.zeros(N_SIGN_PATTERNS)
    for value, signs in zip(values.tolist(), _random_signs(n), strict=True):
        sums += value * signs
    return (1 + int(np.count_nonzero(np.abs(sums) >= threshold))) / (N_SIGN_PATTERNS + 1)


def signed_rank(differences: Sequence[float]) -> float | None:
    r"""Return the two-sided p-value of Wilcoxon's (1945) signed-rank test.

    :math:`W^+` is the sum of the ranks, by size, of the positive differences; zeros are omitted,
    ties have their mean rank. Its distribution under :math:`2^n` equally likely sign patterns is
    counted exactly, ties included, up to `MAX_COUNTED_PAIRS` differences; beyond, it is normal.

    None without differences; 1 when all are zero.
    """
    if len(differences) == 0:
        return None
    values = np.array([d for d in differences if d != 0.0])
    n = len(values)
    if n == 0:
        return 1.0
    if n > MAX_COUNTED_PAIRS:
        from scipy.stats import wilcoxon

        return float(wilcoxon(values, method="approx", correction=True).pvalue)
    ranks = doubled_ranks(np.abs(values))
    rank_sum = int(ranks[values > 0].sum())
    total = int(ranks.sum())
    share = np.zeros(total + 1)  # of sign patterns, for each sum of doubled ranks
    share[0] = 1.0
    for rank in ranks.tolist():
        shifted_share = np.zeros_like(share)
        shifted_share[rank:] = share[: total + 1 - rank]
        share = (share + shifted_share) / 2
    distance = np.abs(2 * np.arange(total + 1) - total)
    return min(1.0, float(share[distance >= abs(2 * rank_sum - total)].sum()))


def mcnemar(first_only: int, second_only: int) -> float:
    r"""Return the two-sided p-value of McNemar's (1947) test in its exact form.

    If neither is better, a pair in which only one succeeds is as likely in favour of either. With b
    and c such pairs, p is :math:`2\,P(X \le \min(b, c))` with :math:`X \sim B(b + c, 1/2)`, at most
    1. Pairs in which both or neither succeed have no information about which is better.
    """
    from scipy.special import bdtr

    n = first_only + second_only
    return min(1.0, 2 * float(bdtr(min(first_only, second_only), n, 0.5))) if n else 1.0


def min_p_value(n: int) -> float:
    r"""Return the smallest p-value that `sign_flip` can give for any differences of n pairs.

    It is :math:`2/2^n`, or 1 without pairs, where all sign patterns are counted: the observed one
    and its mirror image are always as far from zero as the observed one. Where m patterns are drawn
    it is :math:`1/(m+1)`. Student's test has no smallest one.
    """
    if n <= MAX_EXACT_PAIRS:
        return min(1.0, 2.0 ** (1 - n))
    return 1 / (N_SIGN_PATTERNS + 1) if n <= MAX_COUNTED_PAIRS else 0.0


def min_pairs(alpha: float) -> int:
    r"""Return the least number of pairs whose sign-flip test can reach ``alpha``: 6 for 5 %.

    :math:`n = \lceil \log_2(2/\alpha) \rceil`: the smallest p of n pairs is :math:`2/2^n`
    (`min_p_value`). For m tests with Holm's correction use :math:`\alpha/m`: one p has to be that
    small for any difference to be significant.
    """
    n = max(1, math.ceil(math.log2(2 / alpha)))
    return n - 1 if n > 1 and 2.0 ** (2 - n) <= alpha else n


def doubled_ranks(sizes: npt.NDArray[np.float64]) -> npt.NDArray[np.int64]:
    """Return twice the mean rank of every size, an integer; 2 for the smallest."""
    _, place, counts = np.unique(sizes, return_inverse=True, return_counts=True)
    n_below = np.concatenate([[0], np.cumsum(counts)[:-1]])
    ranks: npt.NDArray[np.int64] = (2 * n_below + counts + 1)[place]
    return ranks


def _student_p(values: npt.NDArray[np.float64]) -> float:
    from scipy.special import stdtr

    n, std = len(values), float(values.std(ddof=1))
    mean = float(values.mean())
    if std == 0.0:
        return 1.0 if mean == 0.0 else 0.0
    return 2 * float(stdtr(n - 1, -abs(mean) / std * math.sqrt(n)))


@functools.lru_cache(maxsize=2)
def _random_signs(n: int) -> npt.NDArray[np.int8]:
    """Return signs, (n, N_SIGN_PATTERNS), the same for all data."""
    rng = stream(0, f"statistics/sign-flip/{n}")
    return (2 * rng.integers(0, 2, (n, N_SIGN_PATTERNS), dtype=np.int8) - 1).astype(np.int8)
