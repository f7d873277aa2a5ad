"""Holm's correction for multiple tests."""

from __future__ import annotations

from collections.abc import Sequence


def holm(p_values: Sequence[float | None]) -> tuple[float | None, ...]:
    r"""Return the p-values of several tests, adjusted by the method of Holm (1979).

    With the p-values :math:`p_{(1)} \le \dots \le p_{(m)}` of m tests, the adjusted values are
    :math:`\tilde p_{(i)} = \max_{j \le i} \min(1, (m-j+1)\, p_{(j)})`. If every test with
    :math:`\tilde p \le \alpha` is called significant, the probability of one or more false
    positives is at most :math:`\alpha`, whatever the dependence between the tests. None stands for
    a test without a p-value; it stays None and does not count in m.
    """
    sorted_tests = sorted((p, i) for i, p in enumerate(p_values) if p is not None)
    adjusted_p_values: list[float | None] = [None] * len(p_values)
    running_maximum = 0.0
    for rank, (p, i) in enumerate(sorted_tests):
        running_maximum = max(running_maximum, min(1.0, (len(sorted_tests) - rank) * p))
        adjusted_p_values[i] = running_maximum
    return tuple(adjusted_p_values)
