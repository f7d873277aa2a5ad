"""Intervals, triangles and weak combinations, against linear problems whose answer is known."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.identification.least_squares import ReducedProblem
from uwsim.identification.parameters import Parameter
from uwsim.identification.triangles import compute_triangles
from uwsim.identification.uncertainty import compute_uncertainty, simplify_basis


def parameters(n: int) -> list[Parameter]:
    return [
        Parameter(
            name=f"added_mass[{i}]", group="added_mass", key=str(i), unit="kg", first_guess=1.0,
            minimum=-100.0, maximum=100.0, plausible_error=1.0,
        )
        for i in range(n)
    ]  # fmt: skip


@pytest.mark.parametrize("shape", [(40, 7), (7, 7), (4, 7)])
def test_a_triangle_has_the_products_of_its_matrix(shape: tuple[int, int]) -> None:
    matrix = np.random.default_rng(1).normal(size=(3, *shape))
    triangles = compute_triangles(matrix)
    assert not np.tril(triangles, -1).any()
    expected = np.einsum("kij,kil->kjl", matrix, matrix)
    found = np.einsum("kij,kil->kjl", triangles, triangles)
    np.testing.assert_allclose(found, expected, atol=1e-12)


def solve(matrices: np.ndarray, rows: np.ndarray) -> tuple[np.ndarray, ReducedProblem]:
    """Fit truth 1, 1, ... with residuals rows - matrices x; return values and the problem."""
    p = matrices.shape[2]
    stacked = np.concatenate([matrices.reshape(-1, p), np.eye(p)])
    target = np.concatenate([rows.ravel(), np.ones(p)])
    values = np.linalg.lstsq(stacked, target, rcond=None)[0]
    residuals = rows - np.einsum("wij,j->wi", matrices, values)
    triangles = compute_triangles(np.concatenate([-matrices, residuals[:, :, None]], axis=2))
    problem = ReducedProblem(
        triangles=triangles[:, :, :p],
        targets=triangles[:, :, p],
        offset_rows=np.zeros((len(matrices), 12, 12 + p + 1)),
    )
    return values, problem


def coverage(*, correlation: float, n: int = 300) -> float:
    """Return the share of intervals that cover the truth, of 3 coefficients and 20 windows.

    The residuals of a window have a common part, with a share of ``correlation`` of the variance.
    """
    generator = np.random.default_rng(7)
    matrices = 20.0 * generator.normal(size=(20, 30, 3)) + 20.0
    hits = []
    for _ in range(n):
        noise = np.sqrt(1.0 - correlation) * generator.normal(size=(20, 30))
        noise += np.sqrt(correlation) * generator.normal(size=(20, 1))
        values, problem = solve(matrices, matrices.sum(axis=2) + noise)
        estimates = compute_uncertainty(problem, parameters(3), values).estimates
        hits += [estimate.low <= 1.0 <= estimate.high for estimate in estimates]
    return float(np.mean(hits))


def test_intervals_of_white_noise_cover_the_truth() -> None:
    assert coverage(correlation=0.0) >= 0.94


def test_intervals_of_residuals_that_are_correlated_in_windows_cover_the_truth() -> None:
    assert coverage(correlation=0.5) >= 0.92


def test_a_coefficient_that_changes_nothing_is_named() -> None:
    matrices = np.random.default_rng(1).normal(size=(6, 30, 3)) * 50.0
    matrices[:, :, 1] = 0.0
    values, problem = solve(matrices, matrices.sum(axis=2))
    result = compute_uncertainty(problem, parameters(3), values)
    assert [estimate.is_determined for estimate in result.estimates] == [True, False, True]
    (direction,) = result.weak_directions
    assert direction.names == ("added_mass[1]",)
    assert "say nothing about it" in direction.describe()


def test_two_coefficients_that_act_as_a_sum_are_named_together() -> None:
    matrices = np.random.default_rng(1).normal(size=(6, 30, 3)) * 50.0
    matrices[:, :, 1] = matrices[:, :, 0]
    values, problem = solve(matrices, matrices.sum(axis=2))
    (direction,) = compute_uncertainty(problem, parameters(3), values).weak_directions
    assert set(direction.names) == {"added_mass[0]", "added_mass[1]"}
    assert "only a combination" in direction.describe()


def test_a_basis_is_simplified_to_vectors_with_many_zeros() -> None:
    sparse = np.array([[1.0, -1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 1.0, 1.0]])
    mixing = np.array([[0.6, 0.8], [-0.8, 0.6]])
    basis = simplify_basis(mixing @ sparse)
    found = {tuple(np.abs(vector).round(9).tolist()) for vector in basis}
    assert found == {(1.0, 1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 1.0, 1.0, 1.0)}
