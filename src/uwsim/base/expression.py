r"""Arithmetic expressions with named values in the syntax of muParser, for scores and error rates.

.. code-block:: text

    corners + centroid          done > 0 ? 100 - 2*taskTime : 0          max(a, b, 0)^2

From the loosest binding to the tightest:

=====================  ==========================================================
``c ? a : b``          b may be another ``? :``; a comparison is 1 or 0
``||``                 1 if one is not 0
``&&``                 1 if both are not 0
``< <= > >= == !=``    from left to right
``+ -``                from left to right
``* /``                from left to right
``-a``  ``+a``         looser than ``^``, as in muParser: ``-2^2`` is -4
``^``                  from right to left: ``2^3^2`` is 512; ``2^-1`` is 0.5
=====================  ==========================================================

The functions are in `FUNCTIONS`; the constants are ``_pi`` and ``_e``. ``log`` has the base **10**,
as in the muParser that UWSim used (newer versions: natural); ``log10`` and ``ln`` are unambiguous.
``rint`` rounds halves up. Angles are in radians. Numbers are float64. If an intermediate value is
not a finite number, the expression has no value: ``max(1, 0/0)``, ``1 || 1/0`` and ``1/(1/0)`` have
none. In ``? :`` and ``if``, the branch that is not chosen is ignored.

Python's ``eval`` is never called: a parsed expression is a list of steps that work on a stack. Not
in the language: assignments, strings, muParser's words ``and``, ``or``, ``xor``.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import UwsimError, did_you_mean
from .numerics import elementwise

if TYPE_CHECKING:
    import lark

MAX_LENGTH = 4096
"""The greatest length of an expression [characters]."""
MAX_DEPTH = 100
"""The greatest depth of nested brackets."""
CONSTANTS = {"_pi": math.pi, "_e": math.e}
GRAMMAR = r"""
    start: choice
    ?choice: or_ | or_ "?" choice ":" choice
    ?or_: and_ | or_ OR and_        -> binary
    ?and_: compared | and_ AND compared  -> binary
    ?compared: sum | compared COMPARE sum -> binary

    ?sum: product | sum SIGN product -> binary
    ?product: signed | product TIMES signed -> binary
    ?signed: power | SIGN signed -> signed

    ?power: atom | atom POWER exponent -> binary
    ?exponent: power | SIGN exponent -> signed
    ?atom: NUMBER -> number
        | NAME -> name
        | NAME "(" [choice ("," choice)*] ")" -> call
        | "(" choice ")"
    OR: "||"
    AND: "&&"
    COMPARE: "<=" | ">=" | "==" | "!=" | "<" | ">"
    SIGN: "+" | "-"
    TIMES: "*" | "/"
    POWER: "^"
    NAME: /[A-Za-z_][A-Za-z0-9_]*/
    NUMBER: /(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?/
    %ignore /[ \t\r\n]+/
"""

CONTEXT_LENGTH = 60
"""The length of the text that an error shows on either side of the error [characters]."""

Function = Callable[..., Any]


class ScoreError(UwsimError):
    """An expression that cannot be parsed, with the column of the error."""

    def __init__(self, text: str, column: int, message: str) -> None:
        self.text, self.column, self.message = text, column, message
        """The expression, the column of the error from 0, and the message without these."""
        super().__init__(f"{message}\n{self.marked_text()}")

    def marked_text(self) -> str:
        """Return the text, shortened, and on the next line a caret under the error."""
        start = max(0, self.column - CONTEXT_LENGTH)
        prefix = "..." if start else ""
        suffix = "..." if len(self.text) > self.column + CONTEXT_LENGTH else ""
        piece = prefix + _one_line(self.text[start : self.column + CONTEXT_LENGTH]) + suffix
        return f"  {piece}\n  {' ' * (len(prefix) + self.column - start)}^"


@dataclass(frozen=True)
class Score:
    """The value of an expression, or the reason why it has none."""

    value: float | None
    """The number; None if there is none."""
    reason: str | None = None
    """The reason why there is no number."""


@dataclass(frozen=True)
class _Step:
    """A step that replaces the topmost numbers of the stack by one number."""

    column: int
    """The column of the step in the expression, from 0."""
    n_operands: int
    """The number of numbers that are removed from the stack."""
    function: Function | None = None
    """The function of these numbers; None for a constant or a name."""
    constant: float | None = None
    """The constant that is put on the stack."""
    name: str = ""
    """The name whose value is put on the stack, if there is no function and no constant."""


@dataclass(frozen=True)
class Expression:
    """A parsed expression over named numbers."""

    text: str
    """The text as written."""
    names: tuple[str, ...]
    """The names in the text, in the order of appearance."""
    steps: tuple[_Step, ...]
    """The steps in postfix order."""

    def evaluate(self, values: Mapping[str, float | None]) -> float | None:
        """Return the value; None if a named number has none, or the value is not finite."""
        return self.score(values).value

    def score(self, values: Mapping[str, float | None]) -> Score:
        """Return the value, or the reason why there is none."""
        missing_names = [name for name in self.names if values[name] is None]
        if missing_names:
            return Score(None, f"no value for {', '.join(missing_names)}")
        stack: list[tuple[float, _Step | None]] = []  # number; step that gave a non-finite number
        with np.errstate(all="ignore"):
            for step in self.steps:
                operands = stack[len(stack) - step.n_operands :]
                del stack[len(stack) - step.n_operands :]
                stack.append(self._apply_step(step, operands, values))
        [(result, faulty_step)] = stack
        if faulty_step is None:
            return Score(result)
        place = f", from column {faulty_step.column + 1} of {self.text!r} on"
        return Score(None, f"the function gives {result}{place}")

    def _apply_step(
        self,
        step: _Step,
        operands: list[tuple[float, _Step | None]],
        values: Mapping[str, float | None],
    ) -> tuple[float, _Step | None]:
        """Return the result of a step, or its first operand that is not finite."""
        if step.function is _choose and operands[0][1] is None:
            return operands[1] if operands[0][0] != 0.0 else operands[2]
        for number, faulty_step in operands:
            if faulty_step is not None:
                return number, faulty_step
        result = self._compute(step, [number for number, _ in operands], values)
        return result, None if math.isfinite(result) else step

    @staticmethod
    def _compute(step: _Step, operands: list[float], values: Mapping[str, float | None]) -> float:
        if step.function is not None:
            return float(step.function(*(np.float64(number) for number in operands)))
        if step.constant is not None:
            return step.constant
        value = values[step.name]
        assert value is not None
        return float(value)


def parse(text: str, names: Collection[str], *, kind: str = "measure") -> Expression:
    """Parse an expression over numbers called ``names``.

    Args:
        text: the expression.
        names: the names of the numbers.
        kind: the noun for the named numbers in error messages.

    Raises:
        ScoreError: a syntax error, an unknown name or function, a wrong number of arguments, or
            an expression longer than 4096 characters or with brackets deeper than 100 levels.
    """
    text = text.strip()
    if not text:
        raise ScoreError(text, 0, "the function is empty; expected an expression")
    if len(text) > MAX_LENGTH:
        raise ScoreError(text[:60] + " ...", 0, f"longer than {MAX_LENGTH} characters")
    text = _one_line(text)
    _check_depth(text)
    steps, names_used = _compile(_tree(text), text, tuple(names), kind)
    return Expression(text, tuple(names_used), tuple(steps))


def _tree(text: str) -> lark.Tree[Any]:
    import lark

    try:
        return _parser().parse(text)
    except lark.exceptions.UnexpectedCharacters as error:
        column = error.pos_in_stream or 0
        raise ScoreError(text, column, f"{text[column]!r} is not allowed here") from None
    except lark.exceptions.UnexpectedToken as error:
        if error.token.type == "$END":
            raise ScoreError(text, len(text), "the expression ends too early") from None
        column = error.token.start_pos or 0
        raise ScoreError(text, column, f"{str(error.token)!r} is not allowed here") from None


def _one_line(text: str) -> str:
    return "".join(" " if letter.isspace() else letter for letter in text)


def _check_depth(text: str) -> None:
    depth = 0
    for column, letter in enumerate(text):
        depth += (letter == "(") - (letter == ")")
        if depth > MAX_DEPTH:
            raise ScoreError(text, column, f"brackets nested deeper than {MAX_DEPTH} levels")


@functools.cache
def _parser() -> lark.Lark:
    import lark

    return lark.Lark(GRAMMAR, parser="lalr", propagate_positions=True)


def _compile(
    tree: lark.Tree[Any], text: str, names: tuple[str, ...], kind: str
) -> tuple[list[_Step], dict[str, None]]:
    """Convert a syntax tree to steps and the names used, without recursion: it may be very deep."""
    steps: list[_Step] = []
    names_used: dict[str, None] = {}
    stack: list[lark.Tree[Any] | _Step] = [tree]
    while stack:
        node = stack.pop()
        if isinstance(node, _Step):
            steps.append(node)
            continue
        column = getattr(node.meta, "start_pos", 0)
        parts = [part for part in node.children if part is not None]
        if node.data == "number":
            steps.append(_Step(column, 0, constant=_number(str(parts[0]), column, text)))
        elif node.data == "name":
            steps.append(_name(str(parts[0]), column, text, names, kind, names_used))
        else:
            tokens = [part for part in parts if isinstance(part, str)]  # lark's are texts
            operands = [part for part in parts if not isinstance(part, str)]
            if node.data != "start":
                stack.append(_operation(node.data, tokens, len(operands), column, text))
            stack.extend(reversed(operands))
    return steps, names_used


def _number(word: str, column: int, text: str) -> float:
    number = float(word)
    if not math.isfinite(number):
        raise ScoreError(text, column, f"{word[:20]} is beyond the largest number, 1.8e308")
    return number


def _name(
    name: str,
    column: int,
    text: str,
    names: tuple[str, ...],
    kind: str,
    names_used: dict[str, None],
) -> _Step:
    if name in names:
        names_used[name] = None
        return _Step(column, 0, name=name)
    if name in CONSTANTS:
        return _Step(column, 0, constant=CONSTANTS[name])
    if name in FUNCTIONS:
        raise ScoreError(text, column, f"{name} is a function; expected {name}(...)")
    valid_names = ", ".join(names) or "none"
    suggestion = did_you_mean(name, [*names, *CONSTANTS])
    raise ScoreError(
        text, column, f"no {kind} is called {name!r}.{suggestion} Known: {valid_names}"
    )


def _operation(kind: str, tokens: list[Any], count: int, column: int, text: str) -> _Step:
    if kind == "choice":
        return _Step(column, 3, _choose)
    if kind == "signed":
        return _Step(column, 1, np.negative if tokens[0] == "-" else np.positive)
    if kind == "binary":
        return _Step(tokens[0].start_pos or 0, 2, OPERATORS[str(tokens[0])])
    name = str(tokens[0])
    if name not in FUNCTIONS:
        suggestion = did_you_mean(name, FUNCTIONS) or f" Known: {', '.join(FUNCTIONS)}"
        raise ScoreError(text, column, f"no function is called {name!r}.{suggestion}")
    n_expected, function = FUNCTIONS[name]
    if count != n_expected if n_expected is not None else count == 0:
        expected = "at least 1 argument" if n_expected is None else f"{n_expected} argument(s)"
        raise ScoreError(text, column, f"{name} takes {expected}, not {count}")
    return _Step(column, count, function)


def _choose(condition: float, value_if_true: float, value_if_false: float) -> float:
    return value_if_true if condition != 0.0 else value_if_false


def _sum(*values: float) -> float:
    total = values[0]
    for value in values[1:]:
        total = total + value
    return total


def _mean(*values: float) -> float:
    return _sum(*values) / len(values)


def _rint(value: float) -> float:
    return float(np.floor(value + 0.5))


OPERATORS: dict[str, Function] = {
    "||": lambda a, b: a != 0.0 or b != 0.0,
    "&&": lambda a, b: a != 0.0 and b != 0.0,
    "<": np.less,
    "<=": np.less_equal,
    ">": np.greater,
    ">=": np.greater_equal,
    "==": np.equal,
    "!=": np.not_equal,
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": np.divide,
    "^": elementwise.power,
}
"""The binary operators."""

FUNCTIONS: dict[str, tuple[int | None, Function]] = {
    "abs": (1, np.abs),
    "acos": (1, elementwise.arccos),
    "acosh": (1, elementwise.arccosh),
    "asin": (1, elementwise.arcsin),
    "asinh": (1, elementwise.arcsinh),
    "atan": (1, elementwise.arctan),
    "atan2": (2, elementwise.arctan2),
    "atanh": (1, elementwise.arctanh),
    "avg": (None, _mean),
    "cos": (1, np.cos),
    "cosh": (1, elementwise.cosh),
    "exp": (1, elementwise.exp),
    "if": (3, _choose),
    "ln": (1, elementwise.log),
    "log": (1, elementwise.log10),
    "log10": (1, elementwise.log10),
    "log2": (1, elementwise.log2),
    "max": (None, lambda *values: max(values)),
    "min": (None, lambda *values: min(values)),
    "rint": (1, _rint),
    "sign": (1, np.sign),
    "sin": (1, np.sin),
    "sinh": (1, elementwise.sinh),
    "sqrt": (1, np.sqrt),
    "sum": (None, _sum),
    "tan": (1, elementwise.tan),
    "tanh": (1, elementwise.tanh),
}
"""The functions by name: the number of arguments (None: one or more), and the function."""
