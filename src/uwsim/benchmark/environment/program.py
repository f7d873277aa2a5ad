"""An expression (`uwsim.base.expression`) as a program for compiled code, of a stack of numbers.

A step puts a number on the stack, or replaces the topmost numbers by a function of them. A result
that is not finite is NaN from then on, and a function of NaN is NaN, except in the branch of
``? :`` that is not chosen: so the program has a number exactly if the expression has one.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ...base.expression import FUNCTIONS, OPERATORS, Expression
from ...base.numerics.jit import njit, njit_borrowed
from ...base.numerics.memory import Floats, Ints64

MAX_STACK = 64
"""The size of the stack for which callers have memory; a longer program is refused."""

_CONSTANT, _NAME = 0, 1
(
    _DISJUNCTION, _CONJUNCTION, _LESS_CODE, _LESS_EQUAL_CODE, _GREATER_CODE, _GREATER_EQUAL_CODE,
    _EQUAL_CODE, _NOT_EQUAL_CODE, _ADD, _SUBTRACT, _MULTIPLY, _DIVIDE, _POWER, _ABS, _ACOS, _ACOSH,
    _ASIN, _ASINH, _ATAN, _ATAN2, _ATANH, _MEAN, _COS, _COSH, _EXP, _CHOOSE, _LN, _LOG10, _LOG2,
    _MAX, _MIN, _RINT, _SIGN, _SIN, _SINH, _SQRT, _SUM, _TAN, _TANH, _NEGATIVE, _POSITIVE,
) = range(2, 43)  # fmt: skip
CODES: dict[Any, int] = {
    np.negative: _NEGATIVE,
    np.positive: _POSITIVE,
    **dict(zip(OPERATORS.values(), range(_DISJUNCTION, _ABS), strict=True)),
    **{
        FUNCTIONS[name][1]: code
        for name, code in zip(
            (name for name in FUNCTIONS if name != "log"), range(_ABS, _NEGATIVE), strict=True
        )
    },
}
"""The code of each function of an expression; ``log`` is the function ``log10``."""


class Program(NamedTuple):
    """An expression in postfix order."""

    codes: Ints64
    """The code of each step, and its number of operands or the index of its name, (s, 2)."""
    constants: Floats
    """The constant of each step, (s,)."""


def compile_program(expression: Expression, names: Sequence[str]) -> Program:
    """Compile an expression of numbers with these names.

    Raises:
        ValueError: the expression needs more than `MAX_STACK` numbers at once.
    """
    codes, constants, depth = [], [], 0
    for step in expression.steps:
        depth += 1 - step.n_operands
        if depth > MAX_STACK:
            raise ValueError(f"more than {MAX_STACK} numbers at once")
        constants.append(0.0 if step.constant is None else step.constant)
        if step.function is not None:
            codes.append((CODES[step.function], step.n_operands))
        else:
            is_name = step.constant is None
            codes.append((_NAME, names.index(step.name)) if is_name else (_CONSTANT, 0))
    return Program(np.array(codes, dtype=np.int64), np.array(constants))


@njit_borrowed
def run(program: Program, values: Floats, stack: Floats) -> float:
    """Return the value of a program; NaN if it has none.

    Args:
        program: the program.
        values: the numbers of the names; NaN for one without a value.
        stack: scratch memory, (`MAX_STACK`,).
    """
    n = 0
    for i in range(len(program.codes)):
        code, k = program.codes[i, 0], program.codes[i, 1]
        if code == _CONSTANT:
            result, k = program.constants[i], 0
        elif code == _NAME:
            result, k = values[k], 0
        else:
            result = _apply(code, stack[n - k : n])
        n += 1 - k
        stack[n - 1] = result if math.isfinite(result) else math.nan
    value: float = stack[0]
    return value


@njit
def run_rows(program: Program, values: Floats) -> Floats:
    """Return the values of a program for rows of numbers (n, names), (n,); NaN without one."""
    results, stack = np.empty(len(values)), np.empty(MAX_STACK)
    for row in range(len(values)):
        results[row] = run(program, values[row], stack)
    return results


@njit_borrowed
def _apply(code: int, operands: Floats) -> float:
    """Return a function of operands; NaN if one of those that it needs is NaN."""
    a: float = operands[0]
    if code == _CHOOSE and a == a:
        branch: float = operands[1] if a != 0.0 else operands[2]
        return branch
    for value in operands:
        if value != value:
            return math.nan
    if len(operands) == 1:
        return _apply_one(code, a)
    if len(operands) == 2 and code < _ABS:
        return _apply_two(code, a, operands[1])
    if code == _ATAN2:
        return math.atan2(a, operands[1])
    for k in range(1, len(operands)):
        value = operands[k]
        if code == _MAX:
            a = max(a, value)
        elif code == _MIN:
            a = min(a, value)
        else:
            a += value
    return a / len(operands) if code == _MEAN else a


@njit_borrowed
def _apply_two(code: int, a: float, b: float) -> float:
    """Return the result of a binary operator."""
    if code == _ADD:
        return a + b
    if code == _SUBTRACT:
        return a - b
    if code == _MULTIPLY:
        return a * b
    if code == _DIVIDE:
        return a / b
    if code == _POWER:
        return math.pow(a, b)
    is_true = a != 0.0 or b != 0.0
    if code == _CONJUNCTION:
        is_true = a != 0.0 and b != 0.0
    elif code == _LESS_CODE:
        is_true = a < b
    elif code == _LESS_EQUAL_CODE:
        is_true = a <= b
    elif code == _GREATER_CODE:
        is_true = a > b
    elif code == _GREATER_EQUAL_CODE:
        is_true = a >= b
    elif code == _EQUAL_CODE:
        is_true = a == b
    elif code == _NOT_EQUAL_CODE:
        is_true = a != b
    return 1.0 if is_true else 0.0


@njit_borrowed
def _apply_one(code: int, a: float) -> float:
    """Return the result of a sign or of a function of one number."""
    if code == _NEGATIVE:
        return -a
    if code == _ABS:
        return abs(a)
    if code == _EXP:
        return math.exp(a)
    if code == _SQRT:
        return math.sqrt(a) if a >= 0.0 else math.nan
    if code == _SIGN:
        return float((a > 0.0) - (a < 0.0))
    if code == _RINT:
        return math.floor(a + 0.5)
    if code == _LN:
        return math.log(a)
    if code == _LOG10:
        return math.log10(a)
    if code == _LOG2:
        return math.log2(a)
    if code in (_COSH, _SINH, _TANH, _ACOSH, _ASINH, _ATANH):
        return _apply_hyperbolic(code, a)
    return _apply_angle(code, a)


@njit_borrowed
def _apply_angle(code: int, a: float) -> float:
    """Return a trigonometric function, or its inverse; else the number."""
    if code == _SIN:
        return math.sin(a)
    if code == _COS:
        return math.cos(a)
    if code == _TAN:
        return math.tan(a)
    if code == _ASIN:
        return math.asin(a)
    if code == _ACOS:
        return math.acos(a)
    if code == _ATAN:
        return math.atan(a)
    return a


@njit_borrowed
def _apply_hyperbolic(code: int, a: float) -> float:
    """Return a hyperbolic function, or its inverse."""
    if code == _SINH:
        return math.sinh(a)
    if code == _COSH:
        return math.cosh(a)
    if code == _TANH:
        return math.tanh(a)
    if code == _ASINH:
        return math.asinh(a)
    if code == _ACOSH:
        return math.acosh(a)
    return math.atanh(a)
