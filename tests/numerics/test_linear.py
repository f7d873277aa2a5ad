"""The small linear algebra against numpy's, which is right, if not the same everywhere."""

import numpy as np
import pytest

from uwsim.base.numerics.linear import (
    compose,
    cross,
    determinant,
    determinants,
    dot,
    inverse,
    length,
    product,
    pseudo_inverse,
    rank,
    rotate,
    rotate_back,
    singular_values,
    solve,
    transform_points,
)

SHAPES = [
    ((3, 3), (3, 3)),
    ((3, 3), (3,)),
    ((5, 3), (3,)),
    ((3,), (3, 4)),
    ((5, 8, 3), (3, 2)),
    ((5, 8, 3), (3,)),
    ((4, 4), (6, 4, 4)),
    ((6, 1, 3), (6, 3, 3)),
    ((6, 3, 3), (6, 3, 3)),
    ((0, 3), (3, 3)),
    ((2, 0, 3), (3, 3)),
]


def random(*shape: int) -> np.ndarray:
    return np.random.Generator(np.random.Philox(sum(shape))).standard_normal(shape)


@pytest.mark.parametrize(("left", "right"), SHAPES, ids=str)
def test_a_product_is_numpys(left: tuple[int, ...], right: tuple[int, ...]) -> None:
    a, b = random(*left), random(*right)

    np.testing.assert_allclose(product(a, b), a @ b, rtol=1e-13, atol=1e-14)
    assert product(a, b).shape == (a @ b).shape


def test_a_product_of_views_and_lists_is_numpys() -> None:
    a, b = random(4, 3), random(5, 4)

    np.testing.assert_allclose(product(a.T, b.T), a.T @ b.T, rtol=1e-13)
    np.testing.assert_allclose(product(a[::2], [1, 2, 3]), a[::2] @ [1, 2, 3], rtol=1e-13)


def test_matrices_that_do_not_fit_are_not_multiplied() -> None:
    with pytest.raises(ValueError, match=r"\(2, 3\) and \(2, 3\) cannot be multiplied"):
        product(random(2, 3), random(2, 3))


def test_the_quick_ones_are_numpys() -> None:
    rotation, other, vector, points = random(3, 3), random(3, 3).T, random(3), random(7, 3)

    np.testing.assert_allclose(rotate(rotation, vector), rotation @ vector, rtol=1e-13)
    np.testing.assert_allclose(rotate_back(rotation, vector), rotation.T @ vector, rtol=1e-13)
    expected = points @ rotation.T + vector
    np.testing.assert_allclose(transform_points(points, rotation, vector), expected, rtol=1e-13)
    shift, turn = compose(rotation, vector, other, 2.0 * vector)
    np.testing.assert_allclose(turn, rotation @ other, rtol=1e-13)
    np.testing.assert_allclose(shift, rotation @ (2.0 * vector) + vector, rtol=1e-13)
    assert dot(vector, points[0]) == pytest.approx(vector @ points[0])
    assert length(vector) == pytest.approx(np.linalg.norm(vector))


@pytest.mark.parametrize("n", [1, 2, 3, 6, 20])
def test_solutions_and_inverses_are_numpys(n: int) -> None:
    matrix, right = random(n, n), random(n, n + 1)

    np.testing.assert_allclose(
        solve(matrix, right), np.linalg.solve(matrix, right), rtol=1e-10, atol=1e-14
    )
    np.testing.assert_allclose(
        solve(matrix, right[:, 0]), np.linalg.solve(matrix, right[:, 0]), rtol=1e-10
    )
    np.testing.assert_allclose(inverse(matrix), np.linalg.inv(matrix), rtol=1e-9, atol=1e-12)


def test_a_stack_is_inverted_one_by_one() -> None:
    matrices = random(5, 4, 4)

    np.testing.assert_allclose(inverse(matrices), np.linalg.inv(matrices), rtol=1e-10)
    np.testing.assert_allclose(
        determinants(matrices[:, :3, :3]), np.linalg.det(matrices[:, :3, :3]), rtol=1e-12
    )
    assert determinant(matrices[0, :3, :3]) == pytest.approx(np.linalg.det(matrices[0, :3, :3]))
    assert inverse(np.zeros((0, 3, 3))).shape == (0, 3, 3)


def test_solving_changes_nothing_it_is_given() -> None:
    matrix, right = random(3, 3), random(3)
    before = matrix.copy(), right.copy()

    solve(matrix, right)

    np.testing.assert_array_equal(matrix, before[0])
    np.testing.assert_array_equal(right, before[1])


def test_a_singular_matrix_has_no_solution() -> None:
    with pytest.raises(np.linalg.LinAlgError, match="Singular"):
        solve(np.array([[1.0, 2.0], [2.0, 4.0]]), np.ones(2))


@pytest.mark.parametrize("shape", [(4, 5), (5, 4), (6, 6), (6, 1), (3, 0)], ids=str)
def test_pseudo_inverses_and_singular_values_are_numpys(shape: tuple[int, int]) -> None:
    matrix = random(*shape)

    np.testing.assert_allclose(
        pseudo_inverse(matrix, rcond=1e-6), np.linalg.pinv(matrix, rcond=1e-6), atol=1e-12
    )
    expected = np.linalg.svd(matrix, compute_uv=False)
    np.testing.assert_allclose(singular_values(matrix), expected, rtol=1e-12)


def test_what_hardly_moves_counts_as_zero_in_a_pseudo_inverse() -> None:
    matrix = random(4, 2) @ random(2, 6)  # of rank 2

    np.testing.assert_allclose(
        pseudo_inverse(matrix, rcond=1e-6), np.linalg.pinv(matrix, rcond=1e-6), atol=1e-10
    )
    assert rank(matrix) == np.linalg.matrix_rank(matrix) == 2
    assert rank(random(4, 6)) == 4


def test_a_vector_product_has_numpys_bytes() -> None:
    for left, right in zip(random(20, 3), random(3, 20).T, strict=True):
        assert cross(left, right).tobytes() == np.cross(left, right).tobytes()
