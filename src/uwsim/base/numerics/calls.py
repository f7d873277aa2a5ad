"""Compiled functions that other compiled code calls by their address.

So a lower layer can call functions that higher layers define. Such a function is
``void(parameters, values, time)``: it reads its parameters from a record at the address
``parameters``, writes its results at the address ``values``, and receives the time [s].
`function_address` compiles a Python function with this signature.
"""

from __future__ import annotations

import functools
import importlib
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt
from numba import types
from numba.extending import intrinsic

from .jit import compile_c_function, njit
from .memory import Floats

ir: Any = importlib.import_module("llvmlite.ir")  # of numba; it has no types

SIGNATURE = types.void(types.intp, types.intp, types.float64)
"""The types of the addresses of parameters and values, and of the time [s]."""

FUNCTION = np.dtype([("function", np.int64), ("parameters", np.int64)])
"""The addresses of a function (0: there is none) and of its parameters."""


def prepare_nothing(end: float) -> None:
    """Prepare nothing, for functions whose inputs need no update."""


@dataclass(frozen=True, kw_only=True, eq=False)
class CompiledFunction:
    """A function that other compiled code calls by its address."""

    addresses: tuple[int, int]
    """The addresses of the function and of its parameters (`FUNCTION`)."""
    prepare: Callable[[float], None] = prepare_nothing
    """A Python function that updates the inputs of the compiled function to a time [s]."""
    memory_owners: tuple[object, ...] = field(default=())
    """The objects whose memory the addresses refer to; they must not be freed."""


def _call(
    typingctx: Any, function: Any, parameters: Any, values: Any, time: Any
) -> Any:  # as numba's interface has it
    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        word, double = ir.IntType(64), ir.DoubleType()
        kind = ir.FunctionType(ir.VoidType(), [word, word, double])
        builder.call(builder.inttoptr(args[0], kind.as_pointer()), args[1:])
        return context.get_dummy_value()

    return types.void(types.intp, types.intp, types.intp, types.float64), codegen


def _call_both(typingctx: Any, function: Any, first_argument: Any, second_argument: Any) -> Any:
    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        word = ir.IntType(64)
        kind = ir.FunctionType(ir.VoidType(), [word, word])
        builder.call(builder.inttoptr(args[0], kind.as_pointer()), args[1:])
        return context.get_dummy_value()

    return types.void(types.intp, types.intp, types.intp), codegen


def _call_three(typingctx: Any, function: Any, a: Any, b: Any, c: Any) -> Any:
    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        word = ir.IntType(64)
        kind = ir.FunctionType(word, [word, word, word])
        return builder.call(builder.inttoptr(args[0], kind.as_pointer()), args[1:])

    return types.intp(types.intp, types.intp, types.intp, types.intp), codegen


def _call_numbered(typingctx: Any, function: Any, a: Any, b: Any, n: Any, c: Any) -> Any:
    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        word, integer = ir.IntType(64), ir.IntType(32)
        kind = ir.FunctionType(ir.VoidType(), [word, word, integer, word])
        arguments = [args[1], args[2], builder.trunc(args[3], integer), args[4]]
        builder.call(builder.inttoptr(args[0], kind.as_pointer()), arguments)
        return context.get_dummy_value()

    words = (types.intp, types.intp, types.intp, types.intp, types.intp)
    return types.void(*words), codegen


def _call_word(typingctx: Any, function: Any, argument: Any) -> Any:
    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        word = ir.IntType(64)
        kind = ir.FunctionType(word, [word])
        return builder.call(builder.inttoptr(args[0], kind.as_pointer()), args[1:])

    return types.uint64(types.intp, types.intp), codegen


call: Any = intrinsic(_call)
"""``call(function, parameters, values, time)`` calls a function in this module's sense."""
call_both: Any = intrinsic(_call_both)
"""``call_both(function, first, second)`` calls a C function ``void(void*, void*)``."""
call_three: Any = intrinsic(_call_three)
"""``call_three(function, a, b, c)`` calls a C function ``void*(void*, void*, void*)``."""
call_numbered: Any = intrinsic(_call_numbered)
"""``call_numbered(function, a, b, n, c)`` calls a C ``void(void*, void*, int, void*)``."""
call_word: Any = intrinsic(_call_word)
"""``call_word(function, argument)`` calls a C function ``uint64_t(void*)``."""


@njit
def evaluate(function: int, parameters: int, n: int, time: float) -> Floats:
    """Call a function from Python; return its ``n`` values at ``time`` [s], (n,).

    Args:
        function: the address of the function.
        parameters: the address of its parameters.
        n: the number of values that it writes.
        time: the time [s].
    """
    values = np.empty(n)
    call(function, parameters, values.ctypes.data, time)
    return values


@functools.cache
def _compile(function: Callable[[int, int, float], None]) -> Any:
    return compile_c_function(function, SIGNATURE)


def function_address(function: Callable[[int, int, float], None]) -> int:
    """Compile a module's function with the signature `SIGNATURE`, once; return its address."""
    return int(_compile(function).address)


def address_of(array: npt.NDArray[Any]) -> int:
    """Return the address of the first number of an array, which must not be freed."""
    return int(array.ctypes.data)
