"""The evaluation of an expression (`uwsim.base.expression`) for rows of numbers at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import reduce
from typing import Any

import numpy as np

from ...base.expression import FUNCTIONS, OPERATORS, Expression
from ...base.geometry import Array


def _add(*values: Array) -> Array:
    return reduce(np.add, values)


ROW_FUNCTIONS: dict[Any, Callable[..., Any]] = {
    OPERATORS["||"]: lambda a, b: (a != 0.0) | (b != 0.0),
    OPERATORS["&&"]: lambda a, b: (a != 0.0) & (b != 0.0),
    FUNCTIONS["if"][1]: lambda condition, a, b: np.where(condition != 0.0, a, b),
    FUNCTIONS["max"][1]: lambda *values: reduce(np.maximum, values),
    FUNCTIONS["min"][1]: lambda *values: reduce(np.minimum, values),
    FUNCTIONS["sum"][1]: _add,
    FUNCTIONS["avg"][1]: lambda *values: _add(*values) / len(values),
    FUNCTIONS["rint"][1]: lambda value: np.floor(value + 0.5),
}
"""The function for rows in place of each function that takes single numbers only."""


def evaluate_rows(expression: Expression, values: Mapping[str, Array], n: int) -> Array:
    """Return the values of an expression, (n,); 0 where one is not finite.

    Args:
        expression: the expression.
        values: the numbers of each name, (n,) each.
        n: the number of rows.
    """
    stack: list[Array] = []
    with np.errstate(all="ignore"):
        for step in expression.steps:
            operands = stack[len(stack) - step.n_operands :]
            del stack[len(stack) - step.n_operands :]
            if step.function is not None:
                function = ROW_FUNCTIONS.get(step.function, step.function)
                stack.append(np.asarray(function(*operands), dtype=np.float64))
            elif step.constant is not None:
                stack.append(np.full(n, step.constant))
            else:
                stack.append(np.broadcast_to(values[step.name], (n,)))
    [result] = stack
    finite_values: Array = np.where(np.isfinite(result), result, 0.0)
    return finite_values
