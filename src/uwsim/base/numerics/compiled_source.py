"""A digest of the source of a compiled function: its code, the functions it calls, its constants.

numba's own cache on disk checks only the file that defines the function. A constant in another
module, or a function that is called, may change without a change of this file.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from types import CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np


def source_digest(function: FunctionType) -> str:
    """Return a digest of a function, of the functions that it calls and of its constants.

    The options of the compilation enter, too.

    Functions that numba does not compile from Python (of numpy, intrinsics) enter by their names.
    """
    digest = hashlib.sha256()
    functions_left, functions_seen = [function], {function}
    while functions_left:
        current_function = functions_left.pop()
        for name, value in _named_values(current_function):
            python_function = getattr(value, "py_func", None)
            if isinstance(python_function, FunctionType):
                value = python_function.__qualname__
                if python_function not in functions_seen:
                    functions_seen.add(python_function)
                    functions_left.append(python_function)
            digest.update(f"{name}={_constant_text(value)};".encode())
        dispatcher = current_function.__globals__.get(current_function.__name__)
        options = getattr(dispatcher, "targetoptions", {})
        digest.update(repr(sorted(options.items())).encode())
        digest.update(_code_bytes(current_function.__code__))
    return digest.hexdigest()


def _named_values(function: FunctionType) -> Iterator[tuple[str, Any]]:
    """Yield the global names in a function's code, and attributes of modules, with their values."""
    code, names = function.__code__, function.__globals__
    modules = []
    for name in code.co_names:
        if name in names:
            yield name, names[name]
            if isinstance(names[name], ModuleType):
                modules.append(names[name])
    for module in modules:
        for name in code.co_names:
            if hasattr(module, name):
                yield f"{module.__name__}.{name}", getattr(module, name)
    for name, cell in zip(code.co_freevars, function.__closure__ or (), strict=True):
        yield name, cell.cell_contents


def _constant_text(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"{value.dtype}{value.shape}{value.tobytes().hex()}"
    if isinstance(value, np.dtype):
        return repr(value)
    if isinstance(value, bool | int | float | complex | str | bytes | tuple | None):
        return repr(value)
    return str(getattr(value, "__name__", type(value).__qualname__))


def _code_bytes(code: CodeType) -> bytes:
    constants = []
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            constants.append(_code_bytes(constant).hex())
        else:  # the order of a set depends on hashes
            constants.append(
                repr(sorted(map(repr, constant)) if isinstance(constant, frozenset) else constant)
            )
    return code.co_code + repr((code.co_varnames, code.co_names, constants)).encode()
