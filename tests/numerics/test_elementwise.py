"""Functions of arrays against numpy's, which are right, if not the same everywhere."""

import numpy as np
import pytest

from uwsim.base.numerics import elementwise

ONE = [
    name
    for name, value in vars(elementwise).items()
    if getattr(value, "__module__", "") == elementwise.__name__ and name not in ("arctan2", "power")
]
POINTS = np.array([-800.0, -3.0, -1.0, -0.3, -0.0, 0.0, 0.3, 1.0, 2.0, 800.0, np.inf, np.nan])


def test_every_function_is_held_against_numpy() -> None:
    assert len(ONE) == 14


@pytest.mark.parametrize("name", ONE)
def test_a_function_is_numpys_where_it_is_defined_and_beyond(name: str) -> None:
    with np.errstate(all="ignore"):
        found, expected = getattr(elementwise, name)(POINTS), getattr(np, name)(POINTS)

    np.testing.assert_allclose(found, expected, rtol=1e-15 * 4)


@pytest.mark.parametrize("name", ["arctan2", "power"])
def test_a_function_of_two_is_numpys(name: str) -> None:
    x, y = np.meshgrid(POINTS, POINTS)
    with np.errstate(all="ignore"):
        found, expected = getattr(elementwise, name)(x, y), getattr(np, name)(x, y)

    np.testing.assert_allclose(found, expected, rtol=1e-15 * 4)
