"""Expressions in ``${...}``: Python's arithmetic, comparisons, conditions, lists and dictionaries.

The text is parsed by Python and the tree is walked here; names are properties and parameters,
functions and methods are those of `functions`. Anything else of the language is an error.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from ...errors import did_you_mean
from .functions import FUNCTIONS, formatted, method, repeated
from .value import MAX_LENGTH, DistinctItems, ExpressionError, Value, checked, written

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
BINARY: dict[type[ast.AST], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.BitOr: operator.or_,
    ast.BitAnd: operator.and_,
}
ON_SETS = ast.Sub | ast.BitOr | ast.BitAnd
"""Operations between sets."""
COMPARE: dict[type[ast.AST], Callable[[Any, Any], Any]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.In: lambda item, whole: item in whole,
    ast.NotIn: lambda item, whole: item not in whole,
}
SINGLE = (None, True, False)
"""Values that may be compared with ``is``: there is one of each."""
KINDS: dict[str, type] = {
    **{kind.__name__: kind for kind in (int, float, bool, str, list, dict)},
    "tuple": list,
    "set": DistinctItems,
}
"""Kinds of values for ``isinstance``; a tuple is a list here."""
MAX_TURNS = 2000
"""Most turns of all loops of an expression."""
MODULES = ("math", "xacro", "python")
"""Names before a dot that are no property."""
INTEGER = re.compile(r"[+-]?\d{1,18}")
REAL = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?")


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


def evaluate(text: str, look_up: Callable[[str], Value], functions: Functions = FUNCTIONS) -> Value:
    """Evaluate an expression.

    Args:
        text: the expression.
        look_up: returns the value of a name; raises ExpressionError.
        functions: the functions that it may call, by their names.

    Raises:
        ExpressionError: it is none, or has no value.
    """
    if len(text) > MAX_LENGTH:
        raise ExpressionError(f"longer than {MAX_LENGTH} characters")
    try:
        tree = ast.parse(text.strip(), mode="eval")
        return Evaluation(look_up, functions).value(tree.body)
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
    """The value of an expression's tree; only the kinds of nodes below are in the language.

    Args:
        look_up: returns the value of a name.
        functions: functions by their names.
        turns: number of turns of loops so far, in a list, for those around this one, too.
    """

    def __init__(
        self,
        look_up: Callable[[str], Value],
        functions: Functions,
        turns: list[int] | None = None,
    ) -> None:
        self._look_up, self._functions = look_up, functions
        self._turns = [0] if turns is None else turns

    def value(self, node: ast.expr) -> Value:
        """Return the value of a node; raises ExpressionError."""
        match node:
            case ast.Constant(value=bool() | int() | float() | str() | None as value):
                return checked(value)
            case ast.Name(id=name):
                return self._look_up(name)
            case ast.List(elts=items) | ast.Tuple(elts=items):
                return checked([self.value(item) for item in items])
            case ast.Subscript(value=whole, slice=ast.Slice() as part):
                return self._part(self.value(whole), part)
            case ast.Subscript(value=whole, slice=place):
                return _item(self.value(whole), self.value(place))
            case ast.Attribute(value=ast.Name(id="math"), attr=name) if name in CONSTANTS:
                return CONSTANTS[name]
            case ast.Attribute(value=whole, attr=name):
                return _attribute(self.value(whole), name)
            case ast.Call(func=ast.Name(id="map"), args=[ast.Name(id=name), items]):
                function = self._function(name)
                return checked([checked(function(item)) for item in self._items(items)])
            case ast.Call(func=function, args=[item, kinds]) if _is_isinstance(function):
                return _is_of(self.value(item), _kinds(kinds))
            case ast.Call():
                return self._call(node)
            case (
                ast.ListComp(elt=item, generators=loops)
                | ast.GeneratorExp(elt=item, generators=loops)
            ):
                return checked(list(self._comprehended(item, loops)))
            case ast.IfExp(test=test, body=body, orelse=other):
                return self.value(body if self.value(test) else other)
            case ast.BoolOp(op=operation, values=parts):
                return self._any_or_all(parts, is_any=isinstance(operation, ast.Or))
            case ast.Compare(left=left, ops=operations, comparators=others):
                return self._compared(self.value(left), operations, others)
        return self._arithmetic(node)

    def _part(self, whole: Value, part: ast.Slice) -> Value:
        """Return the part of a list or a text between two numbers."""
        if not isinstance(whole, list | str):
            raise ExpressionError(f"{written(whole)[:40]} is neither a list nor a text")
        bounds: list[Any] = [
            None if bound is None else self.value(bound)
            for bound in (part.lower, part.upper, part.step)
        ]
        return checked(whole[slice(*bounds)])

    def _items(self, node: ast.expr) -> list[Any]:
        """Return what a loop goes over: the items of a list, keys, or the letters of a text."""
        whole = self.value(node)
        if not isinstance(whole, list | dict | str):
            raise ExpressionError(f"{written(whole)[:40]} is neither a list nor a dictionary")
        self._count(len(whole))
        return list(whole)

    def _count(self, n: int) -> None:
        """Count turns of loops, and the items of the lists that they make."""
        self._turns[0] += n
        if self._turns[0] > MAX_TURNS:
            raise ExpressionError(f"loops of more than {MAX_TURNS} turns")

    def _comprehended(self, item: ast.expr, loops: Sequence[ast.comprehension]) -> Iterator[Value]:
        """Give the items of ``[item for name in list if condition]``."""
        if not loops:
            value = self.value(item)
            self._count(len(value) if isinstance(value, list | dict) else 0)
            yield value
            return
        for each in self._items(loops[0].iter):
            names = _unpacked(loops[0].target, each)

            def look_up(name: str, names: dict[str, Value] = names) -> Value:
                return names[name] if name in names else self._look_up(name)

            inner = Evaluation(look_up, self._functions, self._turns)
            if all(inner.value(condition) for condition in loops[0].ifs):
                yield from inner._comprehended(item, loops[1:])

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
                return checked(FUNCTIONS["pow"](self.value(left), self.value(right)))
            case ast.BinOp(op=operation, left=left, right=right) if type(operation) in BINARY:
                return _binary(operation, self.value(left), self.value(right))
        raise ExpressionError(f"{ast.unparse(node)[:60]!r} is not in the language of expressions")

    def _any_or_all(self, parts: Sequence[ast.expr], *, is_any: bool) -> Value:
        result: Value = not is_any
        for part in parts:
            result = self.value(part)
            if bool(result) is is_any:
                break
        return result

    def _compared(
        self, left: Value, operations: Sequence[ast.cmpop], others: Sequence[ast.expr]
    ) -> bool:
        for operation, other in zip(operations, others, strict=True):
            right = self.value(other)
            if isinstance(operation, ast.Is | ast.IsNot):
                holds = _is_same(left, right) is isinstance(operation, ast.Is)
            else:
                holds = bool(COMPARE[type(operation)](left, right))
            if not holds:
                return False
            left = right
        return True

    def _call(self, node: ast.Call) -> Value:
        arguments = [self.value(each) for each in node.args]
        named = {each.arg: self.value(each.value) for each in node.keywords if each.arg is not None}
        if len(named) < len(node.keywords):
            raise ExpressionError(f"{ast.unparse(node)[:60]!r}: ** is not in the language")
        name = ast.unparse(node.func).removeprefix("math.").removeprefix("python.")
        if name in self._functions:
            if named and name not in ("dict", "xacro.tokenize"):
                raise ExpressionError(f"{name}() takes no named values")
            return checked(self._functions[name](*arguments, **named))
        if isinstance(node.func, ast.Attribute) and not named:
            found = None
            if not (isinstance(node.func.value, ast.Name) and node.func.value.id in MODULES):
                found = method(self.value(node.func.value), node.func.attr)
            if found is not None:
                return checked(found(*arguments))
        raise self._no_function(name)


def _is_same(left: Value, right: Value) -> bool:
    """Compare with ``is``, one side of which must be None, True or False."""
    if not any(each is single for each in (left, right) for single in SINGLE):
        raise ExpressionError("'is' compares only with None, True and False; write ==")
    return left is right


def _is_of(value: Value, kinds: tuple[type, ...]) -> bool:
    """Whether a value is of one of some kinds; a set is no list."""
    return DistinctItems in kinds if isinstance(value, DistinctItems) else isinstance(value, kinds)


def _is_isinstance(function: ast.expr) -> bool:
    return ast.unparse(function) in ("isinstance", "python.isinstance")


def _kinds(node: ast.expr) -> tuple[type, ...]:
    """Return the kinds that ``isinstance`` names: one, or several in brackets."""
    names = [ast.unparse(each) for each in (node.elts if isinstance(node, ast.Tuple) else [node])]
    names = [name.removeprefix("python.") for name in names]
    if unknown := [name for name in names if name not in KINDS]:
        raise ExpressionError(f"{unknown[0][:40]!r} is no kind of value, such as int or str")
    return tuple(KINDS[name] for name in names)


def _unpacked(target: ast.expr, value: Value) -> dict[str, Value]:
    """Return the names of a loop with their values: ``x``, or ``x, y`` for an item of two."""
    if isinstance(target, ast.Name):
        return {target.id: value}
    if isinstance(target, ast.Tuple | ast.List) and isinstance(value, list):
        if len(target.elts) != len(value):
            raise ExpressionError(f"{len(target.elts)} names for {len(value)} values")
        pairs = zip(target.elts, value, strict=True)
        return {name: one for part, item in pairs for name, one in _unpacked(part, item).items()}
    raise ExpressionError(f"{ast.unparse(target)[:40]!r} cannot be the name of an item")


def _item(whole: Value, place: Value) -> Value:
    """Return an item of a list by its number, of a dictionary by its key, or a letter of a text."""
    if isinstance(whole, dict):
        return checked(whole[place])
    if not isinstance(whole, list | str):
        raise ExpressionError(f"{written(whole)[:40]} is neither a list nor a dictionary")
    if not isinstance(place, int):
        raise ExpressionError(f"{written(place)[:40]!r} is no number of an item")
    if not -len(whole) <= place < len(whole):
        raise ExpressionError(f"there is no item {place}: the list has {len(whole)}")
    return whole[place]


def _attribute(whole: Value, name: str) -> Value:
    """Return an entry of a dictionary, written as ``dictionary.name``."""
    if not isinstance(whole, dict):
        raise ExpressionError(f"{written(whole)[:40]} has no entry {name[:40]!r}")
    if name not in whole:
        raise ExpressionError(
            f"the dictionary has no {name[:60]!r}.{did_you_mean(name, map(str, whole))}"
        )
    return checked(whole[name])


def _binary(operation: ast.operator, left: Value, right: Value) -> Value:
    if isinstance(operation, ast.Mod) and isinstance(left, str):
        return checked(formatted(left, right))
    if DistinctItems in (type(left), type(right)):
        if type(left) is not type(right) or not isinstance(operation, ON_SETS):
            raise ExpressionError(f"{left!r} and {right!r}: sets have - & | with sets"[:200])
        return checked(BINARY[type(operation)](left, right))
    is_whole = [isinstance(each, str | list) for each in (left, right)]
    if isinstance(operation, ast.Mult) and is_whole.count(True) == 1:
        return checked(repeated(left, right))
    kinds = {type(each) for each in (left, right) if isinstance(each, str | list)}
    if kinds and not (isinstance(operation, ast.Add) and type(left) is type(right)):
        what = "lists" if kinds == {list} else "texts"
        raise ExpressionError(f"{left!r} and {right!r}: {what} can only be added to {what}"[:200])
    return checked(BINARY[type(operation)](left, right))


def _number(value: Value) -> int | float:
    if not isinstance(value, int | float):
        raise ExpressionError(f"{written(value)[:40]!r} is not a number")
    return value
