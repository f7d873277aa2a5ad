"""The programs of expressions in compiled code, held against the expressions."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from uwsim.base.expression import FUNCTIONS, OPERATORS, parse
from uwsim.benchmark.environment.program import CODES, MAX_STACK, compile_program, run_rows

TEXTS = (
    "a + 2*b", "a > b ? a : -b", "1/b > 0 ? a : 1/b", "if(a, 1/a, 0)", "max(1, 0/a)", "1 || 1/a",
    "avg(a, b, 1)", "max(a, b, 1)", "min(a, b) - sum(a, b, a)", "+a - _pi", "2^3^a",
    *(f"a {operator} b" for operator in OPERATORS),
    *(f"{name}({'a, b, 1'[: 3 * (n or 3) - 2]})" for name, (n, _) in FUNCTIONS.items()),
)  # fmt: skip


@pytest.mark.parametrize("text", TEXTS)
def test_a_program_is_its_expression(text: str) -> None:
    expression = parse(text, ["a", "b"])
    numbers = [0.0, 1.5, -2.0, 3.25, 1.0, -0.75, 0.3, 800.0]
    rows = np.array(list(itertools.product(numbers, numbers)))
    values = [expression.evaluate({"a": a, "b": b}) for a, b in rows]
    expected = [np.nan if value is None else value for value in values]
    np.testing.assert_array_equal(run_rows(compile_program(expression, ["a", "b"]), rows), expected)


def test_a_name_without_a_value_is_ignored_where_it_is_not_chosen() -> None:
    program = compile_program(parse("a > 0 ? b : 2", ["a", "b"]), ["a", "b"])
    rows = np.array([[1.0, np.nan], [-1.0, np.nan], [np.nan, 1.0]])
    np.testing.assert_array_equal(run_rows(program, rows), [np.nan, 2.0, np.nan])


def test_each_function_has_a_code_of_its_own() -> None:
    assert len(set(CODES.values())) == len(CODES)


def test_an_expression_of_too_many_numbers_at_once_is_refused() -> None:
    text = "(1+" * MAX_STACK + "1" + ")" * MAX_STACK
    with pytest.raises(ValueError, match="numbers at once"):
        compile_program(parse(text, []), [])
