"""Expressions in ``${...}``: Python's arithmetic, comparisons and conditions, and nothing else.

The text is parsed by Python and the tree is walked here; names are properties and parameters,
functions are those of `FUNCTIONS`. Anything else of the language is an error.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable
from typing import Any

from ..errors import UwsimError, did_you_mean

Value = int | float | bool | str
MAX_LENGTH = 4096
"""Longest expression, and longest text it may give [characters]."""
MAX_INTEGER = 2**63
CONSTANTS: dict[str, Value] = {
    "pi": math.pi,
    "M_PI": math.pi,
    "e": math.e,
    "tau": math.tau,
    "inf": math.inf,
    "True": True,
    "False": False,
    "true": True,
    "false": False,
}
FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{name: getattr(math, name) for name in ("sin", "cos", "tan", "asin", "acos", "atan")},
    **{name: getattr(math, name) for name in ("atan2", "sqrt", "exp", "log", "log10", "hypot")},
    **{name: getattr(math, name) for name in ("floor", "ceil", "radians", "degrees", "fabs")},
    **{name: getattr(math, name) for name in ("sinh", "cosh", "tanh", "copysign", "fmod")},
    **{"abs": abs, "min": min, "max": max, "round": round},
    **{"int": int, "float": float, "bool": bool, "str": str, "len": len},
}
BINARY: dict[type[ast.AST], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
}
COMPARE: dict[type[ast.AST], Callable[[Any, Any], Any]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
}
INTEGER = re.compile(r"[+-]?\d{1,18}")
REAL = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?")


class ExpressionError(UwsimError):
    """An expression that cannot be evaluated."""


def literal(text: str) -> Value:
    """Return a text as the number or truth value that it is, or as it is."""
    word = text.strip()
    if INTEGER.fullmatch(word):
        return int(word)
    if REAL.fullmatch(word):
        return float(word)
    if word in ("true", "True", "false", "False"):
        return word in ("true", "True")
    if len(word) >= 2 and word[0] == word[-1] == "'":
        return word[1:-1]
    return text


def written(value: Value) -> str:
    """Return a value as it stands in a file."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(value)


def evaluate(text: str, look_up: Callable[[str], Value]) -> Value:
    """Evaluate an expression.

    Raises:
        ExpressionError: it is none, or has no value.
    """
    if len(text) > MAX_LENGTH:
        raise ExpressionError(f"longer than {MAX_LENGTH} characters")
    try:
        tree = ast.parse(text.strip(), mode="eval")
        return _value(tree.body, look_up)
    except ExpressionError:
        raise
    except SyntaxError as error:
        raise ExpressionError(f"not an expression: {error.msg}") from None
    except (RecursionError, MemoryError):
        raise ExpressionError("nested too deeply") from None
    except (ArithmeticError, TypeError, ValueError) as error:
        raise ExpressionError(str(error)) from None


def _value(node: ast.expr, look_up: Callable[[str], Value]) -> Value:
    """Walk a node; only the kinds below are in the language."""
    match node:
        case ast.Constant(value=bool() | int() | float() | str() as value):
            return _checked(value)
        case ast.Name(id=name):
            return look_up(name)
        case ast.Attribute(value=ast.Name(id="math"), attr=name) if name in CONSTANTS:
            return CONSTANTS[name]
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return not _value(operand, look_up)
        case ast.UnaryOp(op=ast.USub() | ast.UAdd() as sign, operand=operand):
            number = _number(_value(operand, look_up))
            return -number if isinstance(sign, ast.USub) else number
        case ast.BinOp(op=ast.Pow(), left=left, right=right):
            return _power(_number(_value(left, look_up)), _number(_value(right, look_up)))
        case ast.BinOp(op=operation, left=left, right=right) if type(operation) in BINARY:
            return _binary(operation, _value(left, look_up), _value(right, look_up))
        case ast.BoolOp(op=operation, values=parts):
            wanted = isinstance(operation, ast.Or)
            result: Value = not wanted
            for part in parts:
                result = _value(part, look_up)
                if bool(result) is wanted:
                    break
            return result
        case ast.Compare(left=left, ops=operations, comparators=others):
            return _compared(_value(left, look_up), operations, others, look_up)
        case ast.IfExp(test=test, body=body, orelse=other):
            return _value(body if _value(test, look_up) else other, look_up)
        case ast.Call(func=function, args=arguments, keywords=[]):
            return _call(function, [_value(each, look_up) for each in arguments])
    raise ExpressionError(f"{ast.unparse(node)[:60]!r} is not in the language of expressions")


def _compared(
    left: Value,
    operations: list[ast.cmpop],
    others: list[ast.expr],
    look_up: Callable[[str], Value],
) -> bool:
    for operation, other in zip(operations, others, strict=True):
        right = _value(other, look_up)
        if type(operation) not in COMPARE:
            raise ExpressionError("'in' and 'is' are not in the language of expressions")
        if not COMPARE[type(operation)](left, right):
            return False
        left = right
    return True


def _call(function: ast.expr, arguments: list[Value]) -> Value:
    name = function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")
    if isinstance(function, ast.Attribute) and getattr(function.value, "id", "") != "math":
        name = ast.unparse(function)[:60]
    if name not in FUNCTIONS:
        raise ExpressionError(f"no function is called {name!r}.{did_you_mean(name, FUNCTIONS)}")
    return _checked(FUNCTIONS[name](*arguments))


def _binary(operation: ast.operator, left: Value, right: Value) -> Value:
    if isinstance(left, str) or isinstance(right, str):
        if not (
            isinstance(operation, ast.Add) and isinstance(left, str) and isinstance(right, str)
        ):
            raise ExpressionError(f"{left!r} and {right!r}: texts can only be added to texts")
        return _checked(left + right)
    return _checked(BINARY[type(operation)](left, right))


def _power(left: int | float, right: int | float) -> Value:
    if isinstance(left, int) and isinstance(right, int) and 0 <= right <= 64 and abs(left) <= 64:
        return _checked(left**right)
    result = float(left) ** float(right)
    if isinstance(result, complex):
        raise ExpressionError(f"{left}**{right} is no real number")
    return _checked(result)


def _number(value: Value) -> int | float:
    if isinstance(value, str):
        raise ExpressionError(f"{value[:40]!r} is not a number")
    return value


def _checked(value: Any) -> Value:
    """Refuse numbers and texts beyond the limits."""
    if isinstance(value, str) and len(value) > MAX_LENGTH:
        raise ExpressionError(f"a text longer than {MAX_LENGTH} characters")
    if isinstance(value, int) and abs(value) > MAX_INTEGER:
        return float(value)
    if not isinstance(value, bool | int | float | str):
        raise ExpressionError("the result is neither a number nor a text")
    return value
