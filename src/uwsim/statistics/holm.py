"""Holm's correction for multiple tests."""

from __future__ import annotations

from collections.abc import Sequence


def holm(p_values: Sequence[float | None]) -> tuple[float | None, ...]:
    r"""Return the p-values adjusted by Holm (1979); None (no test) stays None and is not counted.

    With m tests ordered by p, :math:`\tilde p_{(i)} = \max_{j \le i} \min(1, (m-j+1)\, p_{(j)})`.
    The probability of even one false rejection at :math:`\tilde p \le \alpha` is at most
    :math:`\alpha`, for every dependence between the tests.
    """
    sorted_tests = sorted((p, i) for i, p in enumerate(p_values) if p is not None)
    adjusted_p_values: list[float | None] = [None] * len(p_values)
    running_maximum = 0.0
    for rank, (p, i) in enumerate(sorted_tests):
        running_maximum = max(running_maximum, min(1.0, (len(sorted_tests) - rank) * p))
        adjusted_p_values[i] = running_maximum
    return tuple(adjusted_p_values)
