"""Paired tests, which compare two values, or two outcomes, with the same seed and level."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ..base.rng import stream

MAX_EXACT_PAIRS = 20
"""The greatest number of differences for which all 2^n sign patterns are evaluated."""
N_SIGN_PATTERNS = 99_999
"""The number of random sign patterns that are evaluated for more differences."""
MAX_COUNTED_PAIRS = 200
"""The number of differences above which the limiting distribution (Student's t, or normal) is used;
it then agrees to all printed digits."""


def sign_flip(differences: Sequence[float]) -> float | None:
    r"""Return the two-sided p-value of the sign-flip test of a mean difference of zero.

    If neither of the compared algorithms is better, both signs of each difference are equally
    likely. p is the fraction of all :math:`2^n` sign patterns for which the mean is at least as far
    from zero as the observed mean (Fisher 1935, section 21; Pitman 1937). It is exact for any
    distribution, and never below :math:`2/2^n`. For more than `MAX_EXACT_PAIRS` differences,
    :math:`m` = `N_SIGN_PATTERNS` random patterns are evaluated, and p is :math:`(b+1)/(m+1)` if the
    mean is at least as far from zero for b of them (Phipson and Smyth 2010). For more than
    `MAX_COUNTED_PAIRS` differences, p is that of Student's paired t-test. Zeros have no sign and
    are then left out first: with few other values the distribution is far from Student's.

    The result is None without differences.
    """
    n = len(differences)
    if n == 0:
        return None
    values = np.sort(np.asarray(differences, dtype=np.float64))
    is_sparse = n > MAX_COUNTED_PAIRS
    if is_sparse:
        values = values[values != 0.0]
        n = len(values)
    total = abs(math.fsum(differences))
    threshold = total - 1e-12 * math.fsum(map(abs, differences))
    if n == 0:
        return 1.0
    if n <= MAX_EXACT_PAIRS:
        sums = values[:1]  # one sign of the first suffices: the distribution is symmetric
        for value in values[1:]:
            sums = np.concatenate([sums - value, sums + value])
        return float(np.mean(np.abs(sums) >= threshold))
    if n > MAX_COUNTED_PAIRS:
        return _student_p(values)
    sums = np.zeros(N_SIGN_PATTERNS)
    all_signs = _random_signs(MAX_COUNTED_PAIRS)[:n] if is_sparse else _random_signs(n)
    for value, signs in zip(values.tolist(), all_signs, strict=True):
        sums += value * signs
    return (1 + int(np.count_nonzero(np.abs(sums) >= threshold))) / (N_SIGN_PATTERNS + 1)


def signed_rank(differences: Sequence[float]) -> float | None:
    r"""Return the two-sided p-value of Wilcoxon's (1945) signed-rank test.

    The differences are ranked by their absolute values; zeros are omitted, and ties have their mean
    rank. :math:`W^+` is the sum of the ranks of the positive differences. Its distribution over
    :math:`2^n` equally likely sign patterns is computed exactly, ties included, for up to
    `MAX_COUNTED_PAIRS` differences, and approximated by a normal distribution for more.

    The result is None without differences, and 1 if all differences are zero.
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

    If neither of two algorithms is better, a pair in which only one of them succeeds is equally
    likely to favour the first or the second. With b pairs in favour of the first and c in favour of
    the second, p is :math:`2\,P(X \le \min(b, c))` with :math:`X \sim B(b + c, 1/2)`, at most 1.
    Pairs in which both or neither succeed contain no information about which algorithm is better.

    Args:
        first_only: the number b of pairs in which only the first succeeds.
        second_only: the number c of pairs in which only the second succeeds.
    """
    from scipy.special import bdtr

    n = first_only + second_only
    return min(1.0, 2 * float(bdtr(min(first_only, second_only), n, 0.5))) if n else 1.0


def min_p_value(n: int) -> float:
    r"""Return the smallest p-value that `sign_flip` can give for any differences of n pairs.

    If all sign patterns are evaluated, it is :math:`2/2^n` (1 without pairs), because the observed
    pattern and the opposite one always count. If m random patterns are evaluated, it is
    :math:`1/(m+1)`. For Student's test it is 0.
    """
    if n <= MAX_EXACT_PAIRS:
        return min(1.0, 2.0 ** (1 - n))
    return 1 / (N_SIGN_PATTERNS + 1) if n <= MAX_COUNTED_PAIRS else 0.0


def min_pairs(alpha: float) -> int:
    r"""Return the minimum number of pairs whose sign-flip test can reach ``alpha``: 6 for 5 %.

    It is :math:`n = \lceil \log_2(2/\alpha) \rceil`, as the smallest p of n pairs is
    :math:`2/2^n` (`min_p_value`). For m tests with Holm's correction use :math:`\alpha/m`: the
    smallest p has to reach that value for any difference to be significant.
    """
    n = max(1, math.ceil(math.log2(2 / alpha)))
    return n - 1 if n > 1 and 2.0 ** (2 - n) <= alpha else n


def doubled_ranks(sizes: npt.NDArray[np.float64]) -> npt.NDArray[np.int64]:
    """Return twice the mean rank of every size (n,), which is an integer; 2 for the smallest."""
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
    """Return random signs, (n, N_SIGN_PATTERNS), which are the same for all data."""
    rng = stream(0, f"statistics/sign-flip/{n}")
    return (2 * rng.integers(0, 2, (n, N_SIGN_PATTERNS), dtype=np.int8) - 1).astype(np.int8)
