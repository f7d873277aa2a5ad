"""Expressions in ``${...}``: Python's arithmetic, comparisons, conditions, lists and dictionaries.

Python parses the text, and this module evaluates the syntax tree. Names are properties and
parameters; functions and methods are those in `functions`. All other syntax is an error.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from ...errors import did_you_mean
from .functions import FUNCTIONS, format_pattern, method, repeat
from .value import MAX_LENGTH, DistinctItems, ExpressionError, Value, check_value, to_text

Functions = Mapping[str, Callable[..., Any]]
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
    "None": None,
}
BINARY_OPERATORS: dict[type[ast.AST], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.BitOr: operator.or_,
    ast.BitAnd: operator.and_,
}
SET_OPERATIONS = ast.Sub | ast.BitOr | ast.BitAnd
"""The operators between sets."""
COMPARISON_OPERATORS: dict[type[ast.AST], Callable[[Any, Any], Any]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.In: lambda item, container: item in container,
    ast.NotIn: lambda item, container: item not in container,
}
SINGLETONS = (None, True, False)
"""The values that can be compared with ``is``."""
TYPES: dict[str, type] = {
    **{kind.__name__: kind for kind in (int, float, bool, str, list, dict)},
    "tuple": list,
    "set": DistinctItems,
}
"""The types of values for ``isinstance``; a tuple is a list here."""
MAX_ITERATIONS = 2000
"""The greatest number of iterations of all loops of an expression."""
MODULES = ("math", "xacro", "python")
"""The names of modules before a dot, which are not properties."""
INTEGER = re.compile(r"[+-]?\d{1,18}")
REAL_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?")


def parse_literal(text: str) -> Value:
    """Convert a text that is a number, truth value or quoted text; return other texts unchanged."""
    word = text.strip()
    if INTEGER.fullmatch(word):
        return int(word)
    if REAL_NUMBER.fullmatch(word):
        return float(word)
    if word in ("true", "True", "false", "False"):
        return word in ("true", "True")
    if len(word) >= 2 and word[0] == word[-1] == "'":
        return word[1:-1]
    return text


def evaluate(text: str, resolve: Callable[[str], Value], functions: Functions = FUNCTIONS) -> Value:
    """Evaluate an expression.

    Args:
        text: the expression.
        resolve: the function that returns the value of a name or raises ExpressionError.
        functions: the functions that the expression may call, by name.

    Raises:
        ExpressionError: the text is not a valid expression, or has no value.
    """
    if len(text) > MAX_LENGTH:
        raise ExpressionError(f"longer than {MAX_LENGTH} characters")
    try:
        tree = ast.parse(text.strip(), mode="eval")
        return Evaluation(resolve, functions).value(tree.body)
    except ExpressionError:
        raise
    except SyntaxError as error:
        raise ExpressionError(f"not an expression: {error.msg}") from None
    except (RecursionError, MemoryError):
        raise ExpressionError("nested too deeply") from None
    except KeyError as error:
        raise ExpressionError(f"the dictionary has no {str(error)[:60]}") from None
    except (ArithmeticError, TypeError, ValueError, IndexError) as error:
        raise ExpressionError(str(error)[:200]) from None


class Evaluation:
    """The evaluation of an expression's syntax tree; other kinds of nodes are errors.

    Args:
        resolve: the function that returns the value of a name.
        functions: the functions that the expression may call, by name.
        n_iterations: the number of iterations so far, in a list that nested loops share.
    """

    def __init__(
        self,
        resolve: Callable[[str], Value],
        functions: Functions,
        n_iterations: list[int] | None = None,
    ) -> None:
        self._resolve, self._functions = resolve, functions
        self._n_iterations = [0] if n_iterations is None else n_iterations

    def value(self, node: ast.expr) -> Value:
        """Return the value of a node; raises ExpressionError."""
        match node:
            case ast.Constant(value=bool() | int() | float() | str() | None as value):
                return check_value(value)
            case ast.Name(id=name):
                return self._resolve(name)
            case ast.List(elts=items) | ast.Tuple(elts=items):
                return check_value([self.value(item) for item in items])
            case ast.Subscript(value=container, slice=ast.Slice() as part):
                return self._slice(self.value(container), part)
            case ast.Subscript(value=container, slice=key):
                return _item(self.value(container), self.value(key))
            case ast.Attribute(value=ast.Name(id="math"), attr=name) if name in CONSTANTS:
                return CONSTANTS[name]
            case ast.Attribute(value=container, attr=name):
                return _attribute(self.value(container), name)
            case ast.Call(func=ast.Name(id="map"), args=[ast.Name(id=name), items]):
                function = self._function(name)
                return check_value([check_value(function(item)) for item in self._items(items)])
            case ast.Call(func=function, args=[item, kinds]) if _is_isinstance(function):
                return _has_type(self.value(item), _types(kinds))
            case ast.Call():
                return self._call(node)
            case (
                ast.ListComp(elt=item, generators=loops)
                | ast.GeneratorExp(elt=item, generators=loops)
            ):
                return check_value(list(self._comprehend(item, loops)))
            case ast.IfExp(test=test, body=body, orelse=other):
                return self.value(body if self.value(test) else other)
            case ast.BoolOp(op=operation, values=parts):
                return self._any_or_all(parts, is_any=isinstance(operation, ast.Or))
            case ast.Compare(left=left, ops=operations, comparators=operands):
                return self._compare(self.value(left), operations, operands)
        return self._arithmetic(node)

    def _slice(self, container: Value, part: ast.Slice) -> Value:
        if not isinstance(container, list | str):
            raise ExpressionError(f"{to_text(container)[:40]} is neither a list nor a text")
        bounds: list[Any] = [
            None if bound is None else self.value(bound)
            for bound in (part.lower, part.upper, part.step)
        ]
        return check_value(container[slice(*bounds)])

    def _items(self, node: ast.expr) -> list[Any]:
        """Return the items over which a loop iterates: list items, keys, or characters."""
        container = self.value(node)
        if not isinstance(container, list | dict | str):
            raise ExpressionError(f"{to_text(container)[:40]} is neither a list nor a dictionary")
        self._count_iterations(len(container))
        return list(container)

    def _count_iterations(self, n: int) -> None:
        self._n_iterations[0] += n
        if self._n_iterations[0] > MAX_ITERATIONS:
            raise ExpressionError(f"loops of more than {MAX_ITERATIONS} iterations")

    def _comprehend(self, item: ast.expr, loops: Sequence[ast.comprehension]) -> Iterator[Value]:
        if not loops:
            value = self.value(item)
            self._count_iterations(len(value) if isinstance(value, list | dict) else 0)
            yield value
            return
        for entry in self._items(loops[0].iter):
            names = _unpack(loops[0].target, entry)

            def look_up(name: str, names: dict[str, Value] = names) -> Value:
                return names[name] if name in names else self._resolve(name)

            evaluation = Evaluation(look_up, self._functions, self._n_iterations)
            if all(evaluation.value(condition) for condition in loops[0].ifs):
                yield from evaluation._comprehend(item, loops[1:])

    def _function(self, name: str) -> Callable[..., Any]:
        if name not in self._functions:
            raise self._no_function(name)
        return self._functions[name]

    def _no_function(self, name: str) -> ExpressionError:
        near = did_you_mean(name, self._functions)
        return ExpressionError(f"no function is called {name[:60]!r}.{near}")

    def _arithmetic(self, node: ast.expr) -> Value:
        match node:
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return not self.value(operand)
            case ast.UnaryOp(op=ast.USub() | ast.UAdd() as sign, operand=operand):
                number = _number(self.value(operand))
                return -number if isinstance(sign, ast.USub) else number
            case ast.BinOp(op=ast.Pow(), left=left, right=right):
                return check_value(FUNCTIONS["pow"](self.value(left), self.value(right)))
            case ast.BinOp(op=operation, left=left, right=right) if (
                type(operation) in BINARY_OPERATORS
            ):
                return _binary(operation, self.value(left), self.value(right))
        raise ExpressionError(f"{ast.unparse(node)[:60]!r} is not supported in expressions")

    def _any_or_all(self, parts: Sequence[ast.expr], *, is_any: bool) -> Value:
        result: Value = not is_any
        for part in parts:
            result = self.value(part)
            if bool(result) is is_any:
                break
        return result

    def _compare(
        self, left: Value, operations: Sequence[ast.cmpop], operands: Sequence[ast.expr]
    ) -> bool:
        for operation, other in zip(operations, operands, strict=True):
            right = self.value(other)
            if isinstance(operation, ast.Is | ast.IsNot):
                is_true = _is_same(left, right) is isinstance(operation, ast.Is)
            else:
                is_true = bool(COMPARISON_OPERATORS[type(operation)](left, right))
            if not is_true:
                return False
            left = right
        return True

    def _call(self, node: ast.Call) -> Value:
        arguments = [self.value(argument) for argument in node.args]
        pairs = ((argument.arg, argument.value) for argument in node.keywords)
        keywords = {name: self.value(value) for name, value in pairs if name is not None}
        if len(keywords) < len(node.keywords):
            raise ExpressionError(f"{ast.unparse(node)[:60]!r}: ** is not supported")
        name = ast.unparse(node.func).removeprefix("math.").removeprefix("python.")
        if name in self._functions:
            if keywords and name not in ("dict", "xacro.tokenize"):
                raise ExpressionError(f"{name}() accepts no named values")
            return check_value(self._functions[name](*arguments, **keywords))
        if isinstance(node.func, ast.Attribute) and not keywords:
            function = None
            if not (isinstance(node.func.value, ast.Name) and node.func.value.id in MODULES):
                function = method(self.value(node.func.value), node.func.attr)
            if function is not None:
                return check_value(function(*arguments))
        raise self._no_function(name)


def _is_same(left: Value, right: Value) -> bool:
    """Compare with ``is``, one side of which must be None, True or False."""
    if not any(operand is singleton for operand in (left, right) for singleton in SINGLETONS):
        raise ExpressionError("'is' compares only with None, True and False; write ==")
    return left is right


def _has_type(value: Value, types: tuple[type, ...]) -> bool:
    """Return whether a value has one of the types; a set does not count as a list."""
    return DistinctItems in types if isinstance(value, DistinctItems) else isinstance(value, types)


def _is_isinstance(function: ast.expr) -> bool:
    return ast.unparse(function) in ("isinstance", "python.isinstance")


def _types(node: ast.expr) -> tuple[type, ...]:
    """Return the types in a call of ``isinstance``: one, or several in parentheses."""
    elements = node.elts if isinstance(node, ast.Tuple) else [node]
    names = [ast.unparse(element) for element in elements]
    names = [name.removeprefix("python.") for name in names]
    if unknown_names := [name for name in names if name not in TYPES]:
        raise ExpressionError(f"{unknown_names[0][:40]!r} is no kind of value, such as int or str")
    return tuple(TYPES[name] for name in names)


def _unpack(target: ast.expr, value: Value) -> dict[str, Value]:
    """Return the loop variables with their values: ``x``, or ``x, y`` for an item of two."""
    if isinstance(target, ast.Name):
        return {target.id: value}
    if isinstance(target, ast.Tuple | ast.List) and isinstance(value, list):
        if len(target.elts) != len(value):
            raise ExpressionError(f"{len(target.elts)} names for {len(value)} values")
        pairs = zip(target.elts, value, strict=True)
        return dict(entry for part, item in pairs for entry in _unpack(part, item).items())
    raise ExpressionError(f"{ast.unparse(target)[:40]!r} cannot be the name of an item")


def _item(container: Value, key: Value) -> Value:
    """Return a list item by index, a dictionary entry by key, or a character of a text."""
    if isinstance(container, dict):
        return check_value(container[key])
    if not isinstance(container, list | str):
        raise ExpressionError(f"{to_text(container)[:40]} is neither a list nor a dictionary")
    if not isinstance(key, int):
        raise ExpressionError(f"{to_text(key)[:40]!r} is no number of an item")
    if not -len(container) <= key < len(container):
        raise ExpressionError(f"there is no item {key}: the list has {len(container)}")
    return container[key]


def _attribute(container: Value, name: str) -> Value:
    if not isinstance(container, dict):
        raise ExpressionError(f"{to_text(container)[:40]} has no entry {name[:40]!r}")
    if name not in container:
        raise ExpressionError(
            f"the dictionary has no {name[:60]!r}.{did_you_mean(name, map(str, container))}"
        )
    return check_value(container[name])


def _binary(operation: ast.operator, left: Value, right: Value) -> Value:
    if isinstance(operation, ast.Mod) and isinstance(left, str):
        return check_value(format_pattern(left, right))
    if DistinctItems in (type(left), type(right)):
        if type(left) is not type(right) or not isinstance(operation, SET_OPERATIONS):
            raise ExpressionError(f"{left!r} and {right!r}: sets have - & | with sets"[:200])
        return check_value(BINARY_OPERATORS[type(operation)](left, right))
    is_whole = [isinstance(operand, str | list) for operand in (left, right)]
    if isinstance(operation, ast.Mult) and is_whole.count(True) == 1:
        return check_value(repeat(left, right))
    kinds = {type(operand) for operand in (left, right) if isinstance(operand, str | list)}
    if kinds and not (isinstance(operation, ast.Add) and type(left) is type(right)):
        plural = "lists" if kinds == {list} else "texts"
        message = f"{left!r} and {right!r}: {plural} can only be added to {plural}"
        raise ExpressionError(message[:200])
    return check_value(BINARY_OPERATORS[type(operation)](left, right))


def _number(value: Value) -> int | float:
    if not isinstance(value, int | float):
        raise ExpressionError(f"{to_text(value)[:40]!r} is not a number")
    return value
