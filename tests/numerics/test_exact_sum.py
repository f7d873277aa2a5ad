"""The compiled exact sum against `math.fsum`."""

from __future__ import annotations

import math

import numpy as np

from uwsim.base.numerics.exact_sum import exact_sum


def test_it_is_the_sum_of_the_standard_library() -> None:
    """With cancellation over 200 binary digits, and rounding of halves."""
    rng = np.random.default_rng(5)
    for n in (0, 1, 2, 3, 8, 40):
        for _ in range(200):
            values = rng.standard_normal(n) * 2.0 ** rng.integers(-100, 100, n)
            values = np.concatenate([values, -values[: n // 2] * (1.0 + 2.0**-52)])
            rng.shuffle(values)
            assert exact_sum(values) == math.fsum(values.tolist())


def test_half_of_a_last_digit_is_rounded_by_what_is_beyond() -> None:
    for tiny in (2.0**-120, -(2.0**-120), 0.0):
        for values in ([1.0, 2.0**-53, tiny], [1.0 + 2.0**-52, 2.0**-53, tiny], [1e16, 1.0, tiny]):
            assert exact_sum(np.array(values)) == math.fsum(values)
