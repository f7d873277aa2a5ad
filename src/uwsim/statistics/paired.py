"""Paired tests: two values, or two outcomes, of the same seed and level."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ..base.rng import stream

MAX_EXACT = 20
"""Up to so many differences every one of the 2^n sign patterns is counted."""
N_FLIPS = 99_999
"""Sign patterns drawn beyond that."""
MAX_COUNTED = 200
"""From here on the limiting distribution is the same to any digit that is printed."""


def sign_flip(differences: Sequence[float]) -> float | None:
    r"""Return the two-sided p-value of the sign-flip test of a mean difference of zero.

    If neither of a pair is better, each difference could as well have had the other sign. p is the
    share of all :math:`2^n` sign patterns whose mean is at least as far from zero as the one found
    (Fisher 1935, section 21; Pitman 1937): exact, whatever the distribution, and never below
    :math:`2/2^n`. Beyond `MAX_EXACT` differences p is :math:`(b+1)/(m+1)` over `N_FLIPS` random
    patterns (Phipson and Smyth 2010), beyond `MAX_COUNTED` that of Student's paired t-test.

    None without differences.
    """
    n = len(differences)
    if n == 0:
        return None
    values = np.sort(np.asarray(differences, dtype=np.float64))
    total = abs(math.fsum(differences))
    limit = total - 1e-12 * math.fsum(map(abs, differences))
    if n <= MAX_EXACT:
        sums = values[:1]  # the first sign may stand: the distribution is symmetric
        for value in values[1:]:
            sums = np.concatenate([sums - value, sums + value])
        return float(np.mean(np.abs(sums) >= limit))
    if n > MAX_COUNTED:
        return _student(values)
    sums = np.zeros(N_FLIPS)
    for value, flips in zip(values.tolist(), _flips(n), strict=True):
        sums += value * flips
    return (1 + int(np.count_nonzero(np.abs(sums) >= limit))) / (N_FLIPS + 1)


def signed_rank(differences: Sequence[float]) -> float | None:
    r"""Return the two-sided p-value of Wilcoxon's (1945) signed-rank test.

    :math:`W^+` is the sum of the ranks, by size, of the positive differences; zeros are left out,
    ties share their mean rank. Its distribution under :math:`2^n` equally likely sign patterns is
    counted exactly, ties included, up to `MAX_COUNTED` differences; beyond, the normal limit.

    None without differences; 1 when all are zero.
    """
    if len(differences) == 0:
        return None
    values = np.array([d for d in differences if d != 0.0])
    n = len(values)
    if n == 0:
        return 1.0
    if n > MAX_COUNTED:
        from scipy.stats import wilcoxon

        return float(wilcoxon(values, method="approx", correction=True).pvalue)
    doubled = doubled_ranks(np.abs(values))
    found = int(doubled[values > 0].sum())
    total = int(doubled.sum())
    share = np.zeros(total + 1)  # of sign patterns, for each sum of doubled ranks
    share[0] = 1.0
    for rank in doubled.tolist():
        moved = np.zeros_like(share)
        moved[rank:] = share[: total + 1 - rank]
        share = (share + moved) / 2
    off = np.abs(2 * np.arange(total + 1) - total)
    return min(1.0, float(share[off >= abs(2 * found - total)].sum()))


def mcnemar(first_only: int, second_only: int) -> float:
    r"""Return the two-sided p-value of McNemar's (1947) test in its exact form.

    Of the pairs in which only one succeeded, each side should win half: p is that of a fair coin,
    :math:`2\,P(X \le \min(b, c))` with :math:`X \sim B(b + c, 1/2)`, at most 1. Pairs in which both
    or neither succeeded carry no information about which is better.
    """
    from scipy.special import bdtr

    n = first_only + second_only
    return min(1.0, 2 * float(bdtr(min(first_only, second_only), n, 0.5))) if n else 1.0


def smallest_p(n: int) -> float:
    r"""Return the smallest p-value that `sign_flip` can give for n pairs, whatever they measure.

    :math:`2/2^n`, 1 without pairs, while all sign patterns are counted: the one found and its
    mirror image are always as far from zero as the one found. Where m patterns are drawn none is
    below :math:`1/(m+1)`, and where Student's distribution is used there is no least one.
    """
    if n <= MAX_EXACT:
        return min(1.0, 2.0 ** (1 - n))
    return 1 / (N_FLIPS + 1) if n <= MAX_COUNTED else 0.0


def fewest_for(alpha: float) -> int:
    r"""Return the least number of pairs whose sign-flip test can reach ``alpha``: 6 for 5 %.

    :math:`n = \lceil \log_2(2/\alpha) \rceil`: the smallest p there is with n pairs is
    :math:`2/2^n` (`smallest_p`). For m tests and Holm's correction ask for
    :math:`\alpha/m`: unless one p is that small, none is called different.
    """
    n = max(1, math.ceil(math.log2(2 / alpha)))
    return n - 1 if n > 1 and 2.0 ** (2 - n) <= alpha else n


def doubled_ranks(sizes: npt.NDArray[np.float64]) -> npt.NDArray[np.int64]:
    """Return twice the mean rank of every size, from 2 for the smallest: whole numbers."""
    _, place, counts = np.unique(sizes, return_inverse=True, return_counts=True)
    below = np.concatenate([[0], np.cumsum(counts)[:-1]])
    doubled: npt.NDArray[np.int64] = (2 * below + counts + 1)[place]
    return doubled


def _student(values: npt.NDArray[np.float64]) -> float:
    from scipy.special import stdtr

    n, std = len(values), float(values.std(ddof=1))
    mean = float(values.mean())
    if std == 0.0:
        return 1.0 if mean == 0.0 else 0.0
    return 2 * float(stdtr(n - 1, -abs(mean) / std * math.sqrt(n)))


@functools.lru_cache(maxsize=2)
def _flips(n: int) -> npt.NDArray[np.int8]:
    """(n, N_FLIPS) signs, the same for all data."""
    random = stream(0, f"statistics/sign-flip/{n}")
    return (2 * random.integers(0, 2, (n, N_FLIPS), dtype=np.int8) - 1).astype(np.int8)
