"""The solution of banded equations against numpy's."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.forces.chain.banded import solve_banded


@pytest.mark.parametrize(("n", "width"), [(1, 1), (7, 3), (30, 6), (30, 9)])
def test_the_solution_is_that_of_the_full_matrix(n: int, width: int) -> None:
    random = np.random.Generator(np.random.Philox(n))
    band = random.normal(size=(n, width))
    band[:, 0] = 20.0 + random.random(n)
    full = np.zeros((n, n))
    for j in range(n):
        for k in range(min(width, n - j)):
            full[j + k, j] = full[j, j + k] = band[j, k]
    right = random.normal(size=n)
    solution = right.copy()
    solve_banded(band, solution)
    assert solution == pytest.approx(np.linalg.solve(full, right), rel=1e-12)
