"""Holm's correction for multiple tests."""

from __future__ import annotations

from collections.abc import Sequence


def holm(p_values: Sequence[float | None]) -> tuple[float | None, ...]:
    r"""Return the p-values adjusted by Holm (1979); None, no test, stays None and counts for none.

    With m tests ordered by p, :math:`\tilde p_{(i)} = \max_{j \le i} \min(1, (m-j+1)\, p_{(j)})`.
    Of all that are called different at :math:`\tilde p \le \alpha`, the chance that even one is not
    is at most :math:`\alpha`, however the tests depend on each other.
    """
    tested = sorted((p, i) for i, p in enumerate(p_values) if p is not None)
    adjusted: list[float | None] = [None] * len(p_values)
    largest = 0.0
    for place, (p, i) in enumerate(tested):
        largest = max(largest, min(1.0, (len(tested) - place) * p))
        adjusted[i] = largest
    return tuple(adjusted)
